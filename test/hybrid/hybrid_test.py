#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Random hybrid studies: objective and gradient of `codesign gradient` against an event-driven solver of this folder.
Usage: hybrid_test.py CODESIGN [--studies N] [--first SEED] [--keep FOLDER] [--table]"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import numpy as np  # noqa: E402

from event_solver import Doubt, Motion  # noqa: E402
from random_study import Generator  # noqa: E402

VALUE, GRADIENT = 1e-7, 1e-5  # relative errors allowed


def evaluate(codesign, study, folder):
    """What the program says: (JSON, None) or (None, message)."""
    model, text = folder / "model.urdf", folder / "study.yaml"
    model.write_text(study.model_text(), encoding="utf-8")
    text.write_text(study.study_text(), encoding="utf-8")
    done = subprocess.run([codesign, "gradient", model, text, "--json", "--quiet"], capture_output=True, text=True, check=False)
    if done.returncode == 2 or done.returncode < 0:
        raise RuntimeError(done.stderr)
    return (json.loads(done.stdout), None) if done.returncode == 0 else (None, done.stderr.strip() or done.stdout)


def compare(codesign, seed, keep):
    """One line about a study: (outcome, kinds, details)."""
    generator = Generator(seed)
    study = generator.make()
    kinds = ", ".join(generator.kinds)
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(keep) / str(seed) if keep else pathlib.Path(place)
        folder.mkdir(parents=True, exist_ok=True)
        answer, failure = evaluate(codesign, study, folder)
    motion = Motion(study)
    try:
        value, gradient = motion.run()
    except Doubt as doubt:
        honest = failure or (answer["warnings"] and "; ".join(w["code"] for w in answer["warnings"]))
        return ("doubt, told" if honest else "doubt, not told"), kinds, f"{doubt}; the program: {honest}"
    if failure:
        return "failed", kinds, failure
    ranges = np.array([study.ranges[name][1] - study.ranges[name][0] for name in study.names])
    ours = np.array([answer["gradient"][name] for name in study.names])
    scale = max(np.max(np.abs(gradient * ranges)), abs(value))
    error_value = abs(answer["objective"] - value) / max(abs(value), 1e-3)
    error = np.abs(ours - gradient) * ranges / scale
    worst = int(np.argmax(error))
    details = f"{len(motion.events)} events, {answer['steps']} steps, value off by {error_value:.1e}, gradient by {error[worst]:.1e}"
    if error_value < VALUE and error[worst] < GRADIENT:
        return "agrees", kinds, details
    warned = [warning["code"] for warning in answer["warnings"]]
    details += f" ({study.names[worst]}: {ours[worst]:.10g} for {gradient[worst]:.10g}; objective {answer['objective']:.10g} for {value:.10g}) {warned}"
    return ("warned" if warned else "DISAGREES"), kinds, details


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("codesign")
    parser.add_argument("--studies", type=int, default=40)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    outcomes = collections.Counter()
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        seeds = range(options.first, options.first + options.studies)
        for seed, (outcome, kinds, details) in zip(seeds, pool.map(compare, [os.path.abspath(options.codesign)] * len(seeds), seeds, [options.keep] * len(seeds))):
            outcomes[outcome] += 1
            if options.verbose or outcome in ("DISAGREES", "failed", "doubt, not told"):
                print(f"{seed}: {outcome}: {kinds}: {details}", flush=True)
    print(dict(outcomes))
    sys.exit(1 if outcomes["DISAGREES"] + outcomes["failed"] + outcomes["doubt, not told"] else 0)


if __name__ == "__main__":
    main()
