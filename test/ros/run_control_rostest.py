#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Pause, resume, step and restart of the simulation node in real time, and its real-time factor."""
import os
import sys
import unittest

import rospy
import rostest
from mechanism_codesign.msg import JointFriction
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, state_of, values_of, wait_until  # noqa: E402
from robot_node import Latest, Robot, time_in  # noqa: E402

# Of the crank.
START = ([0.0], [-10.0])


class RunControlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot()
        cls.factor = Latest("/robot/simulation/real_time_factor", Float64)

    def test_pause_step_and_resume(self):
        self.robot.restart(*START)
        wait_until(lambda: len(self.robot.joints.messages) > 5, "the run goes on")
        paused = self.robot.call("pause")
        self.assertTrue(paused.success)
        last = self.robot.wait_for_frame(paused.message)
        self.assertAlmostEqual(self.robot.elapsed(last), time_in(paused.message), delta=1e-4, msg="a pause names the last frame")
        frames = self.robot.joints.messages.index(last) + 1
        state_of("robot/simulation", "running")
        # Each tells the time of the run behind it: the run has moved by the two frames of a step and, standing still meanwhile, by no other.
        first, second = self.robot.call("step"), self.robot.call("step")
        self.assertTrue(first.success and second.success, second.message)
        self.assertAlmostEqual(time_in(first.message) - time_in(paused.message), 2 / 50.0, delta=1e-9)
        self.assertAlmostEqual(time_in(second.message) - time_in(first.message), 2 / 50.0, delta=1e-9)
        wait_until(lambda: len(self.robot.joints.messages) >= frames + 4, "two steps of two frames")
        # Answered once the run stands again. The pause is longer than a frame.
        self.assertEqual(time_in(self.robot.call("pause").message), time_in(second.message))
        rospy.sleep(0.1)
        before = rospy.Time.now()
        resumed = self.robot.call("resume")
        self.assertTrue(resumed.success)
        self.assertEqual(time_in(resumed.message), time_in(second.message))
        wait_until(lambda: len(self.robot.joints.messages) > frames + 6, "a resumed run goes on")
        self.assertGreater(self.robot.joints.messages[frames + 4].header.stamp, before, "a resumed run does not hurry to make up for its pause")
        self.assertFalse(self.robot.call("step").success, "a run that is not paused takes no steps")

    def test_the_state_tells_the_time_after_a_step(self):
        self.robot.restart(*START)
        self.assertTrue(self.robot.call("pause").success)
        # The second one comes before the real-time factor, with which the time is told of a run that goes on.
        self.robot.call("step")
        answer = self.robot.call("step")
        self.assertTrue(answer.success, answer.message)
        wait_until(lambda: abs(float(values_of(state_of("robot/simulation", "running"))["time of the run"]) - time_in(answer.message)) < 1e-6,
                   "the state does not tell the time after a step")
        self.robot.call("resume")

    def test_the_run_ends_and_restarts(self):
        friction = Latest("/brief/joint_friction", JointFriction)
        brief = Robot("/brief", paused=True)
        brief.call("resume")
        state_of("brief/simulation", "finished slider_crank")
        answer = brief.call("step")
        self.assertFalse(answer.success)
        self.assertIn("finished", answer.message)
        brief.restart(*START)
        state_of("brief/simulation", "finished slider_crank")
        wait_until(lambda: friction.messages and friction.last().name, "a restarted run has no friction")

    def test_the_real_time_factor_is_published(self):
        self.robot.restart(*START)
        wait_until(lambda: self.factor.messages, "no real-time factor")
        self.assertGreater(self.factor.last().data, 0.0)

    def test_with_bad_input_the_services_say_so(self):
        for service in ("pause", "resume", "step", "restart"):
            rospy.wait_for_service(f"/robot/no_model/{service}", PATIENCE)
            answer = rospy.ServiceProxy(f"/robot/no_model/{service}", Trigger)()
            self.assertFalse(answer.success)
            self.assertIn("/nonexistent/robot.urdf", answer.message)


if __name__ == "__main__":
    rospy.init_node("run_control_test")
    rostest.rosrun("mechanism_codesign", "run_control", RunControlTest)
