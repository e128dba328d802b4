#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What the gradients of all shipped cases cost and say, with one program or with two beside each other. Usage: benchmark/shipped_gradients.py [BEFORE] AFTER [--cases WORD]

BEFORE and AFTER are programs `codesign`; benchmark/two_programs.py says how to build an earlier one. Each evaluates the studies of config/ and gallery/ of this tree at their own
start, in turn. Prints a table: accepted steps of a run without gradient, accepted and rejected ones of the gradient, its processor time [ms], the objective and the Euclidean norm
of the gradient. With two programs every column has both numbers, and `steps` and `gradient` say by how much AFTER differs: in accepted steps, and |g - g'|/|g'| over all parameters.
A study that has no gradient shows why.
"""
import argparse
import json
import math
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEAD = ["case", "simulate", "accepted", "rejected", "ms", "objective", "norm"]


def cases(word):
    """(name, model, study) of the shipped cases whose names hold `word`."""
    found = [(path.stem, ROOT / f"urdf/{path.stem}.urdf", path) for path in sorted((ROOT / "config").glob("*.yaml"))]
    found += [(path.parent.name, path.parent / "model.urdf", path) for path in sorted((ROOT / "gallery").glob("*/study.yaml"))]
    return [case for case in found if word in case[0] and case[1].exists()]


def answer(program, command, model, study):
    """The JSON object that a command prints, also of a failure."""
    done = subprocess.run([program, command, model, study, "--json", "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return json.loads(done.stdout)


def measured(program, model, study):
    """The columns of one program, and the gradient; a text in place of both if there is none."""
    run, result = answer(program, "simulate", model, study), answer(program, "gradient", model, study)
    if "gradient" not in result:
        return result.get("error", {}).get("code", "no gradient"), None
    gradient = list(result["gradient"].values())
    return [str(run.get("steps", "-")), str(result["steps"]), str(result["rejected_steps"]), f"{1e3 * result['cpu_seconds']:.1f}", f"{result['objective']:.9g}",
            f"{math.hypot(*gradient):.6g}"], gradient


def differences(before, after):
    """The columns `steps` and `gradient` of two programs."""
    (columns, gradient), (other_columns, other) = before, after
    distance, size = math.dist(gradient, other), math.hypot(*other)
    return [f"{100.0 * (float(other_columns[1]) / max(1.0, float(columns[1])) - 1.0):+.1f} %", f"{distance / size if size > 0.0 else distance:.1e}"]


def row(name, programs, model, study):
    """The cells of a case."""
    results = [measured(program, model, study) for program in programs]
    if any(gradient is None for _, gradient in results):
        return [name, " / ".join(columns if gradient is None else "ok" for columns, gradient in results)]
    cells = [name] + [" ".join(numbers) for numbers in zip(*(columns for columns, _ in results))]
    return cells + (differences(*results) if len(results) == 2 and len(results[0][1]) == len(results[1][1]) else [])


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--cases", default="", metavar="WORD", help="only cases whose names hold this word")
    options = parser.parse_args()
    if len(options.programs) > 2:
        parser.error("one program, or two")
    head = HEAD + (["steps", "gradient"] if len(options.programs) == 2 else [])
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for case in cases(options.cases):
        print(f"| {' | '.join(row(case[0], options.programs, *case[1:]))} |", flush=True)


if __name__ == "__main__":
    main()
