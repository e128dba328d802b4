#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The client of doc/ros_api.md that stands in for FollowJointTrajectory drives the arm to its last point, and says so if it does not get there."""
import os
import re
import subprocess
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, SHARE, wait_until  # noqa: E402
from robot_node import Robot  # noqa: E402


class FollowTrajectoryTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot()
        with open(f"{SHARE}/doc/ros_api.md", encoding="utf-8") as page:
            section = page.read().partition("#### What stands in for ros_control")[2]
        cls.client = re.search(r"```python\n(.*?)```", section, re.DOTALL).group(1)

    def run_client(self, text):
        done = subprocess.run([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True, check=True, timeout=PATIENCE, env={**os.environ, "ROS_NAMESPACE": "/robot"})
        return done.stdout

    def test_it_reaches_the_last_point(self):
        self.assertRegex(self.run_client(self.client), "^succeeded 0.0")
        target = {"shoulder": 1.0, "elbow": 0.4}

        def is_there():
            state = self.robot.joints.last()
            return all(abs(state.position[state.name.index(joint)] - position) < 0.1 for joint, position in target.items())

        wait_until(is_there, "the arm is elsewhere")

    def test_a_joint_that_does_not_get_there_is_told(self):
        text = self.client
        # It is asked for 0.1 s after its begin.
        for old, new in (("(2.0, [1.0, 0.4])", "(2.0, [1.0, 2.0])"), ("patience=1.0", "patience=-1.9")):
            self.assertEqual(text.count(old), 1)
            text = text.replace(old, new)
        self.assertRegex(self.run_client(text), "^goal tolerance violated")


if __name__ == "__main__":
    rospy.init_node("follow_trajectory_test")
    rostest.rosrun("mechanism_codesign", "follow_trajectory", FollowTrajectoryTest)
