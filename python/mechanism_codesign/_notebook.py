# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""How objects show themselves in a notebook: tables, curves and the mechanism, drawn by the code of `codesign report`."""
from __future__ import annotations

import base64
import math
from html import escape
from typing import Any, Iterable, List, Sequence, Tuple

_MOST_CURVES = 6
_MOST_SECONDS = 2.0  # of a run that is repeated for its picture


def _short(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ("" if math.isnan(value) else "\u221e" if value > 0 else "\u2212\u221e")
    return "" if value is None else str(value)


def _table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """The first column is text."""
    def row(tag: str, cells: Sequence[Any]) -> str:
        return "<tr>" + "".join(f'<{tag} style="text-align:{"right" if k else "left"}">{escape(_short(c))}</{tag}>' for k, c in enumerate(cells)) + "</tr>"

    return f'<table><thead>{row("th", head)}</thead><tbody>{"".join(row("td", cells) for cells in rows)}</tbody></table>'


def _images(pictures: Iterable[Tuple[str, str]]) -> str:
    """Pictures side by side, as images: their style reaches nothing else on the page."""
    from .codesign_report import charts  # type: ignore  # scripts/codesign_report
    parts = []
    for caption, svg in pictures:
        data = base64.b64encode(charts.standalone(svg, background=True).encode()).decode()
        parts.append(f'<figure style="margin:4px;display:inline-block;width:420px;max-width:100%"><figcaption>{escape(caption)}</figcaption>'
                     f'<img alt="{escape(caption)}" style="width:100%" src="data:image/svg+xml;base64,{data}"/></figure>')
    return f'<div>{"".join(parts)}</div>'


def _notes(warnings: Iterable[Any]) -> str:
    return "".join(f"<p><b>{escape(w.code)}</b>: {escape(w.message)}</p>" for w in warnings)


def _curve(name: str, x: Sequence[float], curves: Sequence[Tuple[str, str, Sequence[float]]], unit: str, x_label: str = "time [s]") -> Tuple[str, str]:
    from .codesign_report import charts
    series = [charts.Series(label, kind, [float(v) for v in x], [float(v) for v in y]) for label, kind, y in curves]
    return name, charts.line_chart(name, series, x_label, f"[{unit}]" if unit else "")


def _scene(sides: Sequence[Tuple[str, str, Any]]) -> List[Tuple[str, str]]:
    """(caption, picture) of designs: (caption, URDF, poses)."""
    from .codesign_report import drawing, geometry
    scene = drawing.Scene([(geometry.Robot(urdf), poses) for _, urdf, poses in sides])
    return [(caption, scene.picture(k, caption)) for k, (caption, _, _) in enumerate(sides)]


def _outcome(of: Any) -> str:
    return escape(str(of.status) if of.termination == of.status.code else f"{of.status}, {of.termination}")


def extent(duration: float, postures: int, may_end_before: bool, runs: int, samples: int, is_uncertain: bool) -> str:
    """What a study computes, in words: `2 s`, `at most 5 s`, `3 postures`, `2 runs of 2 s, 32 samples of each`."""
    if postures == 0 and duration == 0.0:
        return "no study"
    each = f"{postures} posture{'' if postures == 1 else 's'}" if postures else f"{'at most ' if may_end_before else ''}{duration:g} s"
    words = f"{runs} runs of {each}" if runs > 1 else each
    return words + (f", {samples} samples{' of each' if runs > 1 else ''}" if is_uncertain else "")


def problem(name: str, extent_: str, of: Any) -> str:
    rows = [(p.name, p.value, p.lower, p.upper, p.unit, "tuned" if p.tuned else "") for p in of.parameters]
    return f"<p><b>{escape(name)}</b>, {escape(extent_)}</p>" + _table(("parameter", "value", "lower", "upper", "unit", ""), rows) + _notes(of.warnings)


def run(of: Any) -> str:
    rho, parameters = of._design
    found = of._problem._core.details(rho, parameters) if of.statistics["cpu_seconds"] < _MOST_SECONDS else {}
    units = {signal["name"]: signal["unit"] for signal in found.get("signals", [])}
    rows = [(name, float(y.min()), float(y.max()), float(y[-1]), units.get(name, "")) for name, y in of.items() if len(y)]
    in_postures = bool(found) and of.status.ok and "energy" not in found  # a motion has energies
    pictures = [_curve(name, of.time, [(name, "tuned", y)], units.get(name, ""), "posture" if in_postures else "time [s]")
                for name, y in list(of.items())[:_MOST_CURVES] if len(y)]
    if found.get("poses", {}).get("times"):
        moments = "in the first posture; faint: in others" if in_postures else "at the start; faint: later"
        pictures = _scene([(moments, of._problem.urdf(rho, **parameters), found["poses"])]) + pictures
    objective = "" if of.objective is None else f", objective {of.objective:.10g}"
    head = f'<p>{escape(str(of.status))}{objective}, {of.statistics["steps"]} steps, {of.statistics["cpu_seconds"]:.3g} s of processor time</p>'
    return head + _table(("signal", "smallest", "largest", "in the last posture" if in_postures else "at the end", "unit"), rows) + _images(pictures) + _notes(of.warnings)


def result(of: Any) -> str:
    head = f"<p>{_outcome(of)}"
    if not of._core.has_point:
        return head + "</p>" + _notes(of.warnings)
    head += f": objective {_short(of.initial_objective)} \u2192 <b>{_short(of.objective)}</b></p>"
    problem_ = of._problem
    named = {p.name: p for p in problem_.parameters}
    rows = [(name, a, b, named[name].lower, named[name].upper, named[name].unit) for name, a, b in zip(problem_.names, of.initial_rho.tolist(), of.rho.tolist())]
    pictures = []
    if len(of.best_objectives) > 1:
        pictures = [_curve("best objective by evaluation", range(1, len(of.best_objectives) + 1), [("best", "tuned", of.best_objectives)], "", "evaluation")]
    sides = [(caption, problem_.urdf(rho), problem_._core.details(rho, {})["poses"]) for caption, rho in (("before", of.initial_rho), ("after", of.rho))]
    if all(poses["times"] for _, _, poses in sides):
        pictures = _scene(sides) + pictures
    return head + _table(("parameter", "initial", "tuned", "lower", "upper", "unit"), rows) + _images(pictures) + _notes(of.warnings)


def fit(of: Any) -> str:
    head = f"<p>{_outcome(of)}</p>"
    rows = [(name, n.start, n.value, n.deviation, *(n.interval or (None, None)), n.unit,
             "on its bound" if n.on_bound else "" if n.determined else "not determined") for name, n in of.numbers.items()]
    pictures = [_curve(f"{name}: recorded (dashed) and computed", of.time, [("recorded", "initial", of.recorded[name]), ("computed", "tuned", of.computed[name])], "")
                for name in list(of.recorded)[:_MOST_CURVES]]
    return head + _table(("number", "start", "identified", "deviation", "from", "to", "unit", ""), rows) + _images(pictures) + _notes(of.warnings)
