#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Pause, resume, step and restart of the simulation node in real time, and its real-time factor."""
import os
import re
import sys
import unittest

import rospy
import rostest
from mechanism_codesign.msg import JointFriction
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import TIMEOUT, state_of, wait_until  # noqa: E402
from robot_node import Latest, Robot, settled  # noqa: E402


def time_in(message):
    return float(re.search(r"t = ([0-9.e-]+) s", message).group(1))


class RunControlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot()
        cls.factor = Latest("/robot/simulation/real_time_factor", Float64)

    def test_pause_step_and_resume(self):
        self.assertTrue(self.robot.call("restart").success)
        rospy.sleep(0.2)
        paused = self.robot.call("pause")
        self.assertTrue(paused.success)
        frames = settled(self.robot.joints.messages)
        rospy.sleep(0.3)
        self.assertEqual(len(self.robot.joints.messages), frames, "a paused run stands still")
        first, second = self.robot.call("step"), self.robot.call("step")
        self.assertTrue(first.success and second.success, second.message)
        self.assertAlmostEqual(time_in(second.message) - time_in(first.message), 2 / 50.0, delta=1e-9)
        self.assertAlmostEqual(time_in(first.message) - time_in(paused.message), 2 / 50.0, delta=1e-9, msg="a pause names the last frame")
        wait_until(lambda: len(self.robot.joints.messages) >= frames + 4, "two steps of two frames")
        self.assertEqual(settled(self.robot.joints.messages), frames + 4)
        self.assertTrue(self.robot.call("resume").success)
        wait_until(lambda: len(self.robot.joints.messages) > frames + 6, "a resumed run goes on")
        # Stamps are of the present: a resumed run does not hurry to make up for its pause.
        self.assertLess(abs((rospy.Time.now() - self.robot.joints.last().header.stamp).to_sec()), 20.0)
        self.assertFalse(self.robot.call("step").success, "a run that is not paused takes no steps")

    def test_the_run_ends_and_restarts(self):
        self.robot.call("restart")
        self.robot.call("resume")
        state_of("robot/simulation", "finished slider_crank")
        answer = self.robot.call("step")
        self.assertFalse(answer.success)
        self.assertIn("finished", answer.message)
        frames = len(self.robot.joints.messages)
        self.assertTrue(self.robot.call("restart").success)
        wait_until(lambda: len(self.robot.joints.messages) > frames, "a restarted run publishes")
        first = self.robot.joints.messages[frames]
        self.assertAlmostEqual(first.position[0], 0.0, delta=1e-9)
        self.assertAlmostEqual(first.velocity[0], -10.0, delta=1e-9)
        self.assertTrue(rospy.wait_for_message("/robot/joint_friction", JointFriction, TIMEOUT).name)

    def test_the_real_time_factor_is_published(self):
        self.robot.call("restart")
        wait_until(lambda: self.factor.messages, "no real-time factor")
        self.assertGreater(self.factor.last().data, 0.0)
        self.assertLess(self.factor.last().data, 3.0)

    def test_with_bad_input_the_services_say_so(self):
        for service in ("pause", "resume", "step", "restart"):
            rospy.wait_for_service(f"/robot/no_model/{service}", TIMEOUT)
            answer = rospy.ServiceProxy(f"/robot/no_model/{service}", Trigger)()
            self.assertFalse(answer.success)
            self.assertIn("/nonexistent/robot.urdf", answer.message)


if __name__ == "__main__":
    rospy.init_node("run_control_test")
    rostest.rosrun("mechanism_codesign", "run_control", RunControlTest)
