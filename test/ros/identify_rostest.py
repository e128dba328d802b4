#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Action and service `identify`: goal, feedback, result, cancel, and recordings that cannot be used."""
import json
import math
import os
import sys
import threading

import actionlib
import rosbag
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from mechanism_codesign.msg import IdentificationProgress, IdentifyAction, IdentifyGoal
from mechanism_codesign.srv import Identify, IdentifyRequest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, NodesTestCase, content, wait_for_topic, wait_until  # noqa: E402
from robot_node import Latest  # noqa: E402

# An arm on a vertical axis. The rig has the inertia 0.3 and the damping 0.4.
MODEL = """<robot name="arm" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
    <dynamics damping="0.1" friction="0" codesign:damping="${viscous}"/></joint>
</robot>
"""
STUDY = """identify:
  data: [{bag: excite.bag, topic: /joint_states, to: 6.0}]
  holdout: [{bag: excite.bag, topic: /joint_states, from: 6.0}]
  filter: {cutoff: 20.0}
MORE
parameters: {inertia: {}, viscous: {}}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
"""
RATE = 200.0


def state(k, rate=RATE):
    """What the rig publishes at sample k, without noise."""
    t = k / rate
    position = math.sin(2 * t) + 0.3 * math.sin(5 * t)
    velocity = 2 * math.cos(2 * t) + 1.5 * math.cos(5 * t)
    effort = 0.8 * (-4 * math.sin(2 * t) - 7.5 * math.sin(5 * t)) + 0.4 * velocity
    message = JointState(name=["gripper", "hinge"], position=[0.0, position], velocity=[0.0, velocity], effort=[0.0, effort])
    message.header.stamp = rospy.Time.from_sec(100.0 + t)
    return message


def write_bag(path, change=lambda k, message: message, count=int(8 * RATE), rate=RATE, topic="/joint_states", **options):
    """`change` may return None: the message is missing."""
    with rosbag.Bag(path, "w", **options) as bag:
        bag.write("/words", String("begins"), rospy.Time(100))
        for k in range(count):
            message = change(k, state(k, rate))
            if message is not None:
                bag.write(topic, message, rospy.Time.from_sec(100.0 + k / rate))


def changed(**fields):
    """A change of one joint state: hinge's entries, or whole fields."""
    def change(k, message):
        for name, value in fields.items():
            value = value(k, getattr(message, name)) if callable(value) else value
            setattr(message, name, value)
        return message
    return change


class IdentifyTest(NodesTestCase):
    def setUp(self):
        super().setUp()
        self.bag = f"{self.folder}/excite.bag"
        self.model = f"{self.folder}/arm.urdf"
        with open(self.model, "w", encoding="utf-8") as file:
            file.write(MODEL)

    def start_node(self, name, more=""):
        study = f"{self.folder}/{name}.yaml"
        with open(study, "w", encoding="utf-8") as file:
            file.write(STUDY.replace("MORE\n", more))
        return self.start("optimization", name, model=self.model, study=study, output_directory=f"{self.folder}/out")

    def client(self, name):
        client = actionlib.SimpleActionClient(f"/{name}/identify", IdentifyAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)), "no action")
        return client

    def identify(self, name, **fields):
        rospy.wait_for_service(f"/{name}/identify", PATIENCE)
        return rospy.ServiceProxy(f"/{name}/identify", Identify)(IdentifyRequest(**fields))

    def test_goal_feedback_and_result(self):
        write_bag(self.bag)
        self.start_node("told", "  intervals: {profiles: true}\n")
        # The client drops feedback that the result has overtaken; the topic has all of it.
        client, told, topic = self.client("told"), [], Latest("/told/identification_progress", IdentificationProgress)
        wait_for_topic("/told", topic.subscriber)
        client.send_goal(IdentifyGoal(), feedback_cb=lambda feedback: told.append(feedback.progress))
        self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)))
        result = client.get_result()
        self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED, result.message)
        found = {number.name: number for number in result.numbers}
        for name, truth in (("inertia", 0.3), ("viscous", 0.4)):
            self.assertAlmostEqual(found[name].value, truth, delta=1e-3)
            self.assertTrue(found[name].determined and found[name].low < found[name].value < found[name].high)
            self.assertLess(found[name].profile_low, found[name].profile_high)
        self.assertEqual((result.rank, result.noise, result.level), (2, "correlated", 0.95))
        self.assertLess(result.data[0].rms, 0.01 * result.data[0].start_rms)
        self.assertEqual([fit.joint for fit in result.holdout], ["hinge"])
        wait_until(lambda: topic.messages and topic.last().seconds_left == 0.0, "no last message")
        self.assertTrue(told and set(map(content, told)) <= set(map(content, topic.messages)))
        self.check_progress(topic.messages, result)
        self.check_files(result)
        last = rospy.wait_for_message("/told/identification_progress", IdentificationProgress, PATIENCE)
        self.assertEqual((last.job, last.seconds_left), (result.job, 0.0))
        urdf = rospy.wait_for_message("/told/identified/robot_description", String, PATIENCE).data
        self.assertIn(f'name="inertia" value="{found["inertia"].value!r}"', urdf)
        # The service takes the same request; chosen parameters alone are fitted.
        reply = self.identify("told", parameters=["viscous"], start=[1.0])
        self.assertTrue(reply.success, reply.message)
        self.assertEqual([(number.name, number.start) for number in reply.numbers], [("viscous", 1.0)])
        self.assertGreater(reply.data[0].rms, 10 * result.data[0].rms, "the inertia stays as the model has it")
        self.assertNotEqual(reply.job, result.job)

    def check_progress(self, told, result):
        stages = [progress.stage for progress in told]
        self.assertEqual(sorted(set(stages), key=stages.index), ["reading", "fitting", "profiling", "recording"])
        fitting = [progress for progress in told if progress.stage == "fitting"]
        self.assertEqual([progress.evaluation for progress in fitting], list(range(1, len(fitting) + 1)))
        self.assertEqual((fitting[0].names, fitting[0].joints), (["inertia", "viscous"], ["hinge"]))
        self.assertEqual(fitting[-1].iteration, result.iterations)
        self.assertLess(fitting[-1].rms[0], fitting[0].rms[0])
        for progress in told:
            self.assertEqual(progress.job, result.job)
            self.assertTrue(math.isnan(progress.seconds_left) or progress.seconds_left >= 0.0)

    def check_files(self, result):
        with open(result.report, encoding="utf-8") as file:
            report = json.load(file)
        for number in result.numbers:
            self.assertEqual(report["identified"][number.name]["value"], number.value)
        with open(result.residuals, encoding="utf-8") as file:
            self.assertEqual(file.readline(), "set,recording,time,hinge/recorded,hinge/computed\n")
        with rosbag.Bag(result.bag) as bag:
            topics = bag.get_type_and_topic_info().topics
            for topic in ("measured/joint_states", "identified/joint_states", "identified/joint_friction", "residuals", "efforts", "tf"):
                self.assertGreater(topics[topic].message_count, 100, topic)
            (_, request, _), = bag.read_messages(topics=["request"])
            (_, kept, _), = bag.read_messages(topics=["result"])
            self.assertEqual((request.version, kept.bag, str(kept.numbers)), (result.version, result.bag, str(result.numbers)))
            recordings = [message.recording for _, message, _ in bag.read_messages(topics=["residuals"])]
            self.assertEqual(sorted(set(recordings)), ["identify.data[0]", "identify.holdout[0]"])

    def cancelled(self, name, stage, cancel, under_way=lambda: True):
        """Client and result of an identification that `cancel` ends in a stage. On a busy machine it may have ended before; then the next one is cancelled.
        `under_way` is false if it finds so."""
        for _ in range(20):
            client, begun = self.client(name), threading.Event()
            client.send_goal(IdentifyGoal(parameters=["inertia", "viscous"], start=[4.0, 9.0]),
                             feedback_cb=lambda feedback, begun=begun: begun.set() if feedback.progress.stage == stage else None)
            self.assertTrue(begun.wait(PATIENCE))
            if under_way():
                cancel(client)
            self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)))
            if client.get_result().code != "success":
                break
        return client, client.get_result()

    def test_the_service_cancel_ends_an_identification(self):
        write_bag(self.bag, count=40000, rate=1000.0)
        self.start_node("ended", "  intervals: {profiles: true}\n")
        replies = []
        _, result = self.cancelled("ended", "fitting", lambda client: replies.append(rospy.ServiceProxy("/ended/cancel", Trigger)()))
        self.assertTrue(replies[-1].success)
        self.assertIn("cancelled the identification", replies[-1].message)
        self.assertEqual(result.code, "cancelled")
        self.assertTrue(os.path.isfile(result.bag))

    def test_a_cancel_is_answered_on_the_way_with_the_best_point(self):
        # 40 s at 1 kHz: an evaluation takes long enough to be cancelled in.
        write_bag(self.bag, count=40000, rate=1000.0)
        self.start_node("cancelled", "  intervals: {profiles: true}\n")
        for stage in ("fitting", "profiling"):
            with self.subTest(stage):
                # Meanwhile another request is refused, and the node answers.
                client, result = self.cancelled("cancelled", stage, lambda client: client.cancel_goal(), lambda: self.identify("cancelled").code == "busy")
                print(f"{stage}: cancelled after {result.evaluations} evaluations", flush=True)
                self.assertEqual(client.get_state(), GoalStatus.PREEMPTED)
                # A cancel that was sent while fitting may arrive when the fit has just ended.
                self.assertEqual(result.code, "cancelled")
                if stage == "profiling":
                    self.assertNotEqual(result.termination, "cancelled")
                self.assertEqual([number.name for number in result.numbers], ["inertia", "viscous"])
                for path in (result.report, result.urdf, result.residuals, result.bag):
                    self.assertTrue(os.path.isfile(path), path)

    def test_recordings_that_cannot_be_used_are_answered_with_their_place(self):
        self.start_node("strict")

        # By the service: the Python client of actions may miss an answer that comes at once.
        def answer(**request):
            result = self.identify("strict", **request)
            self.assertFalse(result.success)
            return result

        def degrees(k, numbers):
            return [number * 180 / math.pi for number in numbers]

        def with_nan(k, numbers):
            return [numbers[0], math.nan if k == 321 else numbers[1]]

        def jumping(k, header):
            header.stamp -= rospy.Duration(0.5 if k >= 400 else 0.0)
            return header

        # Each fault, and the words about its kind and place that the answer must contain.
        faults = (("no bag", None, ("excite.bag", "cannot be")),
                  ("topic", dict(topic="/joint_state"), ("identify.data[0].topic", "no message on this topic", "/joint_state (sensor_msgs/JointState)")),
                  ("robot", dict(change=changed(name=["wrist", "elbow"])), ("identify.data[0].topic", "another robot", "elbow, wrist")),
                  ("NaN", dict(change=changed(position=with_nan)), ("message 322", "t = 1.605 s", "nan")),
                  ("gap", dict(change=lambda k, message: None if 500 <= k < 600 else message), ("message 501", "gap")),
                  ("clock", dict(change=changed(header=jumping)), ("message 401", "t = ")),
                  ("short", dict(count=10), ("identify.data[0]: 10 samples to 6 s", "at least 20")),
                  ("efforts", dict(change=changed(effort=[])), ("effort",)))
        for name, how, words in faults:
            with self.subTest(name):
                if how is not None:
                    write_bag(self.bag, **how)
                result = answer()
                print(f"{name}: {result.message}", flush=True)
                self.assertEqual(result.code, "bad_input")
                for word in words:
                    self.assertIn(word, result.message)
        with self.subTest("a recorder that was killed"):
            write_bag(self.bag)
            with open(self.bag, "r+b") as file:
                file.truncate(os.path.getsize(self.bag) // 2)
            result = answer()
            print(f"killed: {result.message}", flush=True)
            self.assertEqual(result.code, "bad_input")
            self.assertIn("excite.bag", result.message)
            self.assertIn("rosbag reindex", result.message)
        for request, word in ((dict(parameters=["inertai"]), "inertia"), (dict(parameters=["inertia"], start=[7.0]), "inertia"),
                              (dict(relative_tolerance=-1.0), "relative_tolerance")):
            write_bag(self.bag)
            result = answer(**request)
            print(f"goal: {result.message}", flush=True)
            self.assertEqual(result.code, "bad_input")
            self.assertIn(word, result.message)
        # Positions in degrees are read, with a warning; so are compressed bags.
        write_bag(self.bag, change=changed(position=degrees))
        self.assertIn("recording_units", [warning.code for warning in self.identify("strict").warnings])
        for compression in ("bz2", "lz4"):
            write_bag(self.bag, compression=compression)
            reply = self.identify("strict")
            self.assertTrue(reply.success, f"{compression}: {reply.message}")


if __name__ == "__main__":
    rospy.init_node("identify_test")
    rostest.rosrun("mechanism_codesign", "identify", IdentifyTest)
