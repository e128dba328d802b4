# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Charts as SVG. Colors and strokes are classes, which the page's style gives a light and a dark look."""
import collections
import math
import os
import re

from .numbers import Markup, escape, log_ticks, nice_step, short, tick_labels, ticks

WIDTH, HEIGHT = 420, 210
LEFT, RIGHT, TOP, BOTTOM = 58, 10, 10, 34
LETTER = 7.8  # width of a letter of a tick, at most: letters are larger on a narrow page
ROUNDING = 1e-9  # smaller variations are drawn as a flat line, in any SI unit

# kind: initial, tuned or another class of the style; style: line, dots, steps, or points: a line with a dot at each of them.
Series = collections.namedtuple("Series", "label kind xs ys style", defaults=("line",))


def finite(values):
    return [v for v in values if isinstance(v, (int, float)) and math.isfinite(v)]


def thin(xs, ys, most):
    """At most about `most` points of a curve; of each stretch the smallest and the largest value are kept."""
    points = [(x, y) for x, y in zip(xs, ys) if isinstance(y, (int, float)) and math.isfinite(y) and math.isfinite(x)]
    if len(points) <= most:
        return points
    stretch = math.ceil(2 * len(points) / most)
    kept = []
    for first in range(0, len(points), stretch):
        part = points[first:first + stretch]
        ends = {min(range(len(part)), key=lambda k: part[k][1]), max(range(len(part)), key=lambda k: part[k][1])}
        kept += [part[k] for k in sorted(ends)]
    return [points[0]] + kept[1:-1] + [points[-1]]


class Axis:
    """Maps values to the picture. `log`: powers of ten; values that are not positive have no place."""

    def __init__(self, values, start, end, log=False, margin=0.06):
        values = [v for v in finite(values) if not log or v > 0.0]
        low, high = (min(values), max(values)) if values else (0.0, 1.0)
        self.log, self.start, self.end = log, start, end
        if log:
            low, high = math.log10(low), math.log10(high)
            pad = max(0.1, margin * (high - low))
            self.low, self.high = low - pad, high + pad
            self.ticks = [t for t in log_ticks(10 ** self.low, 10 ** self.high) if self.low <= math.log10(t) <= self.high]
            if len(self.ticks) < 2:
                powers = [10.0 ** k for k in range(math.floor(self.low), math.ceil(self.high))]
                self.ticks = [f * p for p in powers for f in (1, 2, 5) if self.low <= math.log10(f * p) <= self.high]
            if len(self.ticks) < 2:
                self.ticks = ticks(10 ** self.low, 10 ** self.high)
                self.labels, self.offset = tick_labels(self.ticks)
            else:
                self.labels, self.offset = [short(value, 4) for value in self.ticks], ""
            return
        size = max(abs(low), abs(high))
        if size < ROUNDING:
            low, high, size = -1.0, 1.0, 1.0
        if high - low <= 1e-12 * size:  # a constant with rounding errors is drawn as a constant
            low, high = low - (0.5 * size or 0.5), high + (0.5 * size or 0.5)
        pad = margin * (high - low)
        self.low, self.high = low - pad, high + pad
        self.ticks = ticks(self.low, self.high)
        if all(isinstance(v, int) for v in values):
            self.ticks = [t for t in self.ticks if abs(t - round(t)) < 1e-9]
        self.labels, self.offset = tick_labels(self.ticks)

    def widest(self):
        """Width of the widest label."""
        return LETTER * max((len(label) for label in self.labels), default=0)

    def spaced(self, distance):
        """[(tick, label)] of those ticks that stand so far apart in the picture."""
        kept = []
        for tick, label in zip(self.ticks, self.labels):
            if not kept or abs(self.place(tick) - self.place(kept[-1][0])) >= distance:
                kept.append((tick, label))
        return kept

    def place(self, value):
        if self.log:
            value = math.log10(value) if value > 0.0 else self.low
        return self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)


def path_of(points, x, y, steps=False):
    text, last = [], None
    for px, py in points:
        here = f"{x.place(px):.1f} {y.place(py):.1f}"
        if last is not None and steps:
            text.append(f"L{here.split()[0]} {last.split()[1]}")
        text.append(("M" if last is None else "L") + here)
        last = here
    return "".join(text)


def x_ticks(x, top, bottom, below):
    """Lines and labels of a horizontal axis; a label does not leave the picture."""
    parts = []
    for value, label in x.spaced(x.widest() + 6):
        at, half = x.place(value), 0.5 * LETTER * len(label)
        text_at = min(max(at, half + 1), WIDTH - half - 1)
        parts.append(f'<path class="grid" d="M{at:.1f} {top}V{bottom}"/><text class="tick" x="{text_at:.1f}" y="{below}" text-anchor="middle">'
                     f"{label}</text>")
    return parts


def grid(x, y, x_label, y_label, height=HEIGHT):
    """Lines, ticks and the names of both axes."""
    left, right, bottom = x.start, WIDTH - RIGHT, height - BOTTOM
    parts = x_ticks(x, TOP, bottom, bottom + 14)
    for value, label in y.spaced(14):
        at = y.place(value)
        parts.append(f'<path class="grid" d="M{left:.0f} {at:.1f}H{right}"/><text class="tick" x="{left - 5:.0f}" y="{at + 4:.1f}" text-anchor="end">'
                     f"{label}</text>")
    if y.offset:
        parts.append(f'<text class="tick" x="{left + 5:.0f}" y="{TOP + 11}">from {y.offset}</text>')
    x_label += f", from {x.offset}" if x.offset else ""
    parts.append(f'<path class="frame" d="M{left:.0f} {TOP}V{bottom}H{right}"/>')
    parts.append(f'<text class="axis" x="{right}" y="{height - 4}" text-anchor="end">{escape(x_label)}</text>')
    parts.append(f'<text class="axis" x="12" y="{(TOP + bottom) / 2:.0f}" text-anchor="middle" '
                 f'transform="rotate(-90 12 {(TOP + bottom) / 2:.0f})">{escape(y_label)}</text>')
    return "".join(parts)


def svg(body, title, width=WIDTH, height=HEIGHT):
    return Markup(f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{escape(title)}"><title>{escape(title)}</title>{body}</svg>')


def standalone(picture, background=False):
    """A picture as a file or an image of its own: with its size, the colors, and those rules of the page's style that it uses."""
    picture = str(picture)
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "style.css"), encoding="utf-8") as file:
        text = file.read()
    there = {word for words in re.findall(r'class="([^"]*)"', picture) for word in words.split()}
    there |= {"text"} if "<text" in picture else set()
    rules = [f"{names}{look}" for line in re.findall(r"^svg .*$", text, re.MULTILINE) for names, look in re.findall(r"(svg [^{]*)({[^}]*})", line)
             if any(0 < len(parts) and there.issuperset(parts) for parts in (re.findall(r"\w+", name)[1:] for name in names.split(",")))]
    style = re.sub(r"\s+", " ", text[text.index(":root"):text.index("* {")] + ("svg { background: var(--paper); } " if background else "") + " ".join(rules))
    width, height = re.search(r'viewBox="0 0 (\S+) (\S+)"', picture).groups()
    return picture.replace("<svg ", f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" ', 1).replace(
        "</title>", f"</title><style>{style}</style>", 1)


def ticks_of(marks, x):
    """Rows of short strokes above a horizontal axis, one row for each of the marks, at places that lie on the axis."""
    parts = []
    for row, (kind, label, places) in enumerate(marks):
        bottom = HEIGHT - BOTTOM - 11 * row
        inside = sorted({f"{x.place(place):.1f}" for place in finite(places) if x.low <= place <= x.high}, key=float)
        if inside:
            strokes = "".join(f"M{at} {bottom}v-8" for at in inside)
            parts.append(f'<path class="{kind} mark" d="{strokes}"><title>{escape(label)}</title></path>')
    return parts


def line_chart(title, series, x_label, y_label, limits=(), log=False, most=240, marks=()):
    """@param limits values of horizontal lines. They are drawn if they lie near the curves, and never squeeze these.
    @param marks (kind, label, places): instants that are marked at the axis of x."""
    values = [v for s in series for v in finite(s.ys)]
    span = max(values) - min(values) if values else 1.0
    near = [v for v in limits if values and min(values) - 0.6 * span <= v <= max(values) + 0.6 * span]
    y = Axis(values + near, HEIGHT - BOTTOM, TOP, log and any(v > 0.0 for v in values))
    left = max(LEFT, 24 + y.widest())
    x = Axis([v for s in series for v in s.xs], left, WIDTH - RIGHT, margin=0.0 if all(s.style == "line" for s in series) else 0.03)
    body = [grid(x, y, x_label, y_label), *ticks_of(marks, x)]
    for value in near:
        body.append(f'<path class="limit" d="M{left:.0f} {y.place(value):.1f}H{WIDTH - RIGHT}"/>')
    for s in series:
        points = [(px, py) for px, py in thin(s.xs, s.ys, most) if not y.log or py > 0.0]
        if s.style in ("dots", "points"):
            radius = 3 if s.style == "dots" else 2.2
            body += [f'<circle class="{s.kind} dot" cx="{x.place(px):.1f}" cy="{y.place(py):.1f}" r="{radius}"/>' for px, py in points]
        if points and s.style != "dots":
            body.append(f'<path class="{s.kind} line" d="{path_of(points, x, y, s.style == "steps")}"/>')
    return svg("".join(body), title)


def bar_chart(title, names, pairs, unit):
    """Horizontal bars, two per name: before and after. @param pairs (initial, tuned) for each name; None: no bar."""
    row, left, top = 38, 12, 6
    height = top + row * len(names) + 32
    x = Axis([0.0] + [v for pair in pairs for v in pair if v is not None], left, WIDTH - 14)
    body = x_ticks(x, top, height - 30, height - 17)
    zero = x.place(0.0)
    for k, (name, pair) in enumerate(zip(names, pairs)):
        y = top + row * k
        body.append(f'<text class="tick" x="{left}" y="{y + 11}">{escape(name)}</text>')
        for value, kind, offset in zip(pair, ("initial", "tuned"), (15, 25)):
            if value is None:
                continue
            at = x.place(value)
            body.append(f'<rect class="{kind} bar" x="{min(at, zero):.1f}" y="{y + offset}" width="{max(abs(at - zero), 0.5):.1f}" height="8"/>')
    body.append(f'<path class="frame" d="M{zero:.1f} {top}V{height - 30}"/>')
    body.append(f'<text class="axis" x="{WIDTH - 14}" y="{height - 3}" text-anchor="end">{escape(unit)}</text>')
    return svg("".join(body), title, WIDTH, height)


def matrix_chart(title, names, rows):
    """Correlations from -1 to 1 as shades; None: not known. Names are numbers where they are many, as in the table beside it."""
    count, most = len(names), 32  # letters of a name
    top, left = 6, 12 + 7 * min(most, max(map(len, names), default=0))
    cell = max(8, min(34, (WIDTH - left - 8) // max(count, 1)))
    width, height = max(WIDTH, left + cell * count + 10), top + cell * count + 26
    body = []
    for i, (name, row) in enumerate(zip(names, rows)):
        label = name if len(name) <= most else name[:most - 1] + "\u2026"
        body.append(f'<text class="tick" x="{left - 5}" y="{top + cell * (i + 0.5) + 4:.0f}" text-anchor="end">{escape(label)}</text>')
        body.append(f'<text class="tick" x="{left + cell * (i + 0.5):.0f}" y="{top + cell * count + 14}" text-anchor="middle">{i + 1}</text>')
        for j, value in enumerate(row):
            kind = "unknown" if value is None else "plus" if value >= 0.0 else "minus"
            shade = 0.15 if value is None else min(1.0, abs(value))
            text = "not known" if value is None else short(value, 3)
            body.append(f'<rect class="cell {kind}" fill-opacity="{shade:.2f}" x="{left + cell * j}" y="{top + cell * i}" width="{cell - 1}" '
                        f'height="{cell - 1}"><title>{escape(name)}, {escape(names[j])}: {text}</title></rect>')
    return svg("".join(body), title, width, height)


def map_chart(title, x_label, y_label, xs, ys, rows):
    """A value for each pair of two positions as shades of its magnitude over the largest one; None: not known. @param rows one per y, from below."""
    values = finite([value for row in rows for value in row])
    most = max(map(abs, values), default=0.0) or 1.0
    left, top, width, height = LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    wide, high = width / len(xs), height / len(ys)
    body = []
    for j, (y, row) in enumerate(zip(ys, rows)):
        for i, (x, value) in enumerate(zip(xs, row)):
            kind = "unknown" if value is None else "plus" if value >= 0.0 else "minus"
            shade = 0.15 if value is None else min(1.0, abs(value) / most)
            text = "not known" if value is None else short(value, 4)
            body.append(f'<rect class="cell {kind}" fill-opacity="{shade:.3f}" x="{left + wide * i:.1f}" y="{top + height - high * (j + 1):.1f}" '
                        f'width="{wide:.1f}" height="{high:.1f}"><title>{escape(x_label)} {short(x, 4)}, {escape(y_label)} {short(y, 4)}: {text}</title></rect>')
    for at, label, anchor in ((left, xs[0], "start"), (left + width, xs[-1], "end")):
        body.append(f'<text class="tick" x="{at}" y="{top + height + 14}" text-anchor="{anchor}">{short(label, 4)}</text>')
    for at, label in ((top + height, ys[0]), (top + 10, ys[-1])):
        body.append(f'<text class="tick" x="{left - 5}" y="{at}" text-anchor="end">{short(label, 4)}</text>')
    body.append(f'<text class="axis" x="{left + width / 2:.0f}" y="{HEIGHT - 4}" text-anchor="middle">{escape(x_label)}</text>')
    body.append(f'<text class="axis" x="12" y="{top + height / 2:.0f}" text-anchor="middle" '
                f'transform="rotate(-90 12 {top + height / 2:.0f})">{escape(y_label)}</text>')
    return svg("".join(body), title)


def relative(bound, value):
    """How far a bound of an interval is from its value, relative to it; infinite where the value is zero."""
    return math.copysign(math.inf, bound) if value == 0.0 and bound else (bound - value) / abs(value) if value else 0.0


def interval_scale(intervals):
    """The common scale of several intervals: the largest relative distance of a bound from its value, rounded up, and at most 1.

    @param intervals [(low, high, value)]; None: not known."""
    reach = [abs(relative(bound, value)) for low, high, value in intervals if value is not None for bound in (low, high) if bound is not None]
    widest = max((r for r in reach if r <= 1.0), default=0.0)
    return 1.0 if any(r > 1.0 for r in reach) or not widest else nice_step(widest, 1)


def interval_chart(title, low, high, value, start, scale):
    """One confidence interval in a row of a table, relative to its value: a bar from low to high, a dot at the value, and a tick at the start if
    that is near. An end beyond the scale, which all rows share, has an arrowhead. @param scale at the ends of the picture, relative to the value."""
    left, middle, right = 10.0, 80.0, 150.0

    def place(bound):
        return middle + (right - middle) * max(-1.0, min(1.0, relative(bound, value) / scale))

    body = f'<path class="grid" d="M{left:.0f} 10H{right:.0f}M{middle:.0f} 3V17"/>'
    if low is not None and high is not None:
        body += f'<path class="interval" d="M{place(low):.1f} 10H{place(high):.1f}"/>'
        for bound, end, side in ((low, left, -1), (high, right, 1)):
            if side * relative(bound, value) > scale:
                body += f'<path class="beyond" d="M{end:.0f} 5L{end + 6 * side:.0f} 10L{end:.0f} 15Z"/>'
    if start is not None and abs(relative(start, value)) <= scale:
        body += f'<path class="initial line" d="M{place(start):.1f} 4V16"/>'
    return svg(body + f'<circle class="tuned dot" cx="{middle:.0f}" cy="10" r="3.5"/>', title, 160, 20)
