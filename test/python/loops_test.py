#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Verdicts about loops against runs, and searches over loops against other programs."""
import math
import unittest

import numpy as np
from scipy import linalg, optimize
from fixture import command_line  # noqa: F401  (sets the path of the package's tests)

import mechanism_codesign as codesign

INERTIA = '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>'
LIMIT = '<limit lower="-9" upper="9" effort="0" velocity="0"/>'
CART = f"""<robot name="cart" xmlns:codesign="urn:mechanism_codesign"><link name="rail"/>
<link name="body"><inertial><mass value="1"/>{INERTIA}</inertial></link>
<joint name="slide" type="prismatic"><parent link="rail"/><child link="body"/><axis xyz="1 0 0"/>{LIMIT}<dynamics damping="1"/></joint></robot>"""
# A structure of 1 kg and 1 N/m, whose spring is a controller, with a damper of a fifth of its mass.
DAMPER = f"""<robot name="damper" xmlns:codesign="urn:mechanism_codesign">
<codesign:parameter name="k" value="0.15" lower="0.02" upper="1"/><codesign:parameter name="c" value="0.06" lower="0.01" upper="1"/><link name="ground"/>
<link name="structure"><inertial><mass value="1"/>{INERTIA}</inertial></link><link name="mass"><inertial><mass value="0.2"/>{INERTIA}</inertial></link>
<joint name="sway" type="prismatic"><parent link="ground"/><child link="structure"/><axis xyz="1 0 0"/>{LIMIT}</joint>
<joint name="slide" type="prismatic"><parent link="structure"/><child link="mass"/><axis xyz="1 0 0"/>{LIMIT}
<codesign:torsion_spring stiffness="0.15" codesign:stiffness="${{k}}" damping="0.06" codesign:damping="${{c}}" free_position="0"/></joint></robot>"""


def amplification(frequency, k, c, ratio=0.2):
    """|x| of the structure per static deflection, under a force of this frequency [rad/s]."""
    s = 1j * frequency
    link = k + c * s
    return np.abs((ratio * s * s + link) / ((s * s + 1 + link) * (ratio * s * s + link) - link * link))


class Loops(unittest.TestCase):
    def test_a_sampled_loop_grows_and_decays_in_a_long_run_as_its_poles_say(self):
        """2/(s (s + 1)(s + 2)) behind a zero-order hold of 0.05 s: the gain margin is 2.7928."""
        study = ("duration: 400.0\ninitial_state: {slide: {position: 0.01}}\nparameters: {p: {initial: 1.0, lower: 0.5, upper: 4.0}}\n"
                 "objective: {terminal: [{signal: slide/position}]}\ncontrollers: {servo: {type: pid, input: slide/position, setpoint: 0.0, output: slide, "
                 "gains: {p: \"${p}\"}, sample_time: 0.05, time_constant: 0.5}}\nsolver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-13}\n")
        problem = codesign.Problem(CART, study)
        margin = problem.linearize(p=1.0).loops["servo"]["gain_margin"]["value"]
        self.assertAlmostEqual(margin, 2.7928, delta=5e-5)
        for part, stable in ((0.98, True), (1.02, False)):
            loop = problem.linearize(p=part * margin)
            self.assertEqual(loop.stability, "stable" if stable else "unstable")
            growth = loop.modes[0]["growth"]
            self.assertEqual(growth < 0.0, stable)
            run = problem.simulate(signals=["slide/position"], samples=40001, p=part * margin)
            time, position = np.asarray(run.time), run["slide/position"]
            period = 1.0 / loop.modes[0]["frequency"]

            def swing(begin, time=time, position=position, period=period):
                inside = (time >= begin) & (time < begin + 20 * period)
                return math.sqrt(np.mean(position[inside] ** 2))

            self.assertAlmostEqual(math.log(swing(100.0 + 40 * period) / swing(100.0)) / (40 * period), growth, delta=1e-4 * abs(growth))

    def test_a_tuned_mass_damper_has_the_least_largest_peak(self):
        """Both peaks alike, and stationary: 3.32543884112347215 at k = 0.138852110669809, c = 0.0840466846689308 by mpmath's Newton method with 40 digits. Den Hartog's
        fixed points, sqrt(1 + 2/ratio), are 0.3 % lower."""
        study = ("duration: 10.0\nparameters: {k: {}, c: {}}\nobjective: {loop: [{loop: frame, measure: complementary_sensitivity}]}\n"
                 "controllers: {frame: {type: pid, input: sway/position, setpoint: 0.0, output: sway, gains: {p: 1.0}}}\n")
        result = codesign.Problem(DAMPER, study).optimize()
        self.assertEqual(str(result.status.code), "success", str(result))
        self.assertAlmostEqual(result.objective, 3.32543884112347215, delta=1e-9)
        tuned = result.parameters
        self.assertAlmostEqual(tuned["k"], 0.138852110669809, delta=1e-7)
        self.assertAlmostEqual(tuned["c"], 0.0840466846689308, delta=1e-7)
        frequencies = np.linspace(0.3, 2.0, 200001)
        self.assertAlmostEqual(amplification(frequencies, tuned["k"], tuned["c"]).max(), result.objective, delta=1e-8)
        self.assertGreater(result.objective, math.sqrt(11.0))

    def test_a_tuned_mass_damper_at_nineteen_frequencies(self):
        """0.5, 0.55, ..., 1.4 rad/s: the minimax over these alone is 3.29334298, lower than over all."""
        study = ("duration: 10.0\nparameters: {k: {}, c: {}}\nobjective: {terminal: [{signal: sway/position}]}\n"
                 "controllers: {frame: {type: pid, input: sway/position, setpoint: 0.0, output: sway, gains: {p: 1.0}}}\n")
        problem, frequencies = codesign.Problem(DAMPER, study), np.linspace(0.5, 1.4, 19)

        def peaks(design):
            return np.abs(problem.linearize(k=design[0], c=design[1], signals=["sway/position"]).transfer("sway/position", "frame/disturbance").at(frequencies))

        bound = optimize.minimize(lambda x: x[2], [0.14, 0.08, 3.5], method="SLSQP", options={"ftol": 1e-12},
                                  constraints={"type": "ineq", "fun": lambda x: x[2] - peaks(x[:2])})
        self.assertAlmostEqual(peaks(bound.x[:2]).max(), 3.29334298, delta=1e-8)

    def test_margins_of_a_fast_loop_within_a_slow_one(self):
        """The speed sampled every 0.05 s, the position every 0.15 s: poles over 0.15 s of matrices that are set up here, and runs beside the gain margin."""
        study = ("duration: 60.0\ninitial_state: {slide: {position: 0.01}}\nparameters: {p: {initial: 8.0, lower: 0.5, upper: 100.0}}\n"
                 "objective: {terminal: [{signal: slide/position}]}\ncontrollers:\n"
                 "  outer: {type: pid, input: slide/position, setpoint: 0.0, gains: {p: 3.0}, sample_time: 0.15}\n"
                 "  inner: {type: pid, input: slide/velocity - outer/output, setpoint: 0.0, output: slide, gains: {p: \"${p}\"}, sample_time: 0.05}\n"
                 "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-13}\n")
        flow = linalg.expm(0.05 * np.array([[0, 1, 0, 0], [0, -1, 1, 0], [0, 0, 0, 0], [0, 0, 0, 0]]))  # (x, v, effort, wanted speed)

        def period(factor):
            outer, inner = np.eye(4, dtype=complex), np.eye(4, dtype=complex)
            outer[3] = [-3, 0, 0, 0]
            inner[2] = factor * 8.0 * np.array([0, -1, 0, 1])
            return flow @ inner @ flow @ inner @ flow @ inner @ outer

        def beyond(factor):
            return np.abs(np.linalg.eigvals(period(factor))).max() - 1.0

        problem = codesign.Problem(CART, study)
        loop = problem.linearize().loops["inner"]
        self.assertEqual(loop["samples"], 3)
        gain = optimize.brentq(beyond, 1.0, 10.0, xtol=1e-13)
        self.assertAlmostEqual(loop["gain_margin"]["value"], gain, delta=1e-9)
        angles = np.linspace(0.0, math.pi, 2001)
        first = next(k for k, angle in enumerate(angles) if beyond(np.exp(-1j * angle)) > 1e-9)
        phase = optimize.brentq(lambda angle: beyond(np.exp(-1j * angle)), angles[first - 1], angles[first], xtol=1e-13)
        self.assertAlmostEqual(loop["phase_margin"]["value"], phase, delta=1e-8)
        for part, stable in ((0.98, True), (1.02, False)):
            run = problem.simulate(signals=["slide/position"], samples=6001, p=8.0 * part * gain)
            late, early = np.abs(run["slide/position"][-1000:]).max(), np.abs(run["slide/position"][2000:3000]).max()
            self.assertEqual(late < early, stable)
            growth = math.log(np.abs(np.linalg.eigvals(period(part * gain))).max()) / 0.15
            self.assertAlmostEqual(problem.linearize(p=8.0 * part * gain).modes[0]["growth"], growth, delta=1e-9)

    def test_margins_of_a_continuous_loop_beside_a_sampled_one(self):
        """A PD with a lag, and a damper that is sampled each 0.1 s and 0.05 s late: poles over 0.1 s of matrices that are set up here, norms of signals in 96 steps, and
        runs beside the gain margin."""
        study = ("duration: 60.0\ninitial_state: {slide: {position: 0.01}}\nparameters: {k: {initial: 1.0, lower: 0.1, upper: 100.0}}\n"
                 "objective: {terminal: [{signal: slide/position}]}\ncontrollers:\n"
                 "  servo: {type: pid, input: slide/position, setpoint: 0.0, output: slide, gains: {p: \"${20*k}\", d: \"${k}\"}, time_constant: 0.05}\n"
                 "  damper: {type: pid, input: slide/velocity, setpoint: 0.0, output: slide, gains: {p: 6.0}, sample_time: 0.1, delay: 0.05}\n"
                 "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-13}\n")
        output = np.array([-20.0, -1, 0, 0, 0])  # of (x, v, effort, held, waiting)
        sample, apply = np.eye(5), np.eye(5)
        sample[4], apply[3] = [0, -6, 0, 0, 0], [0, 0, 0, 0, 1]
        flow = np.array([[0, 1, 0, 0, 0], [0, -1, 1, 1, 0], [0, 0, -20, 0, 0], [0] * 5, [0] * 5], dtype=complex)

        def period(factor):
            closed = flow.copy()
            closed[2] += 20 * factor * output
            half = linalg.expm(0.05 * closed)
            return half @ apply @ half @ sample

        def beyond(factor):
            return np.abs(np.linalg.eigvals(period(factor))).max() - 1.0

        def norm(angle, shift, steps):
            """The largest singular value of signals that are constant in each of the steps of half a period."""
            closed = np.zeros((7, 7))
            closed[:5, :5], closed[2, 5] = flow.real, 20.0
            closed[2, :5] += 20 * output
            closed[6, :5] = output
            once = linalg.expm(0.05 / steps * closed)
            state, rows = np.hstack([np.eye(5), np.zeros((5, 2 * steps))]), []
            for step in range(2 * steps):
                state = {0: sample, steps: apply}.get(step, np.eye(5)) @ state
                rows.append(once[6, :5] @ state * steps / 0.05)
                rows[-1][5 + step] += once[6, 5] * steps / 0.05 + shift
                state = once[:5, :5] @ state
                state[:, 5 + step] += once[:5, 5]
            rows = np.array(rows)
            lifted = rows[:, 5:] + rows[:, :5] @ np.linalg.solve(np.exp(1j * angle) * np.eye(5) - state[:, :5], state[:, 5:])
            return np.linalg.norm(lifted, 2)

        problem = codesign.Problem(CART, study)
        loop = problem.linearize().loops["servo"]
        self.assertEqual(loop["samples"], 0)
        gain = optimize.brentq(beyond, 2.0, 20.0, xtol=1e-13)
        self.assertAlmostEqual(loop["gain_margin"]["value"], gain, delta=1e-9)
        angles = np.linspace(0.0, math.pi, 2001)
        first = next(k for k, angle in enumerate(angles) if beyond(np.exp(-1j * angle)) > 1e-9)
        phase = optimize.brentq(lambda angle: beyond(np.exp(-1j * angle)), angles[first - 1], angles[first], xtol=1e-13)
        self.assertAlmostEqual(loop["phase_margin"]["value"], phase, delta=1e-9)
        turn = min(np.angle(np.linalg.eigvals(period(np.exp(-1j * phase)))), key=lambda angle: abs(angle / 0.1 - loop["phase_margin"]["frequency"]))
        self.assertAlmostEqual(loop["phase_margin"]["frequency"], turn / 0.1, delta=1e-8)
        self.assertAlmostEqual(loop["delay_margin"]["value"], phase * 0.1 / turn, delta=1e-9)
        for name, shift in (("sensitivity", 1.0), ("complementary_sensitivity", 0.0)):
            largest = [max(norm(angle, shift, steps) for angle in np.linspace(0.0, math.pi, 721)) for steps in (6, 12)]
            self.assertAlmostEqual(loop[name]["value"], largest[1] + (largest[1] - largest[0]) / 3, delta=2e-5)
        for part, stable in ((0.98, True), (1.02, False)):
            run = problem.simulate(signals=["slide/position"], samples=6001, k=part * gain)
            late, early = np.abs(run["slide/position"][-1000:]).max(), np.abs(run["slide/position"][2000:3000]).max()
            self.assertEqual(late < early, stable)
            growth = math.log(np.abs(np.linalg.eigvals(period(part * gain))).max()) / 0.1
            self.assertAlmostEqual(problem.linearize(k=part * gain).modes[0]["growth"], growth, delta=1e-9)

    def test_a_slow_axis_hunts_where_friction_falls_with_speed(self):
        """At 0.05 m/s Stribeck's curve falls: the verdict at that speed agrees with runs, of which one slides evenly and the other sticks and slips."""
        model = CART.replace('<dynamics damping="1"/>', '<codesign:friction model="stribeck" coulomb="2" static="3" stribeck_velocity="0.1" transition_velocity="0.001" viscous="1"/>')
        study = ("duration: 40.0\ninitial_state: {slide: {position: 0.0, velocity: 0.05}}\nparameters: {d: {initial: 5.0, lower: 1.0, upper: 50.0}}\n"
                 "objective: {terminal: [{signal: slide/position}]}\ncontrollers: {servo: {type: pid, input: slide/position, output: slide, "
                 "gains: {p: 100.0, i: 50.0, d: \"${d}\"}, setpoint: {type: waypoints, times: [0.0, 40.0], positions: [0.0, 2.0], velocities: [0.05, 0.05]}}}\n")
        problem = codesign.Problem(model, study)
        for d, stable in ((5.0, False), (20.0, True)):
            small = problem.linearize(d=d, friction="given_speed")
            self.assertEqual(small.stability, "stable" if stable else "unstable")
            self.assertIn("friction at the given speed counted", small.verdict)
            speed = problem.simulate(signals=["slide/velocity"], samples=4001, d=d)["slide/velocity"][-1000:]
            self.assertEqual(speed.max() - speed.min() < 1e-5, stable)


if __name__ == "__main__":
    unittest.main()
