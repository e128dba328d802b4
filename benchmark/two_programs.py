#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What whole runs of one program cost beside those of another, of an earlier revision say. Usage: benchmark/two_programs.py BEFORE AFTER [--pairs N]

BEFORE and AFTER are programs `codesign`. An earlier one is built in a working tree of its own, whose folder `build` is its own, too:

  git worktree add ../before REVISION && ../before/tools/build codesign
  benchmark/two_programs.py ../before/devel/lib/mechanism_codesign/codesign devel/lib/mechanism_codesign/codesign

Both run the shipped cases of this tree in turn, one after the other in a pair and in changing order, so that other work of the machine disturbs both alike. Prints the median of
the quotients of their processor times, after over before, with half of the range of the middle half of them, and both medians [s].
"""
import argparse
import csv
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def lengthened(folder, case, duration):
    """The files of a shipped case whose study has another duration."""
    text = (ROOT / f"config/{case}.yaml").read_text(encoding="utf-8")
    first = next(line for line in text.splitlines() if line.startswith("duration:"))
    study = folder / f"{case}_{duration}.yaml"
    study.write_text(text.replace(first, f"duration: {duration}"), encoding="utf-8")
    return [str(ROOT / f"urdf/{case}.urdf"), str(study)]


def cases(folder, program):
    """(name, words): runs of some tenths of a second."""
    recorded = folder / "slider_crank_identify.csv"
    model, study = ROOT / "urdf/slider_crank_identify.urdf", ROOT / "config/slider_crank_identify.yaml"
    subprocess.run([program, "simulate", model, study, "--samples", "30001", "--csv", folder / "run.csv", "--quiet", "--signals", "crank_joint/velocity,crank_joint/effort"], check=True)
    subprocess.run([ROOT / "scripts/simulate_sensors", folder / "run.csv", recorded, "--rate", "100", "--noise", "*=40", "--delay", "*/effort=0.004"], check=True)
    with open(recorded, newline="", encoding="utf-8") as file:
        assert len(list(csv.reader(file))) > 1000
    (folder / study.name).write_text(study.read_text(encoding="utf-8"), encoding="utf-8")
    return [("simulate slider_crank, 100 s", ["simulate", *lengthened(folder, "slider_crank", 100.0)]), ("simulate governor, 50 s", ["simulate", *lengthened(folder, "governor", 50.0)]),
            ("gradient slider_crank, 30 s", ["gradient", *lengthened(folder, "slider_crank", 30.0)]), ("gradient governor, 15 s", ["gradient", *lengthened(folder, "governor", 15.0)]),
            ("optimize inverted_pendulum", ["optimize", *(str(ROOT / f"{place}/inverted_pendulum.{kind}") for place, kind in (("urdf", "urdf"), ("config", "yaml")))]),
            ("identify slider_crank_identify", ["identify", str(model), str(folder / study.name)])]


def seconds(program, words):
    """Processor time of one run. A fit that says what it cannot determine ends with 1."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, *words, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        sys.exit(f"{program} {' '.join(words)}: {done.stderr}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def pair(programs, words, backward):
    """The times of both, of which the second may run first."""
    order = programs[::-1] if backward else programs
    times = [seconds(program, words) for program in order]
    return times[::-1] if backward else times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs=2, metavar="PROGRAM")
    parser.add_argument("--pairs", type=int, default=15, help="runs of each program for each case, at least 3")
    arguments = parser.parse_args()
    if arguments.pairs < 3:
        parser.error("--pairs: at least 3")
    with tempfile.TemporaryDirectory() as folder:
        print("| run | after/before | half of the middle half | before [s] | after [s] |\n|---|---:|---:|---:|---:|")
        for name, words in cases(pathlib.Path(folder), arguments.programs[0]):
            pair(arguments.programs, words, False)  # caches of the machine
            times = [pair(arguments.programs, words, k % 2 == 1) for k in range(arguments.pairs)]
            quotients = [after / before for before, after in times]
            low, middle, high = statistics.quantiles(quotients, n=4)
            before, after = (statistics.median(column) for column in zip(*times))
            print(f"| {name} | {middle:.3f} | {0.5 * (high - low):.3f} | {before:.3f} | {after:.3f} |", flush=True)


if __name__ == "__main__":
    main()
