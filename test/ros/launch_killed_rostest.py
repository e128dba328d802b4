#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Launch files that are interrupted or killed leave nothing on the master."""
import os
import signal
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from launch_fixture import FAST, LaunchTestCase, nodes_of, processes, records  # noqa: E402
from node_process import Launch, state_of, wait_until  # noqa: E402


class LaunchKilledTest(LaunchTestCase):
    def test_a_roslaunch_that_is_interrupted_while_it_starts(self):
        for ready in (records, lambda: rospy.get_param("/use_sim_time", False)):
            launch = Launch(*FAST)
            self.launches.append(launch)
            wait_until(ready, "no parameter is set")
            launch.end()
            wait_until(lambda: not records(), "nobody restores the parameters")
            self.assert_left_as_found()

    def test_a_killed_roslaunch_leaves_nothing_either(self):
        for ending in (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP):
            launch = self.launch(*FAST)
            state_of("simulation", "running")
            nodes = nodes_of(launch)
            launch.end(ending)
            wait_until(lambda: not records(), "nobody sees that roslaunch is gone")
            self.assert_left_as_found()
            wait_until(lambda: not any("/restore_parameters" in words for pid, words in processes() if pid in nodes), "a process waits for ever")
            self.end_orphans(nodes)

    def test_a_roslaunch_killed_with_its_nodes_is_put_right_by_the_next(self):
        launch = self.launch(*FAST)
        nodes = nodes_of(launch)
        watchers = [pid for pid, words in processes() if "watch" in words and f'"pid": {launch.process.pid},' in words]
        self.assertEqual(len(watchers), 1)
        for pid in [*watchers, launch.process.pid, *nodes]:
            os.kill(pid, signal.SIGKILL)
        launch.process.wait(20)
        self.assertEqual(len(records()), 1)
        self.assertTrue(rospy.get_param("/use_sim_time"))
        following = self.launch("optimize.launch", f"output_directory:={self.folder}")
        self.assertFalse(rospy.get_param("/use_sim_time"))
        self.end(following)
        self.assertIn("a roslaunch was killed: restored /use_sim_time", following.output())
        self.assert_left_as_found()

    def end_orphans(self, nodes):
        for pid in nodes:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        wait_until(lambda: not any(os.path.exists(f"/proc/{pid}/exe") for pid in nodes), "a node does not end")


if __name__ == "__main__":
    rospy.init_node("launch_killed_test")
    rostest.rosrun("mechanism_codesign", "launch_killed", LaunchKilledTest)
