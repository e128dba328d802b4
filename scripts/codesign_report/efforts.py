# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of what `codesign efforts --json` prints: curves along a motion, maps over postures."""
import os

from . import charts, numbers
from .job import ReportError

SHOWN = ("effort", "holding", "breakaway_up", "breakaway_down")  # in postures
MEANING = {"effort": "holds the posture without friction", "holding": "least effort that holds it with friction",
           "breakaway_up": "at which the joint begins to move along its coordinate", "breakaway_down": "at which it begins to move against it"}


class Efforts:
    """One file of `codesign efforts --json`."""

    def __init__(self, path, result):
        self.path, self.result = path, result
        if not all(isinstance(self.result.get(key), dict) for key in ("joints", "series")):
            raise ReportError(f"{path}: no output of codesign efforts --json, which has joints and series, nor of codesign linearize --json or codesign tradeoff --json")
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.series = self.result["series"]
        self.in_postures = "time" not in self.series
        names = list(self.series)
        #: the joints whose postures are the grid; their positions are the first columns
        self.grid = [name[:-len("/position")] for name in names[:len(self.result["joints"])]] if self.in_postures else []

    def refuse_to_replace(self, output):
        if os.path.exists(output) and os.path.samefile(output, self.path):
            raise ReportError(f"{output}: the page would replace the efforts that it shows; choose another file with -o")


def of_motion(found):
    """[(joint, [(quantity, words, chart)])]: the curves of each joint over time."""
    groups = []
    for joint in found.result["joints"]:
        shown = [name for name in ("effort", "velocity", "friction") if f"{joint}/{name}" in found.series]
        groups.append((joint, [(name, "", charts.line_chart(f"{joint}/{name}", [charts.Series("", "tuned", found.series["time"],
                                                                                          found.series[f"{joint}/{name}"])],
                                                        "time [s]", name)) for name in shown]))
    return groups


def largest(values):
    """The value of largest magnitude; None if none is known."""
    known = charts.finite(values)
    return max(known, key=abs) if known else None


def over_one(found, joint):
    """All efforts of a joint over the positions of a grid of one joint."""
    where = found.series[found.grid[0] + "/position"]
    curves = [charts.Series(name, kind, where, found.series[f"{joint}/{name}"])
              for name, kind in zip(SHOWN, ("tuned", "initial", "limit", "limit")) if f"{joint}/{name}" in found.series]
    return [("effort, holding, breakaway", "blue: without friction; brown: least effort that holds; dashed: where it begins to move", charts.line_chart(joint, curves, f"{found.grid[0]}/position", "effort"))]


def over_two(found, joint):
    """A map per effort over the first two joints of the grid; of further joints the posture with the largest magnitude counts."""
    across, up = (found.series[name + "/position"] for name in found.grid[:2])
    columns, rows = sorted(set(across)), sorted(set(up))
    maps = []
    for name in SHOWN:
        values = found.series.get(f"{joint}/{name}")
        if values is None:
            continue
        cells = {}
        for x, y, value in zip(across, up, values):
            cells.setdefault((x, y), []).append(value)
        table = [[largest(cells.get((x, y), [])) for x in columns] for y in rows]
        known = charts.finite(values)
        extent = f"{numbers.short(min(known), 4)} to {numbers.short(max(known), 4)}" if known else "none known"
        maps.append((f"{name}: {extent}", MEANING[name], charts.map_chart(f"{joint}/{name}", found.grid[0], found.grid[1], columns, rows, table)))
    return maps


def groups(found):
    if not found.in_postures:
        return of_motion(found)
    return [(joint, over_one(found, joint) if len(found.grid) == 1 else over_two(found, joint)) for joint in found.result["joints"]]


def largest_rows(found):
    """[(joint, [(quantity, value, where)])]: the largest of each joint, with the posture or the time at which it occurs."""
    rows = []
    for joint, entry in found.result["joints"].items():
        cells = []
        for name, value in entry.items():
            at = value.get("at") if isinstance(value, dict) else None
            cells.append((name, value["value"] if isinstance(value, dict) else value, ", ".join(numbers.short(v, 4) for v in at) if at else ""))
        rows.append((joint, cells))
    return rows


def context(found):
    return {"result": found.result, "name": found.name, "in_postures": found.in_postures, "grid": found.grid,
            "rows": largest_rows(found), "groups": groups(found)}
