# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Drake: MultibodyPlant in continuous time, its own integrators with error control; gradients by its AutoDiffXd."""
import functools
import importlib.metadata

import numpy as np
import tree
from pydrake.autodiffutils import AutoDiffXd, ExtractGradient, InitializeAutoDiff
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import SpatialInertia_, UnitInertia_
from pydrake.symbolic import Variable, tanh
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator_
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import SymbolicVectorSystem


def version():
    return importlib.metadata.version("drake")


def friction_of(plant, case):
    """The dry friction of each velocity [N m], which Drake's parser does not keep."""
    friction = np.zeros(plant.num_velocities())
    for link in tree.read(case):
        friction[plant.GetJointByName(link.joint).velocity_start()] = link.friction
    return friction


@functools.lru_cache(maxsize=None)
def diagram(path, name, folder):
    """The diagram and its plant. Dry friction is an expression of Drake, evaluated without Python."""
    from worker import Case
    case = Case(folder, name)
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(0.0))
    Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("base"))
    plant.Finalize()
    friction = friction_of(plant, case)
    if friction.any():
        state = [Variable(f"x{k}") for k in range(plant.num_multibody_states())]
        rates = state[plant.num_positions():]
        idle = Variable("idle")  # its time derivative is asked for, and fails without a state
        law = builder.AddSystem(SymbolicVectorSystem(input=state, state=[idle], dynamics=[-idle],
                                                     output=[-f * tanh(400.0 * v) for f, v in zip(friction, rates)]))
        builder.Connect(plant.get_state_output_port(), law.get_input_port())
        builder.Connect(law.get_output_port(), plant.get_applied_generalized_force_input_port())
    return builder.Build(), plant


def start_of(plant, case):
    q = np.zeros(plant.num_positions())
    for name, position in zip(case.joints, case.start):
        q[plant.GetJointByName(name).position_start()] = position
    return q


def places(plant, case):
    return [plant.GetJointByName(name).position_start() for name in case.joints]


def simulator_for(system, method, tolerance, scalar):
    simulator = Simulator_[scalar](system)
    integrator = ResetIntegratorFromFlags(simulator, method, 0.1)
    integrator.set_target_accuracy(tolerance)
    integrator.set_fixed_step_mode(False)
    return simulator


def set_parameters(case, plant, context, values):
    """Scales masses, with inertias, and dampings."""
    for (kind, link), value in zip(case.parameters, values):
        if kind == "damping":
            joint = plant.GetJointByName(f"{link}_joint")
            joint.SetDampingVector(context, np.array([value * joint.default_damping_vector()[0]]))
            continue
        body = plant.GetBodyByName(link)
        inertia = body.default_spatial_inertia()
        unit = inertia.get_unit_inertia()
        moments, products = unit.get_moments(), unit.get_products()
        body.SetSpatialInertiaInBodyFrame(context, SpatialInertia_[AutoDiffXd](
            value * inertia.get_mass(), inertia.get_com().astype(object) * AutoDiffXd(1.0),
            UnitInertia_[AutoDiffXd](*(AutoDiffXd(x) for x in (*moments, *products)))))


def prepare(case, method, tolerance):
    system, plant = diagram(str(case.urdf), case.name, str(case.folder))
    start, order = start_of(plant, case), places(plant, case)
    gradient = bool(case.parameters)
    if gradient:
        names = [plant.GetJointByName(name).name() for name in case.joints]
        system = system.ToAutoDiffXd()
        plant_name = plant.get_name()
        plant = system.GetSubsystemByName(plant_name)
        assert names == [plant.GetJointByName(name).name() for name in case.joints]
    simulator = simulator_for(system, method, tolerance, AutoDiffXd if gradient else float)
    context = simulator.get_mutable_context()
    part = plant.GetMyMutableContextFromRoot(context)
    if gradient:
        set_parameters(case, plant, part, InitializeAutoDiff(np.ones(len(case.parameters)))[:, 0])

    def run():
        context.SetTime(0.0)
        plant.SetPositions(part, start)
        plant.SetVelocities(part, np.zeros(plant.num_velocities()))
        simulator.Initialize()
        simulator.get_integrator().ResetStatistics()
        simulator.AdvanceTo(case.duration)
        steps = simulator.get_integrator().get_num_steps_taken()
        q = plant.GetPositions(part)[order]
        return steps, (ExtractGradient(np.array([q.dot(q)]))[0] if gradient else q)

    return run
