#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Arguments of launch files: paths, numbers, cases, typing errors."""
import os
import pathlib
import shutil
import sys

import rospy
import rostest
from mechanism_codesign.srv import Identify

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from launch_fixture import LaunchTestCase  # noqa: E402
from node_process import PATIENCE, SHARE, Launch, state_of, values_of  # noqa: E402


class LaunchInputsTest(LaunchTestCase):
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

    def test_a_launch_file_names_the_known_cases_on_a_typo(self):
        for file in ("simulate.launch", "optimize.launch"):
            output = Launch(file, "case:=slider_crnk").output()
            self.assertIn('did you mean "slider_crank"?', output)
            self.assertIn("inverted_pendulum", output)
        self.assert_left_as_found()


if __name__ == "__main__":
    rospy.init_node("launch_inputs_test")
    rostest.rosrun("mechanism_codesign", "launch_inputs", LaunchInputsTest)
