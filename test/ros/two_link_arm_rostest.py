#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Controllers that follow way-points, as the simulation node publishes them; the node's own state."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from mechanism_codesign.msg import ControllerStates

TIMEOUT = 60.0


class TwoLinkArmTest(unittest.TestCase):
    def test_setpoints_move_and_are_followed(self):
        first = rospy.wait_for_message("controller_states", ControllerStates, TIMEOUT)
        self.assertEqual(first.name, ["shoulder_servo", "elbow_servo"])
        moved = False
        for _ in range(100):
            message = rospy.wait_for_message("controller_states", ControllerStates, TIMEOUT)
            moved = moved or message.setpoint[0] != first.setpoint[0]
            for setpoint, value, error in zip(message.setpoint, message.input, message.error):
                self.assertAlmostEqual(setpoint - value, error, delta=1e-12)
                self.assertLess(abs(error), 0.3)
        self.assertTrue(moved)

    def test_the_node_tells_what_it_does(self):
        status = rospy.wait_for_message("/diagnostics", DiagnosticArray, TIMEOUT).status[0]
        self.assertEqual(status.level, DiagnosticStatus.OK)
        self.assertIn("running two_link_arm", status.message)
        self.assertEqual({value.key: value.value for value in status.values}["robot"], "two_link_arm")


if __name__ == "__main__":
    rospy.init_node("two_link_arm_test")
    rostest.rosrun("mechanism_codesign", "two_link_arm", TwoLinkArmTest)
