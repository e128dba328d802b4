#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Each study of test/features goes through the command line: signals, gradients against a reference, runs and samples, a job with its files, and the report.
Usage: features_test.py CODESIGN [unittest arguments]"""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import yaml

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/python"))
from features import features  # noqa: E402

CODESIGN = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "codesign"
# Arrivals and stays are no functions of a replay of the steps, postures have none: both are compared with differences.
BY_DIFFERENCES = {"bounds", "postures"}


def codesign(*words):
    return subprocess.run([CODESIGN, *map(str, words)], capture_output=True, text=True, check=False)


class Features(unittest.TestCase):
    def answer(self, *words):
        done = codesign(*words, "--json", "--quiet")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def test_there_is_a_study_for_each_feature(self):
        self.assertEqual({feature.name for feature in features()},
                         {"given_motion", "varying_loads", "lossy_gear", "elastic_gear", "friction_in_newton_metres", "stuck_start", "planar_loop", "bounds", "postures", "moving_end", "switches", "margins", "contact", "clearance", "motor_by_voltage", "observer", "current_loop"})

    def test_its_signals_are_shown_in_every_run(self):
        for feature in features():
            with self.subTest(feature.name):
                nominal = self.answer("simulate", feature.model, feature.study, "--signals", ",".join(feature.signals))["series"]
                self.assertEqual([name for name in nominal if name != "time"], feature.signals)
                for signal in feature.signals:
                    self.assertTrue(all(math.isfinite(value) for value in nominal[signal]), signal)
                    self.assertGreater(max(nominal[signal]) - min(nominal[signal]), 1e-9, signal)
                names = list(yaml.safe_load(pathlib.Path(feature.study).read_text(encoding="utf-8"))["runs"])
                self.assertEqual(len(names), 2)
                series = [self.answer("simulate", feature.model, feature.study, "--run", name, "--signals", ",".join(feature.signals))["series"] for name in names]
                self.assertEqual(series[0], nominal)
                self.assertNotEqual(series[1], nominal)

    def test_its_gradient_meets_an_independent_reference(self):
        for feature in features():
            with self.subTest(feature.name):
                verification = self.answer("gradient", feature.model, feature.study, "--verify=complex_step")["verification"]
                self.assertEqual(verification["method"], "ridders" if feature.name in BY_DIFFERENCES else "complex_step")
                self.assertLess(verification["largest_relative_difference"], 1e-8)
                self.assertEqual("largest_change" in verification, verification["method"] == "complex_step")
                for name, value in verification["reference"].items():
                    self.assertGreater(abs(value), 1e-9, f"{name} counts")

    def test_its_gradient_is_that_of_independent_runs(self):
        """A replay of the same steps knows nothing of their error: with tight tolerances gradients meet differences of other runs."""
        for feature in features():
            with self.subTest(feature.name), tempfile.TemporaryDirectory() as folder:
                study, text = pathlib.Path(folder) / "tight.yaml", pathlib.Path(feature.study).read_text(encoding="utf-8")
                study.write_text(text + ("" if "\nsolver:" in text else "solver: {relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-13}\n"), encoding="utf-8")
                verification = self.answer("gradient", feature.model, study, "--verify=ridders")["verification"]
                self.assertLess(verification["largest_relative_difference"], 1e-5)

    def test_a_job_lowers_the_objective_and_reports_it(self):
        for feature in features():
            with self.subTest(feature.name):
                with tempfile.TemporaryDirectory() as folder:
                    job, page = pathlib.Path(folder) / "job", pathlib.Path(folder) / "report.html"
                    result = self.answer("optimize", feature.model, feature.study, "--output", job)
                    self.assertLess(result["objective"], result["initial_objective"])
                    self.assertEqual(len(result["scenarios"]), 4, "two runs at two samples")
                    tuned = self.answer("gradient", job / "tuned.urdf", job / "job_study.yaml", "--result", job / "result.json")
                    self.assertAlmostEqual(tuned["objective"], result["objective"], delta=1e-8 * abs(result["objective"]))
                    done = codesign("report", job, "-o", page)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    text = page.read_text(encoding="utf-8")
                    self.assertIn("<svg", text)
                    for name in result["parameters"]:
                        self.assertIn(name, text)


if __name__ == "__main__":
    unittest.main()
