#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The shipped cases that make their own recordings, with the commands of doc/case_studies.md. Usage: identify_cases_test.py CODESIGN"""
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


if __name__ == "__main__":
    if shutil.which(sys.argv[1]) is None:
        sys.exit(f"{sys.argv[1]}: not a program")
    unittest.main(argv=[sys.argv[0]])
