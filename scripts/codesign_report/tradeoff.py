# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of what `codesign tradeoff --json` prints: the curve between the objectives, and the design of each point."""
import os

from . import charts
from .job import ReportError
from .plane import Plane

KEYS = ("objectives", "tuned", "points")
MEANING = {"on_curve": "no design near it is better in one objective without being worse in another",
           "stopped_early": "its search ended on a slope: a better design may be near",
           "repeated": "has the objectives of another point: the curve has a gap there",
           "dominated": "another point is as good in all objectives and better in one",
           "failed": "no design that meets the constraints was found"}
LOOK = {"on_curve": "tuned", "stopped_early": "unknown", "repeated": "initial", "dominated": "initial"}
MARGIN = 0.06


class Tradeoff:
    """One file of `codesign tradeoff --json`, or its record."""

    def __init__(self, path, result):
        self.path, self.result = path, result
        self.name = os.path.splitext(os.path.basename(path))[0]

    def refuse_to_replace(self, output):
        if os.path.exists(output) and os.path.samefile(output, self.path):
            raise ReportError(f"{output}: the page would replace the trade-off that it shows; choose another file with -o")


def is_one(result):
    """Whether a JSON object is a trade-off."""
    return all(key in result for key in KEYS)


def frame(values):
    low, high = min(values), max(values)
    margin = MARGIN * (high - low) or 0.5 * abs(high) or 0.5
    return low - margin, high + margin


def number_of(points):
    """[(number from 1, point)] of those that have a design."""
    return [(k, point) for k, point in enumerate(points, 1) if point["kind"] != "failed"]


def chart(found, across, up, is_curve):
    """A picture of two objectives: the points with their numbers, and the line between neighbours of a curve."""
    shown = number_of(found.result["points"])
    place = {k: (point["objectives"][across], point["objectives"][up]) for k, point in shown}
    plane = Plane(*(frame([at[i] for at in place.values()]) for i in (0, 1)), (across, up))
    if is_curve:
        plane.curve([place[k] for k, point in shown if point["kind"] in ("on_curve", "stopped_early")], "tuned line")
    for k, point in shown:
        plane.dot(place[k], LOOK[point["kind"]], f"point {k}: {across} {charts.short(place[k][0], 5)}, {up} {charts.short(place[k][1], 5)}, "
                  f"{point['kind'].replace('_', ' ')}")
    for k, _ in shown:
        plane.note(place[k], str(k))
    return plane.svg(f"{up} over {across}")


def pictures(found):
    """[(title, picture)] of each pair of objectives."""
    names = found.result["objectives"]
    if not number_of(found.result["points"]):
        return []
    return [(f"{up} over {across}", chart(found, across, up, len(names) == 2)) for i, across in enumerate(names) for up in names[i + 1:]]


def designs(found):
    """[(parameter, picture)]: each tuned parameter over the first objective, along the curve."""
    result = found.result
    along = [point for _, point in number_of(result["points"]) if point["kind"] in ("on_curve", "stopped_early")]
    if len(along) < 2:
        return []
    first = result["objectives"][0]
    style = "points" if len(result["objectives"]) == 2 else "dots"
    return [(name, charts.line_chart(name, [charts.Series(name, "tuned", [point["objectives"][first] for point in along],
                                                          [point["parameters"][name] for point in along], style)], first, name))
            for name in result["tuned"]]


def context(found):
    result = found.result
    kinds = [kind for kind in MEANING if any(point["kind"] == kind for point in result["points"])]
    return {"result": result, "name": found.name, "charts": pictures(found), "designs": designs(found),
            "kinds": [(kind.replace("_", " "), sum(point["kind"] == kind for point in result["points"]), MEANING[kind]) for kind in kinds]}
