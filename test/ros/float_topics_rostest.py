#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Each number of a frame as a topic of its own, and PlotJuggler's layout, whose curves are such topics."""
import os
import sys
import unittest
import xml.etree.ElementTree

import rosgraph
import rospkg
import rospy
import rostest
from mechanism_codesign.msg import JointFriction
from std_msgs.msg import Float64

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, wait_until  # noqa: E402
from robot_node import Latest  # noqa: E402

LAYOUT = os.path.join(rospkg.RosPack().get_path("mechanism_codesign"), "plotjuggler", "slider_crank.xml")


def published():
    return dict(rosgraph.Master("/float_topics_test").getTopicTypes())


class FloatTopicsTest(unittest.TestCase):
    def test_the_topics_of_the_layout_exist(self):
        # The node makes them before its first frame.
        rospy.wait_for_message("/signals/crank_joint/position", Float64, PATIENCE)
        root = xml.etree.ElementTree.parse(LAYOUT).getroot()
        curves = [curve.get("name") for curve in root.iter("curve")]
        self.assertGreaterEqual(len(curves), 6)
        topics = published()
        for curve in curves:
            self.assertTrue(curve.endswith("/data"), curve)
            self.assertEqual(topics.get(curve[:-len("/data")]), "std_msgs/Float64", curve)
        selected = root.find("Plugins/plugin/selected_topics").get("list").split(";")
        self.assertEqual({curve[:-len("/data")] for curve in curves}, set(selected))

    def test_they_are_the_numbers_of_the_messages(self):
        numbers = Latest("/signals/slider_joint/friction", Float64)
        friction = Latest("/joint_friction", JointFriction)
        wait_until(lambda: len(numbers.messages) > 20 and len(friction.messages) > 20, "no numbers")
        wanted = [message.friction[0] for message in friction.messages[5:10]]
        wait_until(lambda: set(wanted) <= {message.data for message in numbers.messages}, f"{wanted} are not among the numbers")

    def test_every_number_of_joints_and_controllers_is_there(self):
        rospy.wait_for_message("/signals/crank_speed/output", Float64, PATIENCE)
        topics = published()
        for name in ("ball_joint_x/position", "crank_joint/velocity", "crank_joint/effort", "slider_joint/normal_force",
                     "slider_joint/sliding_velocity", "crank_speed/setpoint", "crank_speed/input", "crank_speed/error", "crank_speed/integral"):
            self.assertIn("/signals/" + name, topics)


if __name__ == "__main__":
    rospy.init_node("float_topics_test")
    rostest.rosrun("mechanism_codesign", "float_topics", FloatTopicsTest)
