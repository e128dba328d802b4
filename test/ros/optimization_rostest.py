#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""An empty request runs the loaded study; the bag it leaves can be read and replayed."""
import json
import os
import shutil
import subprocess
import sys
import threading
import unittest
import xml.etree.ElementTree

import rosbag
import rospy
import rostest
from mechanism_codesign.msg import OptimizationProgress
from mechanism_codesign.srv import Evaluate, EvaluateRequest, Optimize, OptimizeRequest
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE  # noqa: E402

RUN_TOPICS = ("joint_states", "joint_friction", "controller_states", "loop_errors", "signals", "friction_markers")


class OptimizationTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("optimization_test")
        rospy.wait_for_service("optimize", PATIENCE)
        rospy.wait_for_service("evaluate", PATIENCE)
        cls.result = rospy.ServiceProxy("optimize", Optimize)(OptimizeRequest())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(rospy.get_param("optimization/output_directory"), ignore_errors=True)

    def test_result(self):
        result = self.result
        self.assertTrue(result.success, result.message)
        self.assertEqual(result.code, "success")
        self.assertEqual(list(result.parameters), ["crank_length", "rod_length", "slider_length", "slider_width", "Kp"])
        self.assertAlmostEqual(result.initial_objective, 0.05925272691, delta=1e-4 * 0.05925272691)
        self.assertLess(result.objective, 8.8e-4)
        self.assertEqual(len(result.tuned), 5)
        self.assertNotEqual(result.termination, "")

    def test_progress_is_latched(self):
        progress = rospy.wait_for_message("optimization_progress", OptimizationProgress, PATIENCE)
        self.assertEqual(progress.evaluation, self.result.evaluations)
        self.assertEqual(list(progress.parameters), list(self.result.parameters))

    def test_tuned_description_is_latched_and_holds_the_tuned_values(self):
        text = rospy.wait_for_message("tuned/robot_description", String, PATIENCE).data
        namespace = "{urn:mechanism_codesign}"
        values = {node.get("name"): float(node.get("value")) for node in xml.etree.ElementTree.fromstring(text).iter(namespace + "parameter")}
        tuned = dict(zip(self.result.parameters, self.result.tuned))
        for name, value in values.items():
            self.assertEqual(value, tuned[name], name)

    def test_evaluate_with_a_check_of_the_gradient(self):
        reply = rospy.ServiceProxy("evaluate", Evaluate)(EvaluateRequest(check="complex_step"))
        self.assertTrue(reply.success, reply.message)
        self.assertAlmostEqual(reply.objective, self.result.initial_objective, delta=1e-9)
        self.assertLess(reply.largest_relative_difference, 1e-6)
        self.assertTrue(0.0 < reply.constraint_drift <= self.result.constraint_drift, "the start is one of the optimization's points")
        self.assertTrue(0.0 < reply.energy_error <= self.result.energy_error < 1e-4)

    def test_evaluate_at_the_tuned_design(self):
        reply = rospy.ServiceProxy("evaluate", Evaluate)(EvaluateRequest(parameters=self.result.parameters, values=self.result.tuned))
        self.assertTrue(reply.success, reply.message)
        self.assertAlmostEqual(reply.objective, self.result.objective, delta=1e-6 * self.result.objective)

    def test_a_bad_request_is_an_answer(self):
        reply = rospy.ServiceProxy("optimize", Optimize)(OptimizeRequest(parameters=["crank_lenght"]))
        self.assertFalse(reply.success)
        self.assertEqual(reply.code, "bad_input")
        self.assertIn('"crank_length"', reply.message)

    def test_bag(self):
        with rosbag.Bag(self.result.bag) as bag:
            topics = bag.get_type_and_topic_info().topics
            for side in ("initial/", "tuned/"):
                for topic in RUN_TOPICS:
                    self.assertEqual(topics[side + topic].message_count, 101, side + topic)
                self.assertEqual(topics[side + "robot_description"].message_count, 1)
            self.assertEqual(topics["optimization_progress"].message_count, self.result.evaluations)
            (_, result, _), = bag.read_messages(topics=["result"])
            self.assertEqual(result.objective, self.result.objective)
            self.assertEqual(result.bag, self.result.bag)
            (_, request, _), = bag.read_messages(topics=["request"])
            self.assertRegex(result.version, r"^\d+\.\d+\.\d+$")
            self.assertEqual((request.version, self.result.version), (result.version, result.version))
            self.assertEqual((result.constraint_drift, result.energy_error), (self.result.constraint_drift, self.result.energy_error))
            velocity = [message.velocity[message.name.index("crank_joint")] for _, message, _ in bag.read_messages(topics=["tuned/joint_states"])]
            self.assertAlmostEqual(velocity[-1], -10.0, delta=0.2)
            signals = [message for _, message, _ in bag.read_messages(topics=["tuned/signals"])]
            self.assertEqual(signals[-1].name, ["crank_joint/velocity", "crank_speed/output"])
            self.assertEqual(signals[-1].value[0], velocity[-1])

    def test_the_folder_beside_the_bag(self):
        folder = self.result.bag[:-len(".bag")]
        names = set(os.listdir(folder))
        self.assertLessEqual({"result.json", "details.json", "tuned.urdf", "initial.urdf", "job_study.yaml", "initial.csv", "tuned.csv",
                              "convergence.csv"}, names)
        with open(os.path.join(folder, "result.json")) as file:
            result = json.load(file)
        self.assertEqual(result["objective"], self.result.objective)
        self.assertEqual([result["parameters"][name] for name in self.result.parameters], list(self.result.tuned))
        self.assertEqual(len(result["warnings"]), len(self.result.warnings))
        # The files alone give the objective again, and a page.
        reply = self.codesign("simulate", "tuned.urdf", "job_study.yaml", "--result", "result.json", "--json", cwd=folder)
        self.assertAlmostEqual(json.loads(reply)["objective"], self.result.objective, delta=1e-9 * self.result.objective)
        page = os.path.join(folder, "page.html")
        self.codesign("report", self.result.bag, "-o", page)
        with open(page, encoding="utf-8") as file:
            self.assertIn(repr(self.result.objective), file.read())

    def codesign(self, *arguments, cwd=None):
        reply = subprocess.run(["rosrun", "mechanism_codesign", "codesign", *arguments], capture_output=True, text=True, check=False, cwd=cwd)
        self.assertEqual(reply.returncode, 0, reply.stderr)
        return reply.stdout

    def test_with_the_example_client(self):  # last, since it changes latched messages
        for way in ([], ["--action"]):
            command = ["rosrun", "mechanism_codesign", "example_client", *way, "--evaluations", "2", "Kp=2.5"]
            reply = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(reply.returncode, 0, reply.stdout + reply.stderr)
            self.assertIn("  Kp 2.5 -> ", reply.stdout)
            self.assertEqual("trial 2" in reply.stdout, bool(way), reply.stdout)

    def test_replay(self):
        launch = subprocess.Popen(["roslaunch", "mechanism_codesign", "replay.launch", f"bag:={self.result.bag}", "rviz:=false"])
        try:
            places = rospy.wait_for_message("tf_static", TFMessage, PATIENCE)
            self.assertEqual([t.child_frame_id for t in places.transforms], ["initial", "tuned", "caption"])
            missing, complete = {"initial/slider", "tuned/slider", "initial/rod", "tuned/rod"}, threading.Event()

            def receive(message):
                missing.difference_update(transform.child_frame_id for transform in message.transforms)
                if not missing:
                    complete.set()

            rospy.Subscriber("tf", TFMessage, receive)
            self.assertTrue(complete.wait(PATIENCE), missing)
            self.assertIn("crank_length", rospy.get_param("initial/robot_description"))
            self.assertNotEqual(rospy.get_param("initial/robot_description"), rospy.get_param("tuned/robot_description"))
        finally:
            launch.terminate()
            launch.wait()


if __name__ == "__main__":
    rostest.rosrun("mechanism_codesign", "optimization", OptimizationTest)
