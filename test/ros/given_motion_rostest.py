#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A simulation with a given motion: the joint moves as the study says, its effort is what that takes, and commands on it are refused."""
import os
import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import state_of, values_of, wait_until  # noqa: E402
from robot_node import Robot  # noqa: E402

NAME = "/robot/simulation"


def of(frame, field, joint):
    return getattr(frame, field)[frame.name.index(joint)]


class GivenMotionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(paused=True)
        cls.effort = cls.robot.publisher(NAME + "/command/effort", JointState)

    def setUp(self):
        self.robot.restart([0.0, 0.2])
        self.robot.step()

    def test_the_joint_meets_its_way_point_and_a_command_below_it_changes_its_effort(self):
        in_effect = self.robot.send(self.effort, JointState(name=["swing"], effort=[2.0]))
        self.assertEqual((in_effect.joints, list(in_effect.efforts)), (["swing"], [2.0]))
        begin = self.robot.joints.messages[0].header.stamp
        frame = self.robot.step_until(0.5)
        self.assertAlmostEqual((frame.header.stamp - begin).to_sec(), 0.5, delta=1e-6)
        self.assertAlmostEqual(of(frame, "position", "travel"), 0.55, delta=1e-6)
        self.assertNotEqual(of(frame, "effort", "travel"), 0.0)
        pushed = of(frame, "position", "swing")
        self.robot.restart([0.0, 0.2])
        self.robot.step()
        self.robot.send(self.effort, JointState(name=["swing"], effort=[0.0]))
        free = self.robot.step_until(0.5)
        self.assertAlmostEqual(of(free, "position", "travel"), 0.55, delta=1e-6)
        self.assertGreater(abs(of(free, "position", "swing") - pushed), 1e-3)

    def test_an_effort_on_the_joint_is_refused_by_name(self):
        self.effort.publish(JointState(name=["travel"], effort=[5.0]))

        def is_told():
            values = values_of(state_of(NAME[1:], "warning"))
            return any("command_refused" in key and "travel" in value and "gives the motion of the joint" in value for key, value in values.items())

        wait_until(is_told, "the refusal is not on /diagnostics")
        self.assertEqual(self.robot.commands.last().joints, ["swing"])


if __name__ == "__main__":
    rospy.init_node("given_motion_test")
    rostest.rosrun("mechanism_codesign", "given_motion", GivenMotionTest)
