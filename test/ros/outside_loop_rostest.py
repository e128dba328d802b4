#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A loop at 100 Hz through another process: this one holds an arm with friction by a PID law.

In lock step the run waits for each command, so that neither the number of commands nor the motion depends on the speed of the machine.
"""
import os
import sys
import threading
import unittest

import rosbag
import rospy
import rostest
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import NodesTestCase, state_of, wait_until  # noqa: E402

TARGET = {"shoulder": 0.8, "elbow": 0.5}
P = {"shoulder": 80.0, "elbow": 30.0}
D = {"shoulder": 8.0, "elbow": 2.0}
INTEGRAL = 200.0


class Controller:
    """Answers each joint state with efforts that have its stamp."""

    def __init__(self, node):
        self.publisher = rospy.Publisher(f"/{node}/command/effort", JointState, queue_size=100, tcp_nodelay=True)
        self.lock, self.command, self.integral, self.laws = threading.Lock(), None, dict.fromkeys(TARGET, 0.0), {}
        self.subscriber = rospy.Subscriber("/joint_states", JointState, self.answer, queue_size=1000, tcp_nodelay=True)

    def answer(self, state):
        with self.lock:
            command = JointState(name=list(TARGET))
            command.header.stamp = state.header.stamp
            for joint in TARGET:
                k = state.name.index(joint)
                error = TARGET[joint] - state.position[k]
                self.integral[joint] += 0.01 * error
                command.effort.append(P[joint] * error + INTEGRAL * self.integral[joint] - D[joint] * state.velocity[k])
            self.command = command
            self.laws[round(100.0 * (state.header.stamp.to_sec() - 1.0))] = list(command.effort)
            self.publisher.publish(command)

    def insist(self):
        """Repeats the last answer: the first one is lost if the connection stands later than the first frame."""
        with self.lock:
            if self.command is not None:
                self.publisher.publish(self.command)

    def end(self):
        self.subscriber.unregister()
        self.publisher.unregister()


class OutsideLoopTest(NodesTestCase):
    def start_arm(self, name, **parameters):
        return self.start("simulation", name, model="two_link_arm", rate=100.0, lock_step=True, mode="as_fast_as_possible",
                          disconnect=["shoulder_servo", "elbow_servo"], wait_for_subscribers="joint_states", **parameters)

    def test_a_law_at_a_hundred_hertz_reaches_the_set_point_and_all_is_in_the_bag(self):
        path = os.path.join(self.folder, "loop.bag")
        controller = Controller("outside")
        self.start_arm("outside", duration=4.0, bag=path)

        def is_over():
            controller.insist()
            rospy.sleep(0.3)
            return os.path.exists(path)

        wait_until(is_over, "the run does not end")
        state_of("outside", "finished")
        controller.end()
        with rosbag.Bag(path) as bag:
            states = [message for _, message, _ in bag.read_messages("joint_states")]
            commands = {round(100.0 * (time.to_sec() - 1.0)): message for _, message, time in bag.read_messages("commands")}
            for topic in ("joint_friction", "controller_states", "tf", "robot_description"):
                self.assertGreater(bag.get_message_count(topic), 0, topic)
        self.assertEqual(len(states), 401)
        # One command for each frame but the last, from its very instant on, as this process computed it.
        self.assertEqual(sorted(commands), list(range(400)))
        self.assertEqual(commands[0].joints, ["shoulder", "elbow"])
        for number in (0, 1, 50, 150, 399):
            for mine, recorded, applied in zip(controller.laws[number], commands[number].efforts, states[number + 1].effort):
                self.assertAlmostEqual(mine, recorded, delta=1e-12)
                self.assertAlmostEqual(mine, applied, delta=1e-9)
        for joint, target in TARGET.items():
            k = states[-1].name.index(joint)
            self.assertAlmostEqual(states[-1].position[k], target, delta=0.03)
            self.assertAlmostEqual(states[-1].velocity[k], 0.0, delta=0.05)

    def test_without_an_answer_the_run_waits(self):
        states = []
        listener = rospy.Subscriber("/joint_states", JointState, states.append, queue_size=1000)
        self.start_arm("waiting", duration=1.0)
        wait_until(lambda: states, "no first frame")
        publisher = rospy.Publisher("/waiting/command/effort", JointState, queue_size=10)
        wait_until(lambda: publisher.get_num_connections() > 0, "the node does not listen")
        rospy.sleep(0.5)
        self.assertEqual(len(states), 1)
        early = JointState(name=["elbow"], effort=[1.0])
        early.header.stamp = states[0].header.stamp - rospy.Duration(0.005)
        publisher.publish(early)
        rospy.sleep(0.5)
        self.assertEqual(len(states), 1, "an answer to an earlier frame is none")
        publisher.publish(JointState(name=["elbow"], effort=[1.0]))
        wait_until(lambda: len(states) == 2, "a command without a stamp steps the run")
        rospy.sleep(0.5)
        self.assertEqual(len(states), 2)
        listener.unregister()


if __name__ == "__main__":
    rospy.init_node("outside_loop_test")
    rostest.rosrun("mechanism_codesign", "outside_loop", OutsideLoopTest)
