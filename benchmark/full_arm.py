#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Processor time of the fit of a whole arm: ten inertial numbers of each of seven links, Coulomb and viscous friction of each of seven joints, 84 numbers.

Each arm is random: links of thirty masses, so that their inertias are possible; 20 s of a sum of cosines at 200 Hz, with noise of 0.3 N m and 2e-5 rad; the fit begins at
masses, centres and inertias up to 1.5 times too large or too small. Prints the times that `codesign identify` tells, and what the fit leaves of the efforts.

usage: benchmark/full_arm.py [--codesign PROGRAM] [--arms N]
"""
import argparse
import csv
import json
import math
import pathlib
import random
import subprocess
import tempfile

AXES = ("0 0 1", "0 1 0", "0 0 1", "0 -1 0", "0 0 1", "0 1 0", "0 0 1")
PLACES = ("0 0 0.3", "0 0 0.05", "0 0 0.3", "0.08 0 0.1", "-0.08 0 0.3", "0 0 0.1", "0.08 0 0.1")
LINK = ("alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3")
NOISE = {"position": 2e-5, "effort": 0.3}


class Link:
    """Thirty masses about a centre."""

    def __init__(self, generator, place):
        self.mass = generator.uniform(1, 5) * (1 - 0.1 * place)
        self.centre = [generator.uniform(-0.1, 0.1) for _ in range(3)]
        sizes = [generator.uniform(0.05, 0.15) for _ in range(3)]
        points = [[generator.gauss(0, size) for size in sizes] for _ in range(30)]
        means = [sum(column) / 30 for column in zip(*points)]
        points = [[x - mean for x, mean in zip(point, means)] for point in points]
        self.second = {(a, b): self.mass / 30 * sum(point[a] * point[b] for point in points) for a in range(3) for b in range(a, 3)}

    def inertial(self, mass, centre, inertia):
        """The element, each kind of number times a factor."""
        second, trace = self.second, sum(self.second[a, a] for a in range(3))
        numbers = {"xyz"[a] + "xyz"[b]: (trace - value if a == b else -value) * inertia for (a, b), value in second.items()}
        moments = " ".join(f'i{axes}="{value:.9g}"' for axes, value in numbers.items())
        place = " ".join(f"{x * centre:.9g}" for x in self.centre)
        return f'<inertial codesign:inertia="free"><origin xyz="{place}"/><mass value="{self.mass * mass:.9g}"/><inertia {moments}/></inertial>'


def arm(links, factors, friction):
    text = '<robot name="arm" xmlns:codesign="urn:mechanism_codesign">'
    text += "".join(f'<codesign:parameter name="{name}" value="{value:.6g}" lower="0" upper="50"/>' for name, value in friction.items())
    text += '<link name="base"/>'
    for k, (link, factor) in enumerate(zip(links, factors)):
        law = " ".join(f'{kind}="{friction[f"{kind}{k}"]:.6g}" codesign:{kind}="${{{kind}{k}}}"' for kind in ("coulomb", "viscous"))
        text += (f'<link name="link{k}">{link.inertial(*factor)}</link><joint name="joint{k}" type="continuous"><parent link="{f"link{k - 1}" if k else "base"}"/>'
                 f'<child link="link{k}"/><origin xyz="{PLACES[k]}"/><axis xyz="{AXES[k]}"/><codesign:friction {law} transition_velocity="0.01"/></joint>')
    return text + "</robot>"


def drive(generator):
    text = "duration: 20.0\ncontrollers:\n"
    for k in range(7):
        terms = []
        for wave in range(1, 6):
            size, turn = generator.uniform(-0.35, 0.35), 2 * math.pi * wave / 10
            terms.append(f"({size:.4f})*" + (f"(1 - cos({turn:.6f}*t))" if wave % 2 else f"sin({turn:.6f}*t)"))
        stiffness = 1 - 0.12 * k
        text += (f"  drive{k}: {{type: pid, input: joint{k}/position, output: joint{k}, gains: {{p: {2000 * stiffness:.0f}, d: {150 * stiffness:.0f}}}, "
                 f'setpoint: "${{{" + ".join(terms)}}}"}}\n')
    return text


def answer_of(program, command, folder, files, more=()):
    done = subprocess.run([program, command, *(str(folder / file) for file in files), "--json", "--quiet", *more], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def fit(program, seed, folder):
    generator = random.Random(seed)
    links = [Link(generator, k) for k in range(7)]
    friction = {f"{kind}{k}": generator.uniform(0.3, 2) for k in range(7) for kind in ("coulomb", "viscous")}
    factors = [(generator.uniform(0.7, 1.4), generator.uniform(0.6, 1.3), generator.uniform(0.7, 1.5)) for _ in links]
    names = [f"link{k}_{number}" for k in range(7) for number in LINK] + list(friction)
    study = "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 30.0, residual_cutoff: 10.0, decimate: 5}\nparameters: {"
    for name, text in (("true.urdf", arm(links, [(1, 1, 1)] * 7, friction)), ("start.urdf", arm(links, factors, dict.fromkeys(friction, 0.8))),
                       ("drive.yaml", drive(generator)), ("fit.yaml", study + ", ".join(f"{name}: {{}}" for name in names) + "}\n")):
        (folder / name).write_text(text, encoding="utf-8")
    wanted = [f"joint{k}/{quantity}" for k in range(7) for quantity in NOISE]
    series = answer_of(program, "simulate", folder, ("true.urdf", "drive.yaml"), ["--samples", "4001", "--signals", ",".join(wanted)])["series"]
    columns = [series["time"]] + [[value + generator.gauss(0, NOISE[name.split("/")[1]]) for value in series[name]] for name in wanted]
    with open(folder / "data.csv", "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["time", *wanted])
        rows.writerows(zip(*columns))
    return len(names), answer_of(program, "identify", folder, ("start.urdf", "fit.yaml"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, usage=argparse.SUPPRESS)
    parser.add_argument("--codesign", default="codesign")
    parser.add_argument("--arms", type=int, default=5)
    arguments = parser.parse_args()
    print("| arm | numbers | determined combinations | fitted samples of each joint | evaluations | least explained share of an effort | processor time [s] |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for seed in range(1, arguments.arms + 1):
        with tempfile.TemporaryDirectory() as folder:
            count, answer = fit(arguments.codesign, seed, pathlib.Path(folder))
        explained = min(joint["explained"] for joint in answer["data"]["joints"].values())
        print(f"| {seed} | {count} | {answer['rank']} | {answer['data']['samples']} | {answer['evaluations']} | {explained:.4f} | {answer['cpu_seconds']:.2f} |", flush=True)


if __name__ == "__main__":
    main()
