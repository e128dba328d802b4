# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The shipped slider-crank with friction by reactions, as one would write it for CasADi by hand: one coordinate, the crank's angle, and the
reactions as algebraic unknowns. Numbers are those of urdf/slider_crank_haug.urdf and config/slider_crank_haug.yaml.
"""
import casadi

START = (0.08, 0.3, 0.05, 0.025, 1.0)  # crank_length, rod_length, slider_length, slider_width, Kp
CENTRE = (0.0, 0.1, 0.12)
CRANK_INERTIA, ROD_MASS, SLIDER_MASS, GRAVITY = 1e-4, 0.5, 2.0, 9.81
ROD_INERTIA = (4e-3, 4e-4, 4e-3)
MU_STATIC, MU_DYNAMIC, TRANSITION, SMOOTHING = 0.4, 0.3, 0.01, 0.01
SPEED, DURATION = -10.0, 2.0


def rates_of(function, angle, rate, acceleration):
    """First and second derivative in time of a function of the angle."""
    first = casadi.jacobian(function, angle)
    return first * rate, first * acceleration + casadi.jacobian(first, angle) * rate ** 2


def friction(force, torque, speed, p):
    """Theory (10) to (12): the force of friction on the slider."""
    def magnitude(x):
        return casadi.sqrt(x ** 2 + SMOOTHING ** 2)
    length, width = p[2], p[3]
    normal = (magnitude(-force[1] + torque[2] / length) + magnitude(-force[2] - torque[1] / length) + magnitude(torque[2] / length)
              + magnitude(torque[1] / length) + 2.0 * magnitude(0.5 * torque[0] / width))
    u = speed / TRANSITION
    return -normal * (MU_DYNAMIC * casadi.tanh(4.0 * u) + (MU_STATIC - MU_DYNAMIC) * u / (0.25 * u ** 2 + 0.75) ** 2)


def system():
    """x = (angle, rate, psi); z = (acceleration, forces of crank and slider on the rod, torque of its universal joint)."""
    x, z, p = casadi.SX.sym("x", 3), casadi.SX.sym("z", 8), casadi.SX.sym("p", 5)
    angle, rate, acceleration, on_rod, by_slider, twist = x[0], x[1], z[0], z[1:4], z[4:7], z[7]
    pin = casadi.vertcat(CENTRE[0], CENTRE[1] - p[0] * casadi.sin(angle), CENTRE[2] + p[0] * casadi.cos(angle))
    place = casadi.sqrt(p[1] ** 2 - pin[1] ** 2 - pin[2] ** 2)
    slider = casadi.vertcat(place, 0.0, 0.0)
    along = (pin - slider) / p[1]
    up = casadi.DM([0.0, 0.0, 1.0])
    across = casadi.cross(along, up)
    across = across / casadi.norm_2(across)
    axes = casadi.horzcat(across, along, casadi.cross(across, along))
    spin = casadi.inv_skew(casadi.reshape(casadi.jacobian(casadi.vec(axes), angle), 3, 3) @ axes.T)  # per rate
    inertia = axes @ casadi.diag(casadi.DM(ROD_INERTIA)) @ axes.T
    momentum = inertia @ spin
    _, rod_acceleration = rates_of(0.5 * (pin + slider), angle, rate, acceleration)
    speed, slider_acceleration = rates_of(place, angle, rate, acceleration)
    turned = momentum * acceleration + casadi.jacobian(momentum, angle) * rate ** 2
    normal = casadi.cross(across, up)
    half = 0.5 * p[1] * along
    effort = -p[4] * (rate - SPEED)
    guide_force = casadi.vertcat(0.0, by_slider[1], by_slider[2] + SLIDER_MASS * GRAVITY)
    push = friction(guide_force, twist * normal, speed, p)
    pin_arm = pin - casadi.DM(CENTRE)
    algebraic = casadi.vertcat(
        ROD_MASS * (rod_acceleration + GRAVITY * up) - on_rod - by_slider,
        turned - casadi.cross(half, on_rod) + casadi.cross(half, by_slider) - twist * normal,
        CRANK_INERTIA * acceleration - effort + casadi.cross(pin_arm, on_rod)[0],
        SLIDER_MASS * slider_acceleration + by_slider[0] - push)
    ode = casadi.vertcat(rate, acceleration, (rate - SPEED) ** 2 + 0.01 * effort ** 2)
    return {"x": x, "z": z, "p": p, "ode": ode, "alg": algebraic}


def prepare(tolerance, with_gradient):
    options = {"reltol": tolerance, "abstol": 0.01 * tolerance, "max_num_steps": 1_000_000, "suppress_algebraic": True, "jit": not with_gradient, "compiler": "shell",
               "jit_options": {"flags": ["-O2", "-march=native"], "verbose": False}}
    run = casadi.integrator("run", "idas", system(), 0.0, DURATION, options)
    # With sensitivities, compilers take minutes for each tolerance: CasADi then interprets its expressions.
    guess = [0.0, 0.0, 0.0, 2.5, 0.0, 0.0, 2.5, 0.0]
    if not with_gradient:
        def motion():
            psi = float(run(x0=[0.0, 0.0, 0.0], z0=guess, p=START)["xf"][2])
            return run.stats().get("nsteps", 0), [psi]
        return motion
    p = casadi.MX.sym("p", 5)
    psi = run(x0=[0.0, 0.0, 0.0], z0=guess, p=p)["xf"][2]
    gradient = casadi.Function("gradient", [p], [casadi.jtimes(psi, p, casadi.DM.eye(5))])
    return lambda: (0, gradient(START).full().ravel())
