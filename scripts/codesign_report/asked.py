# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What the study asks for, as rows of words and the study's own texts."""
import collections

import yaml

Term = collections.namedtuple("Term", "kind signal reference weight")


def text_of(value):
    """A value of the study in one line, as YAML writes it."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    return yaml.safe_dump(value, default_flow_style=True, width=10 ** 6, sort_keys=False).strip()


def maps(value):
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []


SQUARE = "weight \u00b7 (signal \u2212 reference)\u00b2"
KINDS = (("integral", "integral over the run of " + SQUARE),
         ("sum", "sum over the postures of " + SQUARE),
         ("terminal", "at the end, " + SQUARE),
         ("peak", "weight \u00b7 largest |signal \u2212 reference|"),
         ("stroke", "weight \u00b7 (largest minus smallest signal \u2212 reference)"),
         ("maximum", "weight \u00b7 largest signal \u2212 reference"),
         ("minimum", "weight \u00b7 smallest signal \u2212 reference"),
         ("arrival", "weight \u00b7 first time after which signal \u2212 reference stays in the band"),
         ("dwell", "weight \u00b7 time of signal \u2212 reference in the band"),
         ("loop", "weight \u00b7 this number of the loop about rest"),
         ("poles", "weight \u00b7 this number of the poles about rest"))
MEASURES = ("peak", "stroke", "maximum", "minimum", "arrival", "dwell")


def in_postures(study):
    """Whether the study is of postures in place of a motion."""
    return isinstance(study.get("positions"), dict) and bool(study["positions"])


def interval_text(item):
    """Band and interval of a measure; empty without them."""
    return "".join(f", {key} {text_of(item[key])}" for key in ("band", "after", "before") if key in item)


def counted(words, item):
    """How a term counts: its loss in place of the square."""
    loss = item.get("loss", "square")
    return words if loss == "square" else words.replace(SQUARE, f"weight \u00b7 {text_of(loss)} of (signal \u2212 reference)")


def linear_name(item):
    """What a bound on, or a term of a loop or of poles is about, as the results name it; empty for others."""
    if "loop" in item:
        return f"loop {text_of(item['loop'])}, {text_of(item.get('measure', ''))}"
    return f"poles, {text_of(item['poles'])}" if "poles" in item else ""


def objective_terms(study):
    """The terms of the objective: when they count, signal, reference, weight."""
    objective = study.get("objective")
    objective = objective if isinstance(objective, dict) else {}
    terms = []
    for kind, words in KINDS:
        if kind == "terminal" and in_postures(study):
            words = "in the last posture, " + SQUARE
        terms += [Term(counted(words, item) + interval_text(item), linear_name({"poles": item.get("measure", "")} if kind == "poles" else item) or text_of(item.get("signal", "")), text_of(item.get("reference", 0)), text_of(item.get("weight", 1)))
                  for item in maps(objective.get(kind))]
    return terms


def numbers_asked(study):
    """{signal: its reference in each posture} of those terms of the sum whose references are numbers."""
    objective = study.get("objective")
    found = {}
    for item in maps(objective.get("sum") if isinstance(objective, dict) else None):
        reference = item.get("reference", 0)
        reference = reference if isinstance(reference, list) else [reference]
        if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in reference):
            found[text_of(item.get("signal", ""))] = [float(value) for value in reference]
    return found


def bounds_text(item):
    if "between" in item:
        return "between " + text_of(item["between"])
    parts = [words + " " + text_of(item[key]) for key, words in (("at_least", "at least"), ("at_most", "at most")) if key in item]
    return " and ".join(parts)


def bounds(study):
    """(what, bounds) of everything that is constrained."""
    last = " in the last posture" if in_postures(study) else " at the end"
    rows = [(text_of(item.get("signal", "")) + (last if key == "final" else ""), bounds_text(item))
            for key in ("path", "final") for item in maps(study.get(key))]
    for item in study.get("constraints") or []:
        if isinstance(item, dict):
            measure = next((key for key in MEASURES if key in item), None)
            what = f"{measure} of {text_of(item[measure])}{interval_text(item)}" if measure else linear_name(item) or text_of(item.get("expression", ""))
            rows.append((what, bounds_text(item)))
        else:
            rows.append((text_of(item), ""))
    return rows


def controllers(study):
    """(name, type, what it drives, gains) of each controller."""
    found = study.get("controllers")
    rows = []
    for name, item in (found.items() if isinstance(found, dict) else []):
        if isinstance(item, dict):
            rest = {key: item[key] for key in ("setpoint", "input", "gains", "feedback") if key in item}
            rows.append((str(name), text_of(item.get("type", "")), text_of(item.get("output", "")),
                         "; ".join(f"{key} {text_of(value)}" for key, value in rest.items())))
    return rows


def identification(study):
    """(key, value) of what an identification was asked for: each recording, how it is fitted, and what is looked for."""
    block = study.get("identify")
    rows = []
    for key, value in (block.items() if isinstance(block, dict) else []):
        if key in ("data", "holdout") and isinstance(value, list):
            rows += [(f"{key}[{k}]", text_of(item)) for k, item in enumerate(value)]
        else:
            rows.append((str(key), text_of(value)))
    return rows + settings(study, ("parameters",)) if rows else []


OVER = ("runs", "uncertain", "robust", "multistart")
SOLVED = ("gravity", "positions", "hold", "initial_state", "loads", "motion", "limits", "optimizer", "solver", "engine")


def settings(study, keys):
    """(key, value) of those blocks of the study that it has."""
    return [(key, text_of(study[key])) for key in keys if key in study]
