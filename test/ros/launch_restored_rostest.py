#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Launch files leave the parameters of the master as they found them, in whatever order they end."""
import json
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from launch_fixture import FAST, FOUND, LaunchTestCase, parameters  # noqa: E402
from node_process import state_of  # noqa: E402


class LaunchRestoredTest(LaunchTestCase):
    def test_each_alone(self):
        bag = self.bag()
        for arguments, node in ((FAST, "simulation"), (("optimize.launch", f"output_directory:={self.folder}"), "optimization"),
                                (("replay.launch", "rviz:=false", f"bag:={bag}"), None)):
            launch = self.launch(*arguments)
            if node:
                state_of(node, "running|ready")
            self.assertEqual(rospy.get_param("/use_sim_time"), arguments[0] != "optimize.launch")
            self.end(launch)
            self.assert_left_as_found()

    def test_a_master_that_has_nothing_gets_nothing(self):
        for name in FOUND:
            rospy.delete_param(name)
        self.before = parameters()
        first, second = self.launch(*FAST), self.launch("optimize.launch", f"output_directory:={self.folder}")
        self.end(first)
        self.end(second)
        self.assert_left_as_found()

    def test_a_record_of_another_kind_is_left_alone(self):
        for name, text in (("a", "no JSON"), ("b", json.dumps({"time": 1.0})), ("c", 5)):
            rospy.set_param(f"/{name}/before_launch", text)
        self.before = parameters()
        launch = self.launch("optimize.launch", f"output_directory:={self.folder}")
        self.end(launch)
        self.assert_left_as_found()


if __name__ == "__main__":
    rospy.init_node("launch_restored_test")
    rostest.rosrun("mechanism_codesign", "launch_restored", LaunchRestoredTest)
