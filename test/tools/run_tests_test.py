#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What tools/run_tests runs in which pass, its exit code and its report, with a few tests of ctest that are made here. Usage: run_tests_test.py [-v]"""
import os
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LABELS = {"sum": "", "job": "slow", "master": "slow;waits", "page": "waits"}


class RunTestsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = folder.name
        self.results()

    def results(self, **failing):
        """The four tests of the build; those named with True fail."""
        with open(os.path.join(self.build, "CTestTestfile.cmake"), "w") as file:
            for name, labels in LABELS.items():
                file.write(f'add_test({name} "{"false" if failing.get(name) else "true"}")\nset_tests_properties({name} PROPERTIES LABELS "{labels}")\n')

    def run_tests(self, *words):
        """Exit code, and the names of the tests that ran, by pass."""
        result = subprocess.run([os.path.join(ROOT, "tools", "run_tests"), self.build, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        passes = re.split(r"tools/run_tests: the pass '\w+' took.*\n", result.stdout)[:-1]
        return result.returncode, [sorted(re.findall(r"Test +#\d+: (\w+) ", part)) for part in passes]

    def test_what_waits_runs_after_what_computes(self):
        self.assertEqual(self.run_tests(), (0, [["job", "sum"], ["master", "page"]]))

    def test_options_count_in_both_passes(self):
        self.assertEqual(self.run_tests("-LE", "slow"), (0, [["sum"], ["page"]]))
        self.assertEqual(self.run_tests("-L", "slow"), (0, [["job"], ["master"]]))
        self.assertEqual(self.run_tests("-R", "page|sum"), (0, [["sum"], ["page"]]))
        self.assertEqual(self.run_tests("-R", "page"), (0, [[], ["page"]]))

    def test_a_failure_of_either_pass_is_one(self):
        for name in ("sum", "page"):
            self.results(**{name: True})
            status, passes = self.run_tests()
            self.assertNotEqual(status, 0)
            self.assertEqual(passes, [["job", "sum"], ["master", "page"]])

    def test_what_failed_in_either_pass_is_run_again(self):
        self.results(sum=True, page=True)
        self.run_tests()
        self.assertEqual(self.run_tests("--rerun-failed")[1], [["page", "sum"]])

    def test_no_test_is_an_error(self):
        self.assertNotEqual(self.run_tests("-R", "nothing")[0], 0)

    def test_one_report_has_both_passes(self):
        self.results(page=True)
        report = os.path.join(self.build, "results", "all.xml")
        self.assertNotEqual(self.run_tests("--report", report)[0], 0)
        suite = ElementTree.parse(report).getroot()
        self.assertEqual((suite.get("tests"), suite.get("failures")), ("4", "1"))
        self.assertEqual({case.get("name"): case.get("status") for case in suite.iter("testcase")},
                         {"sum": "run", "job": "run", "master": "run", "page": "fail"})


if __name__ == "__main__":
    unittest.main()
