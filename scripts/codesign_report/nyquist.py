# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The Nyquist diagram of an open loop, with its margins."""
import math

from . import plane
from .numbers import short
from .open_loop import TURN, crossings

FARTHEST = 6.0  # of a mark from zero in a Nyquist diagram


def circle(middle, radius, count=180):
    return [(middle + radius * math.cos(TURN * k / count), radius * math.sin(TURN * k / count)) for k in range(count + 1)]


def chart(name, response, margins):
    """L over frequencies of both signs about the point -1, the unit circle, and the circle of radius 1/Ms about -1 that L touches."""
    marks = crossings(margins, at_rest=True)
    places = [1.0 / value for key, (value, _) in marks.items() if key in ("gain_margin", "gain_reduction")]
    half = 0.65 + 0.95 * max([1.0] + [place for place in places if place <= FARTHEST])
    drawn = plane.square(-0.25 * half, 0.0, half, ("real part of L", "imaginary part of L"))
    drawn.curve([(-4.0 * half, 0.0), (4.0 * half, 0.0)], "edge")
    drawn.curve([(0.0, -4.0 * half), (0.0, 4.0 * half)], "edge")
    drawn.curve(circle(0.0, 1.0), "guide", "|L| = 1")
    if "sensitivity" in margins:
        largest = margins["sensitivity"]["value"]
        drawn.curve(circle(-1.0, 1.0 / largest), "limit", f"1/Ms = {short(1.0 / largest, 4)} about \u22121")
    for points in response.pieces():
        drawn.curve([(x, -y) for x, y in points], "mirror", "frequencies below zero")
        drawn.curve(points, "tuned line", "L")
    drawn.cross((-1.0, 0.0), "limit", "the point \u22121")
    notes = [((-1.0, 0.0), "\u22121")]
    for key in ("gain_margin", "gain_reduction"):
        if key in marks:
            value, f = marks[key]
            drawn.dot((-1.0 / value, 0.0), "limit", f"{key.replace('_', ' ')} {short(value, 4)} at {short(f, 4)} Hz")
            notes.append(((-1.0 / value, 0.0), f"\u22121/{short(value, 3)}"))
    if "phase_margin" in marks:
        value, f = marks["phase_margin"]
        point = on_circle(response, f)
        drawn.dot(point, "limit", f"phase margin {short(math.degrees(value), 4)}\u00b0 at {short(f, 4)} Hz")
        notes.append((point, f"{short(math.degrees(value), 3)}\u00b0"))
    if "sensitivity" in marks:
        notes.append(((-1.0, 1.0 / marks["sensitivity"][0]), f"1/Ms = {short(1.0 / marks['sensitivity'][0], 3)}"))
    for note in notes:
        drawn.note(*note)
    return drawn.svg(f"{name}: Nyquist diagram")


def on_circle(response, frequency):
    """L/|L| at a frequency [Hz]."""
    phase = math.radians(response.at(frequency, response.phases))
    return math.cos(phase), math.sin(phase)
