# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Puts the page together."""
import json
import os
import re
import shlex
import xml.etree.ElementTree as ElementTree

import jinja2

from . import asked, drawing, efforts, geometry, linear, numbers, results, signals, tradeoff, words
from .job import ReportError, find_job, read_json, read_text
from .numbers import Markup

HERE = os.path.dirname(os.path.abspath(__file__))
MOST_BYTES = 2_000_000
MOST_EMBEDDED = 300_000


def read_robot(path):
    try:
        return geometry.Robot(read_text(path))
    except ElementTree.ParseError as error:
        raise ReportError(f"{path}:{error.position[0]}: not complete XML from column {error.position[1] + 1} on; codesign urdf writes the model of a design") from error
    except (AttributeError, TypeError) as error:
        raise ReportError(f"{path}: not a model in URDF: a joint without parent or child, or an end of a loop without link") from error


def mechanism(job):
    """(pictures, traced): the mechanism before and after, empty if the poses or the models are missing; links whose path is drawn."""
    sides = []
    for side in ("initial", "tuned"):
        poses = job.details.get(side, {}).get("poses")
        if poses and poses["times"] and job.has(side + ".urdf"):
            sides.append((side, read_robot(job.path(side + ".urdf")), poses))
    if not sides:
        return [], ()
    traced = signals.traced(job.study, sides[0][2]["links"]) if job.in_postures else ()
    scene = drawing.Scene([side[1:] for side in sides], traced, asked.numbers_asked(job.study))
    titles = {"initial": "Before", "tuned": "After"}
    moments = "in the first posture; faint: in others" if job.in_postures else "at the start; faint: later"
    return [(titles[side], scene.picture(k, f"The mechanism {titles[side].lower()}, {moments}")) for k, (side, _, _) in enumerate(sides)], traced


def embedded(job):
    """The result as JSON that no parser of HTML ends early; empty if it is long."""
    text = json.dumps(job.result)
    return Markup(text.replace("<", "\\u003c")) if len(text) < MOST_EMBEDDED else ""


def shell_word(path):
    """A path as one word of bash, also where its bytes are no UTF-8."""
    data = os.fsencode(path)
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "$'" + "".join(chr(byte) if 32 <= byte < 127 and byte not in b"'\\" else f"\\x{byte:02x}" for byte in data) + "'"
    return shlex.quote(path)


def commands(job):
    """[(what, command)] that repeat the job or go on from it."""
    files = job.details.get("files", {})
    here = "cd " + shell_word(job.folder)
    if job.kind == "identification":
        model, study, result = (shell_word(job.prefix + name) for name in ("identified.urdf", "job_study.yaml", "identification.json"))
        study = study if job.study_text else "STUDY"
        rows = [("see the identified numbers in motion", f"{here} && codesign simulate {model} {study} --result {result}")]
        if job.bag:
            rows.append(("the measured beside the identified motion", f"roslaunch mechanism_codesign replay.launch bag:={shell_word(job.bag)}"))
        return rows
    rows = []
    if files.get("model") and not job.bag:
        overlays = "".join(f" --overlay {shell_word(path)}" for path in files.get("overlays", []))
        overlays += " --base floating" if files.get("base") == "floating" else ""
        inputs = f'{shell_word(files["model"])} {shell_word(files["study"])}{overlays} --result {shell_word(job.path("initial.json"))}'
        rows.append(("the same job from its files", f"codesign optimize {inputs} --output again"))
    rows += [("the same job from this folder alone", f"{here} && codesign optimize initial.urdf job_study.yaml --result initial.json --output again"),
             ("the objective of the result, to the last digit", f"{here} && codesign gradient tuned.urdf job_study.yaml --result result.json --json"),
             ("the tuned postures as a table" if job.in_postures else "the tuned run as a table", f"{here} && codesign simulate tuned.urdf job_study.yaml --result result.json --csv run.csv"),
             ("the tuned mechanism in rviz",
              f"{here} && roslaunch mechanism_codesign simulate.launch model:=tuned.urdf study:=job_study.yaml result:=result.json")]
    if job.bag:
        rows.append(("both runs side by side", f"roslaunch mechanism_codesign replay.launch bag:={shell_word(job.bag)}"))
    if job.gains:
        rows.append(("the gains to a robot's parameter server", f"{here} && rosparam load gains.yaml"))
    return rows


def postures(job):
    """(number, joints) of a study of postures; None of a motion."""
    tables = [table for table in job.runs.values() if table]
    return (len(tables[-1]) if tables else None, list(job.study["positions"])) if job.in_postures else None


def context(job, scale):
    """Everything that the template shows."""
    friction_rows, friction_chart = results.friction(job)
    pictures, traced = mechanism(job)
    identified, interval_scale = results.identified(job)
    signal_rows, zeros = signals.signal_rows(job)
    return {
        "job": job, "result": job.result, "details": job.details, "embedded": embedded(job),
        "verdict": " ".join(filter(None, (words.termination(job.result.get("termination", "")), words.stationarity(job.result)))),
        "terms": asked.objective_terms(job.study), "bounds": asked.bounds(job.study), "controllers": asked.controllers(job.study),
        "fitted": asked.identification(job.study) if job.kind == "identification" else [],
        "over": asked.settings(job.study, asked.OVER), "settings": asked.settings(job.study, asked.SOLVED),
        "mechanism": pictures, "traced": traced, "postures": postures(job),
        "wanted": job.in_postures and bool(asked.numbers_asked(job.study)), "objective_title": signals.GROUPS[0][0], "convergence": results.convergence(job), "failed_trials": len(results.failed_trials(job)),
        "friction_rows": friction_rows, "friction_chart": friction_chart, "energies": results.energies(job),
        "signal_rows": signal_rows, "zeros": zeros, "signal_groups": signals.signal_groups(job, scale),
        "contacts": signals.contacts(job), "events": signals.events(job),
        "waterfall": results.waterfall(job), "samples": results.samples(job),
        "identified": identified, "interval_percent": numbers.short(100.0 * interval_scale, 3), "correlations": results.correlations(job), "residuals": results.residuals(job),
        "commands": commands(job),
    }


def labelled(rows):
    """The rows of a table with the name of its column at each cell, which a narrow page shows in place of the head."""
    labels = [re.sub(r"<[^>]*>", "", text) for text in re.findall(r'<th scope="col"[^>]*>(.*?)</th>', rows)]

    def row(match):
        cells = iter(labels[1:])
        return re.sub(r"<td\b([^>]*)>", lambda td: f'<td{td[1]} data-label="{next(cells, "")}">', match[0])

    return Markup(re.sub(r'<tr><th scope="row">.*?</tr>', row, rows, flags=re.DOTALL))


def environment():
    env = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                             undefined=jinja2.ChainableUndefined)
    env.filters["num"] = lambda value, digits=6: "" if isinstance(value, jinja2.Undefined) else numbers.number(value, digits)
    env.filters["labelled"] = labelled
    env.filters["on_bound"] = words.on_bound
    env.globals["style"] = Markup(read_text(os.path.join(HERE, "style.css")))
    return env


def find(path):
    """What a page can show: the trade-off, the linearization or the efforts of a JSON file, or a job."""
    path = os.path.abspath(path)
    if not (path.endswith(".json") and os.path.isfile(path)):
        return find_job(path)
    result = read_json(path)
    if tradeoff.is_one(result):
        return tradeoff.Tradeoff(path, result)
    return linear.Linearization(path, result) if linear.is_one(result) else efforts.Efforts(path, result)


def shown(text):
    """Bytes of names that are no UTF-8 get the sign of what is unknown: a page is UTF-8."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def render(job):
    """The page as text. Curves get coarser until it is at most two megabytes."""
    if isinstance(job, efforts.Efforts):
        return shown(environment().get_template("efforts.html.j2").render(efforts.context(job)))
    if isinstance(job, linear.Linearization):
        return shown(environment().get_template("linear.html.j2").render(linear.context(job)))
    if isinstance(job, tradeoff.Tradeoff):
        return shown(environment().get_template("tradeoff.html.j2").render(tradeoff.context(job)))
    template = environment().get_template("page.html.j2")
    for scale in (1.0, 0.5, 0.2, 0.0):
        text = shown(template.render(context(job, scale)))
        if len(text.encode()) <= MOST_BYTES:
            break
    return text
