# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Rotations and the solids of a URDF, as far as a picture needs them. Vectors are tuples, rotations are rows."""
import math
import xml.etree.ElementTree as ElementTree

from . import sticks

SPRING = "{urn:mechanism_codesign}spring_damper"
IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def apply(rotation, position, point):
    return tuple(dot(row, point) + p for row, p in zip(rotation, position))


def product(a, b):
    columns = tuple(zip(*b))
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def from_quaternion(w, x, y, z):
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def from_rpy(roll, pitch, yaw):
    """URDF's fixed-axis angles."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return ((cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr))


def numbers(text, default):
    try:
        values = tuple(float(part) for part in text.split())
    except (AttributeError, ValueError):
        return default
    return values if len(values) == len(default) and all(map(math.isfinite, values)) else default


class Solid:
    """A visual in its link's frame: its points, of which a picture shows the outline.

    core: the points that tell in which plane a mechanism moves: all, or of a stick its ends, which have no thickness."""

    def __init__(self, kind, points, core=None):
        self.kind, self.points, self.core = kind, points, core or points
        self.is_stick = core is not None


def outline_points(kind, size):
    """Points whose convex hull is the solid, or nearly."""
    if kind == "box":
        return [tuple(s * 0.5 * c for s, c in zip(size, corner)) for corner in
                ((x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))]
    turn = [2.0 * math.pi * k / 24 for k in range(24)]
    if kind == "cylinder":
        radius, length = size
        return [(radius * math.cos(a), radius * math.sin(a), z) for z in (-0.5 * length, 0.5 * length) for a in turn]
    radius = size[0]
    return [(radius * math.cos(a) * math.cos(b), radius * math.sin(a) * math.cos(b), radius * math.sin(b))
            for a in turn for b in (-1.2, -0.8, -0.4, 0.0, 0.4, 0.8, 1.2)] + [(0.0, 0.0, radius), (0.0, 0.0, -radius)]


def read_solid(visual):
    geometry = visual.find("geometry")
    shape = geometry[0] if geometry is not None and len(geometry) else None
    if shape is None or shape.tag not in ("box", "cylinder", "sphere"):
        return None
    size = {"box": lambda: numbers(shape.get("size"), (0.0, 0.0, 0.0)),
            "cylinder": lambda: numbers(f'{shape.get("radius")} {shape.get("length")}', (0.0, 0.0)),
            "sphere": lambda: numbers(shape.get("radius"), (0.0,))}[shape.tag]()
    rotation, position = from_rpy(*numbers(origin_of(visual).get("rpy"), (0.0, 0.0, 0.0))), place_of(visual)
    return Solid(shape.tag, [apply(rotation, position, point) for point in outline_points(shape.tag, size)])


def origin_of(element):
    """The element with `xyz` and `rpy`: the child `<origin>`, or the element itself; {} without any."""
    if element is None:
        return {}
    origin = element.find("origin")
    return element if origin is None else origin


def place_of(element):
    return numbers(origin_of(element).get("xyz"), (0.0, 0.0, 0.0))


class Link:
    """What a picture needs of a link: its solids, and where they are missing its mass and centre of mass [m]."""

    def __init__(self, element):
        inertial, mass = element.find("inertial"), element.find("inertial/mass")
        self.solids = [solid for solid in map(read_solid, element.findall("visual")) if solid]
        self.mass = numbers(mass.get("value"), (0.0,))[0] if mass is not None else 0.0
        self.centre = place_of(inertial)
        self.is_root, self.slides = True, False


class Robot:
    """Links with their solids, and where the joints are. A link without shapes that can be drawn has sticks as its solids."""

    def __init__(self, urdf):
        root = ElementTree.fromstring(urdf)
        links = {link.get("name"): Link(link) for link in root.findall("link")}
        # Where joints, loops and springs sit on each link, in its frame; frames: of joints below a link and loops; springs: their ends.
        self.joints_on, frames, springs = {name: [] for name in links}, {}, {}
        for joint in root.findall("joint"):
            parent, child = (joint.find(tag).get("link") for tag in ("parent", "child"))
            if child in links:
                links[child].is_root, links[child].slides = False, joint.get("type") == "prismatic"
            frames.setdefault(parent, []).append(place_of(joint))
            self.joints_on.setdefault(child, []).append((0.0, 0.0, 0.0))
        # Rods without mass and springs: what runs between points of two links.
        self.rods = []
        for part in root.findall("loop") + root.findall(SPRING):
            ends = [(end.get("link"), place_of(end)) for end in map(part.find, ("predecessor", "successor")) if end is not None]
            for name, point in ends:
                (springs if part.tag == SPRING else frames).setdefault(name, []).append(point)
            if len(ends) == 2 and part.get("type", "codesign:distance") == "codesign:distance":
                self.rods.append(ends)
        for name, points in [*frames.items(), *springs.items()]:
            self.joints_on.setdefault(name, []).extend(points)
        self.root = next((name for name, link in links.items() if link.is_root), None)
        sticks.draw(links, frames, springs)
        self.solids = {name: link.solids for name, link in links.items()}
