#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Gains of a finished job go to a running robot, here a mock: with `codesign apply` and by the node's service. Robots that clamp, refuse, die, fall
silent or leave their limits half way get their values back."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import rosnode
import rospy
import rostest
from mechanism_codesign.srv import Apply, ApplyRequest, OptimizeRequest
from std_msgs.msg import Empty, Float64

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mock_robot import START, MockGains, MockJoints  # noqa: E402
from node_process import PATIENCE, NodesTestCase, program_path, wait_until  # noqa: E402

MODEL = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/><inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.01"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0 0 -0.2"/><mass value="1"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.01"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="60" velocity="8"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 -0.6"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="30" velocity="8"/></joint>
</robot>
"""
STUDY = """duration: 0.4
initial_state: {shoulder: {position: 0.2}, elbow: {position: 0.1}}
controllers:
  shoulder_hold: {type: pid, input: shoulder/position, setpoint: 0.3, output: shoulder, gains: {p: "${Kp1}", i: 2.0, d: "${Kd1}"}}
  elbow_hold: {type: pid, input: elbow/position, setpoint: 0.2, output: elbow, gains: {p: "${Kp2}", d: 1.5}}
hardware:
  shoulder_hold: {namespace: arm_controller/gains/shoulder, i_clamp: 4.0, antiwindup: true}
  elbow_hold: {namespace: arm_controller/gains/elbow}
parameters:
  Kp1: {initial: 40.0, lower: 1.0, upper: 200.0}
  Kd1: {initial: 4.0, lower: 0.1, upper: 20.0}
  Kp2: {initial: 20.0, lower: 1.0, upper: 200.0}
objective:
  integral: [{signal: shoulder_hold/error}, {signal: elbow_hold/error}]
optimizer: {algorithm: lbfgs, max_evaluations: 4}
"""
QUICK = ("--ramp", "0.3", "--hold", "0.1")
# So long that the cause to end it cannot come too late.
WATCHED = ("--ramp", "0.3", "--hold", str(PATIENCE))
BEFORE = {name: START[name] for name in ("p", "i", "d")}


def program():
    return program_path("codesign")


class ApplyTest(NodesTestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp()
        cls.job = os.path.join(cls.root, "job")
        for name, text in (("arm.urdf", MODEL), ("arm.yaml", STUDY)):
            with open(os.path.join(cls.root, name), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([program(), "optimize", "arm.urdf", "arm.yaml", "--output", "job", "--json"], capture_output=True, text=True, cwd=cls.root, check=True)
        cls.tuned = json.loads(done.stdout)["parameters"]
        cls.joints = MockJoints(["shoulder", "elbow"])
        cls.shoulder = MockGains("/arm_controller/gains/shoulder")
        cls.elbow = MockGains("/arm_controller/gains/elbow")

    @classmethod
    def tearDownClass(cls):
        cls.joints.end()
        shutil.rmtree(cls.root)

    def setUp(self):
        super().setUp()
        self.joints.silent, self.joints.lag, self.joints.stamp = False, 0.0, None
        self.joints.message.effort[:] = [0.5, 0.5]
        for gains in (self.shoulder, self.elbow):
            gains.takes = lambda values, number: values
            gains.server.update_configuration(START)
            gains.requests.clear()

    def start_apply(self, *words, job=None):
        # Python does not publish every 0.01 s on a busy machine.
        return subprocess.Popen([program(), "apply", job or self.job, "--json", "--max-age", str(PATIENCE), *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def apply(self, *words, job=None):
        process = self.start_apply(*words, job=job)
        out, err = process.communicate(timeout=PATIENCE)
        return process.returncode, json.loads(out) if out else {}, err

    def copy_of_job(self):
        copy = os.path.join(self.folder, "job")
        shutil.copytree(self.job, copy)
        return copy

    def requests(self):
        return len(self.shoulder.requests) + len(self.elbow.requests)

    def check_taken_back(self, outcome, code, sentence):
        returned, answer, _ = outcome
        self.assertEqual((returned, answer["error"]["code"]), (1, code), answer)
        self.assertIn(sentence, answer["error"]["message"])
        for gains in (self.shoulder, self.elbow):
            self.assertEqual({name: gains.has()[name] for name in BEFORE}, BEFORE)
        return answer

    def after(self, number, action):
        """Calls `action` when the elbow gets its request of this number."""
        def takes(values, count):
            if count == number:
                action()
            return values
        self.elbow.takes = takes

    def test_the_robot_gets_the_gains_step_by_step(self):
        returned, answer, err = self.apply(*QUICK)
        self.assertEqual(returned, 0, err)
        self.assertEqual({**START, "p": self.tuned["Kp1"], "i": 2.0, "d": self.tuned["Kd1"], "i_clamp_max": 4.0, "i_clamp_min": -4.0, "antiwindup": True},
                         self.shoulder.has())
        self.assertEqual({**START, "p": self.tuned["Kp2"], "d": 1.5}, self.elbow.has())
        steps = [values["p"] for values in self.shoulder.requests]
        self.assertEqual(len(steps), 6)
        self.assertEqual(steps, sorted(steps))
        self.assertAlmostEqual(steps[0], 1.0 + (self.tuned["Kp1"] - 1.0) / 6.0, delta=1e-9)
        changes = {(change["server"], change["name"]): change for change in answer["changes"]}
        self.assertEqual(changes["/arm_controller/gains/elbow", "p"], {"server": "/arm_controller/gains/elbow", "name": "p", "before": 1.0,
                                                                       "after": self.tuned["Kp2"], "now": self.tuned["Kp2"]})
        self.assertIsNone(answer["rollback_seconds"])

    def test_a_dry_run_sends_nothing(self):
        returned, answer, err = self.apply("--dry-run")
        self.assertEqual(returned, 0, err)
        self.assertEqual(self.requests(), 0)
        self.assertTrue(all(change["now"] == change["before"] for change in answer["changes"]))

    def test_values_that_were_never_simulated(self):
        job = self.copy_of_job()
        with open(os.path.join(job, "result.json"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(job, "result.json"), "w", encoding="utf-8") as file:
            file.write(text.replace(f'"Kp2": {self.tuned["Kp2"]!r}', f'"Kp2": {self.tuned["Kp2"] * 1.01!r}'))
        returned, answer, _ = self.apply(job=job)
        self.assertEqual((returned, answer["error"]["code"]), (1, "never_simulated"))
        self.assertEqual(self.requests(), 0)

    def test_values_beyond_the_limits_of_a_server(self):
        elsewhere = MockGains("/narrow/arm_controller/gains/shoulder", largest=3.0)
        MockGains("/narrow/arm_controller/gains/elbow")
        returned, answer, err = self.apply("__ns:=/narrow", "--joint-states", "/joint_states")
        self.assertEqual((returned, answer["error"]["code"]), (2, "bad_input"), err)
        self.assertIn("outside the limits of the server", answer["error"]["message"])
        self.assertEqual(elsewhere.requests, [])

    def test_a_robot_that_clamps(self):
        def clamp(values, _number):
            values["p"] = min(values["p"], 10.0)
            return values
        self.elbow.takes = clamp
        self.check_taken_back(self.apply(*QUICK), "aborted", "/arm_controller/gains/elbow has altered the values: p = ")

    def test_a_robot_that_refuses_half_way(self):
        def refuse(values, number):
            if number == 3:
                raise RuntimeError("not now")
            return values
        self.elbow.takes = refuse
        self.check_taken_back(self.apply(*QUICK), "aborted", "/arm_controller/gains/elbow has refused the values or is gone")
        self.assertEqual(len(self.shoulder.requests), 4)

    def test_a_robot_that_dies_half_way(self):
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "mock_robot.py")
        MockGains("/mortal/arm_controller/gains/elbow")
        with subprocess.Popen([sys.executable, path, "/mortal/arm_controller/gains/shoulder", "3"]) as mortal:
            returned, answer, _ = self.apply(*QUICK, "__ns:=/mortal", "--joint-states", "/joint_states")
            self.assertEqual(mortal.wait(PATIENCE), 1)
        self.assertEqual((returned, answer["error"]["code"]), (1, "rollback_failed"))
        self.assertIn("not confirmed their values before: /mortal/arm_controller/gains/shoulder", answer["error"]["message"])
        for change in answer["changes"]:
            self.assertEqual(change["now"], change["before"] if "elbow" in change["server"] else None)

    def test_an_effort_beyond_its_limit(self):
        """The way back is one request to each server, as the tests of GainRamp count it."""
        self.after(3, lambda: self.joints.set_effort("elbow", 31.0))
        answer = self.check_taken_back(self.apply(*WATCHED), "aborted", "elbow/effort is 31, outside -30 to 30, the limit of the model")
        for gains in (self.shoulder, self.elbow):
            steps = [values["p"] for values in gains.requests]
            self.assertEqual(steps[:-1], sorted(steps[:-1]))
            self.assertEqual([value for value in steps if value == START["p"]], [steps[-1]])
        self.assertIsInstance(answer["rollback_seconds"], float)

    def test_limits_that_are_given(self):
        self.after(2, lambda: self.joints.set_effort("shoulder", 5.0))
        self.check_taken_back(self.apply(*WATCHED, "--limit", "shoulder/effort=-4:4"), "aborted", "shoulder/effort is 5, outside -4 to 4")

    def test_a_number_on_a_topic(self):
        publisher = rospy.Publisher("/drive/temperature", Float64, queue_size=10, latch=True)
        publisher.publish(20.0)
        self.after(2, lambda: publisher.publish(95.0))
        self.check_taken_back(self.apply(*WATCHED, "--limit", "/drive/temperature=:80"), "aborted", "/drive/temperature is 95")
        publisher.unregister()

    def test_joint_states_that_end(self):
        def fall_silent():
            self.joints.silent = True
        self.after(2, fall_silent)
        self.check_taken_back(self.apply(*WATCHED, "--max-age", "5"), "aborted", "no message came on joint_states for 5 s")

    def test_joint_states_that_are_late(self):
        self.joints.lag = 2.0
        outcome = self.apply(*QUICK, "--max-age", "0.5")
        self.check_taken_back(outcome, "unsafe", "s old by its stamp")
        self.assertEqual(self.requests(), 0)

    def test_stamps_without_sense(self):
        for stamp, sentence in ((rospy.Time(2**32 - 1, 999999999), "is from the future"), (rospy.Time(1), "s old by its stamp")):
            self.setUp()
            self.after(2, lambda wrong=stamp: setattr(self.joints, "stamp", wrong))
            self.check_taken_back(self.apply(*WATCHED), "aborted", sentence)

    def test_a_robot_that_answers_late(self):
        """It is busy with a step until that is given up. The values before are the last that it takes."""
        def linger(values, number):
            if number == 3:
                wait_until(lambda: self.shoulder.requests[-1]["p"] == START["p"], "the ramp does not end")
            return values
        self.elbow.takes = linger
        self.check_taken_back(self.apply(*WATCHED, "--max-age", "5"), "aborted", "/arm_controller/gains/elbow has not answered within 5 s")
        self.assertEqual([values["p"] for values in self.elbow.requests[3:]], [START["p"]])

    def test_a_joint_that_moves_away(self):
        def move():
            self.joints.message.position[0] = 0.4
        self.after(2, move)
        try:
            self.check_taken_back(self.apply(*WATCHED, "--deviation", "0.2"), "aborted", "shoulder/position has changed by")
        finally:
            self.joints.message.position[0] = 0.1

    def test_two_at_once(self):
        """The second is refused while the first holds the robot, and told by whom and for how long; the first is not disturbed. A holder that was
        killed holds nothing, though the master still knows it."""
        first = self.start_apply("--ramp", str(PATIENCE))
        try:
            wait_until(lambda: self.requests() >= 4, "the ramp does not begin")
            holder = next(name for name in rosnode.get_node_names() if name.startswith("/codesign_apply"))
            returned, answer, _ = self.apply(*QUICK)
            self.assertEqual((returned, answer["error"]["code"]), (1, "busy"), answer)
            self.assertRegex(answer["error"]["message"], f"nothing was sent: {holder} changes the values of /arm_controller/gains/elbow, for [0-9.e+]+ s by now "
                                                         rf"\(ramp {PATIENCE:g} s, hold 1 s\); wait for its end, or end it: rosnode kill {holder}")
            self.assertEqual(answer["changes"], [])
            steps = [values["p"] for values in self.elbow.requests]
            self.assertEqual(steps, sorted(steps), "only the first has sent anything")
            self.assertEqual(self.apply("--dry-run")[0], 0, "what sends nothing is not refused")
            self.assertIsNone(first.poll())
        finally:
            first.kill()
            first.communicate(timeout=PATIENCE)
        self.assertIn(holder, rosnode.get_node_names())
        for gains in (self.shoulder, self.elbow):
            gains.server.update_configuration(START)
        returned, _, err = self.apply(*QUICK)
        self.assertEqual(returned, 0, err)

    def test_an_end_before_the_end(self):
        """By control-C and its relatives."""
        def kill(_process):
            names = [name for name in rosnode.get_node_names() if name.startswith("/codesign_apply")]
            self.assertEqual(rosnode.kill_nodes(names), (names, []))
        ends = [lambda process, kind=kind: process.send_signal(kind) for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
        for end in (*ends, kill):
            self.setUp()
            process = self.start_apply("--ramp", str(PATIENCE))
            wait_until(lambda: self.requests() >= 4, "the ramp does not begin")
            end(process)
            out, _ = process.communicate(timeout=PATIENCE)
            self.check_taken_back((process.returncode, json.loads(out), ""), "cancelled", "all servers have their values before")

    def test_an_end_of_the_node(self):
        """A node that is ended during a ramp takes it back first."""
        def call(apply):
            try:
                apply(ApplyRequest(result="job", ramp=PATIENCE, max_age=PATIENCE))
            except rospy.ServiceException:
                pass  # the node may be gone before its answer is
        ends = {"interrupted": lambda node: node.process.send_signal(signal.SIGINT), "terminated": lambda node: node.process.send_signal(signal.SIGTERM),
                "killed": lambda node: rosnode.kill_nodes(["/" + node.name])}
        for name, end in ends.items():
            self.setUp()
            self.copy_of_job()
            files = {key: os.path.join(self.root, file) for key, file in (("model", "arm.urdf"), ("study", "arm.yaml"))}
            node = self.start("optimization", name, output_directory=self.folder, **files)
            rospy.wait_for_service(f"/{name}/apply", PATIENCE)
            thread = threading.Thread(target=call, args=(rospy.ServiceProxy(f"/{name}/apply", Apply),))
            thread.start()
            wait_until(lambda: self.requests() >= 4, "the ramp does not begin")
            self.assertNotEqual(self.elbow.has()["p"], START["p"])
            end(node)
            self.assertEqual(node.process.wait(PATIENCE), 0, node.output())
            thread.join(PATIENCE)
            for gains in (self.shoulder, self.elbow):
                self.assertEqual({one: gains.has()[one] for one in BEFORE}, BEFORE, name)
            shutil.rmtree(self.folder)

    def test_what_is_not_there(self):
        returned, answer, _ = self.apply("--server", "/nobody")
        self.assertEqual((returned, answer["error"]["code"]), (1, "no_server"))
        returned, answer, _ = self.apply("--joint-states", "/nothing")
        self.assertEqual((returned, answer["error"]["code"]), (1, "unsafe"))
        self.assertIn("nothing came on the topic /nothing", answer["error"]["message"])
        returned, answer, _ = self.apply("--limit", "elbwo/effort=-1:1")
        self.assertEqual((returned, answer["error"]["code"]), (1, "unsafe"))
        self.assertIn("have no elbwo/effort", answer["error"]["message"])
        returned, answer, _ = self.apply("--ramp", "2e8")
        self.assertEqual((returned, answer["error"]["code"]), (2, "bad_input"))
        self.assertIn("up to 100000 s", answer["error"]["message"])
        returned, answer, _ = self.apply(job=self.root)
        self.assertEqual((returned, answer["error"]["code"]), (2, "bad_input"))
        self.assertEqual(self.requests(), 0)

    def test_unwatched(self):
        self.joints.silent = True
        returned, _, err = self.apply("--unwatched", "--ramp", "0.1", "--hold", "0.1")
        self.assertEqual(returned, 0, err)
        returned, answer, _ = self.apply("--unwatched", "--deviation", "0.1")
        self.assertEqual((returned, answer["error"]["code"]), (2, "bad_input"))

    def check_that_a_message_cancels(self, apply):
        for gains in (self.shoulder, self.elbow):
            gains.server.update_configuration(START)
            gains.requests.clear()
        replies = []
        thread = threading.Thread(target=lambda: replies.append(apply(ApplyRequest(ramp=PATIENCE, max_age=PATIENCE))))
        thread.start()
        wait_until(lambda: self.requests() >= 4, "the ramp does not begin")
        self.assertEqual(apply(ApplyRequest(dry_run=True)).code, "busy")
        cancel = rospy.Publisher("/tuner/apply/cancel", Empty, queue_size=1)
        wait_until(lambda: cancel.publish(Empty()) or not thread.is_alive(), "it is not cancelled")
        self.assertEqual(replies[0].code, "cancelled", replies[0].message)
        self.assertEqual({name: self.elbow.has()[name] for name in BEFORE}, BEFORE)

    def test_the_service_of_the_node(self):
        study = os.path.join(self.root, "arm.yaml")
        node = self.start("optimization", "tuner", model=os.path.join(self.root, "arm.urdf"), study=study, output_directory=self.folder)
        rospy.wait_for_service("/tuner/apply", PATIENCE)
        apply = rospy.ServiceProxy("/tuner/apply", Apply)
        self.assertIn("no optimization yet", apply(ApplyRequest()).message)
        result = node.optimize(OptimizeRequest())
        self.assertTrue(result.success, result.message)
        reply = apply(ApplyRequest(dry_run=True, max_age=PATIENCE))
        self.assertTrue(reply.success, reply.message)
        self.assertEqual(self.requests(), 0)
        reply = apply(ApplyRequest(result=os.path.basename(result.bag), ramp=0.2, hold=0.1, max_age=PATIENCE))
        self.assertTrue(reply.success, reply.message)
        self.assertEqual(self.elbow.has()["p"], result.tuned[result.parameters.index("Kp2")])
        reply = apply(ApplyRequest(result=self.job))
        self.assertEqual(reply.code, "bad_input")
        self.assertIn("not a job of the output directory", reply.message)
        self.check_that_a_message_cancels(apply)
        reply = apply(ApplyRequest(ramp=-1.0))
        self.assertEqual(reply.code, "bad_input")
        self.assertIn("ramp: not a time", reply.message)
        reply = apply(ApplyRequest(hold=2e8))
        self.assertEqual(reply.code, "bad_input")
        self.assertIn("up to 100000 s", reply.message)


if __name__ == "__main__":
    rospy.init_node("apply_test", disable_signals=True)
    rostest.rosrun("mechanism_codesign", "apply", ApplyTest)
