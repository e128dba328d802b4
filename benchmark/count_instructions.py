#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Instructions of plain simulations of two builds, counted by valgrind: those of the second half of a run, which set-up has no part in.
Usage: count_instructions.py BEFORE AFTER [CASE...]   two programs codesign, built with -DCODESIGN_NATIVE=OFF, and shipped cases, by default those whose
studies have a number as duration; prints a table in Markdown. Steps are chosen anew in a run of half the duration, so that its last steps differ."""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
DURATION = re.compile(r"^duration:\s*([\d.eE+-]+)\s*(#.*)?$", re.MULTILINE)


def count(program, model, study):
    words = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", program, "simulate", model, study, "--quiet", "--samples", "2"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    found = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
    if done.returncode != 0 or not found:
        raise RuntimeError(done.stderr[-300:])
    return int(found.group(1).replace(",", ""))


def measure(name, programs):
    """Per program: instructions of the second half, and of the whole program."""
    model, study = ROOT / f"urdf/{name}.urdf", ROOT / f"config/{name}.yaml"
    text = study.read_text(encoding="utf-8")
    found = DURATION.search(text)
    handle, half = tempfile.mkstemp(dir=study.parent, prefix=".half_", suffix=".yaml")  # beside the files that the study names
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text[:found.start()] + f"duration: {float(found.group(1)) / 2}" + text[found.end():])
        wholes = [count(program, model, study) for program in programs]
        return [(whole - count(program, model, half), whole) for program, whole in zip(programs, wholes)]
    finally:
        os.unlink(half)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    programs, names = sys.argv[1:3], sys.argv[3:]
    names = names or [path.stem for path in sorted((ROOT / "config").glob("*.yaml")) if DURATION.search(path.read_text(encoding="utf-8"))]
    print("| case | second half of the run [million instructions] | change | whole program | change |\n|---|---|---:|---|---:|")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, future in [(name, pool.submit(measure, name, programs)) for name in names]:
            try:
                (before, all_before), (after, all_after) = future.result()
            except RuntimeError as error:
                print(f"{name}: {error}", file=sys.stderr)
                continue
            print(f"| {name} | {before / 1e6:.1f} → {after / 1e6:.1f} | {100 * (after / before - 1):+.1f} % | {all_before / 1e6:.1f} → {all_after / 1e6:.1f} "
                  f"| {100 * (all_after / all_before - 1):+.1f} % |", flush=True)


if __name__ == "__main__":
    main()
