#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""tools/measured_data without measurements: what is absent is skipped, a number that differs is a fault, and every number that it holds is on the page."""
import collections
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
TOOL = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "tools", "measured_data")
loader = importlib.machinery.SourceFileLoader("measured_data", TOOL)
measured_data = importlib.util.module_from_spec(importlib.util.spec_from_loader("measured_data", loader))
loader.exec_module(measured_data)

NUMBER = {"value": 0.0, "deviation": 0.0, "interval": [0.0, 0.0], "on_bound": True}
SAME = {"identified": collections.defaultdict(lambda: NUMBER), "data": {"joints": {"hinge": {"rms": 0.0, "recorded_rms": 0.0}}}}


class Unfitted(measured_data.Case):
    def __init__(self, title):
        super().__init__(title, "codesign", ".")

    def fit(self, model, study, name):
        return SAME


def said(action):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        action()
    return text.getvalue()


class MeasuredData(unittest.TestCase):
    def test_what_is_absent_is_skipped(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([TOOL, folder], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("is not there: skipped"), 2)
        self.assertIn("nothing to repeat", done.stdout)

    def test_a_number_is_held_to_its_last_digit(self):
        case = Unfitted("A cart on a screw, identified")
        said(lambda: case.hold("M", "95.0422", 95.04221))
        self.assertEqual(case.faults, 0)
        self.assertIn("differs", said(lambda: case.hold("M", "95.0422", 95.0424)))
        self.assertIn("is not on the page", said(lambda: case.hold("M", "95.0423", 95.0423)))
        self.assertIn("not on its bound", said(lambda: case.at_bound("M", SAME, "M", 1.0)))
        self.assertEqual((case.faults, case.count), (3, 4))

    def test_every_number_is_on_the_page(self):
        cart = {name: [0.0] for name in ("t", "qg")}
        for title, action, least in (("A cart on a screw, identified", measured_data.cart_by_efforts, 40),
                                     ("The same cart in motion", lambda case: measured_data.cart_in_motion(case, cart), 20),
                                     ("A pendulum swung up, identified", measured_data.pendulum_by_efforts, 20),
                                     ("The same pendulum in motion", measured_data.pendulum_in_motion, 20)):
            case = Unfitted(title)
            self.assertNotIn("is not on the page", said(lambda: action(case)))
            self.assertGreater(case.count, least, title)


if __name__ == "__main__":
    unittest.main()
