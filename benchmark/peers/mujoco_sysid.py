# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Identification with MuJoCo's toolbox mujoco.sysid: its least squares by differences over rollouts of the whole recording, whose start it is given."""
import mujoco
import numpy as np
from mujoco import sysid

RATE, START = 100.0, 1.3  # as in peer_cases.h, peer_identification.h


def scale(kind, link, nominal):
    """A modifier that sets a mass, with its inertia, or a damping in times of the nominal one."""
    def modify(spec, parameter):
        if kind == "damping":
            spec.joint(f"{link}_joint").damping = [parameter.value[0] * nominal, 0.0, 0.0]
        else:
            body = spec.body(link)
            body.mass = parameter.value[0] * nominal[0]
            body.fullinertia = parameter.value[0] * nominal[1]
    return modify


def specification(case, step):
    spec = mujoco.MjSpec.from_string(case.urdf_text())
    spec.compiler.fusestatic = True
    spec.option.timestep = 1.0 / RATE / max(1, int(np.ceil(1.0 / RATE / step - 1e-9)))
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    for name in case.joints:
        motor = spec.add_actuator(name=f"{name}_motor", target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_motor()
    for kind, label in ((mujoco.mjtSensor.mjSENS_JOINTPOS, "position"), (mujoco.mjtSensor.mjSENS_JOINTVEL, "velocity")):
        for name in case.joints:
            spec.add_sensor(name=f"{name}_{label}", type=kind, objtype=mujoco.mjtObj.mjOBJ_JOINT, objname=name)
    return spec


def prepare(case, step):
    spec = specification(case, step)
    model = spec.compile()
    recording = np.array(case.about["recording"])
    times = np.arange(len(recording)) / RATE
    # A rollout's sensors are those before a step, and the toolbox gives them the time behind it.
    labels = times + spec.option.timestep
    data = mujoco.MjData(model)
    for name, position in zip(case.joints, case.start):
        data.qpos[model.joint(name).qposadr[0]] = position
    start = sysid.create_initial_state(model, data.qpos, data.qvel, data.act)
    control = sysid.TimeSeries(times, np.zeros((len(times), model.nu)))
    sequences = [sysid.ModelSequences("arm", spec, "swing", start, control, sysid.TimeSeries.from_names(labels, recording, model))]
    parameters = sysid.ParameterDict()
    for kind, link in case.parameters:
        body = spec.body(link)
        nominal = float(spec.joint(f"{link}_joint").damping[0]) if kind == "damping" else (body.mass, np.array(body.fullinertia))
        parameters.add(sysid.Parameter(f"{kind}_{link}", nominal=1.0, min_value=0.5, max_value=2.0, modifier=scale(kind, link, nominal)))
    residual = sysid.build_residual_fn(models_sequences=sequences, n_threads=1)

    def run():
        for key in list(parameters.keys()):
            parameters[key].value[:] = START
        found, result = sysid.optimize(initial_params=parameters, residual_fn=residual, optimizer="mujoco", verbose=False)
        return len(result.extras.get("objective", [])), found.as_vector()

    return run
