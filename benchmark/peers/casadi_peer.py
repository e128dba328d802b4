# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""CasADi: an articulated-body algorithm written as its expressions, made into C and compiled, integrated by CasADi's CVODES.

CasADi has no mechanisms of its own, and PyPI's Pinocchio comes without pinocchio.casadi. The C code has the rates and their products with
derivatives; what integrates is CasADi's own compiled code.
"""
import functools
import hashlib
import pathlib
import subprocess

import casadi
import casadi_slider_crank
import numpy as np
import tree


def version():
    return casadi.__version__


def turn(axis, angle):
    c, s = casadi.cos(angle), casadi.sin(angle)
    matrix = casadi.SX(3, 3)  # without the entries that are always zero
    i, j, k = axis, (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i], matrix[j, j], matrix[j, k], matrix[k, j], matrix[k, k] = 1.0, c, -s, s, c
    return matrix


def cross(x):
    return casadi.sparsify(casadi.skew(x))


def blocks(a, b, c, d):
    return casadi.blockcat([[a, b], [c, d]])


ZERO = casadi.SX(3, 3)
LONGEST = 1_500_000  # characters of C


def motion_transform(turned, arm):
    """Twists of the parent in the axes and at the origin of the link."""
    to_link = turned.T
    return blocks(to_link, ZERO, -to_link @ cross(arm), to_link)


def times_motion(twist):
    return blocks(cross(twist[:3]), ZERO, cross(twist[3:]), cross(twist[:3]))


def inertia_of(link, factor):
    mass, c = link.mass * factor, cross(casadi.SX(casadi.sparsify(casadi.DM(link.centre))))
    rotational = casadi.SX(casadi.sparsify(casadi.DM(np.diag(link.moments)))) * factor + mass * (c @ c.T)
    return blocks(rotational, mass * c, mass * c.T, mass * casadi.SX.eye(3))


def accelerations(links, q, v, effort, mass_factor):
    """The articulated-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 7.3)."""
    transform, twist, bias, inertia, load, acceleration = ([None] * len(links) for _ in range(6))
    for k, link in enumerate(links):
        fixed = casadi.SX(casadi.sparsify(casadi.DM(link.frame), 1e-15))
        transform[k] = motion_transform(fixed @ turn(link.axis, q[k]), casadi.SX(casadi.sparsify(casadi.DM(link.origin))))
        joint = casadi.SX(6, 1)
        joint[link.axis] = v[k]
        twist[k] = joint if link.parent < 0 else transform[k] @ twist[link.parent] + joint
        bias[k] = times_motion(twist[k]) @ joint
        inertia[k] = inertia_of(link, mass_factor(link.name))
        load[k] = -times_motion(twist[k]).T @ (inertia[k] @ twist[k])
    column, inverse, drive = ([None] * len(links) for _ in range(3))
    for k in reversed(range(len(links))):
        axis, parent = links[k].axis, links[k].parent
        column[k] = inertia[k][:, axis]
        inverse[k] = 1.0 / column[k][axis]
        drive[k] = effort[k] - load[k][axis]
        if parent >= 0:
            rest = inertia[k] - column[k] @ column[k].T * inverse[k]
            onward = load[k] + rest @ bias[k] + column[k] * (inverse[k] * drive[k])
            inertia[parent] = inertia[parent] + transform[k].T @ rest @ transform[k]
            load[parent] = load[parent] + transform[k].T @ onward
    result = casadi.SX(len(links), 1)
    for k, link in enumerate(links):
        before = casadi.vertcat(0, 0, 0, 0, 0, 9.81) if link.parent < 0 else acceleration[link.parent]
        before = transform[k] @ before + bias[k]
        result[k] = inverse[k] * (drive[k] - casadi.dot(column[k], before))
        joint = casadi.SX(6, 1)
        joint[link.axis] = result[k]
        acceleration[k] = before + joint
    return result


def rates(case):
    """(state, parameters) -> rates; places of the joints."""
    links = tree.read(case)
    count = len(links)
    q, v = casadi.SX.sym("q", count), casadi.SX.sym("v", count)
    p = casadi.SX.sym("p", max(1, len(case.parameters)))
    factor = {(kind, link): p[k] for k, (kind, link) in enumerate(case.parameters)}
    effort = casadi.vertcat(*(
        -link.damping * factor.get(("damping", link.name), 1.0) * v[k] - (link.friction * casadi.tanh(400.0 * v[k]) if link.friction else 0.0)
        for k, link in enumerate(links)))
    acceleration = accelerations(links, q, v, effort, lambda name: factor.get(("mass", name), 1.0))
    order = [link.joint for link in links]
    return (casadi.Function("rates", [casadi.vertcat(q, v), p], [casadi.vertcat(v, acceleration)], ["x", "p"], ["rate"]),
            [order.index(name) for name in case.joints])


@functools.lru_cache(maxsize=None)
def compiled(case_name, folder):
    """The rates as machine code, with one product forward and one backward. What is compiled is kept, since compilers take minutes for a humanoid;
    what is longer than LONGEST, CasADi interprets."""
    from worker import Case
    case = Case(folder, case_name)
    function, places = rates(case)
    generator = casadi.CodeGenerator("rates.c")
    for each in [function, function.forward(1)] + ([function.reverse(1)] if case.parameters else []):
        generator.add(each)
    code = generator.dump()
    if len(code) > LONGEST:
        return function, places
    path = pathlib.Path(folder) / f"casadi_{case_name}_{hashlib.sha256(code.encode()).hexdigest()[:16]}"
    library = path.with_suffix(".so")
    if not library.exists():
        path.with_suffix(".c").write_text(code, encoding="utf-8")
        level = "-O2" if len(code) < 1_000_000 else "-O1"
        subprocess.run(["gcc", level, "-march=native", "-shared", "-fPIC", "-o", str(library), str(path.with_suffix(".c")), "-lm"], check=True)
    return casadi.external("rates", str(library)), places


def integrator(case, method, tolerance):
    """(start, parameters) -> end, and the places of the joints."""
    function, places = compiled(case.name, str(case.folder))
    x, p = casadi.MX.sym("x", function.size1_in(0)), casadi.MX.sym("p", function.size1_in(1))
    options = {"reltol": tolerance, "abstol": 0.1 * tolerance, "max_num_steps": 10_000_000}
    if method.startswith("Adams"):
        options.update(linear_multistep_method="adams", nonlinear_solver_iteration="functional")
    elif method == "BDF gmres":
        options.update(newton_scheme="gmres")
    if case.parameters:
        options.update(steps_per_checkpoint=100)
    return casadi.integrator("run", "cvodes", {"x": x, "p": p, "ode": function(x, p)}, 0.0, case.duration, options), places


def prepare(case, method, tolerance):
    if case.name.startswith("slider_crank"):
        return casadi_slider_crank.prepare(tolerance, case.name != "slider_crank")
    run, places = integrator(case, method, tolerance)
    start = np.zeros(run.size1_in("x0"))
    start[places] = case.start
    if not case.parameters:
        def motion():
            end = run(x0=start, p=0.0)["xf"].full()[:, 0]
            return run.stats().get("nsteps", 0), end[places]
        return motion
    p = casadi.MX.sym("p", len(case.parameters))
    objective = casadi.sumsqr(run(x0=start, p=p)["xf"][places])
    gradient = casadi.Function("gradient", [p], [casadi.gradient(objective, p)])
    ones = np.ones(len(case.parameters))
    return lambda: (0, gradient(ones).full().ravel())  # it does not tell the steps of a gradient
