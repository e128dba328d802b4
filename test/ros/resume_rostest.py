#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Jobs of the action over runs, samples and starts: killed and gone on with, cancelled, their progress, and signals with bounds."""
import math
import os
import signal
import sys
import threading

import actionlib
import rosbag
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from mechanism_codesign.msg import OptimizationProgress, OptimizeAction, OptimizeGoal
from mechanism_codesign.srv import EvaluateRequest, OptimizeRequest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, SHARE, NodesTestCase, content, files, wait_for_topic, wait_until  # noqa: E402
from robot_node import Latest  # noqa: E402

# Searches over two runs at three samples, on two threads: 36 runs of screening, then searches, then 400 runs of validation.
BLOCKS = """
runs: {slow: {}, fast: {controllers: {crank_speed: {setpoint: -12.0}}}}
uncertain: {slider_width: {uniform: [0.02, 0.03]}}
robust: {measure: mean, samples: 3, validate: 200}
multistart: {starts: 3, screen: 6}
engine: {workers: 2}
"""
CIRCUMSTANCES = ("cpu_seconds", "setup_seconds", "bag", "job", "remembered_runs")


def text_without_circumstances(result):
    """All that does not depend on when, where and in how many processes a job ran."""
    return {name: str(getattr(result, name)) for name in result.__slots__ if name not in CIRCUMSTANCES}


def evaluations_in(folder):
    """How many evaluations are in the journals of a folder."""
    count = 0
    for journal in files(folder, ".journal.jsonl"):
        with open(journal, "rb") as file:
            count += max(0, file.read().count(b"\n") - 1)
    return count


class Job:
    """A goal of a node's action, and its feedback so far."""

    def __init__(self, name, goal):
        self.progress = []
        self.client = actionlib.SimpleActionClient(f"/{name}/optimize", OptimizeAction)
        assert self.client.wait_for_server(rospy.Duration(PATIENCE)), "no action"
        self.client.send_goal(goal, feedback_cb=lambda feedback: self.progress.append(feedback.progress))

    def wait_for(self, condition):
        """Waits for feedback that meets the condition, and returns it."""
        wait_until(lambda: any(map(condition, self.progress)), "no such progress")
        return next(filter(condition, self.progress))

    def result(self):
        assert self.client.wait_for_result(rospy.Duration(5 * PATIENCE)), "no result"
        return self.client.get_result()


class ResumeTest(NodesTestCase):
    def study(self, blocks=BLOCKS, duration="0.5"):
        with open(f"{SHARE}/config/slider_crank.yaml", encoding="utf-8") as file:
            text = file.read()
        for old, new in (("duration: 2.0", f"duration: {duration}"), ("slider_width: {tune: true}", "slider_width: {tune: false}")):
            assert old in text, old
            text = text.replace(old, new)
        path = f"{self.folder}/study_{len(files(self.folder, '.yaml'))}.yaml"
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + blocks)
        return path

    def start_node(self, name, **parameters):
        return self.start("optimization", name, output_directory=f"{self.folder}/out", **parameters)

    def tuned_states(self, bag):
        with rosbag.Bag(bag) as opened:
            return [(message.position, message.velocity, message.effort) for topic in ("tuned/joint_states", "worst/tuned/joint_states")
                    for _, message, _ in opened.read_messages(topics=[topic])]

    def test_a_killed_node_goes_on_and_computes_nothing_twice(self):
        study = self.study()
        self.start_node("whole", study=study)
        goal = OptimizeGoal(max_evaluations=12)
        whole = Job("whole", goal).result()
        self.assertTrue(whole.success, whole.message)
        # A search that begins at the study's start evaluates the values that the result reports for the start.
        computed = whole.runs - whole.remembered_runs
        self.assertGreater(computed, 500)
        out, name, before = f"{self.folder}/out", "", 0
        # While screening, searching, and validating.
        for least in (10, 60, computed - 300):
            node = self.start_node("killed", study=study)
            Job("killed", OptimizeGoal(max_evaluations=12, resume=name))
            wait_until(lambda: evaluations_in(out) >= max(least, before + 1), "nothing is computed")
            node.end(signal.SIGKILL)
            (journal,) = files(out, ".journal.jsonl")
            if name:
                self.assertEqual(os.path.basename(journal), f"{name}.journal.jsonl")
            name = os.path.basename(journal)[:-len(".journal.jsonl")]
            self.assertTrue(before < evaluations_in(out) < computed)
            before = evaluations_in(out)
        self.start_node("killed", study=study)
        resumed = Job("killed", OptimizeGoal(max_evaluations=12, resume=name)).result()
        self.assertEqual(text_without_circumstances(resumed), text_without_circumstances(whole))
        self.assertEqual(before + resumed.runs - resumed.remembered_runs, computed, "nothing is computed twice")
        print(f"killed: {computed} evaluations, {before} of them before the last kill", flush=True)
        self.assertEqual(resumed.job, name)
        self.assertEqual(self.tuned_states(resumed.bag), self.tuned_states(whole.bag))
        left = [path for job in (whole, resumed) for path in (job.bag, job.bag[:-len(".bag")])]
        self.assertEqual(sorted(os.listdir(out)), sorted(map(os.path.basename, left)), "nothing else is left")

    def test_only_the_same_job_is_gone_on_with(self):
        study = self.study()
        node = self.start_node("killed_once", study=study)
        job = Job("killed_once", OptimizeGoal())
        name = job.wait_for(lambda progress: progress.runs > 0).job
        # A job that runs is not taken over by another node.
        other = self.start_node("other", study=study, set={"crank_length": 0.09})
        reply = other.optimize(OptimizeRequest(resume=name))
        self.assertEqual(reply.code, "busy", reply.message)
        node.end(signal.SIGKILL)
        for request, sentence in ((OptimizeRequest(resume=name), "the values of the parameters at the start"),
                                  (OptimizeRequest(resume=f"../out/{name}"), "not the name of a job"),
                                  (OptimizeRequest(resume="nothing_2026-01-01-00-00-00"), "there is no journal")):
            reply = other.optimize(request)
            self.assertEqual(reply.code, "bad_input")
            self.assertIn(sentence, reply.message)
        again = self.start_node("again", study=self.study(BLOCKS.replace("200", "201")))
        self.assertIn("the study differs", again.optimize(OptimizeRequest(resume=name)).message)
        self.assertEqual(len(files(f"{self.folder}/out", ".journal.jsonl")), 1, "the journal stays")
        again.end()

    def test_feedback_tells_every_stage(self):
        self.start_node("told", study=self.study(BLOCKS.replace("validate: 200", "validate: 400"), duration="1.0"))
        # The client drops feedback that the result has overtaken; the topic has all of it.
        topic = Latest("/told/optimization_progress", OptimizationProgress)
        wait_for_topic("/told", topic.subscriber)
        job = Job("told", OptimizeGoal(max_evaluations=12))
        result = job.result()
        self.assertTrue(result.success, result.message)
        wait_until(lambda: topic.messages and topic.last().seconds_left == 0.0, "no last message")
        self.assertTrue(job.progress and set(map(content, job.progress)) <= set(map(content, topic.messages)))
        stages = [progress.stage for progress in topic.messages]
        self.assertEqual(sorted(set(stages), key=stages.index), ["screening", "searching", "validating"])
        runs = [progress.runs for progress in topic.messages]
        self.assertEqual(runs, sorted(runs))
        self.assertEqual(runs[-1], result.runs)
        for progress in topic.messages:
            self.assertEqual(progress.job, result.job)
            self.assertTrue(math.isnan(progress.seconds_left) or progress.seconds_left >= 0.0)
            self.assertLessEqual(progress.done, progress.of)
            self.assertEqual(progress.evaluation > 0, progress.code != "")
        searching = [progress for progress in topic.messages if progress.stage == "searching"]
        self.assertGreater(searching[-1].runs_per_second, 0.0)

    def test_a_cancel_is_answered_on_the_way(self):
        """While screening, while searching over many samples, and while validating, before as many runs as that would take."""
        cases = (("screening", BLOCKS.replace("screen: 6", "screen: 3000"), lambda progress: progress.stage == "screening", 3000),
                 ("searching", BLOCKS.replace("samples: 3", "samples: 150").replace("multistart: {starts: 3, screen: 6}\n", ""),
                  lambda progress: progress.stage == "searching" and progress.runs > 100, 600),
                 ("searches", BLOCKS.replace("samples: 3", "samples: 16"), lambda progress: progress.search == 2, 900),
                 ("validating", BLOCKS.replace("validate: 200", "validate: 20000"), lambda progress: progress.stage == "validating", 20000))
        for name, blocks, under_way, most in cases:
            with self.subTest(name):
                self.start_node(name, study=self.study(blocks, duration="2.0"))
                job = Job(name, OptimizeGoal(max_evaluations=4))
                job.wait_for(under_way)
                job.client.cancel_goal()
                result = job.result()
                print(f"{name}: cancelled after {result.runs} runs", flush=True)
                self.assertLess(result.runs, most)
                self.assertEqual(job.client.get_state(), GoalStatus.PREEMPTED)
                self.assertEqual(result.code, "cancelled")
                self.assertTrue(os.path.exists(result.bag))
                self.assertEqual(len(result.tuned), 4)
                # Before the first trial point the best point is the start, which has no objective yet; screening has one.
                self.assertEqual(math.isfinite(result.objective), result.evaluations > 0)
                self.assertEqual(math.isfinite(result.initial_objective), result.evaluations > 0 and name != "screening")

    def test_signals_with_bounds(self):
        node = self.start_node("arm", model="arm_limits")
        reply = node.optimize(OptimizeRequest(max_evaluations=2))
        signals = {one.signal: one for one in reply.signals}
        self.assertEqual(list(signals), ["shoulder/effort", "elbow/effort", "shoulder/velocity", "elbow/velocity"])
        self.assertEqual([(one.element, one.lower, one.upper) for one in reply.signals][:2], [("path[0]", -18.0, 18.0), ("path[1]", -5.8, 5.8)])
        for one in reply.signals:
            self.assertLess(one.smallest, one.largest)
            self.assertEqual((one.after, one.before), (0.0, 2.0))
            self.assertTrue(0.0 <= one.smallest_time <= 2.0 and 0.0 <= one.largest_time <= 2.0)
            self.assertAlmostEqual(one.violation, max(0.0, one.lower - one.smallest, one.largest - one.upper), delta=1e-9)
        evaluation = node.evaluate(EvaluateRequest(parameters=reply.parameters, values=reply.tuned))
        self.assertEqual([(one.smallest, one.largest) for one in evaluation.signals], [(one.smallest, one.largest) for one in reply.signals])


if __name__ == "__main__":
    rospy.init_node("resume_test")
    rostest.rosrun("mechanism_codesign", "resume", ResumeTest)
