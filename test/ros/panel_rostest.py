#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The panel beside the real nodes: what a page sees and what its commands do, by requests as a page sends them, and with a browser if there is one."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.error
import urllib.request

import rospy
import rostest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "scripts")]
import browser  # noqa: E402
from node_process import PATIENCE, SHARE, Node, program_path, wait_until  # noqa: E402
from robot_node import Robot, time_in  # noqa: E402


class Page:
    """What a page knows: the last state, and the points of its signals."""

    def __init__(self, address, *signals):
        self.address, self.state, self.points = address, {}, {name: [] for name in signals}
        self.stream = urllib.request.urlopen(address + "events?" + "&".join(f"signal={name}" for name in signals), timeout=PATIENCE)
        self.thread = threading.Thread(target=self.read, daemon=True)
        self.thread.start()

    def read(self):
        kind = ""
        try:
            for line in self.stream:
                name, _, text = line.decode().strip().partition(": ")
                if name == "event":
                    kind = text
                elif name == "data" and kind == "state":
                    self.state = json.loads(text)
                elif name == "data":
                    for signal_name, points in json.loads(text)["points"].items():
                        self.points[signal_name] += points
        except (OSError, ValueError):  # the panel has ended
            pass

    def wait(self, condition, what):
        wait_until(lambda: self.state and condition(self.state), what)

    def do(self, what, **fields):
        request = urllib.request.Request(self.address + "do", json.dumps({"do": what, **fields}).encode(), {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
            return json.load(answer)

    def done(self, what, **fields):
        """The sentence of a command that succeeds."""
        answer = self.do(what, **fields)
        assert answer["success"], answer["message"]
        return answer["message"]

    def result(self):
        self.wait(lambda state: state["job"]["result"], "the job has no result")
        return self.state["job"]["result"]


class PanelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot()
        path = program_path("panel")
        environment = {**os.environ, "ROS_NAMESPACE": "/robot"}
        cls.panel = subprocess.Popen([path, "--port", "0", "--optimization", "/job"] + [
            f"{topic}:=/job/{topic}" for topic in ("optimization_progress", "identification_progress", *(
                f"{action}/{part}" for action in ("optimize", "identify") for part in ("goal", "status", "result")))], stdout=subprocess.PIPE, text=True, env=environment)
        cls.address = cls.panel.stdout.readline().split()[0]
        cls.page = Page(cls.address, "slider_joint/friction", "crank_speed/setpoint", "crank_joint/position")
        cls.page.wait(lambda state: state["simulation"]["answers"] and state["parameters"]["described"] and state["commands"]["controllers"], "no state")

    @classmethod
    def tearDownClass(cls):
        cls.panel.send_signal(signal.SIGINT)
        cls.panel.wait(PATIENCE)
        cls.panel.stdout.close()

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.page.do("resume")
        self.robot.restart([0.0], [-10.0])

    def start_jobs(self, model="slider_crank", seconds=2.0):
        """The node `job`, with the study of a case in the folder of the test, with runs of so many seconds."""
        with open(f"{SHARE}/config/{model}.yaml", encoding="utf-8") as file, open(f"{self.folder}/study.yaml", "w", encoding="utf-8") as copy:
            copy.write(file.read().replace("duration: 2.0", f"duration: {seconds}"))
        node = Node("optimization", "job", model=model, study=f"{self.folder}/study.yaml", output_directory=self.folder)
        self.addCleanup(node.end)
        self.page.wait(lambda state: state["optimization"]["answers"] and state["optimization"]["message"].startswith("ready"), "the node of jobs is not seen")
        return node

    def test_curves_have_every_frame_of_the_node(self):
        time = {name: points[-1][0] for name, points in self.page.points.items() if points}
        wait_until(lambda: all(points and points[-1][0] > time.get(name, 0.0) + 0.5 for name, points in self.page.points.items()), "the curves do not go on")
        frames, crank = [self.robot.wait_for_frame(self.page.done("pause"))], self.page.points["crank_joint/position"]
        # One by one, since the node drops frames for a subscriber that has no processor for a while.
        for number in range(6):
            frames += [self.robot.step()] if number else []
            wanted = float(f"{frames[-1].position[frames[-1].name.index('crank_joint')]:.6g}")
            wait_until(lambda: crank[-1][1] == wanted, "a frame is not on the page")
        seen = crank[-len(frames):]
        for (moment, value), frame in zip(seen, frames):
            self.assertEqual(value, float(f"{frame.position[frame.name.index('crank_joint')]:.6g}"))
            self.assertAlmostEqual(moment - seen[0][0], (frame.header.stamp - frames[0].header.stamp).to_sec(), delta=2e-4)
        self.assertEqual(self.page.points["crank_speed/setpoint"][-1][1], -10.0)
        self.assertNotEqual(self.page.points["slider_joint/friction"][-1][1], 0.0)

    def test_pause_step_and_resume(self):
        wait_until(lambda: len(self.robot.joints.messages) > 2, "no frames before the pause, whose distance is that of the run's")
        paused = self.page.done("pause")
        self.assertIn("paused after t = ", paused)
        self.page.wait(lambda state: state["simulation"]["values"]["waits for"] == "~step or ~resume", "the page does not say that the run is paused")
        last = self.robot.wait_for_frame(paused)
        stepped = self.page.done("step")
        period = self.robot.elapsed(self.robot.joints.messages[1])
        self.assertAlmostEqual(time_in(stepped) - time_in(paused), period, delta=1e-6, msg="a step is one frame")
        self.page.wait(lambda state: float(state["simulation"]["values"]["time of the run"]) == time_in(stepped), "the page does not show the time after the step")
        self.assertNotIn("real-time factor", self.page.state["simulation"]["values"])
        wait_until(lambda: self.robot.joints.last().header.stamp > last.header.stamp, "a step without a frame")
        self.page.done("resume")
        refused = self.page.do("step")
        self.assertFalse(refused["success"])
        self.assertIn("not paused", refused["message"])

    def test_parameters_with_their_bounds_change_and_are_refused(self):
        crank = self.page.state["parameters"]["described"][0]
        self.assertEqual(crank, {"name": "crank_length", "label": "crank_length [m]", "min": 0.06, "max": 0.1, "initial": 0.08})
        self.assertEqual(self.page.done("parameters", values={"crank_length": 0.07, "Kp": 2.0}), "crank_length = 0.07, Kp = 2")
        self.page.wait(lambda state: state["parameters"]["values"]["crank_length"] == 0.07, "the new value is not shown")
        for values, sentence in (({"Kp": 99.0}, "Kp = 99 was not taken, it is 5"), ({"krank_length": 0.07}, "there is no such parameter")):
            answer = self.page.do("parameters", values=values)
            self.assertFalse(answer["success"])
            self.assertIn(sentence, answer["message"])
        self.page.wait(lambda state: any("krank_length" in value for value in state["simulation"]["values"].values()), "the warning is not shown")
        self.page.done("parameters", values={"crank_length": 0.08, "Kp": 1.0})

    def test_efforts_and_set_points(self):
        self.assertEqual(self.page.state["commands"]["controllers"], ["crank_speed"])
        self.page.done("effort", name="crank_joint", value=0.25)
        self.page.done("setpoint", name="crank_speed", value=-8.0)

        def in_effect(commands):  # two topics, whose messages come in any order
            return commands.setpoints == (-8.0,) and commands.efforts[commands.joints.index("crank_joint")] == 0.25

        wait_until(lambda: in_effect(self.robot.commands.last()), "the effort and the set-point are not in effect")
        self.page.wait(lambda state: state["commands"]["setpoints"] == {"crank_speed": -8.0} and state["commands"]["efforts"]["crank_joint"] == 0.25, "not shown")
        self.page.done("restart")
        self.page.wait(lambda state: state["commands"]["setpoints"] == {}, "a new run begins without commands")
        self.assertIn("no controller of this study", self.page.do("setpoint", name="krank_speed", value=1.0)["message"])
        self.assertEqual(self.page.do("effort", name="no_joint", value=1.0), {"success": False, "message": "no_joint: no joint of this simulation that takes efforts"})

    def test_an_optimization_and_its_report(self):
        self.start_jobs()
        self.page.done("optimize")
        self.page.wait(lambda state: state["job"]["result"] and state["job"]["result"]["success"], "no result")
        result = self.page.result()
        self.assertEqual([row[0] for row in result["rows"]], ["crank_length", "rod_length", "slider_length", "slider_width", "Kp"])
        self.assertEqual(result["values"]["crank_length"], 0.06)
        self.assertTrue(os.path.isfile(result["bag"]))
        self.assertFalse(self.page.state["job"]["running"])
        with urllib.request.urlopen(self.address + "report.html", timeout=PATIENCE) as answer:
            self.assertIn("sandbox", answer.headers["Content-Security-Policy"])
            self.assertIn("crank_length", answer.read().decode())

    def test_an_identification(self):
        self.start_jobs("slider_crank_identify")
        self.page.done("identify")
        self.page.wait(lambda state: state["job"]["result"] and "slider_crank_identify.csv" in state["job"]["result"]["message"], "the missing recording is not told")
        codesign = program_path("codesign")
        run = f"{self.folder}/run.csv"
        subprocess.run([codesign, "simulate", f"{SHARE}/urdf/slider_crank_identify.urdf", f"{self.folder}/study.yaml", "--set", "mu_static=0.4", "--quiet",
                        "--signals", "crank_joint/velocity,crank_joint/effort", "--samples", "3001", "--csv", run], check=True, stdout=subprocess.DEVNULL)
        os.rename(run, f"{self.folder}/slider_crank_identify.csv")
        self.page.done("identify")
        self.page.wait(lambda state: state["job"]["result"] and state["job"]["result"]["rows"], "no numbers")
        result = self.page.result()
        self.assertIn("crank_inertia and rotor_inertia appear only as", result["summary"])
        self.assertEqual(self.page.state["job"]["kind"], "identification")
        mu = next(row for row in result["rows"] if row[0] == "mu_static")
        self.assertAlmostEqual(mu[2], 0.4, delta=0.01)
        self.assertEqual(result["values"]["mu_static"], mu[2])
        with urllib.request.urlopen(self.address + "report.html", timeout=PATIENCE) as answer:
            report = answer.read().decode()
        self.assertIn("fitted recording 1", report)
        self.assertIn(f'replay.launch bag:={result["bag"]}', report)

    def test_a_long_job_shows_its_progress_and_is_cancelled(self):
        node = self.start_jobs(seconds=300.0)
        self.assertIn("nothing to cancel", self.page.do("cancel")["message"])
        self.page.done("optimize")
        self.page.wait(lambda state: state["job"]["running"] and state["job"]["told"].get("evaluation"), "no progress")
        self.assertEqual((self.page.state["job"]["kind"], self.page.state["job"]["told"]["stage"]), ("optimization", "searching"))
        self.assertEqual(self.page.do("optimize"), {"success": False, "message": "another optimization is running"})
        self.assertIn("cancelled the optimization", self.page.done("cancel"))
        self.page.wait(lambda state: state["job"]["result"] and state["job"]["result"]["message"].startswith("cancelled"), "the job is not cancelled")
        self.assertTrue(os.path.isfile(self.page.result()["bag"]))
        node.end()
        self.page.wait(lambda state: not state["optimization"]["answers"], "the page does not say that the node has ended")
        refused = self.page.do("optimize")
        self.assertFalse(refused["success"])
        self.assertIn("/job/optimize/goal: no node listens to it", refused["message"])

    def test_foreign_requests_are_refused(self):
        for headers in ({"Host": "evil.example"}, {"Origin": "http://evil.example"}):
            request = urllib.request.Request(self.address + "do", b'{"do": "pause"}', {"Content-Type": "application/json", **headers})
            with self.assertRaises(urllib.error.HTTPError) as caught:
                urllib.request.urlopen(request, timeout=PATIENCE)
            self.assertEqual(caught.exception.code, 403)
            caught.exception.close()

    @unittest.skipUnless(browser.PATH, "no chromium on this machine: the page is not tested in a browser; Debian's package chromium has one")
    def test_in_a_browser_a_key_pauses_the_node(self):
        page = browser.Browser()
        self.addCleanup(page.close)
        page.open(self.address)
        page.wait("document.querySelectorAll('svg').length === 4")
        page.run("document.getElementById('pause').focus()")
        page.press("Enter")
        page.wait("document.getElementById('state').textContent === 'paused slider_crank'")
        self.assertEqual(page.errors, [])


if __name__ == "__main__":
    rospy.init_node("panel_test")
    rostest.rosrun("mechanism_codesign", "panel", PanelTest)
