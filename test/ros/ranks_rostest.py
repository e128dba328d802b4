#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The node `optimization` as rank 0 of mpirun: the same replies as alone, and a bag also when a rank is killed."""
import os
import shutil
import signal
import subprocess
import sys
import threading
import unittest

import rosbag
import rospy
import rostest
from mechanism_codesign.srv import EvaluateRequest, OptimizeRequest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_process import PATIENCE, SHARE, Launch, NodesTestCase, files, program_path, state_of, wait_until  # noqa: E402

CASE = "pendulum_robust"
FEW = OptimizeRequest(max_evaluations=2)
# For root and for machines with few processors, also in the words of Open MPI 5; and the time after which mpirun ends a node.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                  PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe", OMPI_MCA_odls_base_sigkill_timeout="7")


def has_mpi():
    node = program_path("optimization")
    return shutil.which("mpirun") and b"libmpi" in subprocess.run(["ldd", node], stdout=subprocess.PIPE, check=True).stdout


def mpirun(ranks):
    """The words of a launch-prefix. After the loss of a rank Open MPI 5 otherwise kills the others within half a second."""
    version = subprocess.run(["mpirun", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return ("mpirun", *(["--enable-recovery"] if "(Open MPI) 5." in version else []), "-n", str(ranks))


def ranks_of(name):
    """The processes of a node by rank."""
    found = {}
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline", "rb") as words, open(f"/proc/{process}/environ", "rb") as variables:
                rank = [v for v in variables.read().split(b"\0") if v.startswith(b"OMPI_COMM_WORLD_RANK=")]
                if rank and f"__name:={name}".encode() in words.read():
                    found[int(rank[0].split(b"=")[1])] = int(process)
        except OSError:
            continue
    return found


@unittest.skipUnless(has_mpi(), "this build has no MPI: install libopenmpi-dev and openmpi-bin, and build again")
class RanksTest(NodesTestCase):
    def start_node(self, name, ranks, engine=""):
        prefix = mpirun(ranks) if ranks > 1 else ()
        return self.start("optimization", name, model=CASE, prefix=prefix, study=self.study(engine), output_directory=self.folder)

    def study(self, engine):
        """The case with few samples, which do not take long."""
        with open(f"{SHARE}/config/{CASE}.yaml", encoding="utf-8") as file:
            text = file.read()
        assert "samples: 32, validate: 1000" in text
        path = os.path.join(self.folder, "study.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("samples: 32, validate: 1000", "samples: 3") + engine)
        return path

    def test_replies_are_those_of_a_node_alone(self):
        alone, spread = self.start_node("alone", 1), self.start_node("spread", 3)
        expected, reply = alone.optimize(FEW), spread.optimize(FEW)
        self.assertTrue(reply.success, reply.message)
        for field in ("tuned", "objective", "gradient", "evaluations", "steps", "termination"):
            self.assertEqual(getattr(reply, field), getattr(expected, field), field)
        one, other = alone.evaluate(EvaluateRequest()), spread.evaluate(EvaluateRequest())
        self.assertTrue(other.success, other.message)
        self.assertEqual((other.objective, other.gradient), (one.objective, one.gradient))
        self.assertEqual(sorted(ranks_of("spread")), [0, 1, 2])
        spread.end()
        self.assertEqual(ranks_of("spread"), {})

    def test_a_killed_rank_ends_the_job_with_a_bag(self):
        node = self.start_node("robbed", 3)
        answers = []

        def ask():
            try:
                answers.append(node.optimize(OptimizeRequest(max_evaluations=100000, relative_tolerance=1e-15)))
            except rospy.ServiceException as error:
                answers.append(error)

        thread = threading.Thread(target=ask)
        thread.start()
        wait_until(lambda: files(self.folder, ".best.json"), "no best point on disk")
        os.kill(ranks_of("robbed")[2], signal.SIGKILL)
        node.process.wait(PATIENCE)
        thread.join()
        (bag,) = files(self.folder, ".bag")
        with rosbag.Bag(bag) as opened:
            ((_, result, _),) = opened.read_messages(topics=["result"])
        self.assertEqual(result.code, "worker_lost", result.message)
        # Open MPI 4 ends the other ranks at once, and rank 0 calls the roll; under Open MPI 5 it notices the silence.
        self.assertRegex(result.message, r"rank 2 of 3 on host \S+ (does not answer|has said nothing for)")

    def test_the_launch_file_takes_a_prefix(self):
        launch = Launch("optimize.launch", f"case:={CASE}", "prefix:=mpirun -n 2", f"output_directory:={self.folder}")
        try:
            state_of("optimization", "^ready")
            wait_until(lambda: len(ranks_of("optimization")) == 2, "no second rank")
        finally:
            launch.end()
        self.assertEqual(ranks_of("optimization"), {})

    def test_another_engine_is_refused(self):
        node = self.start_node("threaded", 2, "\nengine: {type: threads}\n")
        reply = node.optimize(FEW)
        self.assertEqual(reply.code, "bad_input")
        self.assertIn("mpirun has started 2 processes", reply.message)


if __name__ == "__main__":
    rospy.init_node("ranks_test")
    rostest.rosrun("mechanism_codesign", "ranks", RanksTest)
