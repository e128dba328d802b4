# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Every signal before and after, in groups, with peaks and limits."""
from .charts import Series, line_chart

GROUPS = (
    ("Objective and controllers", "errors, efforts and whatever else the study reads"),
    ("Friction", "friction, normal force, sliding velocity and power of each joint with friction; loss and torque of gears"),
    ("Motion", "positions and velocities"),
    ("Powers of the mechanism", "negative where energy leaves the mechanism"),
    ("Further signals", ""),
)
CAPACITY = 1_100_000  # bytes of all curves, so that the page stays below two megabytes
MOST_CHARTS = 300


def group_of(name, used):
    quantity = name.rsplit("/", 1)[-1]
    if name.startswith("mechanism/"):
        return 3
    if quantity in ("friction", "normal_force", "sliding_velocity", "friction_power", "gear_torque", "gear_loss", "gear_deflection"):
        return 1
    if name in used or quantity in ("error", "output", "effort", "integral"):
        return 0
    return 2 if quantity in ("position", "velocity", "acceleration") else 4


def used_signals(study):
    """The texts of all signals that the study names, at any place."""
    found = set()

    def search(value):
        if isinstance(value, dict):
            for key, item in value.items():
                if key in ("signal", "input", "peak") and isinstance(item, str):
                    found.add(item)
                search(item)
        elif isinstance(value, list):
            for item in value:
                search(item)

    search(study)
    return found


def by_name(details, side):
    return {item["name"]: item for item in details.get(side, {}).get("signals", [])}


def limits_of(*items):
    return sorted({item[key] for item in items if item for key in ("lower", "upper") if item.get(key) is not None})


def signal_rows(job):
    """One row per signal: name, unit, its summary before and after."""
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


def curves(job, name):
    return [Series("before" if side == "initial" else "after", side, table["time"], table[name])
            for side, table in job.runs.items() if table and name in table]


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
    rows = signal_rows(job)
    most = int(scale * max(24, min(240, CAPACITY // (22 * max(1, min(len(rows), MOST_CHARTS))))))
    for row in sorted(rows, key=lambda row: group_of(row["name"], used))[:MOST_CHARTS]:
        series = curves(job, row["name"])
        if series:
            title = f'{row["name"]} before and after'
            chart = line_chart(title, series, "time [s]", f'[{row["unit"]}]' if row["unit"] else "", row["limits"], most=most,
                               marks=instants)
            groups[group_of(row["name"], used)][2].append((row, chart))
    return [group for group in groups if group[2]]
