# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The tasks, and the programs with their best settings: a table that race.py goes through."""
import dataclasses

OWN = "mechanism_codesign"
TOLERANCES = [10.0 ** -k for k in range(2, 12)]  # from loose to tight
STEPS = [1e-2 * 2.0 ** -k for k in range(0, 20)]  # s


@dataclasses.dataclass(frozen=True)
class Task:
    name: str
    title: str
    errors: tuple
    reference: tuple  # method and tolerance of the reference, by our program


TASKS = [
    Task("arm", "arm of a UR5's shape swings 5 s, viscous friction", (1e-3, 1e-6), ("rodas5p", 1e-11)),
    Task("humanoid", "humanoid of Valkyrie's shape, 32 joints, falls 1 s, viscous friction", (1e-3, 1e-6), ("rodas5p", 1e-11)),
    Task("slider_crank", "slider-crank 2 s, friction by reactions: objective", (1e-3, 1e-6), ("rodas5p", 1e-11)),
    Task("arm_identify", "identification of 5 numbers of the arm from 2 s of its motion", (1e-3, 1e-5), None),
    Task("arm_gradient", "gradient of the arm by 5 parameters", (1e-3, 1e-6), ("rodas5p:direct", 1e-11)),
    Task("slider_crank_gradient", "gradient of the slider-crank by 5 parameters", (1e-3, 1e-5), ("rodas5p, controlled", 1e-10)),
    Task("humanoid_dry", "humanoid of Talos's shape, 32 joints, falls 0.5 s, dry friction", (1e-3, 1e-6), ("rodas5p", 1e-11)),
    Task("humanoid_gradient", "gradient of the humanoid by 64 parameters", (1e-3, 1e-6), ("rodas5p:direct", 1e-11)),
]
GRADIENTS = ("arm_gradient", "humanoid_gradient")
MOTIONS = ("arm", "humanoid", "humanoid_dry")
SLIDER_CRANK = ("slider_crank", "slider_crank_gradient")


@dataclasses.dataclass(frozen=True)
class Code:
    name: str
    packages: tuple  # of PyPI
    source: str
    call: str  # how it is called
    module: str  # of this folder; "": the benchmark program; "pinocchio_run": a program that is compiled
    methods: dict  # task -> [(method, settings)]
    cannot: dict  # task -> reason


def each(tasks, methods, settings):
    return {task: [(method, settings) for method in methods] for task in tasks}


NO_REACTIONS = "no friction by reactions of joints"
CODES = [
    Code(OWN, (), "this repository", "equations recorded, differentiated and compiled for the model; Rosenbrock methods", "",
         {**each(MOTIONS, ["auto"], TOLERANCES), **each(GRADIENTS, ["auto:direct", "auto:adjoint"], TOLERANCES),
          **each(["slider_crank"], ["rodas4", "rodas5p"], TOLERANCES), **each(["slider_crank_gradient"], ["rodas5p", "rodas5p, controlled"], TOLERANCES),
          **each(["arm_identify"], ["motion"], TOLERANCES)}, {}),
    Code("Drake", ("drake",), "https://drake.mit.edu", "MultibodyPlant in continuous time, error-controlled integrators of its Simulator; AutoDiffXd", "drake_peer",
         {**each(("arm", "humanoid"), ["runge_kutta3"], TOLERANCES), **each(["humanoid_dry"], ["radau3"], TOLERANCES),
          **each(GRADIENTS, ["runge_kutta3"], TOLERANCES)},
         {**{task: "no loops in continuous time, " + NO_REACTIONS for task in SLIDER_CRANK}, "arm_identify": "no toolbox"}),
    Code("Pinocchio", ("pin",), "https://github.com/stack-of-tasks/pinocchio",
         "aba() and computeABADerivatives() from C++; it has no integrator: the pair of Dormand and Prince of benchmark/, or CVODE with the exact Jacobian",
         "pinocchio_run",
         {**each(("arm", "humanoid"), ["pair"], TOLERANCES), **each(["humanoid_dry"], ["CVODE BDF"], TOLERANCES), **each(GRADIENTS, ["pair"], TOLERANCES)},
         {**{task: NO_REACTIONS for task in SLIDER_CRANK}, "arm_identify": "no toolbox"}),
    Code("MuJoCo", ("mujoco[sysid]",), "https://mujoco.org", "steps of one size in mujoco.rollout; mujoco.sysid", "mujoco_peer",
         {**each(("arm", "humanoid"), ["RK4"], STEPS), **each(["humanoid_dry"], ["RK4, callback", "implicitfast, own law"], STEPS),
          **each(GRADIENTS, ["RK4, differences"], STEPS), **each(["arm_identify"], ["RK4, sysid"], STEPS)},
         {task: NO_REACTIONS for task in SLIDER_CRANK}),
    Code("CasADi", ("casadi",), "https://web.casadi.org", "an articulated-body algorithm as expressions, as C code, in its CVODES; IDAS for the slider-crank", "casadi_peer",
         {**each(("arm", "humanoid"), ["Adams"], TOLERANCES), **each(["humanoid_dry"], ["BDF direct", "BDF gmres"], TOLERANCES),
          **each(GRADIENTS, ["Adams, adjoint"], TOLERANCES),
          **each(["slider_crank"], ["IDAS"], TOLERANCES), **each(["slider_crank_gradient"], ["IDAS, forward"], TOLERANCES)},
         {"arm_identify": "no toolbox"}),
    Code("Exudyn", ("exudyn",), "https://github.com/jgerstmayr/EXUDYN", "a kinematic tree in minimal coordinates, its C++ integrators; differences", "exudyn_peer",
         {**each(("arm", "humanoid"), ["DOPRI5"], TOLERANCES), **each(["humanoid_dry"], ["DOPRI5"], TOLERANCES), **each(GRADIENTS, ["DOPRI5, differences"], TOLERANCES)},
         {**{task: NO_REACTIONS for task in SLIDER_CRANK}, "arm_identify": "not by sensitivities"}),
    Code("SUNDIALS", (), "Debian, libsundials-dev", "IDAS with our residual and, KLU, our exact Jacobian; staggered sensitivities", "",
         each(SLIDER_CRANK, ["SUNDIALS, KLU", "SUNDIALS, dense"], TOLERANCES),
         {task: "no mechanisms of its own" for task in MOTIONS + GRADIENTS + ("arm_identify",)}),
    Code("Simbody", (), "Debian, libsimbody-dev", "its joints and its Runge-Kutta-Merson integrator; differences", "",
         {**each(("arm", "humanoid"), ["Simbody"], TOLERANCES), **each(GRADIENTS, ["Simbody"], TOLERANCES)},
         {"humanoid_dry": "only by its CPODES, which clashes with SUNDIALS", **{task: NO_REACTIONS for task in SLIDER_CRANK}, "arm_identify": "no toolbox"}),
]
