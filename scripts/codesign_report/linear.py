# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of what `codesign linearize --json` prints: verdict, margins, open loops, poles and step responses."""
import math
import os

from . import bode, nyquist, open_loop, pole_charts, steps
from .charts import Series, line_chart
from .job import ReportError
from .numbers import short

KEYS = ("stability", "verdict", "modes", "states", "inputs", "outputs", "A", "B", "C", "D", "loops")
UNLIMITED = {"gain_margin": "\u221e", "gain_reduction": "0", "phase_margin": "\u221e", "delay_margin": "\u221e", "bandwidth": "none",
             "sensitivity": "\u221e", "complementary_sensitivity": "\u221e"}  # what a margin is without a limit
FEW = 200  # points of a sampled response that are drawn, each as a dot
SMALLEST = 1e-9  # of the largest response: smaller ones are what rounding leaves of zero


class Linearization:
    """One file of `codesign linearize --json`, or its record."""

    def __init__(self, path, result):
        self.path, self.result = path, result
        self.name = os.path.splitext(os.path.basename(path))[0]

    def refuse_to_replace(self, output):
        if os.path.exists(output) and os.path.samefile(output, self.path):
            raise ReportError(f"{output}: the page would replace the linearization that it shows; choose another file with -o")


def is_one(result):
    """Whether a JSON object is a linearization."""
    return all(key in result for key in KEYS)


def in_units(name, margin):
    """(value, unit, further words) as the command line shows them."""
    value = margin["value"]
    if value is None:
        return value, "", ""
    if name == "phase_margin":
        return math.degrees(value), "deg", ""
    if name == "delay_margin":
        return value, "s", ""
    if name == "bandwidth":
        return value / open_loop.TURN, "Hz", ""
    return value, "\u2013", f"{short(open_loop.decibels(value), 3)} dB" if value > 0.0 else ""


def margin_rows(loop, is_stable):
    """[(name, value or None, words in its place, unit, dB, frequency [Hz])]"""
    rows = []
    for name, instead in UNLIMITED.items():
        margin = loop.get(name)
        if margin:
            value, unit, also = in_units(name, margin)
            rows.append((name.replace("_", " "), value, "", unit, also, margin["frequency"] / open_loop.TURN))
        elif is_stable:
            rows.append((name.replace("_", " "), None, instead, "", "", None))
    return rows


def smallest(loops):
    """[(words, value, unit, controller)] of the margins that decide: the smallest ones, and the largest sensitivity."""
    cards = []
    for name, best in (("gain_margin", min), ("phase_margin", min), ("delay_margin", min), ("sensitivity", max)):
        known = [(loop[name]["value"], controller) for controller, loop in loops.items() if loop.get(name, {}).get("value") is not None]
        if known:
            value, controller = best(known)
            shown, unit, also = in_units(name, {"value": value})
            cards.append((name.replace("_", " ") if name != "sensitivity" else "sensitivity Ms", shown, also or unit, controller))
    return cards


def diagrams(controller, loop, is_stable):
    """[(title, words, charts)] of an open loop; without margins where the closed loop is unstable."""
    if not loop.get("response", {}).get("frequency"):
        return []
    response, margins = open_loop.Response(loop["response"]), loop if is_stable else {}
    if len(response.values) < 2:
        return []
    marks = open_loop.crossings(margins)
    words = "dashed: frequencies below zero; dotted: |L| = 1; red: \u22121" + (" and the circle 1/Ms" if "sensitivity" in margins else "")
    return [("Bode diagram of the open loop", "red: margins" if marks else "",
             [bode.gain_chart(controller, response, marks), bode.phase_chart(controller, response, marks)]),
            ("Nyquist diagram", words, [nyquist.chart(controller, response, margins)])]


def open_loops(result):
    """[(controller, samples in the common period, rows of margins, diagrams)]"""
    is_stable = result["stability"] != "unstable"
    return [(controller, loop.get("samples", 1), margin_rows(loop, is_stable), diagrams(controller, loop, is_stable))
            for controller, loop in result["loops"].items()]


def rows_of(result, controller):
    """([(output, c, d)], signal that has no row): what the controller measures, as an output or a state, and the outputs that were asked for."""
    rows = {name: (c, d) for name, c, d in zip(result["outputs"], result["C"], result["D"])}
    signal = result.get("measured", {}).get(controller)
    if signal in result["states"] and signal not in rows:
        rows[signal] = [float(name == signal) for name in result["states"]], [0.0] * len(result["inputs"])
    shown = [(name, *rows[name]) for name in dict.fromkeys([signal, *result["outputs"]]) if name in rows]
    return shown, signal if signal and signal not in rows else None


def is_dotted(step, period):
    """Whether each value of a sampled response is drawn as a dot."""
    return bool(period) and len(step.times) <= FEW


def step_chart(name, output, step, period, is_measured):
    """@param is_measured whether the output is what the set-point is for, which is drawn then."""
    series = Series(output, "tuned", step.times, step.values, "dots" if is_dotted(step, period) else "line")
    return line_chart(f"{output} after a step of {name}", [series], "time [s]", "per unit of the step", (1.0,) if is_measured else (), most=steps.POINTS + 2)


def step_words(step, period):
    """Where a response ends and how, and which instants are drawn."""
    parts = [f"ends at {short(step.final, 4)}"] if step.final is not None else []
    if step.overshoot is not None:
        parts += [f"overshoot {short(100.0 * step.overshoot, 3)} %" if step.overshoot > 1e-4 else "no overshoot",
                  f"within 2 % from {short(step.settling, 3)} s on"]
    if period:
        stride = round(step.interval / period)
        parts.append(("one value per period" if stride == 1 else f"a value each {stride} periods") + ("" if is_dotted(step, period) else ", joined"))
    return "; ".join(parts)


def step_responses(result):
    """[(set-point, [(output, words, chart)], signal without row)]"""
    found, period, system = [], result.get("period"), steps.System(result)
    for name in result["inputs"]:
        controller, _, quantity = name.rpartition("/")
        if quantity == "setpoint" or quantity.startswith("reference["):
            rows, missing = rows_of(result, controller)
            motion = steps.Motion(system, name)
            found.append((name, [(output, steps.response(motion, c, d)) for output, c, d in rows], missing))
    zero = SMALLEST * max((abs(value) for _, shown, _ in found for _, step in shown for value in step.values), default=0.0)
    groups = []
    for name, shown, missing in found:
        measured = result.get("measured", {}).get(name.rpartition("/")[0])
        charts = [(output, step_words(step, period), step_chart(name, output, step, period, output == measured)) for output, step in shown
                  if max(map(abs, step.values)) > zero]
        groups.append((name, charts, missing))
    return groups


def context(found):
    result = found.result
    verdict, _, counted = result["verdict"].partition("; ")
    return {"result": result, "name": found.name, "verdict": verdict, "counted": counted,
            "cards": smallest(result["loops"]) if result["stability"] != "unstable" else [],
            "loops": open_loops(result), "poles": pole_charts.maps(result), "steps": step_responses(result)}
