#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The event-driven solver against closed forms: 1 kg on a slide for 2 s, and what has no derivative."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from event_solver import Doubt, Motion  # noqa: E402
from expressions import TIME, choose, floor, formula, largest, parameter, sign, signal  # noqa: E402
from hybrid_study import HybridStudy  # noqa: E402
from mechanisms import slide  # noqa: E402

X, V = signal("slide/position"), signal("slide/velocity")


def study(load, terminal=(), integral=(), start=(0.0, 0.0), **parameters):
    made = HybridStudy(slide(), 2.0)
    made.of_model = {"mass": 1.0}
    made.parameters = parameters
    made.loads = [("slide", formula(load))]
    made.initial = {"slide": tuple(map(formula, start))}
    made.terminal = [(signal, reference, 1.0) for signal, reference in terminal]
    made.integral = [(signal, 0.0, 1.0) for signal in integral]
    return made


class EventSolver(unittest.TestCase):
    def expect(self, made, value, gradient):
        motion = Motion(made)
        objective, derivatives = motion.run()
        self.assertAlmostEqual(objective, value, delta=1e-9 * max(1.0, abs(value)))
        for name, expected in gradient.items():
            self.assertAlmostEqual(derivatives[motion.model.names.index(name)], expected, delta=1e-8 * max(1.0, abs(expected)), msg=name)

    def test_a_switching_time(self):
        x = 0.8**2 / 2.0 + 0.8 * 1.2 - 1.2**2 / 2.0
        self.expect(study(choose(TIME, parameter("ts"), 1.0, -1.0), [(X, 2.0)], ts=0.8), (x - 2.0) ** 2, {"ts": -6.912})

    def test_a_threshold(self):
        x = 0.7 + 1.3 - 0.25 * 1.69
        self.expect(study(choose(parameter("xs"), X, -0.5, 0.0), [(X, 0.0)], start=(0.0, 1.0), xs=0.7), x**2, {"xs": 2.0 * x * 0.65})

    def test_two_equal_instants(self):
        load = choose(TIME, parameter("t1"), 0.5, 0.0) + choose(TIME, parameter("t2"), 0.5, -1.0)
        self.expect(study(load, [(X, 0.0)], t1=0.8, t2=0.8), 0.3136, {"t1": 0.672, "t2": 2.016})

    def test_a_guard_that_jumps(self):
        self.expect(study(choose(TIME, parameter("ts"), -1.0, 1.0), integral=[largest(signal("slide/acceleration"), 0.0)], ts=0.8), 1.2, {"ts": -1.0})

    def test_two_crossings_within_a_step(self):
        self.expect(study(choose(X, 0.4, 0.0, choose(X, 0.4 + 1e-4, parameter("f"), 0.0)), [(V, 0.0)], start=(0.0, 1.0), f=1000.0), 1.2, {"f": 2e-4})

    def test_steps_of_time(self):
        self.expect(study(floor(TIME * 2.0 / parameter("period")) * parameter("c"), [(V, 0.0)], period=1.0, c=1.0), 9.0, {"period": -18.0, "c": 18.0})

    def test_a_motion_that_is_held_has_no_derivative(self):
        with self.assertRaisesRegex(Doubt, "held"):
            Motion(study(sign(V) * -3.0, [(X, 0.0)], start=(0.0, 1.0))).run()

    def test_a_motion_that_runs_away_ends(self):
        """v' = v^2 is infinite at t = 1 / v(0)."""
        with self.assertRaisesRegex(Doubt, r"runs away at t = 0\.9999"):
            Motion(study(V * V, [(X, 0.0)], start=(0.0, 1.0))).run()


if __name__ == "__main__":
    unittest.main()
