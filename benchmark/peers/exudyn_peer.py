# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Exudyn: a kinematic tree in minimal coordinates, with its explicit integrators with error control, or generalized alpha with one step size.

Damping is the tree's own control of rates. Dry friction by the law of the study is a function in Python, which its C++ code calls. Gradients:
central differences.
"""
import importlib.metadata

import exudyn as exu
import exudyn.utilities as utilities
import numpy as np
import tree

ADAPTIVE = {"DOPRI5": exu.DynamicSolverType.DOPRI5, "ODE23": exu.DynamicSolverType.ODE23}
FIXED = {"RK44": exu.DynamicSolverType.RK44, "RK67": exu.DynamicSolverType.RK67, "generalized alpha": exu.DynamicSolverType.GeneralizedAlpha}


def version():
    return importlib.metadata.version("exudyn")


def build(case, factors):
    """The system with one kinematic tree. @param factors of (kind, link)"""
    links = tree.read(case)
    count = len(links)
    mass_factor = [factors.get(("mass", link.name), 1.0) for link in links]
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(utilities.NodeGenericODE2(
        numberOfODE2Coordinates=count, referenceCoordinates=[0.0] * count, initialCoordinates=[link.position for link in links],
        initialCoordinates_t=[0.0] * count))
    dry = np.array([link.friction for link in links])
    law = {"forceUserFunction": lambda mbs, t, item, q, v: -dry * np.tanh(400.0 * np.array(v))} if dry.any() else {}
    mbs.AddObject(utilities.ObjectKinematicTree(
        nodeNumber=node, jointTypes=[getattr(exu.JointType, f"Revolute{'XYZ'[link.axis]}") for link in links],
        linkParents=[link.parent for link in links], jointTransformations=exu.Matrix3DList([link.frame for link in links]),
        jointOffsets=exu.Vector3DList([link.origin for link in links]),
        linkInertiasCOM=exu.Matrix3DList([factor * np.diag(link.moments) for factor, link in zip(mass_factor, links)]),
        linkCOMs=exu.Vector3DList([link.centre for link in links]), linkMasses=[factor * link.mass for factor, link in zip(mass_factor, links)],
        baseOffset=[0.0, 0.0, 0.0], gravity=[0.0, 0.0, -9.81], jointPControlVector=[0.0] * count, jointPositionOffsetVector=[0.0] * count, jointVelocityOffsetVector=[0.0] * count,
        jointDControlVector=[link.damping * factors.get(("damping", link.name), 1.0) for link in links], **law))
    mbs.Assemble()
    order = [link.joint for link in links]
    return mbs, node, [order.index(name) for name in case.joints]


def settings_of(case, method, setting):
    options = exu.SimulationSettings()
    run = options.timeIntegration
    run.endTime = case.duration
    run.verboseMode = 0
    options.displayStatistics = False
    options.solutionSettings.writeSolutionToFile = False
    options.solutionSettings.sensorsWritePeriod = case.duration
    if method in ADAPTIVE:
        run.numberOfSteps = 1
        run.initialStepSize = 1e-4 * case.duration
        run.automaticStepSize = True
        run.relativeTolerance, run.absoluteTolerance = setting, 0.1 * setting
        run.minimumStepSize = 1e-10
        return options, ADAPTIVE[method]
    run.numberOfSteps = max(1, int(np.ceil(case.duration / setting - 1e-9)))
    run.automaticStepSize = False
    if method == "generalized alpha":
        run.newton.useModifiedNewton = True
        run.generalizedAlpha.spectralRadius = 1.0
        run.newton.relativeTolerance, run.newton.absoluteTolerance = 1e-10, 1e-12
    return options, FIXED[method]


def prepare(case, method, setting):
    method = method.split(", ")[0]
    options, solver = settings_of(case, method, setting)
    h = np.cbrt(setting) if method in ADAPTIVE else 1e-4

    def simulate(built):
        mbs, node, order = built
        mbs.SolveDynamic(options, solverType=solver)
        q = np.array(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates))
        steps = mbs.sys["dynamicSolver"].it.currentStepIndex if "dynamicSolver" in mbs.sys else options.timeIntegration.numberOfSteps
        return steps, q[order]

    if not case.parameters:
        built = build(case, {})
        return lambda: simulate(built)
    moved = [[build(case, {(kind, link): 1.0 + sign * h}) for sign in (1.0, -1.0)] for kind, link in case.parameters]

    def gradient():
        total, values = 0, []
        for pair in moved:
            runs = [simulate(built) for built in pair]
            total += sum(steps for steps, _ in runs)
            values.append((runs[0][1] @ runs[0][1] - runs[1][1] @ runs[1][1]) / (2.0 * h))
        return total, values

    return gradient
