#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""When .ci/run tests in a fresh Debian and when natively, with stand-ins for both tools. Usage: ci_test.py [-v]"""
import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def ci_run(fresh_exit, test_exit=0):
    """Exit code and output of .ci/run where tools/fresh and tools/test do nothing but say so and exit like this."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, ".ci"))
        os.mkdir(os.path.join(folder, "tools"))
        shutil.copy(os.path.join(ROOT, ".ci", "run"), os.path.join(folder, ".ci", "run"))
        for tool, status in (("fresh", fresh_exit), ("test", test_exit)):
            with open(os.path.join(folder, "tools", tool), "w") as file:
                file.write(f'#!/bin/sh\necho "{tool} called: $*"\nexit {status}\n')
            os.chmod(file.name, 0o755)
        result = subprocess.run(["bash", ".ci/run"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**os.environ, "CI": "true"})
    return result.returncode, result.stdout


class CiTest(unittest.TestCase):
    def test_tests_in_a_fresh_debian(self):
        status, output = ci_run(fresh_exit=0)
        self.assertEqual(status, 0)
        self.assertIn("fresh called: --copy build/test_results/ctest.xml bookworm env CI=true ./tools/test", output)
        self.assertNotIn("test called", output)

    def test_a_failure_stays_one(self):
        for code in (1, 2, 130):
            status, output = ci_run(fresh_exit=code)
            self.assertEqual(status, code)
            self.assertNotIn("test called", output)

    def test_tests_natively_only_where_no_debian_can_be_made(self):
        status, output = ci_run(fresh_exit=3, test_exit=0)
        self.assertEqual(status, 0)
        self.assertIn("natively", output)
        self.assertIn("test called", output)
        self.assertEqual(ci_run(fresh_exit=3, test_exit=8)[0], 8)


if __name__ == "__main__":
    unittest.main()
