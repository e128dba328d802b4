#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""scripts/case_figures on a bag made here, scripts/model_mismatch on a stand-in for the program. Usage: figures_test.py [-v]"""
import contextlib
import io
import json
import os
import stat
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

import genpy.dynamic
import rosbag
import rospy
from sensor_msgs.msg import JointState

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SEPARATOR = "=" * 80
HEADER = f"\n{SEPARATOR}\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"


def load(script):
    sys.dont_write_bytecode = True
    loader = SourceFileLoader(script, os.path.join(ROOT, "scripts", script))
    module = module_from_spec(spec_from_loader(script, loader))
    loader.exec_module(module)
    return module


def message_class(name):
    """A message of this package from its definition alone, so that no built package is needed."""
    with open(os.path.join(ROOT, "msg", name + ".msg")) as file:
        return genpy.dynamic.generate_dynamic("mechanism_codesign/" + name, file.read() + HEADER)["mechanism_codesign/" + name]


def write_bag(path, progress):
    friction, controllers, signals, trial = (message_class(n) for n in ("JointFriction", "ControllerStates", "Signals", "OptimizationProgress"))
    with rosbag.Bag(path, "w") as bag:
        for k in range(5):
            stamp = rospy.Time.from_sec(1.0 + 0.1 * k)
            for side, scale in (("initial", 2.0), ("tuned", 1.0)):
                messages = {
                    "joint_states": JointState(name=["slide", "turn"], position=[0.5 * k, 0.0], velocity=[scale * k, -k]),
                    "joint_friction": friction(name=["slide"], friction=[-scale], normal_force=[3.0], sliding_velocity=[k]),
                    "controller_states": controllers(name=["servo", "push"], error=[scale * (4 - k), 0.0], output=[k, 1.0]),
                    "signals": signals(name=["cart/position/x", "servo/error"], value=[k, scale * (4 - k)]),
                }
                for topic, message in messages.items():
                    message.header.stamp = stamp
                    bag.write(f"{side}/{topic}", message, stamp)
        for code, objective in progress:
            bag.write("optimization_progress", trial(evaluation=len(code), code=code, objective=objective, best_objective=objective,
                                                     gradient_norm=1.0, parameters=["Kp", "mass"], values=[objective, 2.0]), stamp)


class CaseFigures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.bag = os.path.join(self.folder.name, "job.bag")
        self.script = load("case_figures")

    def test_series_are_read_by_name_and_begin_at_zero(self):
        write_bag(self.bag, [("success", 1.0)])
        with rosbag.Bag(self.bag) as bag:
            run = self.script.read_run(bag, "initial")
        self.assertEqual([round(t, 6) for t in run["velocity"].time], [0.0, 0.1, 0.2, 0.3, 0.4])
        self.assertEqual(run["velocity"].values["slide"], [0.0, 2.0, 4.0, 6.0, 8.0])
        self.assertEqual(run["velocity"].values["turn"], [0.0, -1.0, -2.0, -3.0, -4.0])
        self.assertEqual(run["friction"].values, {"slide": [-2.0] * 5})

    def test_pictures_are_drawn_without_a_screen(self):
        write_bag(self.bag, [("success", 4.0), ("assembly_failed", 0.0), ("success", 1.0)])
        self.script.main([self.bag, "--output", self.folder.name, "--name", "job", "--velocity", "turn"])
        for name in ("job_runs.png", "job_convergence.png", "job_parameters.png"):
            with open(os.path.join(self.folder.name, name), "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_what_is_flat_or_shown_already_gets_no_panel(self):
        write_bag(self.bag, [("success", 1.0)])
        with rosbag.Bag(self.bag) as bag:
            runs = {side: self.script.read_run(bag, side) for side in ("initial", "tuned")}
        panels = {quantity: names for quantity, _, names in self.script.choose_panels(runs, [], [])}
        self.assertEqual(panels["error"], ["servo"])
        self.assertEqual(panels["output"], ["push", "servo"])
        self.assertEqual(panels["position"], ["slide"])
        self.assertEqual(panels["signal"], ["cart/position/x"])
        self.assertNotIn("velocity", panels)
        panels = {quantity: names for quantity, _, names in self.script.choose_panels(runs, ["turn"], ["slide"])}
        self.assertEqual((panels["position"], panels["velocity"]), (["turn"], ["slide"]))

    def test_other_bags_and_joints_are_refused(self):
        write_bag(self.bag, [])
        for arguments, message in (([self.bag], "not the bag of an optimization"), ([self.bag + "x"], "No such file")):
            with self.assertRaises(SystemExit) as refusal:
                self.script.main(arguments)
            self.assertIn(message, str(refusal.exception))
        write_bag(self.bag, [("success", 1.0)])
        with self.assertRaises(SystemExit) as refusal:
            self.script.main([self.bag, "--velocity", "trun"])
        self.assertIn("no joint trun", str(refusal.exception))


# Answers as the program does: tuning gives other gains without friction, and a run's error ends at 1/Ki.
STAND_IN = """#!/usr/bin/python3
import json, sys
command, model, gains = sys.argv[1], sys.argv[2], [w.split("=")[1] for w in sys.argv if w[:2] in ("Kp", "Ki", "Kd")]
if command == "optimize":
    print(json.dumps({"parameters": {"Kp": 5.0, "Ki": 0.5 if "frictionless" in model else 50.0, "Kd": 1.0}}))
else:
    time = [0.1 * k for k in range(11)]
    series = {s: [1.0 / float(gains[1])] * 11 for s in sys.argv[sys.argv.index("--signals") + 1].split(",")}
    print(json.dumps({"objective": 7.0 + ("--overlay" in sys.argv), "series": dict(series, time=time)}))
"""


class ModelMismatch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.program = os.path.join(self.folder.name, "codesign")
        with open(self.program, "w") as file:
            file.write(STAND_IN)
        os.chmod(self.program, stat.S_IRWXU)
        self.script = load("model_mismatch")

    def test_table_and_picture(self):
        picture, out = os.path.join(self.folder.name, "mismatch.png"), io.StringIO()
        with contextlib.redirect_stdout(out):
            self.script.main(["--codesign", self.program, "--plot", picture])
        rows = [line.split(" | ") for line in out.getvalue().splitlines()[2:]]
        self.assertEqual([row[2] for row in rows], ["frictionless", "rough (Gonthier)"] * 2)
        self.assertEqual([float(row[3]) for row in rows], [0.0283, 0.0283, 2.8284, 2.8284])
        self.assertEqual([float(row[6].strip(" |")) for row in rows], [7.0, 8.0, 7.0, 8.0])
        self.assertGreater(os.path.getsize(picture), 1000)

    def test_a_failing_run_is_passed_on(self):
        with self.assertRaises(SystemExit):
            self.script.main(["--codesign", "/bin/false", "--gains", json.dumps({h: {"Kp": 1, "Ki": 1, "Kd": 1} for h in self.script.MODELS})])

    def test_the_files_it_names_exist(self):
        for case, overlay in self.script.SURFACES.values():
            for path in [os.path.join(ROOT, "urdf", case + ".urdf"), os.path.join(ROOT, "config", case + ".yaml"), *overlay[1:]]:
                self.assertTrue(os.path.exists(path), path)


if __name__ == "__main__":
    unittest.main()
