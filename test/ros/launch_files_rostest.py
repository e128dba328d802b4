#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Launch files as users call them: paths, typing errors, and restored parameters of the master in whatever order they end."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

import rosbag
import rosgraph
import rospy
import rostest
import yaml
from mechanism_codesign.srv import Identify, OptimizeRequest
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, SHARE, Launch, NodesTestCase, state_of, values_of, wait_until  # noqa: E402

FOUND = {"/use_sim_time": False, "/robot_description": "what was here", "/simulation/rate": 7, "/replay/color": [1, 2], "/rviz/a": {"b": 1.5},
         "/tuned/robot_description": "the tuned one", "/optimization/set/crank_length": 0.07}
FAST = ("simulate.launch", "rviz:=false", "mode:=as_fast_as_possible", "loop:=true")
REAL_TIME = ("simulate.launch", "rviz:=false", "set:={crank_length: 0.09}", "loop:=true")


def parameters():
    """All parameters of the master except those that roslaunch itself leaves there."""
    return {name: rospy.get_param(name) for name in rospy.get_param_names() if not name.startswith("/roslaunch/")}


def records():
    return [name for name in rospy.get_param_names() if name.endswith("/before_launch")]


def processes(parent=None):
    """Numbers and command lines."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if parent is None or int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1]) == parent:
                found.append((int(folder.name), (folder / "cmdline").read_text()))
        except (OSError, ValueError):
            continue
    return found


def nodes_of(launch):
    return [pid for pid, _ in processes(launch.process.pid)]


class LaunchFilesTest(NodesTestCase):
    recorded = None  # the bag of an optimization, made once

    @classmethod
    def tearDownClass(cls):
        if cls.recorded:
            os.remove(cls.recorded)

    def setUp(self):
        super().setUp()
        self.launches = []
        for name in parameters():
            if not name.startswith(("/ros", "/run_id")):
                rospy.delete_param(name)
        for name, value in FOUND.items():
            rospy.set_param(name, value)
        self.before = parameters()

    def tearDown(self):
        for launch in self.launches:
            launch.end()
        super().tearDown()

    def launch(self, *arguments, **settings):
        """Returns once all parameters are set."""
        earlier = set(records())
        launch = Launch(*arguments, **settings)
        self.launches.append(launch)
        wait_until(lambda: set(records()) - earlier or launch.process.poll() is not None, f"{arguments} sets nothing")
        wait_until(lambda: nodes_of(launch) or launch.process.poll() is not None, f"{arguments} starts nothing")
        self.assertIsNone(launch.process.poll(), launch.output() if launch.process.poll() is not None else "")
        return launch

    def end(self, *launches):
        """Ends launch files. Parameters that the node had no time to restore are restored by its background process a moment later."""
        count = len(records())
        for launch in launches:
            launch.process.send_signal(signal.SIGINT)
        for launch in launches:
            launch.end()
        wait_until(lambda: len(records()) == count - len(launches), "nobody restores the parameters")

    def bag(self):
        if not LaunchFilesTest.recorded:
            node = self.start("optimization", "recorded", output_directory=self.folder)
            reply = node.optimize(OptimizeRequest(max_evaluations=1))
            node.end()
            LaunchFilesTest.recorded = tempfile.mktemp(suffix=".bag")
            shutil.move(reply.bag, LaunchFilesTest.recorded)
        return LaunchFilesTest.recorded

    def replay(self, bag):
        return self.launch("replay.launch", "rviz:=false", f"bag:={bag}")

    def assert_left_as_found(self):
        self.assertEqual(parameters(), self.before)

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

    def test_paths_may_be_relative_or_begin_with_a_tilde(self):
        bag = self.bag()
        home = os.path.join(self.folder, "home of me")
        os.mkdir(home)
        for name, source in (("my.urdf", f"{SHARE}/urdf/slider_crank.urdf"), ("my.yaml", f"{SHARE}/config/slider_crank.yaml"), ("my.bag", bag)):
            for folder in (self.folder, home):
                shutil.copy(source, os.path.join(folder, name))
        for folder in (self.folder, home):
            for name in ("one.urdf", "two.urdf"):
                pathlib.Path(folder, name).write_text('<robot name="slider_crank"/>', encoding="utf-8")
        for place, folder in (("", self.folder), ("~/", home)):
            inputs = [f"model:={place}my.urdf", f"study:={place}my.yaml", f"overlays:={place}one.urdf, {place}two.urdf"]
            simulation = self.set_by("simulate.launch", *inputs, f"bag:={place}new.bag", f"rviz_config:={place}my.rviz", home=home)
            optimization = self.set_by("optimize.launch", *inputs, f"output_directory:={place}bags", home=home)
            replay = self.set_by("replay.launch", f"bag:={place}my.bag", f"rviz_config:={place}my.rviz", home=home)
            for node, found in (("/simulation", simulation), ("/optimization", optimization)):
                self.assertEqual(found[node + "/model"], f"{folder}/my.urdf")
                self.assertEqual(found[node + "/study"], f"{folder}/my.yaml")
                self.assertEqual(found[node + "/overlays"], [f"{folder}/one.urdf", f"{folder}/two.urdf"])
            self.assertEqual(simulation["/simulation/bag"], f"{folder}/new.bag")
            self.assertEqual(optimization["/optimization/output_directory"], f"{folder}/bags")
            self.assertEqual(replay["/replay/bag"], f"{folder}/my.bag")
            for found in (simulation, replay):
                self.assertEqual(found["/rviz/config"], f"{folder}/my.rviz")
            self.assertIn("<robot", simulation["/robot_description"])
            self.assertIn("<robot", replay["/tuned/robot_description"])

    def set_by(self, *arguments, home):
        """What a launch file would set. In the folder of the test."""
        command = ["roslaunch", "--dump-params", "mechanism_codesign", *arguments]
        reply = subprocess.run(command, cwd=self.folder, env={**os.environ, "HOME": home}, stdout=subprocess.PIPE, text=True, check=True)
        return yaml.safe_load(reply.stdout)

    def test_relative_paths_reach_the_nodes_without_the_parameters_of_the_last_start(self):
        for name, shipped in (("my.urdf", "urdf/slider_crank.urdf"), ("my.yaml", "config/slider_crank.yaml")):
            shutil.copy(f"{SHARE}/{shipped}", f"{self.folder}/{name}")
        self.launch("optimize.launch", "model:=my.urdf", "study:=my.yaml", "output_directory:=bags", cwd=self.folder)
        state = state_of("optimization", "ready")
        self.assertEqual(values_of(state)["output directory"], f"{self.folder}/bags")
        self.assertEqual(rospy.get_param("/optimization/model"), f"{self.folder}/my.urdf")
        self.assertEqual(rospy.get_param("/optimization/set", {}), {})

    def test_numbers_arrive_as_roslaunch_passes_them(self):
        launch = self.launch("simulate.launch", "rviz:=false", "duration:=1e6", "rate:=1e2", "step_frames:=1e1", "set:={crank_length: 9e-2}",
                             "loop:=false")
        state_of("simulation", "running slider_crank")
        self.assertIn('name="crank_length" value="0.09"', rospy.get_param("/robot_description"))
        self.end(launch)
        launch = self.launch("simulate.launch", "rviz:=false", "duration:=long")
        self.assertIn('duration: not a number above zero (value: "long"', state_of("simulation", "bad input").message)

    def test_cases_find_their_overlays_and_a_model_needs_its_study(self):
        overlays = self.set_by("simulate.launch", "rviz:=false", "case:=vendor_arm", home=self.folder)["/simulation/overlays"]
        self.assertEqual([os.path.realpath(path) for path in overlays], [os.path.realpath(f"{SHARE}/urdf/overlays/vendor_arm.urdf")])
        for file in ("simulate.launch", "optimize.launch"):
            self.assertIn("the model my.urdf is given without a study", Launch(file, "model:=my.urdf").output())
            self.assertIn("the study my.yaml is given without a model", Launch(file, "study:=my.yaml").output())
        self.launch("optimize.launch", "case:=vendor_arm", f"output_directory:={self.folder}")
        rospy.wait_for_service("/identify", PATIENCE)
        answer = rospy.ServiceProxy("/identify", Identify)()
        self.assertEqual(answer.code, "bad_input")
        self.assertIn("there is no such recording", answer.message)
        self.assertIn("doc/case_studies.md", answer.message)

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

    def test_a_launch_file_names_the_known_cases_on_a_typo(self):
        for file in ("simulate.launch", "optimize.launch"):
            output = Launch(file, "case:=slider_crnk").output()
            self.assertIn('did you mean "slider_crank"?', output)
            self.assertIn("inverted_pendulum", output)
        self.assert_left_as_found()

    def test_a_record_of_another_kind_is_left_alone(self):
        for name, text in (("a", "no JSON"), ("b", json.dumps({"time": 1.0})), ("c", 5)):
            rospy.set_param(f"/{name}/before_launch", text)
        self.before = parameters()
        launch = self.launch("optimize.launch", f"output_directory:={self.folder}")
        self.end(launch)
        self.assert_left_as_found()


if __name__ == "__main__":
    rospy.init_node("launch_files_test")
    rostest.rosrun("mechanism_codesign", "launch_files", LaunchFilesTest)
