#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Simulations and gradients from Python: the bits of the command line, numpy without copies, errors, scipy."""
import concurrent.futures
import copy
import math
import multiprocessing
import os
import pathlib
import pickle
import re
import tempfile
import unittest
import warnings

import numpy as np
import scipy.optimize

from fixture import PENDULUM, SWING, case, command_line

import mechanism_codesign as codesign
from mechanism_codesign import _core
from mechanism_codesign._linear import transfer_zeros


def pendulum(study=SWING, **options):
    return codesign.Problem(PENDULUM, study, **options)


def shipped(name, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", codesign.Warning)
        return codesign.Problem(*case(name), **options)


class Postures(unittest.TestCase):
    """A study with positions in place of a duration."""

    def test_there_is_a_row_per_posture_whatever_the_samples(self):
        problem = shipped("four_bar_path")
        for samples in (2, 11, 101):
            run = problem.simulate(samples=samples)
            np.testing.assert_array_equal(run.time, np.arange(18.0))

    def test_measures_are_no_squares(self):
        with self.assertRaises(codesign.InputError):
            shipped("six_bar_dwell").residuals()

    def test_there_is_no_adjoint(self):
        with self.assertRaises(codesign.InputError):
            shipped("four_bar_path").adjoint()


class Tradeoffs(unittest.TestCase):
    STUDY = """duration: 20.0
initial_state: {slide: {position: 1.0}}
controllers: {hold: {type: state_feedback, output: slide, feedback: [{signal: slide/position, gain: "${k1}"}, {signal: slide/velocity, gain: "${k2}"}]}}
parameters: {k1: {initial: 1.0, lower: 0.5, upper: 4.0}, k2: {initial: 1.0, lower: 0.5, upper: 4.0}}
tradeoff:
  - {name: error, objective: {integral: [{signal: slide/position}]}}
  - {name: effort, objective: {integral: [{signal: hold/output}]}}
"""
    CART = """<robot name="cart"><link name="ground"/><link name="cart"><inertial><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link><joint name="slide" type="prismatic">
<parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/><limit lower="-5" upper="5" effort="100" velocity="10"/></joint></robot>"""

    def test_a_curve_as_arrays(self):
        lines = []
        curve = codesign.Problem(self.CART, self.STUDY).tradeoff(points=5, progress=lines.append)
        self.assertEqual((curve.names, curve.status.code, len(curve.points)), (["error", "effort"], "success", 5))
        k1, k2 = curve.rho.T
        np.testing.assert_allclose(curve.objectives[:, 1], k1 ** 2 / (2.0 * k2), rtol=1e-3)  # but for what is left after 20 s
        self.assertTrue(np.all(np.diff(curve.objectives[:, 0]) > 0.0) and np.all(np.diff(curve.objectives[:, 1]) < 0.0))
        self.assertEqual([line.done for line in lines], [1, 2, 3, 4, 5])
        self.assertIn("point 5 of 5", str(lines[-1]))
        self.assertIn("<svg", curve.report())
        self.assertIn("on_curve", str(curve))

    def test_a_progress_that_raises_ends_it(self):
        with self.assertRaises(ZeroDivisionError):
            codesign.Problem(self.CART, self.STUDY).tradeoff(progress=lambda point: 1 / 0)

    def test_another_study_is_refused(self):
        with self.assertRaises(codesign.InputError):
            pendulum().tradeoff()


class Linearizations(unittest.TestCase):
    def test_an_arm_under_computed_torque(self):
        model = shipped("two_link_arm").linearize(signals=["elbow/position"])
        self.assertEqual((model.A.shape, model.B.shape[0], model.C.shape), ((4, 4), 4, (1, 4)))
        self.assertEqual(model.B.shape, (4, len(model.inputs)))
        self.assertEqual((model.states[0], model.outputs, model.period), ("shoulder/position", ["elbow/position"], None))
        np.testing.assert_allclose(np.sort(model.poles.real), np.sort(np.linalg.eigvals(model.A).real)[::2], rtol=1e-9)
        frequencies, loop = model.response("elbow_servo")
        margin = model.loops["elbow_servo"]["phase_margin"]
        self.assertAlmostEqual(float(np.interp(margin["frequency"], frequencies, np.abs(loop))), 1.0, 3)
        self.assertIn("stable", repr(model))
        self.assertEqual(model.measured["elbow_servo"], "elbow/position")
        with tempfile.TemporaryDirectory() as folder:
            page = model.report(os.path.join(folder, "page.html"))
            with open(os.path.join(folder, "page.html"), encoding="utf-8") as file:
                self.assertEqual(file.read(), page)
            with self.assertRaises(codesign.OutputError):
                model.report(os.path.join(folder, "no", "page.html"))
        self.assertIn("Nyquist diagram", page)
        self.assertIn("Small motions with mechanism_codesign " + codesign.version(), page)

    def test_transfer_functions(self):
        # The matrices by another way: the response at each frequency from a linear solve.
        for name, signals in (("two_link_arm", ["elbow/position", "shoulder/velocity"]), ("feed_axis", ["axis/position"])):
            model = shipped(name).linearize(signals=signals)
            frequencies = np.array([0.3, 2.0, 9.0])
            points = 1j * frequencies if model.period is None else np.exp(1j * frequencies * model.period)
            for row, output in enumerate(model.outputs):
                for column, given in enumerate(model.inputs):
                    transfer = model.transfer(output, given)
                    expected = np.array([model.C[row] @ np.linalg.solve(s * np.eye(len(model.A)) - model.A, model.B[:, column])
                                         for s in points]) + model.D[row, column]
                    np.testing.assert_allclose(transfer.at(frequencies), expected, rtol=1e-6, atol=1e-9 * np.abs(expected).max(initial=1e-3))
                    self.assertEqual(transfer.period, model.period)
            with self.assertRaises(KeyError):
                model.transfer(signals[0], "nothing/setpoint")

    def test_zeros_of_a_known_plant(self):
        # 5 (s + 2) (s - 3) / (s (s + 1) (s + 4) (s^2 + 2 s + 10)) in controllable canonical form, then in other states of other sizes.
        bottom, top = np.poly([0.0, -1.0, -4.0, -1.0 + 3.0j, -1.0 - 3.0j]).real, 5.0 * np.poly([-2.0, 3.0])
        A = np.diag(np.ones(4), 1)  # pylint: disable=invalid-name
        A[-1] = -bottom[:0:-1]
        b, c = np.eye(5)[-1], np.concatenate([top[::-1], np.zeros(2)])
        change = np.diag([1e3, 1.0, 1e-2, 1.0, 10.0]) @ (np.eye(5) + np.diag(np.ones(4), -1))
        A, b, c = change @ A @ np.linalg.inv(change), change @ b, c @ np.linalg.inv(change)
        zeros, gain = transfer_zeros(A, b, c, 0.0)
        np.testing.assert_allclose(np.sort(zeros.real), [-2.0, 3.0], rtol=1e-9)
        self.assertAlmostEqual(gain, 5.0, 9)
        zeros, gain = transfer_zeros(A, b, c, 0.5)
        self.assertEqual((len(zeros), gain), (5, 0.5))
        np.testing.assert_allclose(np.sort_complex(np.roots(np.polyadd(0.5 * bottom, top))), np.sort_complex(zeros), rtol=1e-8)
        zeros, gain = transfer_zeros(A, b, 0.0 * c, 0.0)
        self.assertEqual((len(zeros), gain), (0, 0.0))

    def test_a_sampled_axis_and_faults(self):
        problem = shipped("feed_axis")
        model = problem.linearize()
        self.assertGreater(model.period, 0.0)
        self.assertLess(np.abs(np.linalg.eigvals(model.A)).max(), 1.0)
        frequencies, response = model.response("velocity_loop")  # it samples four times in the period
        self.assertEqual(response.shape, frequencies.shape)
        with self.assertRaises(KeyError):
            model.response("axis")
        for wrong in ({"friction": "some"}, {"at": -1.0}, {"at": 1e9}, {"signals": ["axis/poise"]}):
            with self.assertRaises(codesign.InputError):
                problem.linearize(**wrong)
        self.assertEqual(shipped("slider_crank").linearize(at=0.1).stability, "stable")
        with self.assertRaises(codesign.ComputationError):
            shipped("slider_crank").linearize()


CART = """
<robot name="cart">
  <link name="rail"/><link name="cart"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="9" velocity="9"/><dynamics damping="1"/></joint>
</robot>"""
SAMPLED = """
duration: {duration}
initial_state: {{slide: {{position: 0.3, velocity: 0.1}}}}
controllers:
{controllers}
solver: {{relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-14}}
"""


class SampledLoops(unittest.TestCase):
    """The positions of a run at the ends of periods follow the recurrence of the characteristic polynomial, whatever the hidden states are."""

    def check(self, period, *controllers):
        study = SAMPLED.format(duration=60 * period, controllers="\n".join(f"  {c}" for c in controllers))
        problem = codesign.Problem(CART, study)
        model = problem.linearize()
        self.assertAlmostEqual(model.period, period, 12)
        coefficients = np.poly(np.linalg.eigvals(model.A)).real[::-1]
        run = problem.simulate(signals=["slide/position"], samples=61)["slide/position"]
        count = len(coefficients)
        left = [abs(coefficients @ run[k:k + count]) for k in range(10, 61 - count)]
        self.assertLess(max(left), 1e-13, controllers)

    def test_a_filter_and_an_integral(self):
        self.check(0.05, "servo: {type: pid, input: slide/position, setpoint: 0, output: slide, "
                   "gains: {p: 8, d: 3, i: 1}, sample_time: 0.05, derivative_filter: 0.03}")

    def test_a_delay_that_is_no_multiple_and_a_lag(self):
        self.check(0.05, "servo: {type: pid, input: slide/position, setpoint: 0, output: slide, "
                   "gains: {p: 8, d: 3}, sample_time: 0.05, delay: 0.12, time_constant: 0.04}")

    def test_a_cascade_of_two_sample_times_with_delays(self):
        self.check(0.06, "outer: {type: pid, input: slide/position, setpoint: 0, gains: {p: 2}, sample_time: 0.03, delay: 0.07}",
                   "inner: {type: pid, input: slide/velocity - outer/output, setpoint: 0, output: slide, "
                   "gains: {p: 10, i: 5}, sample_time: 0.02, delay: 0.02}")

    def test_a_continuous_loop_beside_a_sampled_one(self):
        self.check(0.04, "a: {type: pid, input: slide/position, setpoint: 0, output: slide, gains: {p: 8, d: 3}, sample_time: 0.04}",
                   "b: {type: state_feedback, output: slide, feedback: [{signal: slide/velocity, gain: 1}], time_constant: 0.02}")


class Designs(unittest.TestCase):
    def test_rho_is_a_keyword_too(self):
        problem = pendulum()
        self.assertEqual(problem.gradient(rho=[0.4])[0], problem.gradient([0.4])[0])
        self.assertEqual(problem.objective(rho=np.array([0.4]), payload=0.3), problem.objective([0.4], payload=0.3))
        self.assertEqual(problem.simulate(rho=[0.4])["pivot/position"][-1], problem.simulate([0.4])["pivot/position"][-1])
        named = codesign.Problem(*(re.sub(r"\blength\b", "rho", text) for text in (PENDULUM, SWING)))
        self.assertEqual(named.objective(rho=0.4), problem.objective(length=0.4), "a parameter of this name counts")


def objective_of(problem):
    return problem.gradient()[0]


class Copies(unittest.TestCase):
    """A problem is read again from what it was made of."""

    def test_a_copy_has_the_same_numbers_and_tells_no_warning_again(self):
        problem = pendulum(set={"length": 0.7})
        value, gradient = problem.gradient()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for again in (copy.copy(problem), copy.deepcopy(problem), pickle.loads(pickle.dumps(problem))):
                self.assertEqual(again.gradient()[0], value)
                np.testing.assert_array_equal(again.gradient()[1], gradient)
                np.testing.assert_array_equal(again.start, problem.start)

    def test_files_are_found_from_another_folder(self):
        folder, before = tempfile.mkdtemp(), os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(folder)
        for name, text in (("model.urdf", PENDULUM), ("study.yaml", SWING)):
            pathlib.Path(name).write_text(text, encoding="utf-8")
        packed = pickle.dumps(codesign.Problem("model.urdf", pathlib.Path("study.yaml")))
        os.chdir("/")
        self.assertEqual(pickle.loads(packed).gradient()[0], pendulum().gradient()[0])

    def test_other_processes_compute_with_it(self):
        problem = pendulum()
        with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
            self.assertEqual(list(pool.map(objective_of, [problem] * 3)), [objective_of(problem)] * 3)

    def test_what_the_library_makes_is_not_made_empty(self):
        for kind in (_core.Session, _core.Optimized, _core.Identified, _core.RunNotes):
            with self.assertRaisesRegex(TypeError, "by the library"):
                kind.__new__(kind)
            with self.assertRaisesRegex(TypeError, "by the library"):
                kind()


class Bits(unittest.TestCase):
    """Python computes the numbers of the command line, to the last bit."""

    def test_of_a_run(self):
        for name in ("slider_crank", "inverted_pendulum", "governor", "two_link_arm"):
            with self.subTest(name):
                run, line = shipped(name).simulate(), command_line("simulate", *case(name))
                self.assertEqual(run.time.tolist(), line["series"]["time"])
                self.assertEqual(list(run), [signal for signal in line["series"] if signal != "time"])
                for signal, values in run.items():
                    self.assertEqual(values.tolist(), line["series"][signal], signal)
                self.assertEqual(run.objective, line["objective"])
                self.assertEqual(run.statistics["steps"], line["steps"])
                self.assertEqual(run.parameters, line["parameters"])

    def test_of_a_run_with_a_set_value(self):
        problem, line = shipped("slider_crank", set={"crank_length": 0.07}), command_line("simulate", *case("slider_crank"), "--set", "crank_length=0.07")
        self.assertEqual(problem.simulate()["slider_joint/friction"].tolist(), line["series"]["slider_joint/friction"])

    def test_of_gradients(self):
        for name in ("slider_crank_haug", "inverted_pendulum", "pendulum_robust", "arm_limits"):
            with self.subTest(name):
                problem, line = shipped(name), command_line("gradient", *case(name))
                value, gradient = problem.gradient()
                self.assertEqual(value, line["objective"])
                self.assertEqual(dict(zip(problem.names, gradient.tolist())), line["gradient"])

    def test_of_a_result(self):
        """From the values of a result.json."""
        with tempfile.TemporaryDirectory() as folder:
            result = pathlib.Path(folder) / "result.json"
            result.write_text('{"parameters": {"length": 0.35}}', encoding="utf-8")
            model, study = pathlib.Path(folder) / "pendulum.urdf", pathlib.Path(folder) / "swing.yaml"
            model.write_text(PENDULUM, encoding="utf-8")
            study.write_text(SWING, encoding="utf-8")
            line = command_line("gradient", model, study, "--result", result)
            self.assertEqual(codesign.Problem(model, study, result=result).gradient()[0], line["objective"])


class Values(unittest.TestCase):
    def test_paths_and_texts_and_overlays(self):
        overlay = '<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign"><codesign:parameter name="payload" value="0.1" lower="0" upper="2"/></robot>'
        problem = pendulum(overlays=[overlay])
        self.assertEqual({p.name: p.upper for p in problem.parameters}, {"length": 0.8, "payload": 2.0})
        self.assertIn('value="1.1"', problem.urdf())
        self.assertIn('value="2.5"', problem.urdf(payload=1.5))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "overlay.urdf"
            path.write_text(overlay, encoding="utf-8")
            for given in ([path], [str(path)], path, str(path)):
                self.assertEqual(pendulum(overlays=given).gradient(payload=1.5)[0], problem.gradient(payload=1.5)[0])

    def test_a_model_alone(self):
        self.assertEqual(codesign.Problem(PENDULUM).duration, 0.0)
        self.assertEqual(codesign.Problem(PENDULUM).names, [])

    def test_what_a_problem_tells(self):
        problem = pendulum()
        self.assertEqual(problem.names, ["length"])
        self.assertEqual(problem.start.tolist(), [0.5])
        self.assertEqual(problem.bounds, [(0.3, 0.8)])
        self.assertEqual(problem.joints, ["pivot"])
        self.assertEqual(problem.parameters[0], codesign.Parameter("length", 0.5, 0.3, 0.8, "m", True))
        self.assertIn("pivot/friction", problem.signals)

    def test_a_run_is_numpy_without_copies(self):
        run = pendulum().simulate(samples=51)
        table = run.time.base
        self.assertIsNotNone(table)
        for values in run.values():
            self.assertEqual(values.shape, (51,))
            self.assertIs(values.base, table)
            self.assertFalse(values.flags.writeable)
        friction = run["pivot/friction"].copy()
        kept, expected = run["pivot/friction"], friction.tolist()
        del run, table
        self.assertEqual(kept.tolist(), expected, "an array keeps its memory alive")

    def test_a_run_has_its_events(self):
        run = pendulum(SWING + 'loads: [{joint: pivot, effort: "${t < 0.5 ? 0 : 1}"}]\n').simulate()
        self.assertEqual(run.event_count, 1)
        self.assertEqual(run.events, [{"time": 0.5, "element": "loads[0].effort", "object": "pivot", "expression": "t < 0.5",
                                       "direction": "falling", "kind": "jump"}])
        self.assertEqual((pendulum().simulate().events, pendulum().simulate().event_count), ([], 0))

    def test_signals_are_those_asked_for(self):
        run = pendulum().simulate(signals=["pivot/position", "rod/position/x"], samples=3)
        self.assertEqual(list(run), ["pivot/position", "rod/position/x"])
        self.assertEqual(run.time.tolist(), [0.0, 1.0, 2.0])
        self.assertEqual(list(pendulum().simulate(signals="pivot/velocity")), ["pivot/velocity"])
        self.assertEqual(list(pendulum().simulate(signals=np.array(["pivot/velocity", "pivot/position"]))), ["pivot/velocity", "pivot/position"])
        with self.assertRaisesRegex(KeyError, "pivot/friction.*recorded are pivot/position"):
            run["pivot/friction"]

    def test_values_by_name_and_by_array_are_the_same_design(self):
        study = SWING + "solver: {method: rodas5p}\n"
        problem = pendulum(study)
        value, gradient = problem.gradient(length=0.4)
        self.assertEqual(problem.gradient([0.4])[0], value)
        self.assertEqual(problem.gradient(np.array([0.6]), length=0.4)[1].tolist(), gradient.tolist())
        self.assertEqual(problem([0.4])[0], value)
        self.assertAlmostEqual(problem.objective(length=0.4), value, delta=1e-6, msg="other steps than with a gradient")
        self.assertNotEqual(problem.objective(), value)
        heavy = problem.objective(payload=0.7)
        self.assertNotEqual(heavy, problem.objective())
        self.assertAlmostEqual(pendulum(study, set={"payload": 0.7}).objective(), heavy, delta=1e-9)
        self.assertEqual(problem.simulate(payload=0.7).objective, heavy)

    def test_the_tuned_parameters_have_the_order_of_the_study(self):
        """Whatever their order in the model."""
        study = SWING.replace("{length: {}}", "{payload: {tune: true}, length: {}}")
        problem = pendulum(study)
        self.assertEqual([p.name for p in problem.parameters], ["length", "payload"])
        self.assertEqual((problem.names, problem.bounds, problem.start.tolist()), (["payload", "length"], [(0.0, 1.0), (0.3, 0.8)], [0.1, 0.5]))
        self.assertEqual(problem.objective([0.2, 0.4]), problem.objective(payload=0.2, length=0.4))
        _, gradient = problem.gradient()
        for name, slope in zip(problem.names, gradient):
            value = {p.name: p.value for p in problem.parameters}[name]
            ahead, behind = (problem.objective(**{name: value + step}) for step in (1e-4, -1e-4))
            self.assertAlmostEqual((ahead - behind) / 2e-4, slope, delta=1e-3 * np.abs(gradient).max(), msg=name)
        page = problem.optimize()._repr_html_()
        self.assertRegex(page, r"payload</td>(<td[^>]*>[^<]*</td>){2}<td[^>]*>0</td><td[^>]*>1</td>")

    def test_an_untuned_value_holds_in_all_samples_but_those_of_its_own(self):
        problem = shipped("pendulum_robust")
        tuned = set(problem.names)
        free = next(p for p in problem.parameters if p.name not in tuned)
        at = 0.5 * (free.lower + free.upper) if math.isfinite(free.lower + free.upper) else 1.01 * free.value
        by_name = problem.objective(**{free.name: at})
        self.assertAlmostEqual(by_name, shipped("pendulum_robust", set={free.name: at}).objective(), delta=1e-9 * abs(by_name))


class Derivatives(unittest.TestCase):
    def test_the_adjoint_is_another_way_to_the_gradient(self):
        problem = shipped("governor")
        value, gradient = problem.gradient()
        other, adjoint = problem.adjoint()
        self.assertAlmostEqual(other, value, delta=1e-6 * abs(value))
        np.testing.assert_allclose(adjoint, gradient, rtol=1e-4, atol=1e-6 * np.abs(gradient).max())
        with self.assertRaisesRegex(codesign.InputError, "no adjoint"):
            shipped("arm_limits").adjoint()

    def test_residuals_are_those_of_the_objective(self):
        for problem in (pendulum(), shipped("governor")):
            value, gradient = problem.gradient()
            r, jacobian = problem.residuals(), problem.jacobian()
            count = len(problem.names)
            self.assertEqual((r.shape, jacobian.shape), ((count + 1,), (count + 1, count)))
            self.assertAlmostEqual(r @ r, value, delta=1e-9 * value)
            np.testing.assert_allclose(2.0 * jacobian.T @ r, gradient, rtol=1e-3, atol=1e-6 * np.abs(gradient).max())

    def test_residuals_with_a_parameter_without_effect(self):
        model = PENDULUM.replace('<link name="ground"/>', '<codesign:parameter name="idle" value="1" lower="0" upper="2"/><link name="ground"/>')
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", codesign.Warning)
            problem = codesign.Problem(model, SWING.replace("{length: {}}", "{idle: {}, length: {}}"))
        r, jacobian = problem.residuals(), problem.jacobian()
        alone = pendulum()
        self.assertEqual((r.shape, jacobian.shape), ((3,), (3, 2)))
        self.assertAlmostEqual(r @ r, alone.gradient()[0], delta=1e-9)
        np.testing.assert_allclose(2.0 * jacobian.T @ r, [0.0, alone.gradient()[1][0]], rtol=1e-6, atol=1e-9)

    def test_residuals_need_a_sum_of_squares(self):
        with self.assertRaisesRegex(codesign.InputError, "sum of squares"):
            pendulum(SWING.replace("weight: 0.1", "weight: -0.1")).residuals()

    def test_scipy_minimizes(self):
        problem = pendulum()
        found = scipy.optimize.minimize(problem, problem.start, jac=True, bounds=problem.bounds)
        self.assertTrue(found.success, found.message)
        self.assertAlmostEqual(found.fun, problem.optimize().objective, delta=1e-5)
        squares = scipy.optimize.least_squares(problem.residuals, problem.start, problem.jacobian, bounds=list(zip(*problem.bounds)))
        self.assertAlmostEqual(2.0 * squares.cost, found.fun, delta=1e-5)


class Errors(unittest.TestCase):
    def test_bad_input_names_file_and_line(self):
        model, study = case("slider_crank")
        with tempfile.TemporaryDirectory() as folder:
            bad = os.path.join(folder, "bad.yaml")
            with open(study, encoding="utf-8") as file, open(bad, "w", encoding="utf-8") as copied:
                copied.write(file.read().replace("duration: 2.0", "duration: -2.0"))
            with self.assertRaises(codesign.InputError) as caught:
                codesign.Problem(model, bad)
        error = caught.exception
        self.assertEqual((error.file, error.line, error.element, error.value), (bad, 3, "duration", "-2.0"))
        self.assertTrue(str(error).startswith(f"{bad}:3: duration: the duration must be positive"), error)
        self.assertIsInstance(error, ValueError)
        self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))

    def test_texts_have_a_name(self):
        with self.assertRaisesRegex(codesign.InputError, r"^study text:4: optimizer.algorithm: "):
            pendulum(SWING.replace("lbfgs", "lbfgz"))
        with self.assertRaisesRegex(codesign.InputError, "^nowhere.urdf: "):
            codesign.Problem("nowhere.urdf")

    def test_bad_values(self):
        problem = pendulum()
        for bad, words in (({"lenght": 0.4}, 'did you mean "length"'), ({"length": 7.0}, r"bounds .*7.*\[0.3, 0.8\]"), ({"length": math.nan}, "bounds")):
            for call in (problem.simulate, problem.gradient, problem.objective, problem.urdf):
                with self.subTest(bad, call=call), self.assertRaisesRegex(codesign.InputError, words):
                    call(**bad)
        for bad in ([0.4, 0.5], [], [math.inf]):
            with self.assertRaises(codesign.InputError):
                problem.gradient(bad)
        for bad in ([[0.4]], "a", object()):
            with self.assertRaises((TypeError, ValueError)):
                problem.gradient(bad)
        for call in (problem.gradient, problem.residuals):
            for bad, words in ((np.array([0.4 + 1j]), "complex128"), (np.ma.array([0.4], mask=[True]), "rho has masked values")):
                with self.assertRaisesRegex(TypeError, words):
                    call(bad)
        with self.assertRaisesRegex(TypeError, "signals needs names, not 1"):
            problem.simulate(signals=[1])
        with self.assertRaisesRegex(TypeError, "length needs a number, not 'long'"):
            problem.gradient(length="long")
        with self.assertRaisesRegex(codesign.InputError, "samples"):
            problem.simulate(samples=1)
        with self.assertRaisesRegex(codesign.InputError, 'did you mean "pivot"'):
            problem.simulate(signals=["pivt/position"])
        with self.assertRaises(TypeError):
            codesign.Problem(7)

    def test_nothing_to_differentiate(self):
        with self.assertRaisesRegex(codesign.InputError, "objective"):
            pendulum("duration: 1.0\n").objective()
        with self.assertRaisesRegex(codesign.InputError, "tune"):
            pendulum(SWING.replace("parameters: {length: {}}\n", "")).gradient()
        self.assertIsNone(pendulum("duration: 1.0\n").simulate().objective)

    def test_a_failed_run_is_told_and_kept(self):
        problem = pendulum(SWING + "solver: {maximum_steps: 20}\n")
        with self.assertRaises(codesign.ComputationError) as caught:
            problem.simulate()
        error = caught.exception
        self.assertEqual(error.status.code, "too_many_steps")
        self.assertGreater(error.status.time, 0.0)
        self.assertGreater(len(error.run.time), 0)
        self.assertLess(len(error.run["pivot/position"]), 101)
        with self.assertRaises(codesign.ComputationError):
            problem.gradient()
        self.assertEqual(pickle.loads(pickle.dumps(codesign.ComputationError(error.status))).status, error.status)

    def test_warnings_are_pythons(self):
        model = PENDULUM.replace('<axis xyz="0 1 0"/>', '<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>')
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            problem = codesign.Problem(model, SWING)
        self.assertEqual([str(w.message) for w in caught], [str(w) for w in problem.warnings])
        self.assertEqual([(w.code, w.file, w.line) for w in problem.warnings], [("limit_ignored", "model text", 9)])
        self.assertEqual((caught[0].category, caught[0].filename), (codesign.Warning, __file__))
        self.assertEqual(copy.copy(codesign.Warning("code", "text", "file", 3)).line, 3)


if __name__ == "__main__":
    unittest.main()
