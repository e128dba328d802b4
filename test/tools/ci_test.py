#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""When .ci/run tests in a fresh Debian and when natively, and what tools/ci does in which order, with stand-ins for the tools. Usage: ci_test.py [-v]"""
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
        for tool, status in (("fresh", fresh_exit), ("ci", test_exit)):
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
        self.assertIn("fresh called: trixie env CI=true ./tools/test", output)
        self.assertRegex(output, r"fresh called: --copy build/test_results/ctest.xml bookworm env CI=true CODESIGN_CI_SECONDS=\d+ ./tools/ci")
        self.assertNotIn("ci called", output)

    def test_a_failure_stays_one(self):
        for code in (1, 2, 130):
            status, output = ci_run(fresh_exit=code)
            self.assertEqual(status, code)
            self.assertNotIn("ci called", output)

    def test_tests_natively_only_where_no_debian_can_be_made(self):
        status, output = ci_run(fresh_exit=3, test_exit=0)
        self.assertEqual(status, 0)
        self.assertIn("natively", output)
        self.assertIn("ci called", output)
        self.assertEqual(ci_run(fresh_exit=3, test_exit=8)[0], 8)


def tools_ci(seconds, exits):
    """Exit code and output of tools/ci, with stand-ins that exit as `exits` says by name."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "tools"))
        shutil.copy(os.path.join(ROOT, "tools", "ci"), os.path.join(folder, "tools", "ci"))
        for tool in ("test", "setup", "check", "sanitize", "tour"):
            with open(os.path.join(folder, "tools", tool), "w") as file:
                file.write(f'#!/bin/sh\necho "{tool} called: $*"\nexit {exits.get(tool, 0)}\n')
            os.chmod(file.name, 0o755)
        result = subprocess.run(["bash", "tools/ci"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, env={**os.environ, "CODESIGN_CI_SECONDS": str(seconds)})
    return result.returncode, [line for line in result.stdout.splitlines() if " called" in line or "no time" in line]


SKIPPED = r"^(tools_(check|clone|doc)|panel_page|.*_panel\.test)$"


class ToolsCiTest(unittest.TestCase):
    def test_everything_in_order(self):
        status, lines = tools_ci(600, {})
        self.assertEqual(status, 0)
        self.assertEqual(lines, ["test called: ", "setup called: --headless --checks --pages", "test called: -R " + SKIPPED, "check called: format layering scripts", "tour called: --built --quick",
                                 "check called: tidy",                                 "sanitize called: address", "sanitize called: thread"])

    def test_a_failure_ends_it(self):
        self.assertEqual(tools_ci(600, {"test": 8}), (8, ["test called: "]))
        status, lines = tools_ci(600, {"sanitize": 3})
        self.assertEqual(status, 3)
        self.assertEqual(lines[-1], "sanitize called: address")

    def test_what_there_is_no_time_for_is_named(self):
        status, lines = tools_ci(10, {"check": 1, "sanitize": 1})
        self.assertEqual(status, 0)
        self.assertEqual(lines[0], "test called: ")
        self.assertEqual([line for line in lines if "no time" in line],
                         [f"tools/ci: no time was left for: {words}" for words in
                          ("env -u CI tools/test -R " + SKIPPED, "tools/check format layering scripts", "tools/tour --built --quick", "tools/check tidy", "tools/sanitize address", "tools/sanitize thread")])


if __name__ == "__main__":
    unittest.main()
