#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Random hybrid studies: objective and gradient of `codesign gradient` against an event-driven solver of this folder.
Usage: hybrid_test.py CODESIGN [--studies N | --minutes M] [--first NUMBER] [--keep FOLDER] [--gradient METHOD] [--verbose]"""
import argparse
import collections
import concurrent.futures
import functools
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import numpy as np  # noqa: E402

from event_solver import Doubt, Motion  # noqa: E402
from random_study import Generator  # noqa: E402

VALUE, GRADIENT = 1e-7, 1e-5  # relative errors allowed
FAULTS = ("disagree", "failed", "without derivative, not told")


def write(study, folder):
    model, text = folder / "model.urdf", folder / "study.yaml"
    model.write_text(study.model_text(), encoding="utf-8")
    text.write_text(study.study_text(), encoding="utf-8")
    return model, text


def evaluate(codesign, study, folder):
    """What the program says: (JSON, None) or (None, message)."""
    model, text = write(study, folder)
    done = subprocess.run([codesign, "gradient", model, text, "--json", "--quiet"], capture_output=True, text=True, check=False)
    if done.returncode == 2 or done.returncode < 0:
        raise RuntimeError(done.stderr)
    return (json.loads(done.stdout), None) if done.returncode == 0 else (None, done.stderr.strip() or done.stdout)


def judge(codesign, study):
    """(outcome, details)"""
    with tempfile.TemporaryDirectory() as folder:
        answer, failure = evaluate(codesign, study, pathlib.Path(folder))
    motion = Motion(study)
    try:
        value, gradient = motion.run()
    except Doubt as doubt:
        honest = failure or (answer["warnings"] and "; ".join(w["code"] for w in answer["warnings"]))
        return ("without derivative, told" if honest else "without derivative, not told"), f"{doubt}; the program: {honest}"
    if failure:
        return "failed", failure
    ranges = np.array([study.ranges[name][1] - study.ranges[name][0] for name in study.names])
    ours = np.array([answer["gradient"][name] for name in study.names])
    scale = max(np.max(np.abs(gradient * ranges)), abs(value))
    error_value = abs(answer["objective"] - value) / max(abs(value), 1e-3)
    error = np.abs(ours - gradient) * ranges / scale
    worst = int(np.argmax(error))
    details = f"{len(motion.events)} events, {answer['steps']} steps, value off by {error_value:.1e}, gradient by {error[worst]:.1e}"
    if error_value < VALUE and error[worst] < GRADIENT:
        return "agree", details
    warned = [warning["code"] for warning in answer["warnings"]]
    details += f" ({study.names[worst]}: {ours[worst]:.10g} for {gradient[worst]:.10g}; objective {answer['objective']:.10g} for {value:.10g}) {warned}"
    return ("warned" if warned else "disagree"), details


def compare(codesign, seed, keep=None, gradient=None):
    """One line about the study of a number: (outcome, kinds, details). Model and study of a fault are kept."""
    generator = Generator(seed)
    study = generator.make()
    method = gradient or ("adjoint" if seed % 2 else "auto")
    study.solver = study.solver.replace("{", f"{{gradient: {method}, ", 1)
    outcome, details = judge(codesign, study)
    if keep and outcome in FAULTS:
        folder = pathlib.Path(keep) / str(seed)
        folder.mkdir(parents=True, exist_ok=True)
        write(study, folder)
        details += f"\n  kept in {folder}"
    return outcome, ", ".join(generator.kinds), details


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("codesign")
    parser.add_argument("--studies", type=int, default=40, help="how many; their numbers are their seeds")
    parser.add_argument("--first", type=int, default=0, help="the first number")
    parser.add_argument("--minutes", type=float, help="as many as can be compared in this time, in place of --studies")
    parser.add_argument("--keep", help="a folder for models and studies that fail")
    parser.add_argument("--gradient", choices=("direct", "adjoint"), help="of all studies; by default the adjoint of those with an odd number")
    parser.add_argument("--verbose", action="store_true", help="a line for each study")
    return parser.parse_args()


def numbers(given):
    """The numbers of the studies, until the time is over."""
    begin = time.monotonic()
    for number in itertools.count(given.first):
        if number - given.first >= given.studies if given.minutes is None else time.monotonic() - begin > 60.0 * given.minutes:
            return
        yield number


def main():
    given = options()
    outcomes, kinds_seen = collections.Counter(), collections.Counter()
    compare_one = functools.partial(compare, os.path.abspath(given.codesign), keep=given.keep, gradient=given.gradient)
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        source, waiting = numbers(given), collections.deque()
        while True:
            while len(waiting) < 2 * os.cpu_count() and (number := next(source, None)) is not None:
                waiting.append((number, pool.submit(compare_one, number)))
            if not waiting:
                break
            number, future = waiting.popleft()
            outcome, kinds, details = future.result()
            outcomes[outcome] += 1
            kinds_seen.update(set(kinds.split(", ")))
            if given.verbose or outcome in FAULTS:
                print(f"{number}: {outcome}: {kinds}: {details}", flush=True)
    if given.verbose:
        print(", ".join(f"{kind} {count}" for kind, count in sorted(kinds_seen.items())))
    print(f"{sum(outcomes.values())} hybrid studies: " + ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    sys.exit(1 if any(outcomes[fault] for fault in FAULTS) else 0)


if __name__ == "__main__":
    main()
