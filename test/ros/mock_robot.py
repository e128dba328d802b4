#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A robot of tests: servers of dynamic_reconfigure as control_toolbox::Pid makes them, and joint states.

As a program it is one server that dies: mock_robot.py NAMESPACE REQUESTS ends after so many requests, without an answer to the last one.
"""
import os
import sys
import threading
import time
from types import SimpleNamespace

import rospy
from dynamic_reconfigure.server import Server
from sensor_msgs.msg import JointState

START = {"p": 1.0, "i": 0.0, "d": 0.5, "i_clamp_min": 0.0, "i_clamp_max": 0.0, "antiwindup": False, "publish_state": True}


def toolbox_type(largest):
    """What dynamic_reconfigure generates from control_toolbox's Parameters.cfg."""
    parameters = []
    for name, value in START.items():
        flag = isinstance(value, bool)
        parameters.append({"name": name, "type": "bool" if flag else "double", "default": value, "level": 1, "description": name, "edit_method": "",
                           "min": False if flag else -largest, "max": True if flag else largest})
    description = {"name": "Default", "type": "", "state": True, "cstate": "true", "id": 0, "parent": 0, "parent_name": "", "groups": [],
                   "parameters": parameters}
    by = {key: {p["name"]: p[key] for p in parameters} for key in ("min", "max", "level", "type", "default")}
    return SimpleNamespace(config_description=description, min=by["min"], max=by["max"], defaults=by["default"], level=by["level"], type=by["type"],
                           all_level=1)


class MockGains:
    """One server. `takes(values, number)` may change the values of a request, raise, or do anything else."""

    def __init__(self, name_space, largest=1000.0):
        self.requests = []  # the values of each
        self.takes = lambda values, number: values
        self.started = False
        self.server = Server(toolbox_type(largest), self.on_change, name_space)
        self.started = True

    def on_change(self, config, _level):
        if self.started:
            values = {name: config[name] for name in START}
            self.requests.append(values)
            config.update(self.takes(dict(values), len(self.requests)))
        return config

    def has(self):
        return {name: self.server.config[name] for name in START}


class MockJoints:
    """Joint states at 100 Hz, from a thread. `stamp`: of all messages, instead of the time less `lag`."""

    def __init__(self, names, topic="joint_states"):
        self.message = JointState(name=list(names), position=[0.1] * len(names), velocity=[0.0] * len(names), effort=[0.5] * len(names))
        self.publisher = rospy.Publisher(topic, JointState, queue_size=100)
        self.running, self.silent, self.lag, self.stamp = True, False, 0.0, None
        self.lock = threading.Lock()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def publish(self):
        with self.lock:
            self.message.header.stamp = self.stamp or rospy.Time.now() - rospy.Duration(self.lag)
            self.publisher.publish(self.message)

    def set_effort(self, joint, value):
        """Publishes the new value at once."""
        with self.lock:
            self.message.effort[self.message.name.index(joint)] = value
        self.publish()

    def run(self):
        while self.running and not rospy.is_shutdown():
            if not self.silent:
                self.publish()
            time.sleep(0.01)

    def end(self):
        self.running = False
        self.thread.join()
        self.publisher.unregister()


def main():
    name_space, last = sys.argv[1], int(sys.argv[2])
    rospy.init_node("mock_robot", anonymous=True)
    gains = MockGains(name_space)

    def die(values, number):
        if number == last:
            os._exit(1)  # pylint: disable=protected-access
        return values

    gains.takes = die
    rospy.spin()


if __name__ == "__main__":
    main()
