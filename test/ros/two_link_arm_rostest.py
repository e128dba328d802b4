#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Controllers that follow way-points, as the simulation node publishes them; the node's own state."""
import os
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from mechanism_codesign.msg import ControllerStates

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import state_of, values_of, wait_until  # noqa: E402
from robot_node import Latest  # noqa: E402


class TwoLinkArmTest(unittest.TestCase):
    def test_setpoints_move_and_are_followed(self):
        states = Latest("controller_states", ControllerStates)
        wait_until(lambda: len(states.messages) >= 100, "no states of the controllers")
        first = states.messages[0]
        self.assertEqual(first.name, ["shoulder_servo", "elbow_servo"])
        for message in states.messages[:100]:
            for setpoint, value, error in zip(message.setpoint, message.input, message.error):
                self.assertAlmostEqual(setpoint - value, error, delta=1e-12)
                self.assertLess(abs(error), 0.3)
        wait_until(lambda: states.last().setpoint[0] != first.setpoint[0], "the set-points stand still")

    def test_the_node_tells_what_it_does(self):
        status = state_of("simulation", "running two_link_arm")
        self.assertEqual(status.level, DiagnosticStatus.OK)
        self.assertEqual(values_of(status)["robot"], "two_link_arm")


if __name__ == "__main__":
    rospy.init_node("two_link_arm_test")
    rostest.rosrun("mechanism_codesign", "two_link_arm", TwoLinkArmTest)
