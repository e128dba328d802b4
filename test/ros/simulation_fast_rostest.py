#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The simulation node in the mode as_fast_as_possible: it publishes /clock, which starts at one second and never goes back."""
import os
import sys
import threading
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE  # noqa: E402


class SimulationFastTest(unittest.TestCase):
    def test_clock_advances_with_the_frames(self):
        clocks, full = [], threading.Event()

        def receive(message):
            clocks.append(message.clock.to_sec())
            if len(clocks) >= 500:
                full.set()

        rospy.Subscriber("/clock", Clock, receive)
        self.assertTrue(full.wait(PATIENCE))
        seen = list(clocks)
        self.assertGreaterEqual(seen[0], 1.0)
        self.assertTrue(all(a < b for a, b in zip(seen, seen[1:])))
        # The study lasts 2 s, sampled 50 times a second: several runs follow each other.
        self.assertGreater(seen[-1] - seen[0], 2.0)

    def test_stamps_are_those_of_the_clock(self):
        message = rospy.wait_for_message("joint_states", JointState, PATIENCE)
        frame = (message.header.stamp.to_sec() - 1.0) * 50.0
        self.assertAlmostEqual(frame, round(frame), delta=1e-4)


if __name__ == "__main__":
    rospy.init_node("simulation_fast_test")
    rostest.rosrun("mechanism_codesign", "simulation_fast", SimulationFastTest)
