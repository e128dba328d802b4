#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""codesign optimize on two hosts, which tools/two_hosts makes. Usage: two_hosts_test.py CODESIGN MPIRUN [-v]"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "test"))
from patience import PATIENCE, wait_until  # noqa: E402

TWO_HOSTS = os.path.join(ROOT, "tools", "two_hosts")
MODEL = os.path.join(ROOT, "urdf", "slider_crank.urdf")
CODESIGN, MPIRUN = "codesign", "mpirun"
NO_HOSTS = 3

ENSEMBLE = """
uncertain: {slider_width: {uniform: [0.02, 0.03]}}
robust: {measure: mean, samples: 8}
multistart: {starts: 6, screen: 24}
"""


def study_text(duration):
    with open(os.path.join(ROOT, "config", "slider_crank.yaml")) as file:
        text = file.read()
    for old, new in (("duration: 2.0", f"duration: {duration}"), ("max_evaluations: 200", "max_evaluations: 4"),
                     ("slider_width: {tune: true}", "slider_width: {tune: false}")):
        assert old in text, old
        text = text.replace(old, new)
    return text + ENSEMBLE


def without_times(path):
    with open(path) as file:
        result = json.load(file)
    return {key: value for key, value in result.items() if key not in ("cpu_seconds", "setup_seconds")}


class TwoHostsTest(unittest.TestCase):
    def setUp(self):
        if subprocess.run([TWO_HOSTS, "true"], stderr=subprocess.PIPE).returncode == NO_HOSTS:
            self.skipTest("no two hosts can be made here: that takes root, iproute2 and network namespaces")
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def job(self, option, folder, duration=0.1):
        study = self.path("study.yaml")
        with open(study, "w") as file:
            file.write(study_text(duration))
        return [CODESIGN, "optimize", MODEL, study, option, self.path(folder)]

    def on_hosts(self, words, ranks=4):
        return [TWO_HOSTS, MPIRUN, "-n", str(ranks), *words]

    def run_job(self, words):
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=2 * PATIENCE)

    def test_both_hosts_have_ranks(self):
        names = self.run_job(self.on_hosts(["hostname"])).stdout.split()
        self.assertEqual(sorted(names), ["alpha", "alpha", "beta", "beta"])

    def test_the_result_is_that_of_one_process(self):
        self.assertEqual(self.run_job(self.job("--output", "alone")).returncode, 0)
        done = self.run_job(self.on_hosts(self.job("--output", "spread")))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(without_times(self.path("spread", "result.json")), without_times(self.path("alone", "result.json")))

    def test_a_host_that_vanishes_is_missed_and_the_job_goes_on_without_it(self):
        job = subprocess.Popen(self.on_hosts(self.job("--output", "cut", duration=0.5)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True)
        journal = self.path("cut", "journal.jsonl")
        wait_until(lambda: os.path.exists(journal) and os.path.getsize(journal) >= 4000, "no evaluation", pause=0.01)
        subprocess.run(["ip", "-n", f"two_hosts_beta_{job.pid}", "link", "set", "cable", "down"], check=True)
        output = job.communicate(timeout=PATIENCE)[0]
        self.assertNotEqual(job.returncode, 0)
        with open(self.path("cut", "result.json")) as file:
            error = json.load(file)["error"]
        self.assertEqual(error["code"], "worker_lost", output)
        # Either rank 0 notices it first, by the silence, or mpirun, which then interrupts the job and may end it before it has printed the sentence.
        self.assertRegex(error["message"], r"rank [23] of 4 on host beta (has said nothing|does not answer)")
        done = self.run_job(self.job("--resume", "cut", duration=0.5))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_job(self.job("--output", "alone", duration=0.5)).returncode, 0)
        self.assertEqual(without_times(self.path("cut", "result.json")), without_times(self.path("alone", "result.json")))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    CODESIGN, MPIRUN = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
