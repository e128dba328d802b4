# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Poles in the plane of s, or with a period in that of z = exp(s period)."""
import cmath
import math

from . import plane
from .charts import HEIGHT
from .numbers import short
from .nyquist import circle
from .open_loop import TURN

DAMPING = (0.1, 0.3, 0.5, 0.7, 0.9)
ZERO = 1e-7  # of the fastest motion: a growth that rounding may leave of zero
SPREAD = 12.0  # a map of the slow poles of their own is drawn where the fast ones are so many times as far


def words(k, mode):
    return (f"small motion {k}: growth {short(mode['growth'], 4)} 1/s, {short(mode['frequency'], 4)} Hz, "
            f"damping ratio {short(mode['damping_ratio'], 3)}")


def poles(model):
    """[(number of the small motion, pole, mode)]: s [1/s, rad/s], or z; both of each pair."""
    found = []
    for k, mode in enumerate(model["modes"], 1):
        if mode["frequency"] is None or (mode["growth"] is None and not model.get("period")):
            continue
        if model.get("period"):
            value = cmath.rect(mode["radius"] or 0.0, TURN * mode["frequency"] * model["period"])
        else:
            value = complex(mode["growth"], TURN * mode["frequency"])
        found.append((k, value, mode))
        if abs(value.imag) > 1e-12 * abs(value):
            found.append((0, value.conjugate(), mode))
    return found


def crosses(drawn, found):
    fastest = max([TURN * mode["frequency"] for _, _, mode in found] + [abs(mode["growth"] or 0.0) for _, _, mode in found])
    for k, value, mode in found:
        grows = (mode["growth"] or 0.0) > ZERO * fastest
        drawn.cross((value.real, value.imag), "unstable" if grows else "tuned", words(k or "of the pair", mode))
    for k, value, _ in found:
        if k:
            drawn.note((value.real, value.imag), str(k))


def s_map(found, title):
    """Poles about the imaginary axis. Rays from zero: constant damping ratio, minus the cosine of the angle."""
    reals, height = [value.real for _, value, _ in found], max([abs(value.imag) for _, value, _ in found] + [0.0])
    size = max(max(map(abs, reals), default=1.0), height) or 1.0
    low, high = min(reals + [0.0]), max(reals + [0.0])
    low, high = low - 0.1 * size if low > -0.2 * size else 1.12 * low, max(1.2 * high, 0.18 * size)
    tall = max(1.2 * height, 0.3 * size)
    drawn = plane.Plane((low, high), (-tall, tall), ("real part [1/s]", "imaginary part [rad/s]"), HEIGHT + 90)
    drawn.curve([(low, 0.0), (high, 0.0)], "edge")
    drawn.curve([(0.0, -tall), (0.0, tall)], "edge", "undamped")
    far = 4.0 * (abs(low) + tall)
    crosses(drawn, found)
    for ratio in DAMPING:
        x, y = -ratio * far, math.sqrt(1.0 - ratio ** 2) * far
        drawn.curve([(x, y), (0.0, 0.0), (x, -y)], "guide", f"damping ratio {ratio}")
        shrink = 0.94 * min(abs(low) / -x, tall / y)
        drawn.label((x * shrink, y * shrink), short(ratio))
    return drawn.svg(title)


def spiral(ratio, count=120):
    """z of constant damping ratio, up to half a turn per period: exp(angle (-ratio / sqrt(1 - ratio^2) + i))."""
    slope = ratio / math.sqrt(1.0 - ratio ** 2)
    return [cmath.rect(math.exp(-slope * math.pi * k / count), math.pi * k / count) for k in range(count + 1)]


def z_map(found, middle, half, title):
    """Poles in the unit circle, with lines of constant damping ratio."""
    drawn = plane.square(middle, 0.0, half, ("real part of z", "imaginary part of z"))
    drawn.curve([(-2.0, 0.0), (2.0, 0.0)], "edge")
    drawn.curve(circle(0.0, 1.0, 720), "limit", "undamped: |z| = 1")
    crosses(drawn, found)
    for ratio in DAMPING:
        points = spiral(ratio, 400)
        for sign in (1.0, -1.0):
            drawn.curve([(z.real, sign * z.imag) for z in points], "guide", f"damping ratio {ratio}")
        inside = [z for z in points if drawn.sees((z.real, z.imag))]
        if inside:
            at = inside[min(len(inside) - 1, len(inside) * 3 // 5)]
            drawn.label((at.real, at.imag), short(ratio))
    return drawn.svg(title)


def window(found):
    """(middle, half) of a square with poles near z = 1, little of it beyond the unit circle where none is."""
    far = max(abs(value - 1.0) for _, value, _ in found)
    if any(abs(value) > 1.0 for _, value, _ in found):
        return 1.0, 1.3 * far
    half = 1.2 * max(0.75 * far, *(abs(value.imag) for _, value, _ in found))
    return 1.0 - 1.2 * far + half, half


def maps(model):
    """[(title, words, chart)] of all poles, and of the slow ones where they are crowded."""
    found = poles(model)
    if not found:
        return []
    period = model.get("period")
    distances = sorted(abs(value - (1.0 if period else 0.0)) for _, value, _ in found)
    if period:
        half = max(1.12, 1.12 * max(abs(value) for _, value, _ in found))
        words_beside = f"z = exp(s T), T = {short(period, 6)} s; without those at 0; dotted: constant damping ratio"
        charts = [("Poles", words_beside, z_map(found, 0.0, half, "Poles in the plane of z"))]
        near = [d for d in distances if 0.0 < d < 0.2]
    else:
        charts = [("Poles", "dotted: constant damping ratio", s_map(found, "Poles in the plane of s"))]
        near = [d for d in distances if 0.0 < d < distances[-1] / SPREAD]
    if near:
        found = [entry for entry in found if abs(entry[1] - (1.0 if period else 0.0)) <= near[-1]]
        chart = z_map(found, *window(found), "Poles near z = 1") if period else s_map(found, "Slow poles in the plane of s")
        charts.append(("Poles near z = 1" if period else "Slow poles", "the same, larger", chart))
    return charts
