# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Recordings of Python: several, a holdout, signals, masks, and the regressor of a motion."""
import unittest

import numpy as np

from fixture import ARM, FIT, recorded
import mechanism_codesign as codesign

# Two links that turn in a plane, the second with ten free numbers of its inertia, as `codesign:free_inertia` names them.
TWO = """<robot name="two" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="5"/>
  <link name="ground"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial></link>
  <link name="fore"><inertial codesign:inertia="free"><origin xyz="0.15 0.02 0"/><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/></inertial></link>
  <joint name="one" type="continuous"><parent link="ground"/><child link="upper"/><axis xyz="0 1 0"/><dynamics damping="0.1" codesign:damping="${viscous}"/></joint>
  <joint name="two" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/></joint>
</robot>
"""
FREE = ("viscous", *(f"fore_{name}" for name in ("alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3")))
STUDY = "identify: {filter: {cutoff: 0}}\nparameters: {" + ", ".join(f"{name}: {{}}" for name in FREE) + "}\n"


def motion():
    t = np.linspace(0.0, 3.0, 301)
    return t, {"one": 0.8 * np.sin(2.0 * t) + 0.3 * np.cos(5.0 * t), "two": 0.6 * np.cos(3.0 * t) + 0.4 * np.sin(4.1 * t)}


class Recordings(unittest.TestCase):
    def test_several_with_a_holdout(self):
        t, q, effort = recorded()
        one, other = codesign.Recording(t, q, effort), codesign.Recording(t, -q, -effort)
        problem = codesign.Problem(ARM, FIT)
        alone = problem.identify(t, q, effort)
        fit = problem.identify([one, other], holdout=codesign.Recording(t, q, effort + 0.3))
        self.assertEqual(fit.record["data"]["samples"], 2 * alone.record["data"]["samples"])
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=1e-3)
        holdout = fit.record["holdout"]["joints"]["shoulder"]
        self.assertAlmostEqual(holdout["rms"], 0.3, delta=1e-2)
        judged = problem.identify(holdout=[other], evaluate=True)
        self.assertNotIn("data", judged.record)
        with self.assertRaisesRegex(TypeError, "holdout"):
            problem.identify(holdout=[other])
        with self.assertRaisesRegex(TypeError, "no columns beside it"):
            problem.identify([one, other], q)

    def test_a_parameter_of_one_recording(self):
        t, q, effort = recorded()
        study = "duration: 4.0\nparameters: {mass: {}}\n"
        problem = codesign.Problem(ARM, study)
        fit = problem.identify(codesign.Recording(t, q, effort, set={"viscous": 0.7}))
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=1e-3)
        self.assertGreater(fit.record["data"]["joints"]["shoulder"]["explained"], 0.9999)
        for name, words in (("mass", "tune"), ("viscos", "viscous")):
            with self.assertRaisesRegex(codesign.InputError, words):
                problem.identify(codesign.Recording(t, q, effort, set={name: 0.7}))
        for value in (7.0, float("nan")):
            with self.assertRaisesRegex(codesign.InputError, r"arrays\.set\.viscous: .*outside the bounds of the parameter viscous .*\[0, 5\]"):
                problem.identify(codesign.Recording(t, q, effort, set={"viscous": value}))

    def test_a_mask(self):
        t, q, effort = recorded()
        slow = np.abs(np.gradient(q, t)) < 0.2
        wrong = np.where(slow, effort + 3.0, effort)
        problem = codesign.Problem(ARM, FIT)
        fit = problem.identify(codesign.Recording(t, q, wrong, mask=0.25))
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=1e-3)
        self.assertLess(fit.record["data"]["joints"]["shoulder"]["counted"], 0.95)
        self.assertTrue(np.isnan(fit.computed["shoulder"]).any())
        by_joint = problem.identify(codesign.Recording(t, q, wrong, mask={"shoulder": 0.25}))
        self.assertEqual(by_joint.numbers["mass"], fit.numbers["mass"])
        with self.assertRaisesRegex(codesign.InputError, "mask"):
            problem.identify(codesign.Recording(t, q, wrong, mask=-1.0))
        with self.assertRaisesRegex(codesign.InputError, r"arrays\.mask: "):
            problem.identify(codesign.Recording(t, q, wrong, mask=-1.0))
        with self.assertRaisesRegex(codesign.InputError, r"arrays\.mask.*no sample is left out"):
            codesign.Problem(ARM, FIT + "identify: {residual: motion}\n").identify(codesign.Recording(t, q, wrong, mask=0.25))

    def test_a_mask_with_bounds(self):
        """Of efforts at rest those count that no friction explains."""
        t, q, effort = recorded()
        slow = np.abs(np.gradient(q, t)) < 0.2
        problem = codesign.Problem(ARM, FIT)
        right = problem.identify(codesign.Recording(t, q, effort, mask=0.25, rest="bounds"))
        self.assertAlmostEqual(right.numbers["mass"].value, 2.0, delta=1e-3)
        self.assertLess(right.record["data"]["joints"]["shoulder"]["counted"], 0.95)
        wrong = problem.identify(codesign.Recording(t, q, np.where(slow, effort + 3.0, effort), mask=0.25, rest="bounds"))
        self.assertGreater(abs(wrong.numbers["mass"].value - 2.0), 0.01)
        with self.assertRaisesRegex(codesign.InputError, r"arrays\.rest: without a mask"):
            problem.identify(codesign.Recording(t, q, effort, rest="bounds"))
        with self.assertRaisesRegex(codesign.InputError, "leave_out, bounds"):
            problem.identify(codesign.Recording(t, q, effort, mask=0.25, rest="bound"))

    def test_a_force_in_place_of_an_effort(self):
        """Of a pendulum at 0.5 m the force along the rod is m (g cos q + 0.5 v^2)."""
        t, q, _ = recorded()
        v = np.gradient(q, t, edge_order=2)
        pull = 2.0 * (9.81 * np.cos(q) + 0.5 * v * v)
        recording = codesign.Recording(t, q, signals={"shoulder/reaction_force/z": pull})
        fit = codesign.Problem(ARM, "duration: 4.0\nparameters: {mass: {}}\n").identify(recording)
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=5e-3)
        self.assertIn("shoulder/reaction_force/z", fit.recorded)

    def test_a_signal_of_an_unknown_parameter(self):
        """An expression of signals may read parameters and the time, and nothing else."""
        t, q, effort = recorded()
        problem = codesign.Problem(ARM, "duration: 4.0\nparameters: {mass: {}}\n")
        for name in ("${2*viscos*shoulder/velocity}", "${T*shoulder/velocity}"):
            with self.assertRaisesRegex(codesign.InputError, r"arrays\.signals: unknown parameter"):
                problem.identify(codesign.Recording(t, q, effort, signals={name: q}))


class Regressor(unittest.TestCase):
    def test_it_is_the_derivative_of_the_efforts(self):
        t, q = motion()
        problem = codesign.Problem(TWO, STUDY)
        found = problem.regressor(t, q)
        n, k, p = found.matrix.shape
        self.assertEqual((k, p), (2, len(FREE)))
        self.assertEqual(found.outputs, ["one", "two"])
        self.assertEqual((found.computed.shape, found.time.shape, sum(found.lengths)), ((n, k), (n,), n))
        # Efforts are linear in mass and moments, so that the part of the fore link is what changes with all of them.
        names = [f"fore_{name}" for name in ("m", "mx", "my", "mz", "Jxx", "Jyy", "Jzz", "Jxy", "Jyz", "Jxz")]
        self.assertEqual(set(names), set(found.names[1:]))
        values = dict(zip(found.names, found.values))
        self.assertAlmostEqual(values["fore_mx"], 0.15, delta=1e-12)
        heavier = problem.regressor(t, q, fore_alpha=problem.start[1] + 0.5 * np.log(2.0))  # twice the mass in all places
        part = sum(found[name] * values[name] for name in names)
        np.testing.assert_allclose(heavier.computed - found.computed, part, atol=1e-10)
        step = problem.regressor(t, q, viscous=0.6)
        np.testing.assert_allclose(step.computed - found.computed, 0.5 * found["viscous"], atol=1e-10)

    def test_base_parameters(self):
        t, q = motion()
        found = codesign.Problem(TWO, STUDY).regressor(t, q)
        rank = np.linalg.matrix_rank(found.matrix.reshape(-1, len(found.names)), tol=1e-8)
        self.assertEqual(len(found.base_names), rank)
        self.assertEqual(found.base.shape[2], rank)
        np.testing.assert_allclose(found.base @ found.base_values, found.matrix @ found.values, atol=1e-10)
        with self.assertRaises(KeyError):
            found["nothing"]

    def test_a_sensor_changes_no_effort(self):
        t, q = motion()
        plain = codesign.Problem(TWO, STUDY).regressor(t, q)
        study = STUDY.replace("cutoff: 0}", "cutoff: 0}, joints: {one: {effort_scale: 3, delay: 0.04, offset: 2.0}}")
        for recording in (codesign.Recording(t, q), codesign.Recording(t, q, {"one": np.cos(t), "two": np.sin(t)})):
            found = codesign.Problem(TWO, study).regressor(recording)
            np.testing.assert_allclose(found.computed, plain.computed, atol=1e-9)
            np.testing.assert_allclose(found.matrix, plain.matrix, atol=1e-9)

    def test_what_it_refuses(self):
        t, q = motion()
        with self.assertRaisesRegex(codesign.InputError, "residual"):
            codesign.Problem(TWO, STUDY.replace("filter: {cutoff: 0}", "residual: motion")).regressor(t, q)


if __name__ == "__main__":
    unittest.main()
