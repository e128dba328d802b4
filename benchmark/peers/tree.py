# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The links of a case for programs that do not read URDF."""
import dataclasses
import xml.etree.ElementTree as ElementTree

import numpy as np


@dataclasses.dataclass
class Link:
    """A link and the hinge on which it hangs; centre of mass and moments about it in its own axes."""
    name: str
    joint: str
    parent: int  # its index, -1: the base
    axis: int  # 0, 1, 2: x, y, z
    origin: np.ndarray
    frame: np.ndarray
    mass: float
    centre: np.ndarray
    moments: np.ndarray
    damping: float
    friction: float
    position: float


def numbers(element, name):
    text = element.get(name) if element is not None else None
    return np.array([float(x) for x in text.split()]) if text else np.zeros(3)


def rotation(rpy):
    """Axes of the joint in those of the parent, for angles about the fixed x, y, z in turn."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def read(case):
    """The links, parents first."""
    root = ElementTree.fromstring(case.urdf_text())
    links = {link.get("name"): link for link in root.iter("link")}
    position = dict(zip(case.joints, case.start))
    place, found, waiting = {"base": -1}, [], list(root.iter("joint"))
    while waiting:
        joint = next(each for each in waiting if each.find("parent").get("link") in place)
        waiting.remove(joint)
        name = joint.find("child").get("link")
        inertial, dynamics, origin = links[name].find("inertial"), joint.find("dynamics"), joint.find("origin")
        place[name] = len(found)
        found.append(Link(
            name, joint.get("name"), place[joint.find("parent").get("link")], int(np.argmax(numbers(joint.find("axis"), "xyz"))),
            numbers(origin, "xyz"), rotation(numbers(origin, "rpy")), float(inertial.find("mass").get("value")), numbers(inertial.find("origin"), "xyz"),
            np.array([float(inertial.find("inertia").get(key)) for key in ("ixx", "iyy", "izz")]),
            float(dynamics.get("damping")), float(dynamics.get("friction")), position[joint.get("name")]))
    return found
