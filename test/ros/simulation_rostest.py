#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The simulation node in scaled time, together with robot_state_publisher."""
import math
import os
import sys
import threading
import unittest

import rospy
import rostest
import tf2_ros
from mechanism_codesign.msg import ControllerStates, JointFriction, LoopErrors, Signals
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE  # noqa: E402


def collect(topic, kind, count):
    """`count` successive messages of one topic."""
    messages, full = [], threading.Event()

    def receive(message):
        messages.append(message)
        if len(messages) >= count:
            full.set()

    subscriber = rospy.Subscriber(topic, kind, receive, queue_size=100)
    assert full.wait(PATIENCE), f"{topic}: {len(messages)} of {count} messages"
    subscriber.unregister()
    return messages


class SimulationTest(unittest.TestCase):
    def test_every_joint_of_the_tree_is_published_at_the_rate_asked_for(self):
        messages = collect("joint_states", JointState, 20)
        self.assertGreaterEqual(len(messages), 20)
        self.assertEqual(messages[0].name, ["crank_joint", "ball_joint_x", "ball_joint_y", "ball_joint_z", "slider_joint"])
        steps = [(b.header.stamp - a.header.stamp).to_sec() for a, b in zip(messages, messages[1:])]
        # 40 frames per second of the run at twice real time; where a run starts again the step differs. A busy machine may lose frames.
        regular = [step for step in steps if abs(80.0 * step - max(1, round(80.0 * step))) < 1e-4]
        self.assertGreaterEqual(len(regular), len(steps) - 1)
        self.assertAlmostEqual(min(regular), 1.0 / 80.0, delta=1e-6)
        position = messages[0].name.index("crank_joint")
        self.assertNotEqual(messages[0].position[position], messages[1].position[position])

    def test_friction_controllers_loops_and_markers(self):
        friction = rospy.wait_for_message("joint_friction", JointFriction, PATIENCE)
        self.assertEqual(friction.name, ["slider_joint"])
        self.assertEqual(list(friction.is_torque), [False])
        self.assertGreater(friction.normal_force[0], 0.0)
        self.assertLessEqual(abs(friction.friction[0]), 0.4 * friction.normal_force[0] * 1.001)
        controllers = rospy.wait_for_message("controller_states", ControllerStates, PATIENCE)
        self.assertEqual(controllers.name, ["crank_speed"])
        self.assertAlmostEqual(controllers.error[0], controllers.setpoint[0] - controllers.input[0], delta=1e-12)
        loops = rospy.wait_for_message("loop_errors", LoopErrors, PATIENCE)
        self.assertEqual(loops.name, ["slider_pin"])
        self.assertLess(loops.error[0], 1e-6)
        signals = rospy.wait_for_message("signals", Signals, PATIENCE)
        self.assertEqual(signals.name, ["crank_joint/velocity", "crank_speed/output"])
        markers = rospy.wait_for_message("friction_markers", MarkerArray, PATIENCE)
        self.assertEqual([marker.ns for marker in markers.markers], ["slider_joint"])

    def test_robot_state_publisher_closes_the_loop(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        pin = buffer.lookup_transform("slider", "rod", rospy.Time(0), rospy.Duration(PATIENCE)).transform
        listener.unregister()
        # The rod's far end, 0.3 m along its x, is the slider's centre, wherever the mechanism stands.
        r = pin.rotation
        axis = (1 - 2 * (r.y**2 + r.z**2), 2 * (r.x * r.y + r.w * r.z), 2 * (r.x * r.z - r.w * r.y))
        end = [p + 0.3 * a for p, a in zip((pin.translation.x, pin.translation.y, pin.translation.z), axis)]
        self.assertLess(math.dist(end, (0.0, 0.0, 0.0)), 1e-6)

    def test_the_world_is_at_the_root(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        transform = buffer.lookup_transform("world", "ground", rospy.Time(0), rospy.Duration(PATIENCE)).transform
        listener.unregister()
        self.assertEqual((transform.translation.x, transform.rotation.w), (0.0, 1.0))


if __name__ == "__main__":
    rospy.init_node("simulation_test")
    rostest.rosrun("mechanism_codesign", "simulation", SimulationTest)
