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
from mechanism_codesign.msg import Commands
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import NodesTestCase, state_of, values_of, wait_until  # noqa: E402
from robot_node import Latest  # noqa: E402

TARGET = {"shoulder": 0.8, "elbow": 0.5}
P = {"shoulder": 80.0, "elbow": 30.0}
D = {"shoulder": 8.0, "elbow": 2.0}
INTEGRAL = 200.0


class Controller:
    """Answers each joint state with efforts that have its stamp."""

    def __init__(self, node):
        self.subscriber = None
        self.publisher = rospy.Publisher(f"/{node}/command/effort", JointState, queue_size=100, tcp_nodelay=True)
        self.lock, self.integral, self.laws = threading.Lock(), dict.fromkeys(TARGET, 0.0), {}

    def listen(self):
        """Once the node takes commands: it waits for the first answer, which must not be lost."""
        wait_until(lambda: self.publisher.get_num_connections() > 0, "the node does not listen")
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
            self.laws[round(100.0 * (state.header.stamp.to_sec() - 1.0))] = list(command.effort)
            self.publisher.publish(command)

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
        controller.listen()
        wait_until(lambda: os.path.exists(path), "the run does not end")
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
        joints, commands = Latest("/joint_states", JointState), Latest("/commands", Commands)
        states = joints.messages
        self.start_arm("waiting", duration=1.0)
        publisher = rospy.Publisher("/waiting/command/effort", JointState, queue_size=10)
        wait_until(lambda: publisher.get_num_connections() > 0, "the node does not listen")
        wait_until(lambda: states and commands.messages, "no first frame")
        self.assertEqual(values_of(state_of("waiting", "running"))["waits for"], "a command")

        def command(effort, stamp):
            """Sends it, and returns the stamp of the frame at which it takes effect: that at which the run waits."""
            message = JointState(name=["elbow"], effort=[effort])
            message.header.stamp = stamp
            publisher.publish(message)
            wait_until(lambda: effort in commands.last().efforts, f"{effort} has no effect")
            return commands.last().header.stamp

        first = states[0].header.stamp
        self.assertEqual(command(1.0, first - rospy.Duration(0.005)), first, "the run has waited for it")
        self.assertEqual(command(2.0, rospy.Time()), first, "an answer to an earlier frame is none")
        wait_until(lambda: len(states) == 2, "a command without a stamp steps the run")
        self.assertEqual(command(3.0, first), states[1].header.stamp, "by one frame")
        joints.subscriber.unregister()
        commands.subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("outside_loop_test")
    rostest.rosrun("mechanism_codesign", "outside_loop", OutsideLoopTest)
