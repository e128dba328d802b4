#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What one sees of a job and of a run: the page of watch, ~cancel, the scene, sticks for links without visual, and replay with overlay."""
import json
import os
import subprocess
import sys
import threading
import urllib.request

import rospy
import rostest
from mechanism_codesign.msg import OptimizationProgress, Scene
from mechanism_codesign.srv import OptimizeRequest
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, Launch, NodesTestCase, listeners, program_path, study_of, wait_until  # noqa: E402

LONG, SECONDS = OptimizeRequest(relative_tolerance=1e-15, max_evaluations=100000), 100.0  # of a run: minutes of computing
# A pendulum without a visual.
MODEL = """<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <link name="ground"/>
  <link name="rod"><inertial><origin xyz="0 0 -0.25"/><mass value="1"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.001"/></inertial></link>
  <joint name="pivot" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" joint_length="0.05" pin_radius="0.02"/></joint>
</robot>
"""
STUDY = """duration: 2.0
initial_state: {pivot: {position: 1.0}}
objective: {integral: [{signal: pivot/position}]}
"""


class Watch:
    """The program watch, and its page."""

    def __init__(self, name):
        path = program_path("watch")
        remappings = [f"{topic}:=/{name}/{topic}" for topic in ("optimization_progress", "identification_progress")]
        self.process = subprocess.Popen([path, "--port", "0", *remappings], stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().split()[0]

    def get(self, path):
        with urllib.request.urlopen(self.address + path, timeout=PATIENCE) as reply:
            return reply.read().decode()

    def points(self):
        return json.loads(self.get("points.json"))

    def end(self):
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.process.stdout.close()


class SeenTest(NodesTestCase):
    def cancel(self, name):
        rospy.wait_for_service(f"/{name}/cancel", PATIENCE)
        return rospy.ServiceProxy(f"/{name}/cancel", Trigger)()

    def optimize_in_background(self, node, request):
        answers = []
        thread = threading.Thread(target=lambda: answers.append(node.optimize(request)))
        thread.start()
        return thread, answers

    def test_cancel_ends_a_job_of_the_service_and_keeps_the_best_point(self):
        node = self.start("optimization", "cancelled", study=study_of(SECONDS, self.folder), output_directory=self.folder)
        reply = self.cancel("cancelled")
        self.assertFalse(reply.success)
        self.assertIn("no optimization and no identification is running", reply.message)
        told = []
        rospy.Subscriber("/cancelled/optimization_progress", OptimizationProgress, told.append)
        wait_until(lambda: listeners("/cancelled", "/cancelled/optimization_progress"), "the test does not listen")
        thread, answers = self.optimize_in_background(node, LONG)
        wait_until(lambda: any(message.evaluation >= 2 for message in told), "no trial point")
        reply = self.cancel("cancelled")
        self.assertTrue(reply.success)
        self.assertIn("cancelled the optimization", reply.message)
        thread.join(PATIENCE)
        self.assertEqual(answers[0].code, "cancelled")
        self.assertLessEqual(answers[0].objective, answers[0].initial_objective)
        self.assertTrue(os.path.exists(answers[0].bag))
        self.assertFalse(self.cancel("cancelled").success, "it has ended")
        node.end()  # which flushes its log
        log = node.output()
        self.assertRegex(log, r"trial 1: objective [0-9.]+, scaled gradient ")
        self.assertRegex(log, r"trial 2: .*, step [0-9.e-]+, best [0-9.]+.* left")

    def test_cancel_with_bad_input_is_answered(self):
        self.start("optimization", "bad", model=f"{self.folder}/missing.urdf", output_directory=self.folder)
        self.assertFalse(self.cancel("bad").success)

    def test_watch_shows_the_points_of_the_running_job(self):
        node = self.start("optimization", "watched", study=study_of(SECONDS, self.folder), output_directory=self.folder)
        watch = Watch("watched")
        try:
            self.assertIn("<svg", watch.get(""))
            self.assertEqual(watch.points()["points"], [])
            told = []
            rospy.Subscriber("/watched/optimization_progress", OptimizationProgress, told.append)
            # Points that come before a subscriber is connected are lost.
            wait_until(lambda: len(listeners("/watched", "/watched/optimization_progress")) == 2, "watch does not listen")
            thread, answers = self.optimize_in_background(node, LONG)
            wait_until(lambda: len(watch.points()["points"]) >= 3, "no points on the page")
            state = watch.points()
            self.assertIn(state["stage"], ("searching", "screening"))
            self.assertTrue(self.cancel("watched").success)
            thread.join(PATIENCE)
            # The last message of a job, after its last trial point, has no time left.
            wait_until(lambda: told[-1].seconds_left == 0.0 and watch.points()["seconds_left"] == 0.0, "the page does not follow to the end")
            trials = {message.evaluation: message for message in told if message.evaluation > 0}
            state = watch.points()
            self.assertEqual(state["job"], answers[0].job)
            self.assertEqual(state["names"], list(answers[0].parameters))
            self.assertEqual([point[0] for point in state["points"]], sorted(trials))
            for evaluation, _, objective, best, _, values in state["points"]:
                self.assertEqual(best, trials[evaluation].best_objective)
                self.assertEqual(values, list(trials[evaluation].values))
                if trials[evaluation].code == "success":
                    self.assertEqual(objective, trials[evaluation].objective)
        finally:
            watch.end()

    def test_a_run_has_a_scene_and_a_link_without_visual_is_drawn(self):
        for name, text in (("pendulum.urdf", MODEL), ("swing.yaml", STUDY)):
            with open(f"{self.folder}/{name}", "w", encoding="utf-8") as file:
                file.write(text)
        launch = Launch("simulate.launch", "model:=pendulum.urdf", "study:=swing.yaml", "rviz:=false", "loop:=true", cwd=self.folder)
        try:
            scene = rospy.wait_for_message("scene", Scene, PATIENCE)
            # Released at 1 rad, 0.25 m below the pivot.
            self.assertLess(scene.smallest[0], -0.2)
            self.assertGreater(scene.largest[2], 0.0)
            self.assertLess(scene.floor, -0.24)
            self.assertLess(scene.distance, 3.0)
            self.assertGreater(scene.distance, 0.3)
            description = rospy.wait_for_message("robot_description", String, PATIENCE).data
            self.assertIn('<visual name="stick">', description)
            self.assertEqual(rospy.get_param("robot_description").strip(), description.strip(), "what rviz shows")
            caption = rospy.wait_for_message("caption", MarkerArray, PATIENCE)
            self.assertRegex(caption.markers[0].text, r"^t = [0-9.e-]+ s, objective so far ")
            self.assertIn("friction torque", caption.markers[1].text)
        finally:
            launch.end()

    def test_replay_lays_the_mechanisms_over_each_other(self):
        node = self.start("optimization", "recorded", output_directory=self.folder)
        bag = node.optimize(OptimizeRequest(max_evaluations=1)).bag
        for overlay in ("false", "true"):
            launch = Launch("replay.launch", f"bag:={bag}", "rviz:=false", f"overlay:={overlay}")
            try:
                # Latched by the player; another topic of that type is not on this master.
                places = rospy.wait_for_message("tf_static", TFMessage, PATIENCE).transforms
                found = {place.child_frame_id: place.transform.translation for place in places}
                self.assertEqual(found["initial"].x == found["tuned"].x and found["initial"].y == found["tuned"].y, overlay == "true")
                labels = rospy.wait_for_message("labels", MarkerArray, PATIENCE).markers
                self.assertEqual(len(labels), 1 if overlay == "true" else 2)
            finally:
                launch.end()

    def test_an_overlay_of_what_has_none_is_refused(self):
        path = program_path("play_bag")
        import rosbag
        with rosbag.Bag(f"{self.folder}/old.bag", "w") as bag:
            bag.write("labels", String("an old one"), rospy.Time(1))
        rospy.set_param("/player/bag", f"{self.folder}/old.bag")
        reply = subprocess.run([path, "--overlay", "__name:=player"], stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE)
        rospy.delete_param("/player")
        self.assertNotEqual(reply.returncode, 0)
        self.assertIn("nothing to lay over each other", reply.stderr)


if __name__ == "__main__":
    rospy.init_node("seen_test")
    rostest.rosrun("mechanism_codesign", "seen", SeenTest)
