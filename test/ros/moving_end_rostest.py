#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A run that ends by itself: the last frame of the simulation is its end, between two frames of the rate."""
import math
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import wait_until  # noqa: E402
from robot_node import Robot  # noqa: E402


class MovingEndTest(unittest.TestCase):
    def test_the_last_frame_is_the_end(self):
        robot = Robot(paused=True)

        def at_the_ground():
            frame = robot.joints.last()
            rise = frame.name.index("rise")
            return abs(frame.position[rise]) < 1e-7 and frame.velocity[rise] < 0.0

        self.assertFalse(at_the_ground())
        response = robot.call("resume")
        self.assertTrue(response.success, response.message)
        wait_until(at_the_ground, "the run does not end at the ground")
        # The frame before it is that of 0.43 s.
        end = 2.0 * 3.0 * math.sin(0.8) / 9.81
        before, last = (message.header.stamp for message in robot.joints.messages[-2:])
        self.assertAlmostEqual((last - before).to_sec(), end - 0.43, delta=1e-6)


if __name__ == "__main__":
    rospy.init_node("moving_end_test")
    rostest.rosrun("mechanism_codesign", "moving_end", MovingEndTest)
