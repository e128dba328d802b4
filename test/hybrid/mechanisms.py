# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Small mechanisms: their URDF, and their equations of motion in closed form, M(q) a = h(q, v) + Q, for the event-driven solver."""
import dataclasses
import typing

import numpy as np

GRAVITY = 9.81


@dataclasses.dataclass
class Mechanism:
    """@param numbers names of its parameters and their ranges; @param links of the URDF, as (name, joint, kind, parent, place, inertial) where place is the joint's
    origin; @param solve(parameters, q, v, loads) gives accelerations. Gravity is (0, 0, -9.81)."""
    name: str
    numbers: dict
    links: list
    solve: typing.Callable

    @property
    def joints(self):
        return [link[1] for link in self.links]


def inertial(mass, place, moment):
    """@param place of the centre of mass: an expression, along -z, or None"""
    origin = f'<origin xyz="0 0 -PLACE" codesign:xyz="0 0 ${{-{place}}}"/>' if place else ""
    return (f'<inertial>{origin}<mass value="MASS" codesign:value="${{{mass}}}"/>'
            f'<inertia ixx="{moment}" ixy="0" ixz="0" iyy="{moment}" iyz="0" izz="{moment}"/></inertial>')


def two(m11, m12, m22, r1, r2):
    determinant = m11 * m22 - m12 * m12
    return [(m22 * r1 - m12 * r2) / determinant, (m11 * r2 - m12 * r1) / determinant]


def slide():
    return Mechanism("slide", {"mass": (0.5, 2.0)}, [("body", "slide", "prismatic", "ground", None, inertial("mass", None, 0.01))],
                     lambda p, q, v, load: [load[0] / p["mass"]])


def pendulum():
    def solve(p, q, v, load):
        return [(load[0] - p["mass"] * GRAVITY * p["arm"] * np.sin(q[0])) / (p["mass"] * p["arm"] ** 2 + 0.01)]
    return Mechanism("pendulum", {"mass": (0.5, 2.0), "arm": (0.2, 0.8)},
                     [("rod", "pivot", "revolute", "ground", None, inertial("mass", "arm", 0.01))], solve)


def two_slides():
    def solve(p, q, v, load):
        return two(p["first"] + p["second"], p["second"], p["second"], load[0], load[1])
    return Mechanism("two_slides", {"first": (0.5, 2.0), "second": (0.5, 2.0)},
                     [("carriage", "rail", "prismatic", "ground", None, inertial("first", None, 0.01)),
                      ("tool", "feed", "prismatic", "carriage", None, inertial("second", None, 0.01))], solve)


def cart_pendulum():
    def solve(p, q, v, load):
        c = p["bob"] * p["arm"]
        return two(p["cart"] + p["bob"], -c * np.cos(q[1]), c * p["arm"] + 0.02, load[0] - c * np.sin(q[1]) * v[1] ** 2, load[1] - c * GRAVITY * np.sin(q[1]))
    return Mechanism("cart_pendulum", {"cart": (0.5, 2.0), "bob": (0.3, 1.0), "arm": (0.2, 0.8)},
                     [("trolley", "rail", "prismatic", "ground", None, inertial("cart", None, 0.01)),
                      ("load", "pivot", "revolute", "trolley", None, inertial("bob", "arm", 0.02))], solve)


def two_links():
    # a, b: the angles of both links from the vertical.
    def solve(p, q, v, load):
        a, b, da, db = q[0], q[0] + q[1], v[0], v[0] + v[1]
        c = p["hand"] * p["upper"] * p["reach"]
        swing = c * np.sin(b - a)
        m11 = 0.02 + p["mass"] * p["upper"] ** 2 / 4.0 + p["hand"] * p["upper"] ** 2
        m22 = 0.01 + p["hand"] * p["reach"] ** 2
        r1 = load[0] - load[1] + swing * db**2 - (p["mass"] / 2.0 + p["hand"]) * p["upper"] * GRAVITY * np.sin(a)
        r2 = load[1] - swing * da**2 - p["hand"] * p["reach"] * GRAVITY * np.sin(b)
        da2, db2 = two(m11, c * np.cos(b - a), m22, r1, r2)
        return [da2, db2 - da2]
    return Mechanism("two_links", {"mass": (0.5, 2.0), "hand": (0.3, 1.0), "upper": (0.3, 0.8), "reach": (0.2, 0.6)},
                     [("arm", "shoulder", "revolute", "ground", None, inertial("mass", "upper/2", 0.02)),
                      ("fore", "elbow", "revolute", "arm", "upper", inertial("hand", "reach", 0.01))], solve)


ALL = [slide, pendulum, two_slides, cart_pendulum, two_links]


def urdf(mechanism, values, stops, extra):
    """@param values of all parameters of the model; @param stops a map from joints to (lower, upper), expressions of parameters; @param extra a map from joints to
    further elements."""
    def at(text):
        return repr(float(eval(text, {}, dict(values))))  # pylint: disable=eval-used
    lines = ['<robot name="hybrid" xmlns:codesign="urn:mechanism_codesign">']
    lines += [f'  <codesign:parameter name="{name}" value="{value!r}"/>' for name, value in values.items()]
    lines += ['  <link name="ground"/>']
    for body, joint, kind, parent, place, inertia in mechanism.links:
        mass = inertia.split("${")[-1].split("}")[0]
        com = inertia.split("${-")[1].split("}")[0] if "PLACE" in inertia else None
        inertia = inertia.replace("MASS", at(mass)).replace("PLACE", at(com) if com else "")
        origin = f'<origin xyz="0 0 -{at(place)}" codesign:xyz="0 0 ${{-{place}}}"/>' if place else ""
        axis = "1 0 0" if kind == "prismatic" else "0 1 0"
        lower, upper = stops.get(joint, ("-1000", "1000"))
        limit = f'<limit lower="{at(lower)}" codesign:lower="${{{lower}}}" upper="{at(upper)}" codesign:upper="${{{upper}}}" effort="EFFORT" velocity="1000"/>'
        limit = limit.replace("EFFORT", repr(extra.get((joint, "effort"), 1000.0)))
        lines += [f'  <link name="{body}">{inertia}</link>',
                  f'  <joint name="{joint}" type="{kind}"><parent link="{parent}"/><child link="{body}"/>{origin}<axis xyz="{axis}"/>{limit}{extra.get(joint, "")}</joint>']
    return "\n".join(lines + ["</robot>"]) + "\n"
