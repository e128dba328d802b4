#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Efforts, set-points and trajectories that a paused simulation is commanded, and commands that it refuses."""
import math
import os
import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import state_of, values_of, wait_until  # noqa: E402
from robot_node import Robot  # noqa: E402

NAME = "/robot/simulation"


def point(time, positions, velocities=()):
    return JointTrajectoryPoint(positions=positions, velocities=list(velocities), time_from_start=rospy.Duration(time))


class CommandsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(paused=True)
        cls.effort = cls.robot.publisher(NAME + "/command/effort", JointState)
        cls.efforts = cls.robot.publisher(NAME + "/command/efforts", Float64MultiArray)
        cls.trajectory = cls.robot.publisher(NAME + "/command/trajectory", JointTrajectory)
        cls.elbow = cls.robot.publisher("/robot/elbow_servo/command", Float64)

    def setUp(self):
        self.robot.restart([0.0, 0.3])
        self.robot.step()

    def setpoint(self, controller):
        state = self.robot.controller_states()
        return state.setpoint[state.name.index(controller)]

    def test_an_effort_by_name_adds_to_that_of_the_controllers_and_holds(self):
        before = self.robot.joints.last()
        in_effect = self.robot.send(self.effort, JointState(name=["elbow"], effort=[2.5]))
        self.assertEqual((in_effect.joints, list(in_effect.efforts)), (["shoulder", "elbow"], [0.0, 2.5]))
        wait_until(lambda: self.robot.joints.last() is not before, "a paused node shows what a command changes")
        # Computed torque demands the same acceleration as before: at this instant only the command makes a difference.
        behind = self.robot.joints.last()
        elbow = behind.name.index("elbow")
        self.assertAlmostEqual(behind.effort[elbow] - before.effort[elbow], 2.5, delta=1e-9)
        # The run goes on from its dense output, projected onto the constraints.
        for moved, still in zip(behind.position, before.position):
            self.assertAlmostEqual(moved, still, delta=1e-9)
        held = self.robot.step()
        self.assertGreater(held.position[elbow], before.position[elbow])

    def test_efforts_in_order(self):
        in_effect = self.robot.send(self.efforts, Float64MultiArray(data=[1.0, -2.0]))
        self.assertEqual(list(in_effect.efforts), [1.0, -2.0])

    def test_efforts_end_if_nobody_renews_them(self):
        begin = self.robot.send(self.efforts, Float64MultiArray(data=[1.0, -2.0]))
        for _ in range(5):
            self.robot.step()
        wait_until(lambda: self.robot.commands.last().header.stamp > begin.header.stamp, "efforts never end")
        end = self.robot.commands.last()
        self.assertEqual(list(end.efforts), [0.0, 0.0])
        self.assertAlmostEqual((end.header.stamp - begin.header.stamp).to_sec(), 0.05, delta=1e-6)
        warnings = values_of(state_of(NAME[1:], "warning"))
        self.assertTrue(any("command_timeout" in key for key in warnings), warnings)
        self.robot.send(self.efforts, Float64MultiArray(data=[1.0, 0.0]))

    def test_a_set_point_holds(self):
        in_effect = self.robot.send(self.elbow, Float64(0.75))
        self.assertEqual((in_effect.controllers, list(in_effect.setpoints)), (["elbow_servo"], [0.75]))
        self.robot.step_until(1.2)
        self.assertEqual(self.setpoint("elbow_servo"), 0.75)
        arm = self.robot.joints.last()
        self.assertAlmostEqual(arm.position[arm.name.index("elbow")], 0.75, delta=0.1)

    def test_a_trajectory_is_linear_without_and_cubic_with_velocities(self):
        start = self.setpoint("elbow_servo")
        now = (self.robot.joints.last().header.stamp - self.robot.joints.messages[0].header.stamp).to_sec()
        message = JointTrajectory(joint_names=["elbow"], points=[point(0.1, [0.5]), point(0.2, [0.5], [0.0]), point(0.4, [1.0], [0.0])])
        self.robot.send(self.trajectory, message)
        self.robot.step_until(now + 0.05)
        self.assertAlmostEqual(self.setpoint("elbow_servo"), 0.5 * (start + 0.5), delta=1e-6)
        self.robot.step_until(now + 0.25)
        # A quarter of the way: 3/16 - 2/64 of the rise.
        self.assertAlmostEqual(self.setpoint("elbow_servo"), 0.5 + 0.5 * (3.0 / 16.0 - 2.0 / 64.0), delta=1e-6)
        self.robot.step_until(now + 0.5)
        self.assertEqual(self.setpoint("elbow_servo"), 1.0)

    def test_an_empty_trajectory_holds_the_joints(self):
        self.robot.send(self.trajectory, JointTrajectory(joint_names=["shoulder", "elbow"], points=[point(0.3, [1.0, 1.0])]))
        for _ in range(10):
            self.robot.step()
        arm = self.robot.joints.last()
        in_effect = self.robot.send(self.trajectory, JointTrajectory())
        self.assertEqual(in_effect.controllers, ["shoulder_servo", "elbow_servo"])
        for joint, setpoint in zip(("shoulder", "elbow"), in_effect.setpoints):
            self.assertEqual(setpoint, arm.position[arm.name.index(joint)])

    def test_what_cannot_be_used_is_refused_by_name_and_the_run_goes_on(self):
        cases = [(self.effort, JointState(name=["elbo"], effort=[1.0]), ["command/effort", "elbo", 'did you mean "elbow"']),
                 (self.effort, JointState(name=["elbow"], effort=[math.nan]), ["command/effort", "elbow", "nan"]),
                 (self.efforts, Float64MultiArray(data=[1.0]), ["command/efforts", "wrong number"]),
                 (self.elbow, Float64(math.inf), ["elbow_servo/command", "inf"]),
                 (self.trajectory, JointTrajectory(joint_names=["wrist"], points=[point(1.0, [1.0])]), ["command/trajectory", "wrist"])]
        self.robot.send(self.effort, JointState(name=["shoulder"], effort=[0.5]))
        for publisher, message, parts in cases:
            publisher.publish(message)

            def is_told(parts=parts):
                values = values_of(state_of(NAME[1:], "warning"))
                return any("command_refused" in key and all(part in value for part in parts) for key, value in values.items())

            wait_until(is_told, f"{parts} is not on /diagnostics")
            rospy.sleep(1.1)  # a refusal of the same topic within a second is not told
        self.robot.step()
        self.assertEqual(list(self.robot.commands.last().efforts), [0.5, 0.0])


if __name__ == "__main__":
    rospy.init_node("commands_test")
    rostest.rosrun("mechanism_codesign", "commands", CommandsTest)
