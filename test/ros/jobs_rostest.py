#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The files that jobs leave: after Ctrl-C, cancel, kill -9, a full disk and absurd requests, and by two nodes in the same second."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import rosbag
import rospy
import rostest
from actionlib_msgs.msg import GoalID
from mechanism_codesign.srv import EvaluateRequest, OptimizeRequest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import Node, NodesTestCase, files, study_of, wait_until  # noqa: E402

LONG = OptimizeRequest(relative_tolerance=1e-15, max_evaluations=100000)
SHORT = OptimizeRequest(max_evaluations=1)
SECONDS = 20  # of a run of LONG, which makes it minutes of computing


class JobsTest(NodesTestCase):
    def start_job_node(self, name, **parameters):
        return self.start("optimization", name, **{"output_directory": self.folder, **parameters})

    def result_of(self, bag):
        with rosbag.Bag(bag) as opened:
            ((_, result, _),) = opened.read_messages(topics=["result"])
            frames = opened.get_message_count(["tuned/joint_states"])
        return result, frames

    def in_background(self, node, request):
        """Starts a job through the service and returns once a point of it is on disk."""
        answers = []

        def ask():
            try:
                answers.append(node.optimize(request))
            except rospy.ServiceException as error:
                answers.append(error)

        thread = threading.Thread(target=ask)
        thread.start()
        wait_until(lambda: files(self.folder, ".best.json"), "no best point on disk")
        return thread, answers

    def test_two_nodes_that_finish_in_the_same_seconds(self):
        # So short that several jobs end within a second.
        nodes = [self.start_job_node(f"twin_{k}", study=study_of(0.2), set={"crank_length": value}) for k, value in enumerate((0.07, 0.09))]
        replies = [[], []]

        def ask(k):
            for _ in range(15):
                replies[k].append(nodes[k].optimize(SHORT))

        threads = [threading.Thread(target=ask, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        bags = [reply.bag for reply in replies[0] + replies[1]]
        self.assertEqual(len(set(bags)), 30, "each job has a bag of its own")
        for reply in replies[0] + replies[1]:
            self.assertTrue(reply.success, reply.message)
            result, frames = self.result_of(reply.bag)
            self.assertEqual(list(result.initial), list(reply.initial))
            self.assertEqual(result.bag, reply.bag)
            self.assertEqual(frames, 11)
        folders = [bag[:-len(".bag")] for bag in bags]
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(map(os.path.basename, bags + folders)), "nothing else is left")

    def test_an_interrupted_node_leaves_the_bag_of_a_job_of_the_service(self):
        for kind in (signal.SIGINT, signal.SIGTERM):
            node = self.start_job_node("interrupted", study=study_of(SECONDS), output_directory=os.path.relpath(self.folder))
            thread, answers = self.in_background(node, LONG)
            node.end(kind)
            thread.join()
            (bag,) = files(self.folder, ".bag")
            self.assertEqual(getattr(answers[0], "code", answers[0]), "cancelled", "the client has its answer")
            self.assertEqual(answers[0].bag, bag, "an absolute path, though the parameter is relative")
            self.assertLessEqual(answers[0].objective, answers[0].initial_objective)
            result, frames = self.result_of(bag)
            self.assertEqual(result.code, "cancelled")
            self.assertEqual(frames, 1 + 50 * SECONDS)
            journal = bag.replace(".bag", ".journal.jsonl")
            folder = bag[:-len(".bag")]
            self.assertEqual(sorted(os.listdir(self.folder)), sorted(map(os.path.basename, (bag, journal, folder))), "it can be gone on with")
            self.assertTrue(os.path.exists(os.path.join(folder, "result.json")))
            shutil.rmtree(folder)
            os.remove(bag)
            os.remove(journal)

    def test_a_job_of_the_service_can_be_cancelled(self):
        node = self.start_job_node("cancelled", study=study_of(SECONDS))
        cancel = rospy.Publisher("/cancelled/optimize/cancel", GoalID, queue_size=1)
        wait_until(lambda: cancel.get_num_connections() > 0, "nobody listens to cancel")
        thread, answers = self.in_background(node, LONG)
        cancel.publish(GoalID())
        thread.join()
        self.assertEqual(answers[0].code, "cancelled")
        self.assertLessEqual(answers[0].objective, answers[0].initial_objective)
        self.assertEqual(self.result_of(answers[0].bag)[0].objective, answers[0].objective)

    def test_a_killed_node_leaves_its_best_point_and_the_next_one_cleans_up(self):
        node = self.start_job_node("killed", study=study_of(SECONDS))
        thread, _ = self.in_background(node, LONG)
        node.end(signal.SIGKILL)
        thread.join()
        self.assertEqual(files(self.folder, ".bag"), [])
        (best,) = files(self.folder, ".best.json")
        with open(best, encoding="utf-8") as file:
            point = json.load(file)
        self.assertGreater(point["objective"], 0.0)
        model = best.replace(".json", ".urdf")
        subprocess.run(["rosrun", "mechanism_codesign", "codesign", "check", model], check=True, stdout=subprocess.DEVNULL)
        next_node = self.start_job_node("killed")
        self.assertTrue(next_node.optimize(SHORT).success)
        self.assertEqual(files(self.folder, ".active") + files(self.folder, ".job") + files(self.folder, ".part"), [])
        self.assertEqual(files(self.folder, ".best.json"), [best], "the best point stays")
        next_node.end()
        self.assertIn("a job was killed", next_node.output())
        self.assertIn(best, next_node.output())
        (journal,) = files(self.folder, ".journal.jsonl")
        self.assertEqual(journal, best.replace(".best.json", ".journal.jsonl"))
        name = os.path.basename(journal).replace(".journal.jsonl", "")
        self.assertIn(f"a request with resume: {name} goes on with it", next_node.output())

    def test_a_running_job_keeps_its_files_when_another_node_starts(self):
        node = self.start_job_node("running", study=study_of(SECONDS))
        thread, answers = self.in_background(node, LONG)
        other = self.start_job_node("starting")
        self.assertTrue(other.optimize(SHORT).success)
        node.end(signal.SIGINT)
        thread.join()
        self.assertEqual(len(files(self.folder, ".bag")), 2)

    def test_requests_beyond_all_bounds_are_answered(self):
        """At once: comparing each of these names with all others would take longer than the test may."""
        node = self.start_job_node("asked")
        names = [f"parameter_{k}" for k in range(1000000)]
        for reply in (node.optimize(OptimizeRequest(parameters=names)),
                      node.evaluate(EvaluateRequest(parameters=names, values=[0.0] * len(names))),
                      node.optimize(OptimizeRequest(parameters=["x" * 50000])),
                      node.optimize(OptimizeRequest(algorithm="x" * 1000000))):
            self.assertEqual(reply.code, "bad_input")
            self.assertLess(len(reply.message), 1000)
        node.end()

    @unittest.skipUnless(os.geteuid() == 0, "only root can make a disk of a few kilobytes")
    def test_a_full_disk_costs_the_bag_and_nothing_else(self):
        disk = tempfile.mkdtemp()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", disk], check=False).returncode != 0:
            self.skipTest("no disk can be mounted here")
        try:
            node = Node("optimization", "full", output_directory=disk)
            self.nodes.append(node)
            for free in (0, 4, 16, 40, 64, 100, 140, 180):
                with open(f"{disk}/filler", "wb") as file:
                    file.write(b"x" * (200 - free) * 1024)
                reply = node.optimize(SHORT)
                self.assertEqual(reply.code, "output_failed", f"{free} kB free: {reply.message}")
                if reply.tuned:
                    self.assertIn("No space left on device", reply.message)
                    self.assertGreater(reply.initial_objective, 0.0)
                self.assertEqual(files(disk, ".active") + files(disk, ".bag") + files(disk, ".part"), [])
                for name in os.listdir(disk):
                    os.remove(f"{disk}/{name}")
            self.assertIsNone(node.process.poll(), "the node is up")
            self.assertEqual(self.start_job_node("beside").optimize(SHORT).code, "success")
            node.end()
        finally:
            subprocess.run(["umount", "-l", disk], check=True)


if __name__ == "__main__":
    rospy.init_node("jobs_test")
    rostest.rosrun("mechanism_codesign", "jobs", JobsTest)
