#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs, samples and starts in replies, results of the action and bags; a replay of the worst run."""
import os
import shutil
import subprocess
import sys

import actionlib
import rosbag
import rospy
import rostest
from mechanism_codesign.msg import OptimizeAction, OptimizeGoal
from mechanism_codesign.srv import Optimize, OptimizeRequest
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, SHARE, NodesTestCase  # noqa: E402

RUN_TOPICS = ("joint_states", "joint_friction", "controller_states", "loop_errors", "signals", "friction_markers")


class EnsembleTest(NodesTestCase):
    """A shipped case, through the service, with its launch file; and several runs from several starts, through the action."""

    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("optimize", PATIENCE)
        cls.result = rospy.ServiceProxy("optimize", Optimize)(OptimizeRequest())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(rospy.get_param("optimization/output_directory"), ignore_errors=True)

    def test_scenarios(self):
        result = self.result
        self.assertTrue(result.success, result.message)
        self.assertEqual([scenario.sample for scenario in result.scenarios], list(range(1, 37)), "32 samples, and both ends of the interval with both laws")
        for scenario in result.scenarios:
            self.assertEqual(scenario.run, "")
            self.assertEqual(list(scenario.parameters), ["mu_static"])
            self.assertTrue(0.0 < scenario.values[0] < 0.5)
            self.assertAlmostEqual(scenario.weight, 1.0 / 36.0)
            self.assertFalse(scenario.failed or scenario.initial_failed)
        self.assertEqual({scenario.friction_law for scenario in result.scenarios}, {"brown_mcphee", "gonthier"})
        self.assertAlmostEqual(max(scenario.objective for scenario in result.scenarios), result.objective, delta=1e-6 * result.objective)
        self.assertEqual(result.scenarios[result.worst - 1].objective, max(scenario.objective for scenario in result.scenarios))
        self.assertEqual((list(result.searches), list(result.optima), result.screened, result.unusable), ([], [], 0, 0))

    def test_validation(self):
        (validation,) = self.result.validation
        self.assertEqual((validation.samples, validation.failed), (1000, 0))
        self.assertEqual(validation.promised, self.result.objective)
        self.assertEqual(validation.objective, validation.worst, "the measure is the worst")
        self.assertTrue(validation.mean < validation.worst < 1.05 * validation.promised)

    def test_the_bag_holds_the_nominal_and_the_worst_run(self):
        with rosbag.Bag(self.result.bag) as bag:
            topics = bag.get_type_and_topic_info().topics
            for place in ("", "worst/"):
                for side in ("initial/", "tuned/"):
                    for topic in RUN_TOPICS:
                        self.assertEqual(topics[place + side + topic].message_count, 111, place + side + topic)
                    self.assertEqual(topics[place + side + "robot_description"].message_count, 1)
                self.assertEqual(topics[place + "tf"].message_count, 222)
            ((_, result, _),) = bag.read_messages(topics=["result"])
            self.assertEqual([str(scenario) for scenario in result.scenarios], [str(scenario) for scenario in self.result.scenarios])
            self.assertEqual(str(result.validation), str(self.result.validation))
            ends = [message.position for topic in ("tuned/joint_states", "worst/tuned/joint_states")
                    for _, message, _ in list(bag.read_messages(topics=[topic]))[-1:]]
            self.assertNotEqual(*ends)
            ((_, description, _),) = bag.read_messages(topics=["worst/tuned/robot_description"])
            worst = self.result.scenarios[self.result.worst - 1]
            self.assertIn(repr(worst.values[0])[:10], description.data)
            self.assertIn(f'model="{worst.friction_law}"', description.data)
            ((_, nominal, _),) = bag.read_messages(topics=["tuned/robot_description"])
            self.assertIn('model="brown_mcphee"', nominal.data)

    def last_position(self, topic):
        with rosbag.Bag(self.result.bag) as bag:
            return {message.position for _, message, _ in bag.read_messages(topics=[topic])}

    def test_replay_plays_the_nominal_run_unless_it_is_asked_for_the_worst(self):
        played = {}
        for run, arguments in (("nominal", []), ("worst", ["run:=worst"])):
            launch = subprocess.Popen(["roslaunch", "mechanism_codesign", "replay.launch", f"bag:={self.result.bag}", "rviz:=false", *arguments])
            try:
                played[run] = {rospy.wait_for_message("tuned/joint_states", JointState, PATIENCE).position for _ in range(3)}
                played[run + " description"] = rospy.get_param("tuned/robot_description")
            finally:
                launch.terminate()
                launch.wait()
        self.assertLessEqual(played["nominal"], self.last_position("tuned/joint_states"))
        self.assertLessEqual(played["worst"], self.last_position("worst/tuned/joint_states"))
        self.assertNotEqual(played["nominal description"], played["worst description"])

    def test_searches_and_optima(self):
        with open(f"{SHARE}/config/slider_crank_haug.yaml", encoding="utf-8") as file:
            text = file.read().replace("relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-8", "relative_tolerance: 1.0e-5, absolute_tolerance: 1.0e-6")
        study = f"{self.folder}/study.yaml"
        with open(study, "w", encoding="utf-8") as file:
            file.write(text + "runs: {slow: {controllers: {crank_speed: {setpoint: -9.0}}}, fast: {weight: 3.0}}\nmultistart: {starts: 3, screen: 6}\n")
        self.start("optimization", "many", model="slider_crank_haug", study=study, output_directory=self.folder)
        client = actionlib.SimpleActionClient("/many/optimize", OptimizeAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)))
        numbers = set()
        client.send_goal(OptimizeGoal(), feedback_cb=lambda feedback: feedback.progress.evaluation and numbers.add(feedback.progress.search))
        self.assertTrue(client.wait_for_result(rospy.Duration(5 * PATIENCE)))
        result = client.get_result()
        self.assertTrue(result.success, result.message)
        self.assertEqual([(scenario.run, scenario.sample, scenario.weight) for scenario in result.scenarios], [("slow", 0, 0.25), ("fast", 0, 0.75)])
        self.assertEqual(len(result.searches), 3)
        self.assertTrue(numbers and numbers <= {1, 2, 3}, numbers)
        self.assertEqual(sum(optimum.found for optimum in result.optima), sum(search.optimum > 0 for search in result.searches))
        self.assertEqual(result.optima[0].objective, min(search.objective for search in result.searches))
        self.assertEqual(list(result.optima[0].values), list(result.tuned))
        self.assertEqual(result.screened - result.unusable, 6)
        for search in result.searches:
            self.assertEqual((len(search.start), len(search.end)), (5, 5))
            self.assertLessEqual(search.objective, search.start_objective)
            self.assertEqual(search.code, "success")
        with rosbag.Bag(result.bag) as bag:
            self.assertEqual(bag.get_message_count(["worst/tuned/joint_states"]), 101)


if __name__ == "__main__":
    rospy.init_node("ensemble_test")
    rostest.rosrun("mechanism_codesign", "ensemble", EnsembleTest)
