#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""scripts/compare_algorithms on files of its own. Usage: compare_algorithms_test.py CODESIGN"""
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PENDULUM = """<robot name="pendulum"><link name="ground"/>
<link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="0 1 0"/></joint></robot>"""
STUDY = """
duration: 0.5
controllers: {hold: {type: pid, input: hinge/position, setpoint: 0.3, output: hinge, gains: {p: "${Kp}", d: 1.0}}}
parameters: {Kp: {initial: 10.0, lower: 0.0, upper: 100.0}}
objective: {integral: [{signal: hinge/position, reference: 0.3}, {signal: hold/output, weight: 1.0e-4}]}
constraints: ["Kp >= 1"]
"""


def table(*options):
    with tempfile.TemporaryDirectory() as folder:
        model, study = os.path.join(folder, "arm.urdf"), os.path.join(folder, "arm.yaml")
        for path, text in ((model, PENDULUM), (study, STUDY)):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([os.path.join(ROOT, "scripts", "compare_algorithms"), model, study, "--codesign", sys.argv[1], *options],
                              stdout=subprocess.PIPE, text=True, check=True)
        left = sorted(os.listdir(folder))
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()], left


class CompareAlgorithms(unittest.TestCase):
    def test_a_missing_file_is_a_sentence(self):
        done = subprocess.run([os.path.join(ROOT, "scripts", "compare_algorithms"), "a.urdf", "nowhere.yaml"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("a.urdf: there is no such file", done.stderr)

    def test_a_row_per_algorithm(self):
        lines, left = table("--unconstrained")
        self.assertEqual([line[1] for line in lines[2:]], ["lbfgs", "slsqp", "levenberg_marquardt"])
        self.assertIn("lowest", [line[5] for line in lines[2:]])
        objectives = [float(line[4]) for line in lines[2:]]
        self.assertLess(max(objectives) / min(objectives), 1.001)
        self.assertEqual(left, ["arm.urdf", "arm.yaml"])

    def test_what_an_algorithm_refuses_is_said(self):
        lines, _ = table("--algorithms", "slsqp,levenberg_marquardt")
        self.assertEqual(lines[2][5], "lowest")
        self.assertIn("no constraints", lines[3][-1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
