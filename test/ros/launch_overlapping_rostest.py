#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Launch files that overlap may end in any order."""
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from launch_fixture import FAST, REAL_TIME, LaunchTestCase, parameters  # noqa: E402


class LaunchOverlappingTest(LaunchTestCase):
    def test_two_that_overlap_may_end_in_either_order(self):
        bag = self.bag()
        starts = {"fast": lambda: self.launch(*FAST), "real time": lambda: self.launch(*REAL_TIME), "replay": lambda: self.replay(bag)}
        for first, second in (("fast", "replay"), ("fast", "real time")):
            for is_first_to_end_first in (True, False):
                launches = [starts[first](), starts[second]()]
                # Commands of launch files run one after the other: parameters set by now belong to the second one.
                both = parameters()
                self.assertEqual(both["/use_sim_time"], second != "real time")
                if is_first_to_end_first:
                    self.end(launches[0])
                    self.assertEqual(rospy.get_param("/use_sim_time"), both["/use_sim_time"], "the second's stays as long as it runs")
                    if second != "replay":
                        self.assertEqual(rospy.get_param("/robot_description"), both["/robot_description"])
                        self.assertEqual(rospy.get_param("/simulation/mode"), both["/simulation/mode"])
                    self.end(launches[1])
                else:
                    self.end(launches[1])
                    self.assertEqual(rospy.get_param("/use_sim_time"), first != "real time", "the first's is back")
                    if second != "replay":
                        self.assertEqual(rospy.get_param("/robot_description") == "what was here", first == "replay")
                    self.end(launches[0])
                with self.subTest(first=first, second=second, is_first_to_end_first=is_first_to_end_first):
                    self.assert_left_as_found()

    def test_three_of_which_the_second_ends_first_and_two_at_once(self):
        bag = self.bag()
        launches = [self.launch(*FAST), self.replay(bag), self.launch(*REAL_TIME)]
        self.end(launches[1])
        self.end(launches[0], launches[2])
        self.assert_left_as_found()


if __name__ == "__main__":
    rospy.init_node("launch_overlapping_test")
    rostest.rosrun("mechanism_codesign", "launch_overlapping", LaunchOverlappingTest)
