# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The mechanism as a picture: solids as outlines, at the start and faintly later. Report, gallery and notebooks draw with it."""
import math

from . import geometry
from .charts import svg
from .numbers import escape, nice_step, short

WIDTH, HEIGHT, MARGIN = 420, 300, 16
MOST_GHOSTS = 12  # faint ones of later times or postures


def placed(pose, point):
    return geometry.apply(geometry.from_quaternion(*pose[3:]), pose[:3], point)


def view_of(points):
    """Right, up and towards the eye. A mechanism that moves in a plane is seen at a right angle to it, another one from above a corner."""
    count = len(points)
    mean = [sum(p[k] for p in points) / count for k in range(3)]
    spread = [max(abs(p[k] - mean[k]) for p in points) for k in range(3)]
    thin = min(range(3), key=lambda k: spread[k])
    if spread[thin] < 0.08 * max(spread):
        towards = [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)][thin]
    else:
        towards = geometry.unit((1.0, -1.6, 0.8))
    up = (0.0, 1.0, 0.0) if abs(towards[2]) > 0.99 else (0.0, 0.0, 1.0)
    right = geometry.unit(geometry.cross(up, towards))
    return right, geometry.cross(towards, right), towards


def hull(points):
    """The convex hull of points of the picture, counter-clockwise."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(sequence):
        line = []
        for p in sequence:
            while len(line) > 1 and ((line[-1][0] - line[-2][0]) * (p[1] - line[-2][1]) - (line[-1][1] - line[-2][1]) * (p[0] - line[-2][0])) <= 0:
                line.pop()
            line.append(p)
        return line[:-1]

    return half(points) + half(points[::-1])


class Scene:
    """Both designs in one view and one scale, so that their pictures can be compared."""

    def __init__(self, sides, traced=(), wanted=None):
        """@param sides [(Robot, poses)], poses as in details.json. @param traced links whose origin's path is drawn, through all poses.
        @param wanted {signal: values at all poses} of positions LINK/position/x, y and z: where these origins should be."""
        self.sides, self.traced, self.wanted = sides, traced, wanted or {}
        nowhere = [(0.0, 0.0, 0.0), (1.0, 0.0, 1.0)]
        moving, cores = ([p for robot, poses in sides for p in self.points_of(robot, poses, part)] for part in ("points", "core"))
        self.right, self.up, self.towards = view_of(cores or nowhere)
        self.height = HEIGHT
        flat = [self.project(p) for p in moving] or [(0.0, 0.0), (1.0, 1.0)]
        self.scale, self.centre = self.fitted(flat)
        # Solids of the ground are whole in the picture if the mechanism remains large; of others that part is drawn which is near.
        least = 0.55 * self.scale
        for robot, poses in sides:
            for pose in poses["links"].get(robot.root, [])[:1]:
                for solid in robot.solids.get(robot.root, []):
                    wider = flat + [self.project(placed(pose, p)) for p in solid.points]
                    scale, centre = self.fitted(wider)
                    if scale >= least:
                        flat, self.scale, self.centre = wider, scale, centre

    def fitted(self, flat):
        """Scale and centre of a picture of these points."""
        low, high = ([f(p[k] for p in flat) for k in (0, 1)] for f in (min, max))
        size = max(high[0] - low[0], high[1] - low[1]) or 1.0
        wide, tall = (max(b - a, 0.25 * size) for a, b in zip(low, high))
        scale = 0.94 * min((WIDTH - 2 * MARGIN) / wide, (HEIGHT - 2 * MARGIN - 24) / tall)
        return scale, [(a + b) / 2 for a, b in zip(low, high)]

    def points_of(self, robot, poses, part):
        """Where everything but the ground is, over time. @param part of the solids: their points, or their core."""
        for name, series in poses["links"].items():
            if name == robot.root:
                continue
            local = [p for solid in robot.solids.get(name, []) for p in getattr(solid, part)] + robot.joints_on.get(name, []) + [(0.0, 0.0, 0.0)]
            for pose in series:
                yield from (placed(pose, p) for p in local)

        for name in self.traced:
            yield from self.places_wanted(poses, name)

    def places_wanted(self, poses, name):
        """Where a link's origin should be in each pose; a coordinate that the study leaves open is that which it has."""
        asked = [self.wanted.get(f"{name}/position/{axis}") for axis in "xyz"]
        series = poses["links"].get(name, []) if any(asked) else []
        for k, pose in enumerate(series):
            if all(values is None or k < len(values) or len(values) == 1 for values in asked):
                yield tuple(pose[axis] if values is None else values[k if len(values) > 1 else 0] for axis, values in enumerate(asked))

    def draw_traces(self, poses):
        body = []
        for name in self.traced:
            places = [self.place(tuple(pose[:3])) for pose in poses["links"].get(name, [])]
            body.append('<path class="trace" d="' + "".join(f'{"L" if k else "M"}{x} {y}' for k, (x, y) in enumerate(places)) + '"/>')
            body += [f'<path class="target mark" d="M{x - 4:.1f} {y:.1f}H{x + 4:.1f}M{x:.1f} {y - 4:.1f}V{y + 4:.1f}"/>'
                     for x, y in map(self.place, self.places_wanted(poses, name))]
        return body

    def project(self, point):
        return geometry.dot(self.right, point), geometry.dot(self.up, point)

    def place(self, point):
        x, y = self.project(point)
        return (round(WIDTH / 2 + (x - self.centre[0]) * self.scale, 1), round((self.height - 20) / 2 - (y - self.centre[1]) * self.scale, 1))

    def draw_link(self, robot, name, pose, kind):
        """(depth, SVG) of everything of one link."""
        for solid in robot.solids.get(name, []):
            points = [placed(pose, p) for p in solid.points]
            depth = sum(geometry.dot(self.towards, p) for p in points) / len(points)
            corners = " ".join(f"{x},{y}" for x, y in hull([self.place(p) for p in points]))
            yield depth, f'<polygon class="{kind} solid" points="{corners}"/>'
        if name == robot.root:
            return
        # From the joint of a link to its solids, which may be apart from it.
        centres = [tuple(sum(x) / len(solid.points) for x in zip(*solid.points)) for solid in robot.solids.get(name, []) if not solid.is_stick]
        origin = placed(pose, (0.0, 0.0, 0.0))
        for end in centres:
            a, b = self.place(origin), self.place(placed(pose, end))
            if math.dist(a, b) > 1.0:
                depth = 0.5 * (geometry.dot(self.towards, origin) + geometry.dot(self.towards, placed(pose, end)))
                # Behind the solids around it.
                yield depth - 8.0 / self.scale, f'<path class="{kind} stick" d="M{a[0]} {a[1]}L{b[0]} {b[1]}"/>'

    def draw_rods(self, robot, links, index):
        for ends in robot.rods:
            if all(name in links for name, _ in ends):
                points = [placed(links[name][index], point) for name, point in ends]
                (ax, ay), (bx, by) = map(self.place, points)
                depth = 0.5 * sum(geometry.dot(self.towards, p) for p in points)
                yield depth, f'<path class="{"ghost" if index else "body"} stick" d="M{ax} {ay}L{bx} {by}"/>'

    def joints(self, robot, poses, index):
        links = poses["links"]
        places = {self.place(placed(links[name][index], p)) for name, ends in robot.joints_on.items() if name in links for p in ends}
        return "".join(f'<circle class="pin" cx="{x}" cy="{y}" r="2.6"/>' for x, y in sorted(places))

    def picture(self, side, title):
        robot, poses = self.sides[side]
        body, count = [], len(poses["times"])
        stride = max(1, -(-(count - 1) // MOST_GHOSTS))
        for index in list(range(count - 1, 0, -stride)) + [0]:
            parts = []
            for name, series in poses["links"].items():
                kind = "ground" if name == robot.root else "ghost" if index else "body"
                if kind != "ground" or index == 0:
                    parts += self.draw_link(robot, name, series[index], kind)
            parts += self.draw_rods(robot, poses["links"], index)
            body += [text for _, text in sorted(parts, key=lambda part: part[0])]
        if count:
            body.append(self.joints(robot, poses, 0))
        body += self.draw_traces(poses)
        body.append(self.scale_bar())
        return svg(f'<g class="mechanism">{"".join(body)}</g>', title, WIDTH, self.height)

    def scale_bar(self):
        length = nice_step(60.0 / self.scale, 1)
        x, y = 14, self.height - 10
        factor, unit = next((pair for pair in ((1.0, "m"), (1e3, "mm"), (1e6, "\u00b5m")) if pair[0] * length > 0.999), (1e9, "nm"))
        text = f"{short(factor * length, 4)} {unit}"
        return (f'<path class="frame" d="M{x} {y - 4}V{y}H{x + length * self.scale:.1f}V{y - 4}"/>'
                f'<text class="tick" x="{x + length * self.scale + 6:.1f}" y="{y}">{escape(text)}</text>')
