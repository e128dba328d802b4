#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What users get from a launch file that runs: every frame for a recorder, warnings, a result taken back."""
import json
import os
import signal
import subprocess
import sys

import rosbag
import rosgraph
import rospy
import rostest
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from launch_fixture import LaunchTestCase  # noqa: E402
from node_process import PATIENCE, state_of, values_of, wait_until  # noqa: E402


class LaunchRunsTest(LaunchTestCase):
    def test_a_recorder_gets_every_frame_beside_robot_state_publisher(self):
        # rosbag record has queues of 100 messages, and no time to empty them on a busy machine.
        self.launch("simulate.launch", "rviz:=false", "mode:=as_fast_as_possible", "loop:=false", "duration:=1.9", "wait_for_subscribers:=joint_states")
        state_of("simulation", "waiting for subscribers of joint_states")
        wait_until(lambda: any(topic == "/joint_states" for topic, _ in rosgraph.Master("/test").getSystemState()[1]), "no robot_state_publisher")
        for _ in range(3):  # the node tells it once a second, and waits half a second for further subscribers
            state_of("simulation", "waiting for subscribers of joint_states")
        path = f"{self.folder}/recorded.bag"
        recorder = subprocess.Popen(["rosbag", "record", "-q", "--limit=96", "-O", path, "/clock", "joint_states", "caption", "__name:=recorder"])
        try:
            state_of("simulation", "finished slider_crank")
            self.assertEqual(recorder.wait(PATIENCE), 0, "it ends when it has so many messages of each topic")
        finally:
            if recorder.poll() is None:
                recorder.send_signal(signal.SIGINT)
            recorder.wait(PATIENCE)
        with rosbag.Bag(path) as bag:
            self.assertEqual(bag.get_message_count("joint_states"), 96, "1.9 s at 50 frames per second")
            self.assertEqual(bag.get_message_count("caption"), 96)
            self.assertGreaterEqual(bag.get_message_count("/clock"), 96)

    def test_joints_beyond_their_limits_are_told(self):
        launch = self.launch("simulate.launch", "rviz:=false", "case:=gantry", "loop:=false")
        values = values_of(state_of("simulation", "finished gantry .*warning"))
        self.assertIn("exceeds its upper limit 2 from t =", values["travel beyond its upper limit"])
        self.end(launch)
        self.assertEqual(launch.output().count("exceeds its upper limit"), 1, "once in the log")

    def test_a_result_is_taken_back(self):
        with open(f"{self.folder}/result.json", "w", encoding="utf-8") as file:
            json.dump({"parameters": {"crank_length": 0.0725, "Kp": 2.0}}, file)
        launch = self.launch("simulate.launch", "rviz:=false", "result:=result.json", "set:={Kp: 3.0}", "loop:=true", cwd=self.folder)
        state_of("simulation", "slider_crank")
        self.assertIn('name="crank_length" value="0.0725"', rospy.get_param("/robot_description"))
        self.assertEqual(rospy.get_param("/simulation/result"), f"{self.folder}/result.json")
        description = rospy.wait_for_message("robot_description", String, PATIENCE).data
        self.assertIn('name="crank_length" value="0.0725"', description)
        self.end(launch)


if __name__ == "__main__":
    rospy.init_node("launch_runs_test")
    rostest.rosrun("mechanism_codesign", "launch_runs", LaunchRunsTest)
