#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of `codesign report` for a linearization: margins, diagrams, poles, step responses. Usage: linear_report_test.py CODESIGN"""
import cmath
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from codesign_report import bode, charts, linear, matrices, nyquist, numbers, open_loop, plane, pole_charts, steps  # noqa: E402

PROGRAM = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else "codesign"
CART = re.search(r"<robot.*?</robot>", (ROOT / "doc/linearization.md").read_text(), re.DOTALL).group(0)
STUDY = "duration: 10.0\ncontrollers:\n  servo: {{type: pid, input: slide/position, setpoint: 0.0, output: slide, time_constant: 0.5, gains: {{p: {p}}}{more}}}\n"


def loop_of_the_cart(s, gain=1.0):
    return 2.0 * gain / (s * (s + 1.0) * (s + 2.0))


def table(loop, low=0.01, high=100.0, count=400):
    frequencies = [low * (high / low) ** (k / count) for k in range(count + 1)]
    values = [loop(1j * w) for w in frequencies]
    return {"frequency": frequencies, "real": [v.real for v in values], "imaginary": [v.imag for v in values]}


def model_of(A, b, modes, **more):
    return {"A": A, "B": [[value] for value in b], "inputs": ["c/setpoint"], "modes": modes, "stability": "stable", **more}


def value_at(response, margin, column):
    return response.at(margin["frequency"] / open_loop.TURN, column)


class Steps(unittest.TestCase):
    def test_a_second_order_system_follows_its_formula(self):
        for w, zeta in ((3.0, 0.2), (50.0, 0.7), (1e-3, 0.05)):
            wd, decay = w * math.sqrt(1.0 - zeta ** 2), zeta * w
            mode = {"growth": -decay, "frequency": wd / open_loop.TURN}
            motion = steps.Motion(steps.System(model_of([[0.0, 1.0], [-w * w, -2.0 * zeta * w]], [0.0, w * w], [mode])), "c/setpoint")
            step = steps.response(motion, [1.0, 0.0], [0.0])
            self.assertEqual(len(step.times), steps.POINTS + 1)
            for t, value in zip(step.times, step.values):
                self.assertAlmostEqual(value, 1.0 - math.exp(-decay * t) * (math.cos(wd * t) + decay / wd * math.sin(wd * t)), 11)
            self.assertAlmostEqual(step.final, 1.0, 11)
            self.assertAlmostEqual(step.overshoot, math.exp(-math.pi * decay / wd), 3)
            # The envelope reaches 2 % after its settling time.
            self.assertLessEqual(step.settling, math.log(50.0 / math.sqrt(1.0 - zeta ** 2)) / decay + step.interval)
            self.assertGreater(step.settling / step.times[-1], 0.35, "most of the drawing shows the motion")

    def test_the_rate_of_a_setpoint_is_an_impulse(self):
        """(d s + p)/(s^2 + d s + p) with poles -1 and -2: 1 + exp(-t) - 2 exp(-2 t)."""
        model = model_of([[0.0, 1.0], [-2.0, -3.0]], [0.0, 2.0], [{"growth": -1.0, "frequency": 0.0}, {"growth": -2.0, "frequency": 0.0}])
        model.update(inputs=["c/setpoint", "c/setpoint_rate"], B=[[0.0, 0.0], [2.0, 3.0]])
        step = steps.response(steps.Motion(steps.System(model), "c/setpoint"), [1.0, 0.0], [0.0, 0.0])
        for t, value in zip(step.times, step.values):
            self.assertAlmostEqual(value, 1.0 + math.exp(-t) - 2.0 * math.exp(-2.0 * t), 11)

    def test_a_sampled_system_has_one_value_per_period(self):
        for a, stride in ((0.9, 1), (0.9999, None)):
            model = model_of([[a]], [1.0 - a], [{"growth": math.log(a) / 0.1, "frequency": 0.0}], period=0.1)
            step = steps.response(steps.Motion(steps.System(model), "c/setpoint"), [1.0], [0.0])
            found = round(step.interval / 0.1)
            self.assertTrue(found == stride or stride is None and found > 1, found)
            for t, value in zip(step.times, step.values):
                self.assertAlmostEqual(value, 1.0 - a ** round(t / 0.1), 10)
            self.assertIn("one value per period" if stride else f"a value each {found} periods, joined", linear.step_words(step, 0.1))

    def test_growing_and_undamped_motions_have_no_final_value(self):
        for growth, stability in ((0.5, "unstable"), (0.0, "neutral")):
            model = model_of([[growth]], [1.0], [{"growth": growth, "frequency": 0.0}], stability=stability)
            step = steps.response(steps.Motion(steps.System(model), "c/setpoint"), [1.0], [0.0])
            self.assertEqual((step.final, step.overshoot, step.settling), (None, None, None))
            end = step.times[-1]
            self.assertAlmostEqual(step.values[-1] / ((math.exp(growth * end) - 1.0) / growth if growth else end), 1.0, 9)

    def test_exponentials(self):
        turned = matrices.exponential([[0.0, -20.0], [20.0, 0.0]])
        self.assertAlmostEqual(turned[0][0], math.cos(20.0), 12)
        self.assertAlmostEqual(turned[1][0], math.sin(20.0), 12)
        self.assertLess(abs(matrices.exponential([[-1e6, 1.0], [0.0, -1.0]])[1][1] - math.exp(-1.0)), 1e-9)


class Diagrams(unittest.TestCase):
    def test_the_phase_goes_on_beyond_half_a_turn(self):
        response = open_loop.Response(table(loop_of_the_cart))
        for f, phase in zip(response.frequencies, response.phases):
            w = open_loop.TURN * f
            self.assertAlmostEqual(phase, -90.0 - math.degrees(math.atan(w) + math.atan(0.5 * w)), 9)

    def test_a_pole_without_damping_turns_the_phase_back_and_cuts_the_curve(self):
        response = open_loop.Response(table(lambda s: (s + 1.0) / (s * s + 1.0), count=401))
        self.assertAlmostEqual(response.phases[-1], -90.0, delta=1.0)
        self.assertEqual(len(response.pieces()), 2)
        noise = {"frequency": [0.9, 1.0, 1.0 + 1e-12, 1.1], "real": [5.0, 1e15, 2e15, -5.0], "imaginary": [1.0] * 4}
        self.assertEqual(open_loop.Response(noise).values, [5.0 + 1.0j, -5.0 + 1.0j])

    def test_curves_end_at_the_frame(self):
        self.assertEqual(plane.cut((-1.0, 0.5), (3.0, 0.5), (0.0, 1.0, 0.0, 1.0)), ((0.0, 0.5), (1.0, 0.5)))
        self.assertIsNone(plane.cut((-1.0, 2.0), (3.0, 2.0), (0.0, 1.0, 0.0, 1.0)))
        drawn = plane.square(0.0, 0.0, 1.0, ("x", "y"))
        drawn.curve([(-9.0, -9.0), (9.0, 9.0)], "tuned line")
        ends = [float(v) for v in re.findall(r"[-0-9.]+", re.search(r'class="tuned line" d="([^"]*)"', drawn.svg("t"))[1])]
        self.assertAlmostEqual(ends[2] - ends[0], ends[1] - ends[3], 0, "axes are equal")
        self.assertAlmostEqual(ends[2], charts.WIDTH - charts.RIGHT, 0)

    def test_texts_cover_no_other_text(self):
        drawn = plane.square(0.0, 0.0, 1.0, ("x", "y"))
        for _ in range(40):
            drawn.note((0.1, 0.1), "a text")
        self.assertFalse(any(plane.overlap(a, b) for k, a in enumerate(drawn.texts) for b in drawn.texts[:k]))

    def test_nyquist_marks_are_at_their_places(self):
        margins = {"gain_margin": {"value": 3.0, "frequency": math.sqrt(2.0)}, "sensitivity": {"value": 2.0, "frequency": 1.0}}
        svg = nyquist.chart("c", open_loop.Response(table(loop_of_the_cart)), margins)
        drawn = plane.square(-0.4, 0.0, 1.6, ("real part of L", "imaginary part of L"))
        x, y = drawn.place((-1.0 / 3.0, 0.0))
        self.assertIn(f'cx="{x:.1f}" cy="{y:.1f}"', svg)
        self.assertIn("1/Ms = 0.5", svg)

    def test_poles_of_both_planes(self):
        mode = {"growth": -2.0, "frequency": 0.5, "damping_ratio": 0.54, "rates": {}}
        self.assertEqual([value for _, value, _ in pole_charts.poles({"modes": [mode]})], [complex(-2.0, math.pi), complex(-2.0, -math.pi)])
        sampled = {"modes": [{**mode, "radius": math.exp(-0.2)}], "period": 0.1}
        self.assertLess(abs(pole_charts.poles(sampled)[0][1] - cmath.exp(0.1 * complex(-2.0, math.pi))), 1e-12)
        self.assertIn("|z| = 1", pole_charts.maps(sampled)[0][2])
        for ratio in pole_charts.DAMPING:
            for z in pole_charts.spiral(ratio)[1:-1]:
                s = cmath.log(z)
                self.assertAlmostEqual(-s.real / abs(s), ratio, 9)


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "cart.urdf").write_text(CART)

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)

    def page(self, study, model=None, more=()):
        """(result, page as text) of a study."""
        (self.folder / "study.yaml").write_text(study)
        done = self.run_program("linearize", model or self.folder / "cart.urdf", self.folder / "study.yaml", "--json", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "cart.json").write_text(done.stdout)
        shown = self.run_program("report", self.folder / "cart.json", "-o", self.folder / "cart.html")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        return json.loads(done.stdout), (self.folder / "cart.html").read_text()

    def test_the_drawn_loop_has_the_margins_of_the_table(self):
        for more in ("", ", sample_time: 0.05", ", sample_time: 0.3, delay: 0.2"):
            result, text = self.page(STUDY.format(p=0.8, more=more))
            servo = result["loops"]["servo"]
            response = open_loop.Response(servo["response"])
            gain, phase = servo["gain_margin"], servo["phase_margin"]
            # Between frequencies of the grid the logarithm of |L| is drawn as a straight line.
            self.assertAlmostEqual(value_at(response, gain, response.gains), -open_loop.decibels(gain["value"]), 2)
            self.assertAlmostEqual(value_at(response, gain, response.phases), -180.0, 1)
            self.assertAlmostEqual(value_at(response, phase, response.gains), 0.0, 2)
            self.assertAlmostEqual(value_at(response, phase, response.phases), math.degrees(phase["value"]) - 180.0, 1)
            self.assertAlmostEqual(min(abs(1.0 + value) for value in response.values) * servo["sensitivity"]["value"], 1.0, 3)
            self.assertAlmostEqual(servo["delay_margin"]["value"] * phase["frequency"], phase["value"], 9)
            for value in (gain["value"], math.degrees(phase["value"]), servo["delay_margin"]["value"], gain["frequency"] / open_loop.TURN):
                self.assertIn(f'<data value="{value!r}">', text)
            self.assertIn(f"gain margin {numbers.short(gain['value'], 4)} (", text)
            self.assertLess(text.index("stable: slowest pole"), text.index("<table>"))
            self.assertIn("samples counted" if more else "damping and controllers counted", text)
            self.assertIn("z = exp(s T)" if more else "real part [1/s]", text)

    def test_the_step_response_is_the_run(self):
        """The run of the cart whose set-point is 1, against the drawn response."""
        for more in ("", ", sample_time: 0.05"):
            study = STUDY.format(p=0.8, more=more)
            result, text = self.page(study)
            self.assertEqual(result["measured"], {"servo": "slide/position"})
            step = steps.response(steps.Motion(steps.System(result), "servo/setpoint"), *linear.rows_of(result, "servo")[0][0][1:])
            (self.folder / "run.yaml").write_text(study.replace("setpoint: 0.0", "setpoint: 0.01"))
            done = self.run_program("simulate", self.folder / "cart.urdf", self.folder / "run.yaml", "--json", "--samples", "201", "--signals", "slide/position")
            series = json.loads(done.stdout)["series"]
            self.assertAlmostEqual(series["time"][1], 0.05, 12)
            for t, x in list(zip(series["time"], series["slide/position"]))[::10]:
                k = min(range(len(step.times)), key=lambda k: abs(step.times[k] - t))
                slope = (step.values[k + 1] - step.values[k]) / step.interval
                self.assertAlmostEqual(100.0 * x, step.values[k] + slope * (t - step.times[k]), 2 if not more else 4)
            self.assertIn("A unit step of servo/setpoint", text)
            self.assertIn(f"overshoot {numbers.short(100.0 * step.overshoot, 3)} %", text)

    def test_an_unstable_loop_has_no_margins(self):
        result, text = self.page(STUDY.format(p=9.0, more=""))
        self.assertEqual(result["stability"], "unstable")
        self.assertIn("The closed loops are unstable, so there are no margins.", text)
        self.assertNotIn("phase margin", text)
        self.assertIn("gain reduction", text)
        self.assertNotIn("gain reduction 0.3", text, "in the drawings")
        self.assertIn("Nyquist diagram", text)
        self.assertIn("unstable mark", text)

    def test_without_controllers_there_are_poles_alone(self):
        _, text = self.page("duration: 1\n")
        self.assertIn("No controller drives a joint", text)
        self.assertIn("real part [1/s]", text)
        for absent in ("Bode", "Nyquist", "Step responses", "dl class"):
            self.assertNotIn(absent, text)

    def test_a_loop_that_samples_several_times_says_so(self):
        _, text = self.page((ROOT / "config/feed_axis.yaml").read_text(), ROOT / "urdf/feed_axis.urdf")
        self.assertIn("Margins by the poles over 4 samples, the common period of all controllers;", text)
        self.assertIn("phase margin", text)
        self.assertIn('<code>--signals "axis/velocity - position_loop/output"</code>', text)
        self.assertIn("one value per period", text)
        _, text = self.page((ROOT / "config/feed_axis.yaml").read_text(), ROOT / "urdf/feed_axis.urdf", ("--signals", "axis/velocity - position_loop/output"))
        self.assertNotIn("which is no state", text)

    def test_a_continuous_loop_beside_sampled_ones_says_so(self):
        _, text = self.page("duration: 1\ncontrollers:\n  servo: {type: pid, input: slide/position, setpoint: 0.0, output: slide, gains: {p: 4.0}}\n"
                            "  other: {type: pid, input: slide/velocity, setpoint: 0.0, output: slide, gains: {p: 1.0}, sample_time: 0.01}\n")
        self.assertIn("Margins by the poles over the common period of all controllers;", text)

    def test_its_own_file_is_not_replaced(self):
        self.page("duration: 1\n")
        done = self.run_program("report", self.folder / "cart.json", "-o", self.folder / "cart.json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("would replace the linearization", done.stderr)


class Words(unittest.TestCase):
    def test_a_margin_without_limit(self):
        rows = {name: instead for name, _, instead, *_ in linear.margin_rows({}, True)}
        self.assertEqual((rows["gain margin"], rows["gain reduction"], rows["bandwidth"]), ("\u221e", "0", "none"))
        self.assertEqual(linear.margin_rows({}, False), [])

    def test_ticks_of_degrees(self):
        self.assertEqual(bode.degree_ticks(-275.0, -80.0)[0], [-270, -240, -210, -180, -150, -120, -90])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
