#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The shipped cases that make their own recordings, with the commands of doc/case_studies.md. Usage: identify_cases_test.py CODESIGN"""
import cmath
import csv
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SENSORS = os.path.join(ROOT, "scripts", "simulate_sensors")


def documented(heading):
    """The commands of the first block below a heading of the page, one list of words each."""
    with open(os.path.join(ROOT, "doc", "case_studies.md"), encoding="utf-8") as file:
        block = re.search(rf"^## {heading}$.*?```\n(.*?)```", file.read(), re.S | re.M).group(1)
    return [shlex.split(line) for line in block.replace("\\\n", "").splitlines() if line.strip()]


def run(words, folder):
    programs = {"codesign": sys.argv[1], "scripts/simulate_sensors": SENSORS}
    words = [re.sub(r"^(urdf|config)/", rf"{ROOT}/\1/", word) for word in words]
    words[0] = programs.get(words[0], words[0])
    return subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def follow(self, heading):
        """Runs all commands; the answer of the last one as JSON, with its exit code, and the truth that the first one was given."""
        commands = documented(heading)
        for words in commands[:-1]:
            done = run(words, self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = run([*commands[-1], "--json"], self.folder)
        simulate = next(words for words in commands if words[1] == "simulate")
        truth = {name: float(value) for name, value in (word.split("=") for word in simulate if re.match(r"\w+=[0-9]", word))}
        return json.loads(done.stdout), done.returncode, truth

    def test_the_friction_of_a_slider_from_the_motor_alone(self):
        answer, code, truth = self.follow("A slider-crank identified from its motor")
        found = answer["identified"]
        for name in ("mu_static", "mu_dynamic"):
            self.assertLess(abs(found[name]["value"] / truth[name] - 1.0), 0.02, name)
            low, high = found[name]["interval"]
            self.assertLess(high - low, 0.02 * truth[name], name)
        self.assertLess(abs(found["data[0].start.crank_joint"]["value"] - 0.5), 0.01)
        self.assertLess(abs(found["crank_joint/delay"]["value"] - 0.004), 0.001)
        # Only one sum of the two inertias is identifiable, which the answer says.
        self.assertEqual(code, 1)
        self.assertEqual(answer["error"]["code"], "not_identifiable")
        self.assertIn("crank_inertia", answer["error"]["message"])
        self.assertIn("rotor_inertia", answer["error"]["message"])
        self.assertFalse(found["crank_inertia"]["determined"] or found["rotor_inertia"]["determined"])
        total = found["crank_inertia"]["value"] + 9.0 * found["rotor_inertia"]["value"]
        self.assertLess(abs(total / (truth["crank_inertia"] + 9.0 * truth["rotor_inertia"]) - 1.0), 0.3)

    def test_a_vendor_s_arm(self):
        answer, code, truth = self.follow("A vendor's arm identified")
        self.assertEqual(code, 0, answer.get("error"))
        self.assertEqual(len(truth), 20)
        held = 0
        for name, number in answer["identified"].items():
            self.assertLess(abs(number["value"] / truth[name] - 1.0), 0.03, name)
            held += number["interval"][0] <= truth[name] <= number["interval"][1]
        self.assertGreaterEqual(held, 18)


class SimulateSensors(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_table, self.recording = os.path.join(folder.name, "run.csv"), os.path.join(folder.name, "recording.csv")
        with open(self.run_table, "w", encoding="utf-8") as file:
            file.write("time,a/velocity,a/effort\n")
            for k in range(2001):
                file.write(f"{0.001 * k},{math.sin(0.005 * k)},{0.001 * k}\n")

    def record(self, *options):
        return subprocess.run([SENSORS, self.run_table, self.recording, "--rate", "100", *options], stderr=subprocess.PIPE, text=True, check=False)

    def columns(self, *options):
        done = self.record(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.recording, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}

    def test_samples_delays_and_rounds(self):
        table = self.columns("--delay", "a/effort=0.0125", "--resolution", "*/velocity=0.25")
        self.assertEqual(len(table["time"]), 201)
        self.assertAlmostEqual(table["time"][200], 2.0)
        self.assertAlmostEqual(table["a/effort"][100], 1.0 - 0.0125, places=8)
        self.assertEqual(table["a/effort"][0], 0.0)
        self.assertEqual({value % 0.25 for value in table["a/velocity"]}, {0.0})

    def test_noise_has_its_power_and_its_seed(self):
        clean, noisy = self.columns(), self.columns("--noise", "*=20")
        self.assertEqual(noisy, self.columns("--noise", "*=20", "--seed", "1"))
        self.assertNotEqual(noisy, self.columns("--noise", "*=20", "--seed", "2"))
        for name in ("a/velocity", "a/effort"):
            errors = [x - y for x, y in zip(noisy[name], clean[name])]
            ratio = sum(x * x for x in clean[name]) / sum(e * e for e in errors)
            self.assertLess(abs(10.0 * math.log10(ratio) - 20.0), 1.0, name)

    def test_columns_that_are_not_there(self):
        for options in (["--columns", "b/effort"], ["--delay", "b/*=0.1"], ["--noise", "b=40"]):
            done = self.record(*options)
            self.assertEqual(done.returncode, 1)
            self.assertIn("a/velocity, a/effort", done.stderr)
            self.assertFalse(os.path.exists(self.recording))


HOPPER = """<robot name="hopper" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="trunk_mass" value="6" lower="0.1" upper="50"/><codesign:parameter name="trunk_inertia" value="0.2" lower="0.01" upper="10"/>
  <codesign:parameter name="leg_mass" value="1.5" lower="0.1" upper="50"/><codesign:parameter name="leg_centre" value="0.15" lower="0" upper="1"/>
  <link name="world"/><link name="sliding"/><link name="lifting"/>
  <link name="trunk"><inertial><origin xyz="0 0 0.1"/><mass value="6" codesign:value="${trunk_mass}"/>
    <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.2" codesign:iyy="${trunk_inertia}" iyz="0" izz="0.2"/></inertial></link>
  <link name="leg"><inertial><origin xyz="0 0 -0.15" codesign:xyz="0 0 ${-leg_centre}"/><mass value="1.5" codesign:value="${leg_mass}"/>
    <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.002"/></inertial></link>
  <joint name="x" type="prismatic"><parent link="world"/><child link="sliding"/><axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1000" velocity="10"/></joint>
  <joint name="z" type="prismatic"><parent link="sliding"/><child link="lifting"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1000" velocity="10"/></joint>
  <joint name="pitch" type="continuous"><parent link="lifting"/><child link="trunk"/><axis xyz="0 1 0"/></joint>
  <joint name="hip" type="continuous"><parent link="trunk"/><child link="leg"/><axis xyz="0 1 0"/></joint>
</robot>"""
PLATE = """identify:
  data:
    - csv: plate.csv
      columns: {time: time, x/position: x, z/position: z, pitch/position: pitch, hip/position: hip}
      signals: {mechanism/shaking_force/x: fx, "${mechanism/shaking_force/z - 9.81*(trunk_mass + leg_mass)}": fz, mechanism/shaking_moment/y: my}
parameters: {trunk_mass: {}, leg_mass: {}, leg_centre: {}, trunk_inertia: {}}
"""


class Hopper:
    """A trunk that moves freely in a plane, with a leg: what it exerts on the ground, from linear and angular momentum in closed form."""

    truth = {"trunk_mass": 8.0, "leg_mass": 2.2, "leg_centre": 0.21, "trunk_inertia": 0.35}

    @staticmethod
    def motion(t):
        return 0.1 * cmath.sin(2.1 * t), 0.6 + 0.05 * cmath.sin(5.3 * t), 0.4 * cmath.sin(3.1 * t + 0.3), 0.9 * cmath.sin(4.7 * t + 1)

    def momentum(self, t):
        """Along x and z, and about the y through the origin; velocities by a complex step in time."""
        step = 1e-20
        x, z, pitch, hip = self.motion(t + 1j * step)
        leg = pitch + hip
        parts = ((self.truth["trunk_mass"], self.truth["trunk_inertia"], x + 0.1 * cmath.sin(pitch), z + 0.1 * cmath.cos(pitch), pitch),
                 (self.truth["leg_mass"], 0.03, x - self.truth["leg_centre"] * cmath.sin(leg), z - self.truth["leg_centre"] * cmath.cos(leg), leg))
        along_x = sum(mass * cx.imag for mass, _, cx, _, _ in parts) / step
        along_z = sum(mass * cz.imag for mass, _, _, cz, _ in parts) / step
        about_y = sum(inertia * turn.imag + mass * (cz.real * cx.imag - cx.real * cz.imag) for mass, inertia, cx, cz, turn in parts) / step
        return along_x, along_z, about_y

    def wrench(self, t, step=1e-3):
        """The opposite of the rate of momentum, and the weight."""
        weights = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
        rates = [sum(w * (self.momentum(t + k * step)[i] - self.momentum(t - k * step)[i]) for k, w in weights) / step for i in range(3)]
        return -rates[0], -rates[1] - 9.81 * (self.truth["trunk_mass"] + self.truth["leg_mass"]), -rates[2]


class Plate(unittest.TestCase):
    def test_a_floating_base_on_a_force_plate(self):
        hopper = Hopper()
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("hopper.urdf", HOPPER), ("plate.yaml", PLATE)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            with open(os.path.join(folder, "plate.csv"), "w", newline="", encoding="utf-8") as file:
                rows = csv.writer(file)
                rows.writerow(["time", "x", "z", "pitch", "hip", "fx", "fz", "my"])
                for k in range(801):
                    t = 0.005 * k
                    rows.writerow([t, *(value.real for value in hopper.motion(t)), *hopper.wrench(t)])
            done = run(["codesign", "identify", "hopper.urdf", "plate.yaml", "--json", "--quiet"], folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["identified"]
        for name, truth in hopper.truth.items():
            self.assertLess(abs(found[name]["value"] / truth - 1.0), 1e-5, name)


if __name__ == "__main__":
    if shutil.which(sys.argv[1]) is None:
        sys.exit(f"{sys.argv[1]}: not a program")
    unittest.main(argv=[sys.argv[0]])
