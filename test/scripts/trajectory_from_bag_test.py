#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""scripts/trajectory_from_bag prints what a study takes as way-points."""
import os
import subprocess
import tempfile
import unittest

import genpy
import rosbag
import yaml
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "scripts", "trajectory_from_bag")


def point(seconds, positions, velocities=()):
    return JointTrajectoryPoint(time_from_start=genpy.Duration.from_sec(seconds), positions=positions, velocities=velocities)


class TrajectoryFromBag(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "moves.bag")
        whole = JointTrajectory(joint_names=["elbow", "shoulder"], points=[point(0.0, [1, 2], [3, 4]), point(0.5, [5, 6.25], [7, 8])])
        gaps = JointTrajectory(joint_names=["shoulder"], points=[point(0.0, [1], [0]), point(0.5, [2])])
        with rosbag.Bag(cls.path, "w") as bag:
            for topic, message in (("arm", whole), ("gaps", gaps), ("twice", gaps), ("twice", gaps), ("words", String("x"))):
                bag.write(topic, message, genpy.Time(1))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_script(self, *arguments):
        return subprocess.run([SCRIPT, *arguments], capture_output=True, text=True, check=False)

    def test_prints_waypoints(self):
        reply = self.run_script(self.path, "arm", "shoulder")
        self.assertEqual(reply.returncode, 0, reply.stderr)
        self.assertEqual(yaml.safe_load(reply.stdout),
                         {"type": "waypoints", "times": [0.0, 0.5], "positions": [2.0, 6.25], "velocities": [4.0, 8.0]})

    def test_leaves_out_what_some_points_lack(self):
        self.assertNotIn("velocities", yaml.safe_load(self.run_script(self.path, "gaps", "shoulder").stdout))

    def test_says_what_is_missing(self):
        for arguments, sentence in ((("arm", "wrist"), "0 trajectories"), (("twice", "shoulder"), "2 trajectories"), (("leg", "shoulder"), "no message"),
                                    (("words", "shoulder"), "std_msgs/String")):
            reply = self.run_script(self.path, *arguments)
            self.assertEqual(reply.returncode, 1)
            self.assertIn(sentence, reply.stderr)
        self.assertIn("lost.bag", self.run_script("lost.bag", "arm", "shoulder").stderr)
        self.assertIn("Usage", self.run_script().stderr)


if __name__ == "__main__":
    unittest.main()
