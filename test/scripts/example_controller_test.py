#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The way of scripts/example_controller meets its points, at rest, and its velocity is its derivative."""
import importlib.machinery
import importlib.util
import os
import sys
import unittest

sys.dont_write_bytecode = True
PATH = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "scripts", "example_controller")
LOADER = importlib.machinery.SourceFileLoader("example_controller", PATH)
MODULE = importlib.util.module_from_spec(importlib.util.spec_from_loader("example_controller", LOADER))
LOADER.exec_module(MODULE)


class WayPointsTest(unittest.TestCase):
    def setUp(self):
        self.way = MODULE.WayPoints([0.0, 1.5, 2.0], [0.2, -1.0, 3.0])

    def test_it_rests_in_each_point(self):
        for time, position in ((-1.0, 0.2), (0.0, 0.2), (1.5, -1.0), (2.0, 3.0), (9.0, 3.0)):
            self.assertEqual(self.way.at(time), (position, 0.0))

    def test_the_velocity_is_the_derivative(self):
        for time in (0.1, 0.75, 1.4, 1.6, 1.9):
            difference = (self.way.at(time + 1e-5)[0] - self.way.at(time - 1e-5)[0]) / 2e-5
            self.assertAlmostEqual(self.way.at(time)[1], difference, delta=1e-7 * abs(difference) + 1e-9)

    def test_it_is_half_way_at_half_time(self):
        self.assertAlmostEqual(self.way.at(0.75)[0], -0.4, delta=1e-12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
