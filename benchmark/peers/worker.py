#!/usr/bin/env python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""One program of the comparison, started by race.py inside the virtual environment.

Usage: worker.py MODULE FOLDER. FOLDER has NAME.urdf and NAME.json of each case. A request is one line, CASE, METHOD and SETTING with tabs between;
the answer "ok STEPS SECONDS VALUES..." or "no REASON", as that of the benchmark program. SECONDS is the least processor time of a few runs.

A module has `version()` and `prepare(case, method, setting)`, which returns a function: one whole run from the start, which returns its number of
steps and the values, the joint positions at the end in the order of the case, or the gradient.
"""
import importlib
import json
import os
import pathlib
import sys
import time

SHORTEST = 0.03  # s of processor time


class Case:
    """What a module needs of a case: paths, names, the start, and the parameters of a gradient."""

    def __init__(self, folder, name):
        self.name = name
        self.folder = pathlib.Path(folder)
        self.urdf = self.folder / f"{name}.urdf"
        path = self.folder / f"{name}.json"
        self.about = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}  # the slider-crank is no open chain
        self.duration, self.joints, self.start, self.parameters = (self.about.get(key) for key in ("duration", "joints", "start", "parameters"))

    def urdf_text(self, continuous="continuous"):
        """The model. @param continuous the type of joints without limits, for programs that take an angle of such a joint as a point of a circle."""
        limit = '<limit lower="-1e6" upper="1e6" effort="1e6" velocity="1e6"/>' if continuous == "revolute" else ""
        text = self.urdf.read_text(encoding="utf-8")
        return text.replace('type="continuous">', f'type="{continuous}">{limit}')


def timed(run):
    """The last answer of a few runs, and the least processor time [s]."""
    start = time.process_time()
    steps, values = run()
    first = time.process_time() - start
    least, spent = first if first > 1.0 else float("inf"), 0.0
    while first <= 1.0 and spent < SHORTEST:
        start = time.process_time()
        steps, values = run()
        seconds = time.process_time() - start
        least = min(least, seconds)
        spent += seconds
    return steps, least, values


def answer(module, folder, line):
    """The answer to a request. Set-up is not timed."""
    name, method, setting = line.rstrip("\n").split("\t")
    steps, seconds, values = timed(module.prepare(Case(folder, name), method, float(setting)))
    return " ".join(["ok", str(steps), repr(seconds)] + [repr(float(value)) for value in values])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a library prints is no answer
    try:
        module = importlib.import_module(sys.argv[1])
        print("ready", module.version(), file=out, flush=True)
    except Exception as error:  # any fault of another program is its answer
        print("no", type(error).__name__, " ".join(str(error).split()), file=out, flush=True)
        return
    for line in sys.stdin:
        try:
            print(answer(module, sys.argv[2], line), file=out, flush=True)
        except Exception as error:
            print("no", type(error).__name__, " ".join(str(error).split())[:300], file=out, flush=True)


if __name__ == "__main__":
    main()
