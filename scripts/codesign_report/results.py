# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Charts of a search: convergence, starts, samples, what friction costs; and of an identification: intervals, correlations, residuals."""
import math

from .charts import Series, bar_chart, interval_chart, interval_scale, line_chart, matrix_chart


def convergence(job):
    """Charts of the objective, the gradient and the parameters over the trial points."""
    table = job.convergence
    if table is None or not all(name in table for name in ("evaluation", "objective", "best_objective", "gradient_norm", "status")):
        return []
    trials = list(range(1, len(table) + 1))
    charts = [
        ("Objective", line_chart("Objective at each trial point and at the best so far", [
            Series("best so far", "tuned", trials, table["best_objective"], "steps"),
            Series("trial points", "initial", trials, table["objective"], "dots")], "trial point", "objective", log=True)),
        ("Scaled gradient", line_chart("Norm of the scaled gradient at each trial point", [
            Series("gradient", "tuned", trials, table["gradient_norm"], "dots")], "trial point", "norm", log=True))]
    if "events" in table and any(table["events"]):
        charts.append(("Events per run", line_chart("Number of events in the runs of each trial point", [
            Series("events", "tuned", trials, [int(count) for count in table["events"]], "dots")], "trial point", "events")))
    bounds = {row["name"]: (row["lower"], row["upper"]) for row in job.details.get("parameters", []) if row["tuned"]}
    series = []
    for k, (name, (lower, upper)) in enumerate(bounds.items()):
        if name in table and lower is not None and upper is not None:
            series.append(Series(name, f"hue{k % 8}", trials, [(v - lower) / (upper - lower) for v in table[name]]))
    if series and len(series) <= 24:
        chart = line_chart("Parameters at each trial point, 0 at the lower and 1 at the upper bound", series, "trial point", "0 lower, 1 upper bound")
        charts.append(("Parameters between their bounds", chart, [(s.label, s.kind) for s in series]))
    return charts


def failed_trials(job):
    return [] if job.convergence is None else [s for s in job.convergence["status"] if s != "success"]


def friction(job):
    """(rows, chart) of the energy that friction takes at each joint."""
    before, after = (job.details.get(side, {}).get("friction_energy", {}) for side in ("initial", "tuned"))
    names = list(dict.fromkeys([*after, *before]))
    if not names:
        return [], None
    rows = [(name, before.get(name), after.get(name)) for name in names]
    return rows, bar_chart("Energy that friction puts into the mechanism, by joint, before and after", names, [row[1:] for row in rows], "J")


ENERGIES = (("friction", "friction, all joints"), ("damping", "damping"), ("actuator", "controllers"), ("load", "constant loads"),
            ("electrical", "supply of the motors"), ("copper_loss", "heat of the windings"))


def energies(job):
    sides = [job.details.get(side, {}).get("energy", {}) for side in ("initial", "tuned")]
    return [(words, *(side.get(key) for side in sides)) for key, words in ENERGIES if any(side.get(key) for side in sides)]


def waterfall(job):
    """The objectives of all searches, best first."""
    if job.starts is None or "objective" not in job.starts:
        return None
    rows = [row for row in job.starts.rows() if row["optimum"] > 0 and math.isfinite(row["objective"])]
    rows.sort(key=lambda row: row["objective"])
    if not rows:
        return None
    ranks = list(range(1, len(rows) + 1))
    return line_chart("Waterfall: objective at the end of each search, best first", [
        Series("start", "initial", ranks, [row["start_objective"] for row in rows], "dots"),
        Series("end", "tuned", ranks, [row["objective"] for row in rows], "dots")], "search, by result", "objective", log=True)


def samples(job):
    """Charts of the objective over all runs and samples: sorted, and by each number that varies."""
    table = job.scenarios
    if table is None or "objective" not in table:
        return []
    sides = (("before", "initial", "initial_objective"), ("after", "tuned", "objective"))
    fractions = [(k + 0.5) / len(table) for k in range(len(table))]
    series = [Series(words, kind, sorted(table[column]), fractions, "line") for words, kind, column in sides]
    title = "Share of runs and samples whose objective is below a value"
    charts = [("Share of runs and samples below", line_chart(title, series, "objective", "share"))]
    known = {"run", "sample", "weight", "initial_objective", "objective", "initial_failed", "failed", "friction_law"}
    for name in table.names:
        values = table[name]
        if name in known or not any(isinstance(v, float) and math.isfinite(v) for v in values):
            continue
        pairs = [Series(words, kind, values, table[column], "dots") for words, kind, column in sides]
        charts.append((f"Objective over {name}", line_chart(f"Objective of each run and sample over {name}", pairs, name, "objective")))
    return charts


def identified(job):
    """(rows, scale): the identified numbers with a picture of each interval, all on one scale relative to the value."""
    items = {name: (item, *(item.get("interval") or [None, None])[:2]) for name, item in job.result.get("identified", {}).items()}
    scale = interval_scale([(low, high, item.get("value")) for item, low, high in items.values()])
    rows = []
    for name, (item, low, high) in items.items():
        value = item.get("value")
        chart = interval_chart(f"Interval of {name}", low, high, value, item.get("start"), scale) if value is not None else ""
        note = "on its bound" if item.get("on_bound") else "" if item.get("determined", True) else "the data do not tell it"
        rows.append({"name": name, "item": item, "low": low, "high": high, "chart": chart, "note": note})
    return rows, scale


def correlations(job):
    names, rows = job.result.get("names"), job.result.get("correlation")
    if not names or not rows or len(names) > 60:
        return None
    return matrix_chart("Correlations of the identified numbers", names, rows)


def residuals(job):
    """[(title, chart)] for each joint and each recording: recorded and computed effort, and their difference."""
    table = job.residuals
    if table is None or "time" not in table:
        return []
    joints = [name[:-len("/recorded")] for name in table.names if name.endswith("/recorded")]
    parts = {}
    for index, key in enumerate(zip(table["set"], table["recording"])):
        parts.setdefault(key, []).append(index)
    most = max(60, min(400, 1_000_000 // (33 * max(1, len(parts) * len(joints)))))
    charts = []
    for (kind, recording), rows in list(parts.items())[:24]:
        for joint in joints[:24]:
            time, recorded, computed = ([table[column][k] for k in rows] for column in ("time", joint + "/recorded", joint + "/computed"))
            difference = [a - b for a, b in zip(recorded, computed)]
            title = f"{joint}, {'fitted' if kind == 'data' else kind} recording {recording:.0f}"
            charts.append((title, line_chart(f"Recorded and computed effort of {title}", [
                Series("recorded", "initial", time, recorded), Series("computed", "tuned", time, computed)], "time [s]", "effort", most=most)))
            charts.append((title + ": what is left", line_chart(f"Recorded minus computed effort of {title}", [
                Series("difference", "hue2", time, difference)], "time [s]", "difference", most=most)))
    return charts
