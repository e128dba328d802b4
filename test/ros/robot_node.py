# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A simulation node in a namespace of its own, driven by commands as a robot is."""
import re

import rospy
from mechanism_codesign.msg import Commands, ControllerStates
from node_process import PATIENCE, wait_for_topic, wait_until
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger


class Latest:
    """The last message of a topic, and all of them."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=1000, tcp_nodelay=True)

    def last(self):
        return self.messages[-1]


def time_in(answer):
    """The time of the run [s] that an answer of ~pause, ~step or ~resume names."""
    return float(re.search(r"t = ([0-9.e-]+) s", answer).group(1))


class Robot:
    """The commands and answers of one node. `robot`: its namespace, `node`: its name, `paused`: whether it was started so, with one frame long gone."""

    def __init__(self, robot="/robot", node="simulation", paused=False):
        self.robot, self.node = robot, f"{robot}/{node}"
        self.joints = Latest(f"{robot}/joint_states", JointState)
        self.controllers = Latest(f"{robot}/controller_states", ControllerStates)
        self.commands = Latest(f"{robot}/commands", Commands)
        for each in (self.joints, self.controllers):
            wait_for_topic(self.node, each.subscriber)
        if paused:
            response = self.call("step")
            assert response.success, response.message
        wait_until(lambda: self.joints.messages and self.controllers.messages and self.commands.messages, "the node publishes no frames")

    def publisher(self, topic, kind):
        """A publisher to which the node has connected."""
        publisher = rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True)
        wait_until(lambda: publisher.get_num_connections() > 0, f"nobody listens to {topic}")
        return publisher

    def call(self, service):
        rospy.wait_for_service(f"{self.node}/{service}", PATIENCE)
        return rospy.ServiceProxy(f"{self.node}/{service}", Trigger)()

    def send(self, publisher, message):
        """Publishes a command to the paused node and returns what is then in effect."""
        before, now = len(self.commands.messages), self.joints.last().header.stamp

        def in_effect():
            # A message about an earlier frame may still be on its way.
            return [each for each in self.commands.messages[before:] if each.header.stamp >= now]

        publisher.publish(message)
        wait_until(in_effect, f"the command has no effect: {message}")
        return in_effect()[-1]

    def step(self):
        """One ~step of one frame, and the joints behind it."""
        before = self.joints.last().header.stamp
        response = self.call("step")
        assert response.success, response.message
        wait_until(lambda: self.joints.last().header.stamp > before, "a step without a frame")
        return self.joints.last()

    def controller_states(self):
        """Those of the last frame of the joints, on another topic, whose message may come later."""
        stamp = self.joints.last().header.stamp
        wait_until(lambda: self.controllers.last().header.stamp >= stamp, "no states of the controllers")
        return self.controllers.last()

    def restart(self, positions, velocities=None):
        """~restart, with the messages of the run before forgotten. `positions`, `velocities`: of the first joints at the start; by default all rest."""
        before = len(self.joints.messages)
        response = self.call("restart")
        assert response.success, response.message

        def starts():
            return [k for k, frame in enumerate(self.joints.messages) if k >= before and
                    all(abs(a - b) < 1e-9 for a, b in zip(frame.position, positions)) and
                    (all(abs(a - b) < 1e-9 for a, b in zip(frame.velocity, velocities)) if velocities else not any(frame.velocity))]

        wait_until(starts, "a new run begins where the study says")
        del self.joints.messages[:starts()[-1]]

    def elapsed(self, frame):
        """From the first frame [s] by the stamps, which follow the time of the run as long as it is not paused."""
        return (frame.header.stamp - self.joints.messages[0].header.stamp).to_sec()

    def wait_for_frame(self, answer):
        """The frame whose time an answer names, as long as the run has not been resumed since restart()."""
        wait_until(lambda: self.elapsed(self.joints.last()) > time_in(answer) - 1e-4, f"the frame does not come: {answer}")
        return self.joints.last()

    def step_until(self, time):
        """Steps until the stamp of a frame, counted from the first one, is `time` [s] or later; a free clock runs with the run."""
        while self.elapsed(self.joints.last()) < time - 1e-6:
            self.step()
        return self.joints.last()
