#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Observers against scipy: their motion by DOP853, their gains by Riccati's equation, the poles of loops that they feed."""
import unittest

import numpy as np
from fixture import command_line  # noqa: F401  (sets the path of the package's tests)
from scipy.integrate import solve_ivp
from scipy.linalg import expm, solve_continuous_are, solve_discrete_are
from scipy.signal import place_poles

import mechanism_codesign as codesign

CART = """<robot name="cart"><link name="rail"/>
<link name="body"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
<joint name="slide" type="prismatic"><parent link="rail"/><child link="body"/><axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="0" velocity="0"/>
<dynamics damping="0.5"/></joint></robot>"""
TIGHT = "solver: {relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-13}\n"
SIGNALS = ["slide/position", "slide/velocity", "eye/position", "eye/velocity", "eye/disturbance"]
TIME = 0.01


def study(eye, servo, more=""):
    return ("duration: 1.0\ninitial_state: {slide: {position: 0.1, velocity: 0.3}}\nloads: [{joint: slide, effort: 3.0}]\ncontrollers:\n"
            f"  eye: {{type: observer, joint: slide, inertia: 1.2, disturbance: true, {eye}}}\n"
            "  servo: {type: state_feedback, output: slide, feedback: [{signal: eye/position, gain: 40.0, reference: 0.2}, {signal: eye/velocity, gain: 9.0}, "
            f"{{signal: eye/disturbance, gain: 1.0}}]{servo}}}\n{TIGHT}{more}")


def model(order):
    """x' = A x of position, velocity and acceleration by a disturbance; C."""
    return np.diag(np.ones(order - 1), 1), np.eye(order)[:1]


class Observers(unittest.TestCase):
    def compare(self, run, times, states):
        for k, name in enumerate(SIGNALS):
            found = np.interp(times, run.time, run[name])
            self.assertLess(np.abs(found - states[k]).max(), 1e-7 * (1.0 + np.abs(states[k]).max()), name)

    def test_a_disturbance_observer_moves_as_its_equations(self):
        A, C = model(3)
        gains = place_poles(A.T, C.T, [-20.0, -25.0, -30.0]).gain_matrix.ravel()

        def rates(_, x):
            u, e = -40.0 * (x[2] - 0.2) - 9.0 * x[3] - x[4], x[0] - x[2]
            return [x[1], u + 3.0 - 0.5 * x[1], x[3] + gains[0] * e, (u + x[4]) / 1.2 + gains[1] * e, 1.2 * gains[2] * e]

        run = codesign.Problem(CART, study("poles: [-20, -25, -30]", "")).simulate(signals=SIGNALS, samples=101)
        truth = solve_ivp(rates, (0.0, 1.0), [0.1, 0.3, 0.1, 0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-14, t_eval=run.time)
        self.compare(run, truth.t, truth.y)

    def test_a_sampled_one_sees_what_is_held_and_delayed(self):
        """Between samples estimates flow with the effort in effect, which a limit cuts and a delay holds back."""
        A, C = model(3)
        flow = expm(A * TIME)
        poles = np.exp(TIME * np.array([-20.0, -25.0, -30.0]))
        gains = np.linalg.solve(flow, place_poles(flow.T, C.T, poles).gain_matrix.T).ravel() * [1.0, 1.0, 1.2]
        x, held, times, states = np.array([0.1, 0.3, 0.1, 0.0, 0.0]), 0.0, [], []
        for k in range(100):
            if k > 0:
                x[2:] += gains * (x[0] - x[2])
            output = np.clip(-40.0 * (x[2] - 0.2) - 9.0 * x[3] - x[4], -5.0, 5.0)
            for begin, end in ((0.0, 0.004), (0.004, TIME)):
                if begin > 0.0:
                    held = output

                def rates(_, y, u=held):
                    return [y[1], u + 3.0 - 0.5 * y[1], y[3], (u + y[4]) / 1.2, 0.0]

                piece = solve_ivp(rates, (begin, end), x, method="DOP853", rtol=1e-12, atol=1e-14)
                x = piece.y[:, -1].copy()
                if begin == 0.0:
                    times.append(k * TIME + end)
                    states.append(x.copy())
        run = codesign.Problem(CART, study("poles: [-20, -25, -30], sample_time: 0.01", ", sample_time: 0.01, delay: 0.004, output_limit: 5.0")).simulate(
            signals=SIGNALS, samples=1001)
        inside = [int(round(t * 1000)) for t in times]
        for k, name in enumerate(SIGNALS):
            found = np.asarray(run[name])[inside]
            wanted = np.array(states)[:, k]
            if name.startswith("slide"):  # at the instant of an event a run has the values before it, which are these
                self.assertLess(np.abs(found - wanted).max(), 1e-7, name)
            else:
                self.assertLess(np.abs(found - wanted).max(), 1e-7 * (1.0 + np.abs(wanted).max()), name)

    def test_poles_of_the_loop_and_of_the_observer_are_those_of_the_whole(self):
        """Separation, with the mass that the observer knows: (s + 3)(s + 4) and the observer's own."""
        plain = CART.replace("0.5", "0")
        for sample_time in (0.0, TIME):
            sampled = f", sample_time: {sample_time}" if sample_time else ""
            problem = codesign.Problem(plain, "duration: 1.0\ngravity: [0, 0, 0]\ncontrollers:\n  eye: {type: observer, joint: slide, inertia: 1.0, "
                                              f"poles: [[-15, 10]]{sampled}}}\n  servo: {{type: state_feedback, output: slide, feedback: [{{signal: eye/position, "
                                              f"gain: 12.0}}, {{signal: eye/velocity, gain: 7.0}}]{sampled}}}\n")
            linear = problem.linearize()
            own = np.array([-15 + 10j, -15 - 10j])
            if sample_time:
                A = np.array([[0.0, 1.0], [0.0, 0.0]])
                flow, push = expm(A * TIME), np.array([[0.5 * TIME ** 2], [TIME]])
                own = np.concatenate([np.exp(own * TIME), np.linalg.eigvals(flow - push @ np.array([[12.0, 7.0]]))])
                found = np.linalg.eigvals(linear.A)
                found = found[np.abs(found) > 1e-6]
            else:
                own, found = np.concatenate([own, [-3.0, -4.0]]), np.linalg.eigvals(linear.A)
            self.assertEqual(len(found), len(own))
            for pole in own:
                self.assertLess(np.abs(found - pole).min(), 1e-9 * max(1.0, abs(pole)))

    def test_a_disturbance_observer_leaves_no_error_at_rest(self):
        """d = -u = 3 N, whatever mass it knows: an integral."""
        for eye, servo in (("bandwidth: 5.0", ""), ("bandwidth: 5.0, sample_time: 0.01", ", sample_time: 0.01, delay: 0.01")):
            linear = codesign.Problem(CART, study(eye, servo)).linearize(signals=["slide/position", "eye/disturbance"])
            self.assertEqual(linear.stability, "stable")
            self.assertIn("eye/estimate[2]", linear.states)
            margins = linear.loops["servo"]
            self.assertGreater(margins["gain_margin"]["value"], 1.2)

    def test_kalman_gains_are_those_of_riccati(self):
        """By the poles of the estimates' errors."""
        noise, inertia = 3.0, 1.2
        for order, sample_time, measured in ((2, 0.0, 2e-6), (3, 0.0, 2e-6), (2, TIME, 1e-8)):
            A, C = model(order)
            process = np.zeros((order, order))
            process[-1, -1] = noise / inertia ** 2
            if sample_time:
                flow = expm(A * TIME)
                process = noise / inertia ** 2 * np.array([[TIME ** 3 / 3, TIME ** 2 / 2], [TIME ** 2 / 2, TIME]])
                P = solve_discrete_are(flow.T, C.T, process, np.array([[measured]]))
                own = np.linalg.eigvals((np.eye(2) - P @ C.T / (C @ P @ C.T + measured) @ C) @ flow)
            else:
                P = solve_continuous_are(A.T, C.T, process, np.array([[measured]]))
                own = np.linalg.eigvals(A - P @ C.T @ C / measured)
            sampled = f", sample_time: {sample_time}" if sample_time else ""
            eye = f"type: observer, joint: slide, inertia: {inertia}, process: {noise}, measurement: {measured}{sampled}" + (", disturbance: true" if order == 3 else "")
            linear = codesign.Problem(CART, f"duration: 1.0\ncontrollers: {{eye: {{{eye}}}}}\n").linearize()
            found = np.linalg.eigvals(linear.A)
            for pole in own:
                self.assertLess(np.abs(found - pole).min(), 1e-9 * max(1.0, abs(pole)), (order, sample_time))

    def test_gradients_are_those_of_differences(self):
        for eye, servo in (('bandwidth: "${w}"', ""), ('bandwidth: "${w}", sample_time: 0.01', ', sample_time: 0.01, delay: 0.004, output_limit: "${limit}"')):
            more = ("parameters: {w: {initial: 5.0, lower: 1.0, upper: 20.0}, limit: {initial: 5.0, lower: 1.0, upper: 20.0}}\n"
                    "objective: {integral: [{signal: slide/position, reference: 0.2}, {signal: eye/velocity - slide/velocity}], terminal: [{signal: eye/disturbance}]}\n")
            for gradient in ("direct", "adjoint"):
                problem = codesign.Problem(CART, study(eye, servo, more).replace("solver: {", f"solver: {{gradient: {gradient}, "))
                _, exact = problem.gradient()
                step = 1e-3
                for k, name in enumerate(problem.names):
                    start = 5.0
                    value = [problem.objective(**{name: start + j * step}) for j in (-2, -1, 1, 2)]
                    reference = (value[0] - 8 * value[1] + 8 * value[2] - value[3]) / (12 * step)
                    self.assertLess(abs(exact[k] - reference), 1e-6 * (1e-3 + abs(reference)), (eye, gradient, name))


if __name__ == "__main__":
    unittest.main()
