#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""With bad input the nodes stay up, and services, action and diagnostics report the error."""
import os
import sys
import threading
import unittest

import rosnode
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from mechanism_codesign.srv import Evaluate, EvaluateRequest, Optimize, OptimizeRequest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, wait_until  # noqa: E402


class BadInputTest(unittest.TestCase):
    def wait_for_error(self, node):
        """The sentence of the first error that `node` reports on /diagnostics."""
        sentences, found = [], threading.Event()

        def receive(message):
            for status in message.status:
                if status.name.startswith(node) and status.level == DiagnosticStatus.ERROR:
                    sentences.append(status.message)
                    found.set()

        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, receive)
        self.assertTrue(found.wait(PATIENCE), f"{node} reports no error")
        subscriber.unregister()
        return sentences[0]

    def test_services_say_what_is_wrong(self):
        for name, service, request in (("optimize", Optimize, OptimizeRequest()), ("evaluate", Evaluate, EvaluateRequest())):
            rospy.wait_for_service(name, PATIENCE)
            reply = rospy.ServiceProxy(name, service)(request)
            self.assertFalse(reply.success)
            self.assertEqual(reply.code, "bad_input")
            self.assertIn("objektive", reply.message)
            self.assertIn("objective", reply.message.replace("objektive", ""), "the nearest key")

    def test_diagnostics_say_what_is_wrong(self):
        self.assertIn("objektive", self.wait_for_error("optimization"))
        self.assertIn("/nonexistent/robot.urdf", self.wait_for_error("simulation"))

    def test_nodes_are_up(self):
        self.wait_for_error("simulation")
        for node in ("/optimization", "/simulation"):
            wait_until(lambda node=node: rosnode.rosnode_ping(node, max_count=1), f"{node} does not answer")


if __name__ == "__main__":
    rospy.init_node("bad_input_test")
    rostest.rosrun("mechanism_codesign", "bad_input", BadInputTest)
