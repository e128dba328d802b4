# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Every signal before and after, in groups, with peaks and limits."""
import math
import re

from . import asked
from .charts import Series, line_chart

GROUPS = (
    ("Objective and bounds", "what the objective and the constraints read"),
    ("Controllers", "errors, efforts and whatever else the study reads"),
    ("Friction", "friction, normal force, sliding velocity and power of each joint with friction; loss and torque of gears"),
    ("Contacts", "gap, negative by the penetration, forces and slip"),
    ("Motion", "positions and velocities"),
    ("Powers of the mechanism", "negative where energy leaves the mechanism"),
    ("Further signals", ""),
)
CAPACITY = 1_100_000  # bytes of all curves, so that the page stays below two megabytes
MOST_CHARTS = 300


def group_of(name, asked_for, used, touching=()):
    """The number of the group of a signal. @param touching names of contacts."""
    quantity = name.rsplit("/", 1)[-1]
    if name in asked_for:
        return 0
    if name.startswith("mechanism/"):
        return 5
    if quantity in ("gap", "gap_rate", "sliding_speed") or name.rpartition("/")[0] in touching:
        return 3
    if quantity in ("friction", "normal_force", "sliding_velocity", "friction_power", "gear_torque", "gear_loss", "gear_deflection"):
        return 2
    if name in used or quantity in ("error", "output", "effort", "integral", "current", "voltage"):
        return 1
    return 4 if quantity in ("position", "velocity", "acceleration") else 6


def used_signals(study):
    """The texts of all signals that the study, or a part of it, names at any place."""
    found = set()

    def search(value):
        if isinstance(value, dict):
            for key, item in value.items():
                if key in ("signal", "input", *asked.MEASURES) and isinstance(item, str):
                    found.add(item)
                search(item)
        elif isinstance(value, list):
            for item in value:
                search(item)

    search(study)
    return found


def asked_signals(study):
    return used_signals({key: study.get(key) for key in ("objective", "path", "final", "constraints")})


def traced(study, links):
    """The links whose position the study reads, in the order of the model."""
    found = {name for text in used_signals(study) for name in re.findall(r"([\w.:-]+)/position/[xyz]\b", text)}
    return [name for name in links if name in found]


def by_name(details, side):
    return {item["name"]: item for item in details.get(side, {}).get("signals", [])}


def limits_of(*items):
    return sorted({item[key] for item in items if item for key in ("lower", "upper") if item.get(key) is not None})


def is_zero(job, row):
    """Whether a signal is zero at all times, before and after, as powers are where nothing drives or moves the mechanism."""
    sides = [side for side in (row["initial"], row["tuned"]) if side]
    tables = [table[row["name"]] for table in job.runs.values() if table and row["name"] in table]
    values = [side.get(key) for side in sides for key in ("smallest", "largest")] + [value for table in tables for value in table]
    known = [value for value in values if value is not None and not (isinstance(value, float) and math.isnan(value))]
    return bool(known) and not any(known)


def signal_rows(job):
    """(rows, zeros): one row per signal, its name, unit, and summary before and after; and the names of those that are zero and not asked for."""
    used, rows = used_signals(job.study), every_row(job)
    zeros = [row["name"] for row in rows if row["name"] not in used and is_zero(job, row)]
    return [row for row in rows if row["name"] not in zeros], zeros


def every_row(job):
    before, after = by_name(job.details, "initial"), by_name(job.details, "tuned")
    names = list(after) + [name for name in before if name not in after]
    if not names:
        names = [name for table in job.runs.values() if table for name in table.names if name != "time"]
        names = list(dict.fromkeys(names))
    rows = []
    for name in names:
        first, last = before.get(name), after.get(name)
        rows.append({"name": name, "unit": (last or first or {}).get("unit", ""), "initial": first, "tuned": last, "limits": limits_of(first, last)})
    return rows


def contacts(job):
    """[(name, smallest gap before, after, largest normal force before, after)] of each contact and clearance; None where it is not known."""
    rows = {row["name"]: row for row in every_row(job)}

    def pair(name, key):
        row = rows.get(name, {})
        return [(row.get(side) or {}).get(key) for side in ("initial", "tuned")]

    return [(of, *pair(name, "smallest"), *pair(f"{of}/normal_force", "largest")) for name in rows for of, _, quantity in [name.rpartition("/")] if quantity == "gap"]


MOST_DOTS = 60  # of a curve over postures, which has a dot in each


def curves(job, name):
    found = []
    for side, table in job.runs.items():
        if table and name in table:
            times = [int(time) for time in table["time"]] if job.in_postures else table["time"]
            style = "points" if job.in_postures and len(times) <= MOST_DOTS else "line"
            found.append(Series("before" if side == "initial" else "after", side, times, table[name], style))
    return found


def events(job):
    """[(side, event)] of both designs, before the search and after it."""
    return [(side, event) for side in ("initial", "tuned") for event in job.details.get(side, {}).get("events", [])]


def marks(job):
    """The instants of the events of both designs, for the axis of time; those after the search stand below."""
    found = []
    for side, words in (("tuned", "after"), ("initial", "before")):
        times = [event["time"] for of, event in events(job) if of == side]
        if times:
            found.append((side, f"events {words}", times))
    return found


def signal_groups(job, scale=1.0):
    """[(title, words, [(row, chart)])] without empty groups. @param scale of the number of points of each curve."""
    used, instants = used_signals(job.study), marks(job)
    groups = [(title, words, []) for title, words in GROUPS]
    rows, references = signal_rows(job)[0], asked.numbers_asked(job.study)
    most = int(scale * max(24, min(240, CAPACITY // (22 * max(1, min(len(rows), MOST_CHARTS))))))
    touching = {name for name, *_ in contacts(job)}
    groups_of = {row["name"]: group_of(row["name"], asked_signals(job.study), used, touching) for row in rows}
    for row in sorted(rows, key=lambda row: groups_of[row["name"]])[:MOST_CHARTS]:
        series = curves(job, row["name"])
        if series:
            if job.in_postures and row["name"] in references:
                wanted, count = references[row["name"]], len(series[-1].xs)
                series.append(Series("asked", "target", list(range(count)), (wanted * count if len(wanted) == 1 else wanted)[:count], "dots"))
            chart = line_chart(f'{row["name"]} before and after', series, "posture" if job.in_postures else "time [s]",
                               f'[{row["unit"]}]' if row["unit"] else "", row["limits"], most=most, marks=() if job.in_postures else instants)
            groups[groups_of[row["name"]]][2].append((row, chart))
    return [group for group in groups if group[2]]
