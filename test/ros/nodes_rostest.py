#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Nodes started by hand: their parameters, their output about mechanism and runs, and their files."""
import os
import signal
import subprocess
import sys

import rosbag
import rospy
import rostest
import tf2_ros
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, SHARE, Launch, NodesTestCase, files, state_of, values_of, wait_until  # noqa: E402


class NodesTest(NodesTestCase):
    def test_parameters_that_cannot_be_read_are_errors_that_show_the_value(self):
        cases = {"rate": "fast", "time_scale": -2.0, "loop": "yes", "world_frame": 3, "mode": 7, "set": "crank_length", "overlays": 1.5, "bag": True,
                 "wait_for_subscribers": "joint_state", "frame_prefix": "/left"}
        for key, value in cases.items():
            node = self.start("simulation", f"bad_{key}", **{key: value})
            sentence = state_of(f"bad_{key}", "bad input").message
            self.assertIn(f"/bad_{key}/{key}", sentence)
            self.assertIn(str(value).lower() if isinstance(value, bool) else str(value).rstrip("0").rstrip("."), sentence)
            node.end()
        node = self.start("optimization", "bad_directory", output_directory=12)
        self.assertIn("12", state_of("bad_directory", "bad input").message)

    def test_runs_that_ros_cannot_count_are_bad_input(self):
        study = os.path.join(self.folder, "long.yaml")
        with open(f"{SHARE}/config/slider_crank.yaml", encoding="utf-8") as file:
            text = file.read()
        with open(study, "w", encoding="utf-8") as file:
            file.write(text.replace("duration: 2.0", "duration: 5.0e+9"))
        for name, parameters in {"scale": {"time_scale": 1e-12}, "duration": {"study": study},
                                 "fast": {"study": study, "mode": "as_fast_as_possible"}}.items():
            self.start("simulation", f"endless_{name}", **parameters)
            self.assertIn("longer than ROS time can represent", state_of(f"endless_{name}", "bad input").message)
        self.start("optimization", "too_many", output_directory=self.folder, rate=1e10)
        self.assertIn("too many samples", state_of("too_many", "bad input").message)
        for node in self.nodes:
            self.assertIsNone(node.process.poll())
            node.end()

    def test_a_node_at_a_high_rate_ends_when_it_is_told(self):
        """Its run would take weeks."""
        for program, parameters in (("simulation", {"rate": 1e6, "duration": 1e6}), ("optimization", {"rate": 1e4, "output_directory": self.folder})):
            node = self.start(program, "eager", **parameters)
            state_of("eager", "running" if program == "simulation" else "ready")
            node.end()

    def test_unknown_parameters_are_warnings_with_the_nearest_name(self):
        self.start("simulation", "misspelt", rat=10.0, start_paused=True)
        status = state_of("misspelt", "running")
        self.assertEqual(status.level, 1)
        (warning,) = [value for key, value in values_of(status).items() if key.endswith("unknown_parameter")]
        self.assertIn('/misspelt/rat', warning)
        self.assertIn('did you mean "rate"?', warning)

    def test_help_and_arguments(self):
        for program in ("simulation", "optimization"):
            path = self.start(program, "helped").process.args[0]
            reply = subprocess.run([path, "--help"], stdout=subprocess.PIPE, text=True, check=True)
            self.assertIn("~overlays", reply.stdout)
            self.assertEqual(subprocess.run([path, "study.yaml"], stderr=subprocess.DEVNULL, check=False).returncode, 2)

    def test_as_fast_as_possible_every_frame_reaches_rosbag_record_and_the_own_bag(self):
        before = rospy.get_param("/use_sim_time", None)
        rospy.set_param("/use_sim_time", True)
        recorded, own = f"{self.folder}/recorded.bag", f"{self.folder}/own.bag"
        # rosbag record has queues of 100 messages, and no time to empty them on a busy machine.
        node = self.start("simulation", "fast", mode="as_fast_as_possible", rate=500.0, duration=0.19, bag=own,
                          wait_for_subscribers=["joint_states", "loop_errors", "controller_states"])
        # It ends by itself when it has so many messages of each topic.
        record = subprocess.Popen(["rosbag", "record", "--limit=96", "-O", recorded, "joint_states", "loop_errors", "controller_states", "/clock"])
        try:
            status = state_of("fast", "finished")
            self.assertEqual(record.wait(PATIENCE), 0)
        finally:
            if record.poll() is None:
                record.send_signal(signal.SIGINT)
            record.wait(PATIENCE)
            rospy.delete_param("/use_sim_time")
            if before is not None:
                rospy.set_param("/use_sim_time", before)
        self.assertGreater(float(values_of(status)["real-time factor of the run"]), 0.0)
        self.assertEqual(values_of(status)["bag"], own)
        self.assertGreater(float(values_of(status)["constraint drift"]), 0.0)
        self.assertLess(float(values_of(status)["energy error"]), 1e-4)
        node.end()
        for path, topics in ((recorded, ("joint_states", "loop_errors")), (own, ("joint_states", "joint_friction", "loop_errors", "tf"))):
            with rosbag.Bag(path) as bag:
                for topic in topics:
                    names = [topic, "/" + topic]
                    stamps = [(m.transforms[0] if topic == "tf" else m).header.stamp.to_sec() for _, m, _ in bag.read_messages(topics=names)]
                    self.assertEqual(len(stamps), 96, f"{path} {topic}")
                    self.assertTrue(all(abs(b - a - 0.002) < 1e-6 for a, b in zip(stamps, stamps[1:])), topic)
        with rosbag.Bag(own) as bag:
            (_, version, _), = bag.read_messages(topics=["version"])
        self.assertRegex(version.data, r"^\d+\.\d+\.\d+$")

    def test_the_bag_of_a_killed_node_is_removed_by_the_next_one(self):
        path = f"{self.folder}/run.bag"
        killed = self.start("simulation", "recorded", bag=path, start_paused=True)
        wait_until(lambda: files(self.folder, ".active"), "no bag is begun")
        state_of("recorded", "running")
        beside = self.start("simulation", "beside", bag=path, start_paused=True)
        self.assertTrue(any("output_failed" in key for key in values_of(state_of("beside", "running .*warning"))))
        self.assertEqual(files(self.folder, ".active"), [path + ".active"], "a bag that is being written stays")
        beside.end()
        killed.end(signal.SIGKILL)
        self.assertEqual(sorted(os.listdir(self.folder)), ["run.bag.active", "run.bag.job"])
        following = self.start("simulation", "recorded", bag=path, time_scale=10.0)
        self.assertEqual(values_of(state_of("recorded", "finished"))["bag"], path)
        self.assertEqual(os.listdir(self.folder), ["run.bag"])
        following.end()
        self.assertIn(f"a node was killed: removed {path}.active", following.output())
        with rosbag.Bag(path) as bag:
            self.assertEqual(bag.get_message_count(["joint_states"]), 101)

    def test_an_optimization_node_in_the_same_folder_removes_the_bag_of_a_killed_node_too(self):
        killed = self.start("simulation", "recorded", bag=f"{self.folder}/run.bag", start_paused=True)
        wait_until(lambda: files(self.folder, ".active"), "no bag is begun")
        killed.end(signal.SIGKILL)
        self.start("optimization", "beside", output_directory=self.folder)
        state_of("beside", "ready")
        self.assertEqual(os.listdir(self.folder), [])

    def test_the_description_is_that_of_the_mechanism_and_the_rod_ends_in_the_slider(self):
        launch = Launch("simulate.launch", "rviz:=false", "set:={crank_length: 0.1}", "time_scale:=0.2")
        try:
            text = rospy.wait_for_message("robot_description", String, PATIENCE).data
            self.assertEqual(rospy.get_param("robot_description").strip(), text.strip())
            self.assertIn('name="crank_length" value="0.1"', text)
            buffer = tf2_ros.Buffer()
            listener = tf2_ros.TransformListener(buffer)
            for _ in range(10):
                transform = buffer.lookup_transform("slider", "rod", rospy.Time(0), rospy.Duration(PATIENCE))
                stamp, pin = transform.header.stamp, transform.transform
                r, p = pin.rotation, pin.translation
                axis = (1 - 2 * (r.y**2 + r.z**2), 2 * (r.x * r.y + r.w * r.z), 2 * (r.x * r.z - r.w * r.y))
                for end in (p.x + 0.3 * axis[0], p.y + 0.3 * axis[1], p.z + 0.3 * axis[2]):
                    self.assertAlmostEqual(end, 0.0, delta=1e-6)
                wait_until(lambda shown=stamp: buffer.get_latest_common_time("slider", "rod") > shown, "the run stands still")
            listener.unregister()
        finally:
            launch.end()

    def test_a_description_of_another_mechanism_is_a_warning(self):
        with open(f"{SHARE}/urdf/slider_crank.urdf", encoding="utf-8") as file:
            rospy.set_param("robot_description", file.read())
        self.start("simulation", "alike", model="slider_crank", start_paused=True)
        self.start("simulation", "unlike", set={"crank_length": 0.09}, start_paused=True)
        self.assertEqual(state_of("alike", "running").level, 0)
        self.assertTrue(any("description_differs" in key for key in values_of(state_of("unlike", "running"))))
        rospy.delete_param("robot_description")

    def test_two_robots_in_one_master(self):
        for side in ("left", "right"):
            self.start("simulation", side, frame_prefix=f"{side}/", world_frame="world", loop=True, set={"crank_length": 0.09 if side == "left" else 0.07})
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        for side, length in (("left", 0.09), ("right", 0.07)):
            tip = buffer.lookup_transform(f"{side}/crank", f"{side}/rod", rospy.Time(0), rospy.Duration(PATIENCE)).transform.translation
            self.assertAlmostEqual((tip.x**2 + tip.y**2 + tip.z**2) ** 0.5, length, delta=1e-9)
            buffer.lookup_transform("world", f"{side}/slider", rospy.Time(0), rospy.Duration(PATIENCE))
        listener.unregister()


if __name__ == "__main__":
    rospy.init_node("nodes_test")
    rostest.rosrun("mechanism_codesign", "nodes", NodesTest)
