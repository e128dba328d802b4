# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""MuJoCo: steps of one size in its C loop, mujoco.rollout.

It has no error control: the setting is a step size. Its own dry friction, frictionloss, is a constraint with another law, so that its error has a
floor; "callback" is the law of the study as a C function, which its implicit integrators do not differentiate. Gradients by parameters: central
differences, since its derivatives are by states and controls only.
"""
import ctypes
import functools
import pathlib
import subprocess
import tempfile

import mujoco
import mujoco_sysid
import numpy as np
from mujoco import rollout

METHODS = {"RK4": mujoco.mjtIntegrator.mjINT_RK4, "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST, "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT}
LAW = """
#include <math.h>
#include <mujoco/mujoco.h>
static double friction[1000];
void set_friction(int n, const double* of) { for (int k = 0; k < n; ++k) friction[k] = of[k]; }
void passive(const mjModel* m, mjData* d) { for (int k = 0; k < m->nv; ++k) d->qfrc_passive[k] -= friction[k] * tanh(400.0 * d->qvel[k]); }
"""


def version():
    return mujoco.__version__


@functools.lru_cache(maxsize=None)
def law():
    """The law of the study as machine code, called by MuJoCo without Python."""
    folder = pathlib.Path(tempfile.mkdtemp())
    (folder / "law.c").write_text(LAW, encoding="utf-8")
    include = pathlib.Path(mujoco.__file__).parent / "include"
    subprocess.run(["gcc", "-O3", "-march=native", "-shared", "-fPIC", f"-I{include}", "-o", str(folder / "law.so"), str(folder / "law.c"), "-lm"], check=True)
    return ctypes.CDLL(str(folder / "law.so"))


def load(case):
    spec = mujoco.MjSpec.from_string(case.urdf_text())
    spec.compiler.fusestatic = True
    model = spec.compile()
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    return model


def address(model, joint):
    return model.jnt_qposadr[mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint)]


def scale(model, kind, link, value):
    """Scales a mass, with its inertia, or a damping."""
    if kind == "damping":
        model.dof_damping[model.jnt_dofadr[mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, f"{link}_joint")]] *= value
        return
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, link)
    model.body_mass[body] *= value
    model.body_inertia[body] *= value


def choose_friction(model, method):
    """Own law or the law of the study. @returns the name of the integrator"""
    name, _, way = method.partition(", ")
    mujoco.set_mjcb_passive(None)
    if model.dof_frictionloss.any() and way == "callback":
        code = law()
        friction = np.array(model.dof_frictionloss)
        code.set_friction(model.nv, friction.ctypes.data_as(ctypes.POINTER(ctypes.c_double)))
        mujoco.set_mjcb_passive(code.passive)
        model.dof_frictionloss[:] = 0.0
    return name


def prepare(case, method, step):
    if "recording" in case.about:
        return mujoco_sysid.prepare(case, step)
    model = load(case)
    steps = max(1, int(np.ceil(case.duration / step - 1e-9)))
    model.opt.timestep = case.duration / steps
    model.opt.integrator = METHODS[choose_friction(model, method)]
    order = [address(model, name) for name in case.joints]
    data = mujoco.MjData(model)
    data.qpos[order] = case.start
    start = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, start, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    states = np.empty((1, steps, start.size))
    sensors = np.empty((1, steps, model.nsensordata))

    def end(of):
        rollout.rollout(of, data, start[None, :], nstep=steps, state=states, sensordata=sensors)
        return states[0, -1, 1:][order].copy()

    if not case.parameters:
        return lambda: (steps, end(model))
    moved = []
    h = 1e-4
    for kind, link in case.parameters:
        pair = []
        for sign in (1.0, -1.0):
            other = load(case)
            other.opt.timestep, other.opt.integrator = model.opt.timestep, model.opt.integrator
            scale(other, kind, link, 1.0 + sign * h)
            pair.append(other)
        moved.append(pair)

    def gradient():
        squares = [[end(of) @ states[0, -1, 1:][order] for of in pair] for pair in moved]
        return 2 * steps * len(moved), [(up - down) / (2.0 * h) for up, down in squares]

    return gradient
