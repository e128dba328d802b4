#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Each study of test/features from Python: the bits of the command line in runs, gradients and searches."""
import unittest
import warnings

from features import features
from fixture import command_line

import mechanism_codesign as codesign


class Features(unittest.TestCase):
    def test_runs_gradients_and_searches_are_those_of_the_command_line(self):
        for feature in features():
            with self.subTest(feature.name), warnings.catch_warnings():
                warnings.simplefilter("ignore", codesign.Warning)
                problem, files = codesign.Problem(feature.model, feature.study), (feature.model, feature.study)
                run, line = problem.simulate(signals=feature.signals), command_line("simulate", *files, "--signals", ",".join(feature.signals))
                self.assertEqual(list(run), feature.signals)
                for signal in feature.signals:
                    self.assertEqual(run[signal].tolist(), line["series"][signal], signal)
                line = command_line("gradient", *files)
                value, gradient = problem.gradient()
                self.assertEqual((value, dict(zip(problem.names, gradient.tolist()))), (line["objective"], line["gradient"]))
                line, result = command_line("optimize", *files), problem.optimize()
                self.assertEqual((result.objective, result.record["parameters"]), (line["objective"], line["parameters"]))
        # The report of each feature is made from the command line (test/scripts/features_test.py), by the same script.
        self.assertIn("<svg", result.report())


if __name__ == "__main__":
    unittest.main()
