# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Solids for links without shapes, the same as rviz gets (src/reading/urdf/stick_figure.cc): sticks between the frames of joints and loops."""
import math

from . import geometry

THICKNESS = 0.02  # radius of a stick over the longest link
ALONE = 0.2       # length that stands for the longest link where every frame is at its link's origin [m]


class Pencil:
    """Adds solids to a link. The radius is of a stick [m]."""

    def __init__(self, radius):
        self.radius, self.solids = radius, []

    def stick(self, start, end):
        along = tuple(b - a for a, b in zip(start, end))
        length = math.sqrt(geometry.dot(along, along))
        if length < 0.5 * self.radius:
            return
        turn = geometry.from_rpy(0.0, math.acos(max(-1.0, min(1.0, along[2] / length))), math.atan2(along[1], along[0]))
        middle = tuple(0.5 * (a + b) for a, b in zip(start, end))
        self.add("cylinder", (self.radius, length), turn, middle, [start, end])

    def sphere(self, at, size):
        self.add("sphere", (size * self.radius,), geometry.IDENTITY, at, [at])

    def box(self, at, size):
        self.add("box", 3 * (size * self.radius,), geometry.IDENTITY, at, [at])

    def add(self, kind, size, rotation, position, core):
        points = [geometry.apply(rotation, position, point) for point in geometry.outline_points(kind, size)]
        self.solids.append(geometry.Solid(kind, points, core))


def solids_of(link, frames, springs, extent):
    """Solids of one link without shapes.

    @param link a geometry.Link. @param frames where joints and loops hang on it, in its frame [m]; springs: where springs do, which rviz
    does not draw. @param extent of the longest link [m]."""
    pencil, origin = Pencil(THICKNESS * extent), (0.0, 0.0, 0.0)
    if link.is_root:
        for start, end in zip(frames, frames[1:]):
            pencil.stick(start, end)
        return pencil.solids
    for point in frames + springs:
        pencil.stick(origin, point)
    if link.mass <= 0.0:
        return pencil.solids
    if link.slides:
        pencil.box(origin, 5.0)
    else:
        pencil.sphere(origin, 1.8)
    is_last = all(math.hypot(*point) < pencil.radius for point in frames)
    if is_last and math.hypot(*link.centre) >= pencil.radius:
        pencil.stick(origin, link.centre)
        pencil.sphere(link.centre, 3.0)
    return pencil.solids


def longest(links, frames):
    """The longest link, from its frame to the frame of a joint or to its centre of mass [m]."""
    lengths = [math.hypot(*point) for points in frames.values() for point in points] + [math.hypot(*link.centre) for link in links.values()]
    return max(lengths, default=0.0) or ALONE


def draw(links, frames, springs):
    """Gives each link that a picture cannot show solids. @param links by name. @param frames, springs of each name, as above."""
    extent = longest(links, frames)
    for name, link in links.items():
        if not link.solids:
            link.solids = solids_of(link, frames.get(name, []), springs.get(name, []), extent)
