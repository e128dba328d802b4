#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Gradients of motions that rest, switch, bounce or end by themselves, against closed forms. Usage: benchmark/known_gradients.py CODESIGN [--cases WORD]

Each study is computed with the default tolerances (or those of its row) by several methods and kinds of coordinates, where they apply. Prints a line per parameter: the closed
form, the derivative of `codesign gradient` that is farthest from it, their relative difference (to the largest derivative over the ranges), and with which keys. Exits with 1 if one differs by more
than 1e-4 of it."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

SLIDE = """<robot name="slider"><link name="ground"/><link name="body"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
<joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/><axis xyz="1 0 0"/>{more}<limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint></robot>"""
WHEEL = """<robot name="wheel"><link name="ground"/><link name="rotor"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="2"/></inertial></link>
<joint name="slide" type="continuous"><parent link="ground"/><child link="rotor"/><axis xyz="0 0 1"/></joint></robot>"""
PENDULUM = """<robot name="pendulum"><link name="ground"/><link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
<joint name="slide" type="continuous"><parent link="ground"/><child link="bob"/><axis xyz="0 1 0"/></joint></robot>"""
ALL = ("", "method: dopri5, ", "method: rodas5p, ", "method: rodas4, ", "coordinates: absolute, ", "integrator: idas, ")
SWITCHES = ALL[:-1]  # idas leaves switches to the other integrator
ADJOINT = ALL + ("gradient: adjoint, ",)


def damped(stiffness, damping, inertia, time):
    """The position of a damped oscillator that starts at 1 from rest."""
    decay, wave = damping / (2 * inertia), math.sqrt(stiffness / inertia - (damping / (2 * inertia)) ** 2)
    return math.exp(-decay * time) * (math.cos(wave * time) + decay / wave * math.sin(wave * time))


def cases():
    """(name, model, study, {parameter: derivative}, keys of the solver)"""
    slide = SLIDE.format(more="")
    switched = 0.8 * 0.8 / 2 + 0.8 * 1.2 - 1.2 * 1.2 / 2
    beyond = 0.7 + 1.3 - 0.25 * 1.69
    stiff, drag, inertia = 2 * 9.81 * 0.5 + 20, 2.0, 0.501
    yield ("at rest: an oscillator, by its start", slide, "duration: 20\ninitial_state: {slide: {position: '${x0}'}}\nloads: [{joint: slide, effort: '${-slide/position - 0.1*slide/velocity}'}]\n"
           "parameters: {x0: {initial: 0, lower: -1, upper: 1}}\nobjective: {terminal: [{signal: slide/position, reference: 1}]}", {"x0": -2 * damped(1, 0.1, 1, 20)}, ADJOINT)
    yield ("at rest: a controlled pendulum, by its set-point", PENDULUM, "duration: 1\ncontrollers: {c: {type: pid, input: slide/position, output: slide, setpoint: '${r}', gains: {p: 20, d: 2}}}\n"
           "parameters: {r: {initial: 0, lower: -1, upper: 1}}\nobjective: {terminal: [{signal: slide/position, reference: 1}]}",
           {"r": -2 * 20 / stiff * (1 - damped(stiff, drag, inertia, 1))}, ADJOINT)
    yield ("jump: a tuned switching time", slide, "duration: 2\nloads: [{joint: slide, effort: '${t < ts ? 1 : -1}'}]\nparameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}\n"
           "objective: {terminal: [{signal: slide/position, reference: 2}]}", {"ts": 2 * (switched - 2) * 2.4}, SWITCHES)
    yield ("jump: a tuned threshold", slide, "duration: 2\ninitial_state: {slide: {velocity: 1}}\nloads: [{joint: slide, effort: '${slide/position > xs ? -0.5 : 0}'}]\n"
           "parameters: {xs: {initial: 0.7, lower: 0.1, upper: 1.5}}\nobjective: {terminal: [{signal: slide/position}]}", {"xs": 2 * beyond * 0.65}, SWITCHES)
    yield ("jump: Coulomb's friction written as sign()", slide, "duration: 2\ninitial_state: {slide: {velocity: '${v0}'}}\nloads: [{joint: slide, effort: '${-1.5 - f*sign(slide/velocity)}'}]\n"
           "parameters: {v0: {initial: 1.5, lower: 1, upper: 2}, f: {initial: 0.5, lower: 0.1, upper: 1}}\nobjective: {terminal: [{signal: slide/velocity}]}",
           # To rest in v0/(1.5 + f), then v = -(1.5 - f) (2 - v0/(1.5 + f)).
           {"v0": 2 * -1.25 * 0.5, "f": 2 * -1.25 * (1.25 - 0.375)}, SWITCHES)
    yield ("pulse: a force by the angle of a wheel", WHEEL, "duration: 2\ninitial_state: {slide: {velocity: 3}}\nloads: [{joint: slide, effort: '${-w*exp(-((slide/position - 2)/0.002)^2)}'}]\n"
           "parameters: {w: {initial: 500, lower: 100, upper: 1000}}\nobjective: {terminal: [{signal: slide/velocity}]}",
           # v^2 = 9 - w s sqrt(pi)
           {"w": -0.002 * math.sqrt(math.pi)}, ALL[:-1])
    yield ("power: an exponent that is computed", slide, "duration: 2\nloads: [{joint: slide, effort: '${f*(t - 1)**(1+1)}'}]\nparameters: {f: {initial: 1, lower: 0, upper: 2}}\n"
           "objective: {terminal: [{signal: slide/velocity}]}", {"f": 2 * (2 / 3) ** 2}, tuple("maximum_step: 0.1, " + keys for keys in ADJOINT))
    yield ("minimum time: a double integrator", slide, "duration: '${T}'\nloads: [{joint: slide, effort: '${t < ts ? 1 : -1}'}]\n"
           "parameters: {ts: {initial: 0.9, lower: 0.1, upper: 1.9}, T: {initial: 2, lower: 1, upper: 3}}\nobjective: {terminal: [{signal: slide/position, reference: 2}]}",
           # x = 2 ts T - ts^2 - T^2/2
           {"ts": 2 * (3.6 - 0.81 - 2 - 2) * 2.2, "T": 2 * (3.6 - 0.81 - 2 - 2) * -0.2}, SWITCHES)
    yield ("free end: Bolza's", slide, "duration: '${T}'\ninitial_state: {slide: {velocity: 1}}\nparameters: {T: {initial: 1.2, lower: 1, upper: 3}}\n"
           "objective: {integral: [{signal: slide/velocity}], terminal: [{signal: slide/position, reference: 2}]}", {"T": 1 + 2 * (1.2 - 2)}, ADJOINT[:-2] + ADJOINT[-1:])
    yield ("until: a throw that ends where it began", slide, "duration: 9\nuntil: '${slide/position < 0}'\ninitial_state: {slide: {velocity: '${v0}'}}\nloads: [{joint: slide, effort: -2}]\n"
           "parameters: {v0: {initial: 3, lower: 1, upper: 4}}\nobjective: {terminal: [{signal: end_time}]}", {"v0": 2 * 3}, SWITCHES)
    yield ("until: a brake that ends at standstill", slide, "duration: 9\nuntil: '${slide/velocity <= 0}'\ninitial_state: {slide: {velocity: '${v0}'}}\nloads: [{joint: slide, effort: -2}]\n"
           "parameters: {v0: {initial: 3, lower: 1, upper: 4}}\nobjective: {terminal: [{signal: slide/position}]}", {"v0": 2 * 9 / 4 * 3 / 2}, SWITCHES)
    yield ("extreme value: the largest velocity, at a switch", slide, "duration: 2\nloads: [{joint: slide, effort: '${t < ts ? 3 : -1}'}]\n"
           "parameters: {ts: {initial: 1, lower: 0.1, upper: 1.9}}\nobjective: {maximum: [{signal: slide/velocity}]}", {"ts": 3}, SWITCHES)
    yield ("extreme value: just before a jump", slide, "duration: 2\nloads: [{joint: slide, effort: '${t < ts ? 2*t : -1}'}]\n"
           "parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}\nobjective: {maximum: [{signal: slide/acceleration}]}", {"ts": 2}, SWITCHES)


def gradient(codesign, model, text, folder):
    """The derivatives by name, or a failure."""
    (folder / "model.urdf").write_text(model, encoding="utf-8")
    (folder / "study.yaml").write_text(text + "\n", encoding="utf-8")
    done = subprocess.run([codesign, "gradient", folder / "model.urdf", folder / "study.yaml", "--json", "--quiet"], capture_output=True, text=True, check=False)
    answer = json.loads(done.stdout)
    if "gradient" not in answer:
        sys.exit(f"{text}\n{answer}")
    return answer["gradient"]


def worst(codesign, model, study, right, methods, folder):
    """Per parameter: (difference, derivative, keys) of the method that is farthest."""
    size = max(abs(value) for value in right.values())
    found = {}
    for method in methods:
        ours = gradient(codesign, model, study + "\nsolver: {" + method.rstrip(", ") + "}", folder)
        for name, value in right.items():
            difference = abs(ours[name] - value) / size
            if name not in found or difference > found[name][0]:
                found[name] = (difference, ours[name], method.rstrip(", ") or "default")
    return found


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("codesign")
    parser.add_argument("--cases", default="", metavar="WORD", help="only cases whose names hold this word")
    options = parser.parse_args()
    print("| motion | by | closed form | farthest of all methods | difference | that method |\n|---|---|---:|---:|---:|---|")
    largest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for name, model, study, right, methods in cases():
            if options.cases not in name:
                continue
            for parameter, (difference, ours, method) in worst(options.codesign, model, study, right, methods, pathlib.Path(folder)).items():
                largest = max(largest, difference)
                print(f"| {name} | `{parameter}` | {right[parameter]:.9g} | {ours:.9g} | {difference:.1e} | `{method}` |", flush=True)
    sys.exit(1 if largest > 1e-4 else 0)


if __name__ == "__main__":
    main()
