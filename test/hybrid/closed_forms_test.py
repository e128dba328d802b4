#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Objective and gradient of `codesign gradient` against closed forms, in several ways of computing them.
Usage: closed_forms_test.py CODESIGN [--write]      --write: the table of doc/events.md from what is computed now"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from closed_forms import AT_STATES, AT_TIMES, CASES, ENDS, LOSSES  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parents[2] / "doc" / "events.md"
TIGHT = "relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10"
# name: (options of the solver, relative error that is allowed)
WAYS = {"default": ("", 2e-4), "joint": (TIGHT, 2e-6), "absolute": (TIGHT + ", coordinates: absolute", 2e-6), "implicit": (TIGHT + ", method: rodas5p", 2e-6),
        "idas": (TIGHT + ", integrator: idas", 1e-5), "adjoint": (TIGHT + ", gradient: adjoint", 2e-6)}
Answer = collections.namedtuple("Answer", "value gradient events way")


def errors(case, answer):
    """(relative error of the objective, largest one of the gradient). A derivative that hardly counts, by the parameter's own size, is compared with those that do."""
    value, gradient = case.expected()
    size = {name: max(abs(number), 1e-3 * (upper - lower)) for name, (number, lower, upper) in case.numbers.items()}
    most = max(abs(gradient[name]) * size[name] for name in gradient)
    return (abs(answer.value - value) / abs(value),
            max(abs(answer.gradient[name] - gradient[name]) / max(abs(gradient[name]), 1e-3 * most / size[name]) for name in gradient))


def evaluate(codesign, case, solver):
    with tempfile.TemporaryDirectory() as folder:
        model, study = pathlib.Path(folder, "model.urdf"), pathlib.Path(folder, "study.yaml")
        model.write_text(case.model_text(), encoding="utf-8")
        study.write_text(case.study_text(solver), encoding="utf-8")
        done = subprocess.run([codesign, "gradient", model, study, "--json", "--quiet"], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{case.name} ({solver}): {done.stderr}")
    answer = json.loads(done.stdout)
    way = {"solved_in": answer["counts"]["solved_in"], "explicit_steps": answer.get("explicit_steps", 0),
           "codes": [warning["code"] for warning in answer["warnings"]]}
    return Answer(answer["objective"], answer["gradient"], answer.get("event_count", 0), way)


def other_way(case, way, answer):
    """What shows that an answer was not computed in its way, so that the column would say nothing; "" if nothing does."""
    taken = answer.way
    if way == "absolute" and taken["solved_in"] != "absolute" or way == "joint" and taken["solved_in"] != "joint":
        return f"{case.name}, {way}: it was solved in {taken['solved_in']} coordinates"
    if way == "implicit" and taken["explicit_steps"]:
        return f"{case.name}, {way}: {taken['explicit_steps']} steps were explicit"
    if way == "idas" and taken["explicit_steps"] and "other_integrator" not in taken["codes"]:
        return f"{case.name}, {way}: another integrator computed it and nothing says so"
    return ""


def silent_adjoints(answers):
    """Groups of motions in which no adjoint differs from the direct gradient by as much as its rounding: it was the direct one."""
    for name, cases in (("at times", AT_TIMES), ("at states", AT_STATES), ("ends", ENDS), ("losses", LOSSES)):
        if not any(answers[case.name]["adjoint"].gradient != answers[case.name]["joint"].gradient for case in cases):
            yield f"{name}: every gradient of the way adjoint has the bits of the direct one"


def row(case, answers):
    """Its errors of the gradient with defaults, the largest one of the tight ways, and that of idas."""
    found = {way: errors(case, answer)[1] for way, answer in answers.items()}
    tight = max(error for way, error in found.items() if way not in ("default", "idas"))
    return f"| {case.name} | {answers['default'].events} | {found['default']:.0e} | {tight:.0e} | {found['idas']:.0e} |"


def table(rows):
    return "\n".join(["| motion | events | `default` | tight | `idas` |", "|---|" + "---:|" * 4, *rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("codesign")
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    codesign, faults, rows = os.path.abspath(given.codesign), [], []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {(case.name, way): pool.submit(evaluate, codesign, case, solver) for case in CASES for way, (solver, _) in WAYS.items() if way not in case.without}
        of_cases = {}
        for case in CASES:
            answers = of_cases[case.name] = {way: runs[case.name, way].result() for way in WAYS if way not in case.without}
            faults += filter(None, (other_way(case, way, answer) for way, answer in answers.items()))
            for way in answers:
                allowed = WAYS[way][1]
                for what, error in zip(("objective", "gradient"), errors(case, answers[way])):
                    if not error < allowed:
                        faults.append(f"{case.name}, {way}: the {what} is off by {error:.1e}, {allowed:.0e} is allowed: {answers[way]} for {case.expected()}")
            rows.append(row(case, answers))
    faults += silent_adjoints(of_cases)
    text = PAGE.read_text(encoding="utf-8")
    begin = text.index("| motion | events |")
    end = re.compile(r"\n(?!\|)").search(text, begin).start()
    if given.write:
        PAGE.write_text(text[:begin] + table(rows) + text[end:], encoding="utf-8")
    elif re.findall(r"^\| ([a-z][^|]+) \| \d", text[begin:end], re.MULTILINE) != [case.name for case in CASES]:
        faults.append("the table of doc/events.md lists other motions: closed_forms_test.py CODESIGN --write")
    print("\n".join(faults) or f"{len(CASES)} closed forms agree, each in {len(WAYS)} ways")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
