# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A drawing over two linear or logarithmic axes, with curves that end at its frame."""
from .charts import BOTTOM, HEIGHT, LEFT, LETTER, RIGHT, TOP, WIDTH, Axis, escape, grid, svg


def cut(first, second, box):
    """The part of a segment inside of a box (low x, high x, low y, high y) by the method of Liang and Barsky; None: there is none."""
    begin, end = 0.0, 1.0
    steps = (second[0] - first[0], second[1] - first[1])
    for k, step in enumerate(steps):
        for low, sign in ((box[2 * k], 1.0), (-box[2 * k + 1], -1.0)):
            room, gain = sign * first[k] - low, sign * step  # inside while room + t gain >= 0
            if gain == 0.0 and room < 0.0:
                return None
            if gain > 0.0:
                begin = max(begin, -room / gain)
            elif gain < 0.0:
                end = min(end, -room / gain)
    if begin > end:
        return None
    return tuple(tuple(first[k] + t * steps[k] for k in (0, 1)) for t in (begin, end))


def overlap(one, other):
    return one[0] < other[1] and other[0] < one[1] and one[2] < other[3] and other[2] < one[3]


class Plane:
    """Both axes, and the parts of the picture in the order in which they are drawn."""

    def __init__(self, xs, ys, labels, height=HEIGHT, log_x=False, ticks=None):
        """@param xs, ys (low, high) of the frame. @param ticks (values, labels) of the vertical axis in place of its own."""
        self.height = height
        self.y = Axis(ys, height - BOTTOM, TOP, margin=0.0)
        if ticks:
            self.y.ticks, self.y.labels = ticks
        self.x = Axis(xs, max(LEFT, 24 + self.y.widest()), WIDTH - RIGHT, log=log_x, margin=0.0)
        # Curves that leave the frame are cut in pixels, where both axes are linear.
        self.box = (self.x.start, WIDTH - RIGHT, TOP, height - BOTTOM)
        self.parts = [grid(self.x, self.y, *labels, height)]
        self.texts, self.lines, self.marks = [], [], []  # boxes (left, right, top, bottom) of what a text does not cover

    def place(self, point):
        return self.x.place(point[0]), self.y.place(point[1])

    def sees(self, point):
        x, y = self.place(point)
        return self.box[0] <= x <= self.box[1] and self.box[2] <= y <= self.box[3]

    def curve(self, points, kind, title=""):
        """A curve through points, as far as it is inside of the frame."""
        places, text, last = [self.place(point) for point in points], [], None
        for first, second in zip(places, places[1:]):
            part = cut(first, second, self.box)
            if part is None:
                continue
            if last != part[0]:
                text.append(f"M{part[0][0]:.1f} {part[0][1]:.1f}")
            text.append(f"L{part[1][0]:.1f} {part[1][1]:.1f}")
            last = part[1]
            self.keep_free(*part)
        if text:
            tip = f"<title>{escape(title)}</title>" if title else ""
            self.parts.append(f'<path class="{kind}" d="{"".join(text)}">{tip}</path>')

    def keep_free(self, first, second):
        """Remembers a segment as places at most 8 pixels apart."""
        count = 1 + int(max(abs(second[0] - first[0]), abs(second[1] - first[1])) / 8.0)
        for k in range(count + 1):
            x, y = (first[i] + (second[i] - first[i]) * k / count for i in (0, 1))
            self.lines.append((x - 1, x + 1, y - 1, y + 1))

    def mark(self, point):
        x, y = self.place(point)
        self.marks.append((x - 5, x + 5, y - 5, y + 5))
        self.lines.append(self.marks[-1])
        return x, y

    def dot(self, point, kind, title):
        if self.sees(point):
            x, y = self.mark(point)
            self.parts.append(f'<circle class="{kind} dot" cx="{x:.1f}" cy="{y:.1f}" r="3.2"><title>{escape(title)}</title></circle>')

    def cross(self, point, kind, title):
        if self.sees(point):
            x, y = self.mark(point)
            self.parts.append(f'<path class="{kind} mark" d="M{x - 4:.1f} {y - 4:.1f}l8 8m0 -8l-8 8"><title>{escape(title)}</title></path>')

    def note(self, point, text):
        """A text beside a point: where it covers nothing, else where it covers no other text, else nowhere."""
        if not self.sees(point):
            return
        (px, py), width = self.place(point), LETTER * 0.85 * len(text)
        spots = []
        for away in (7, 16, 30):
            for up in (-away, away + 8, 4, -away - 12, away + 22):
                for left, anchor in ((px + away, "start"), (px - away - width, "end"), (px - 0.5 * width, "middle")):
                    if left >= self.box[0] and left + width <= self.box[1] and py + up - 11 >= self.box[2] and py + up <= self.box[3] - 2:
                        spots.append(((left, left + width, py + up - 11, py + up + 1), anchor))
        allowed = [spot for spot in spots if not any(overlap(spot[0], box) for box in self.texts)]
        best = next((spot for spot in allowed if not any(overlap(spot[0], box) for box in self.lines)), allowed[0] if allowed else None)
        if best:
            self.write(*best, text)

    def label(self, point, text):
        """A text on a line, if it covers neither another text nor a mark."""
        x, y = self.place(point)
        half = 0.5 * LETTER * 0.85 * len(text)
        box = (x - half, x + half, y - 6, y + 6)
        if self.sees(point) and box[0] > self.box[0] and box[1] < self.box[1] and not any(overlap(box, other) for other in self.texts + self.marks):
            self.write((box[0], box[1], y - 7, y + 5), "middle", text)

    def write(self, box, anchor, text):
        """A text that begins, ends or has its middle where its box does: on a narrow page its letters are larger."""
        self.texts.append(box)
        x = {"start": box[0], "end": box[1], "middle": 0.5 * (box[0] + box[1])}[anchor]
        self.parts.append(f'<text class="note" x="{x:.1f}" y="{box[3] - 1:.1f}" text-anchor="{anchor}">{escape(text)}</text>')

    def svg(self, title):
        return svg("".join(map(str, self.parts)), title, WIDTH, self.height)


def square(x_middle, y_middle, half, labels):
    """A plane with equal axes: a unit has the same length in both."""
    height = WIDTH - LEFT - RIGHT + TOP + BOTTOM
    plane = Plane((x_middle - half, x_middle + half), (y_middle - half, y_middle + half), labels, height)
    surplus = plane.x.start - LEFT  # wide labels make the frame narrower, which it then is in both directions
    if surplus > 0.0:
        plane = Plane((x_middle - half, x_middle + half), (y_middle - half, y_middle + half), labels, height - surplus)
    return plane
