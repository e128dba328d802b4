#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""When .ci/run tests in fresh Debians and when natively, and what tools/ci does in which order, with stand-ins for the tools. Usage: ci_test.py [-v]"""
import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def stand_in(folder, name, text):
    path = os.path.join(folder, "tools", name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(f"#!/bin/bash\n{text}\n")
    os.chmod(path, 0o755)


def ci_run(bookworm="exit 0", trixie="exit 0", natively=0):
    """Exit code and output of .ci/run where tools/fresh does nothing but this for a release, and tools/ci exits like this."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, ".ci"))
        shutil.copy(os.path.join(ROOT, ".ci", "run"), os.path.join(folder, ".ci", "run"))
        stand_in(folder, "fresh", f'echo "fresh called: $*"\ncase $* in *bookworm*) {bookworm} ;; *) {trixie} ;; esac')
        stand_in(folder, "ci", f'echo "ci called: $*"\nexit {natively}')
        result = subprocess.run(["bash", ".ci/run"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**os.environ, "CI": "true"}, timeout=100)
    return result.returncode, result.stdout


# A run that ends when it is told to, as tools/fresh does, and never on its own.
LONG = 'trap "echo was ended; exit 143" TERM; echo began; while true; do sleep 0.1; done'


class CiTest(unittest.TestCase):
    def test_tests_in_fresh_debians(self):
        status, output = ci_run()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"12 \| fresh called: --copy build/test_results/ctest.xml bookworm env CI=true CODESIGN_CI_SECONDS=\d+ ./tools/ci plain")
        self.assertRegex(output, r"13 \| fresh called: --copy build/test_results/sanitized.xml trixie env CI=true CODESIGN_CI_SECONDS=\d+ ./tools/ci sanitized")
        self.assertNotIn("ci called", output)

    def test_both_run_at_the_same_time(self):
        with tempfile.TemporaryDirectory() as folder:
            # Each waits for the other.
            meet = "touch {0}/{1}; while [ ! -f {0}/{2} ]; do sleep 0.1; done; exit 0"
            self.assertEqual(ci_run(meet.format(folder, "a", "b"), meet.format(folder, "b", "a"))[0], 0)

    def test_a_failure_of_either_is_one_and_ends_the_other(self):
        for code in (1, 2, 130):
            for releases in ({"bookworm": f"exit {code}", "trixie": LONG}, {"bookworm": LONG, "trixie": f"exit {code}"}):
                status, output = ci_run(**releases)
                self.assertEqual(status, code, output)
                self.assertNotIn("ci called", output)
                if "began" in output:
                    self.assertIn("was ended", output)

    def test_a_failure_after_the_other_is_done_is_one(self):
        self.assertEqual(ci_run("exit 0", "sleep 0.5; exit 4")[0], 4)
        self.assertEqual(ci_run("sleep 0.5; exit 4", "exit 0")[0], 4)

    def test_tests_natively_only_where_no_debian_can_be_made(self):
        status, output = ci_run("exit 3", "exit 3")
        self.assertEqual(status, 0)
        self.assertIn("natively", output)
        self.assertIn("ci called: plain sanitized\n", output)
        self.assertEqual(ci_run("exit 3", "exit 3", natively=8)[0], 8)
        self.assertIn("ci called: plain\n", ci_run("exit 3", "exit 0")[1])
        status, output = ci_run("exit 0", "exit 3")
        self.assertEqual(status, 0)
        self.assertIn("no fresh Debian 13", output)
        self.assertNotIn("ci called", output)


def tools_ci(seconds, exits, parts=(), changed="echo src/engine/dispatcher.cc"):
    """Exit code and output of tools/ci, with stand-ins that exit as `exits` says by name."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "tools"))
        shutil.copy(os.path.join(ROOT, "tools", "ci"), os.path.join(folder, "tools", "ci"))
        for tool in ("test", "setup", "build", "check", "sanitize", "tour", "demo"):
            stand_in(folder, tool, f'echo "{tool} called: $*"\nexit {exits.get(tool, 0)}')
        stand_in(folder, "changed", changed)
        result = subprocess.run(["bash", "tools/ci", *parts], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, env={**os.environ, "CODESIGN_CI_SECONDS": str(seconds)})
    return result.returncode, [line for line in result.stdout.splitlines() if " called" in line or "no time" in line or "nothing was" in line]


SKIPPED = r"^(tools_(check|clone|doc)|panel_page|.*_panel\.test)$"
PLAIN = ["setup called: --headless", "build called: all tests", "test called: ", "setup called: --headless --checks --pages", "test called: -R " + SKIPPED,
         "check called: format layering scripts", "tour called: --built --quick", "check called: tidy", "sanitize called: thread"]
SANITIZED = ["setup called: ", "build called: all", "demo called: ", "test called: --release",
             "sanitize called: address --quick --report build/test_results/sanitized.xml"]


class ToolsCiTest(unittest.TestCase):
    def test_everything_in_order(self):
        self.assertEqual(tools_ci(600, {}), (0, PLAIN + SANITIZED))
        self.assertEqual(tools_ci(600, {}, ["plain"]), (0, PLAIN))
        self.assertEqual(tools_ci(600, {}, ["sanitized"]), (0, SANITIZED))

    def test_an_unknown_part_is_refused(self):
        self.assertEqual(tools_ci(600, {}, ["plane"]), (2, []))

    def test_a_failure_ends_it(self):
        self.assertEqual(tools_ci(600, {"test": 8}, ["plain"]), (8, PLAIN[:3]))
        self.assertEqual(tools_ci(600, {"sanitize": 3}), (3, PLAIN))
        self.assertEqual(tools_ci(600, {"demo": 1}, ["sanitized"]), (1, SANITIZED[:3]))

    def test_the_thread_sanitizer_runs_where_what_threads_run_was_changed(self):
        for name in ("src/engine/dispatcher.cc", "test/equations/equation_variant_test.cc", "src/ros/common/worker.h", "test/sensitivity/threads_test.cc"):
            self.assertIn("sanitize called: thread", tools_ci(600, {}, ["plain"], f"echo README.md; echo {name}")[1])
        self.assertIn("sanitize called: thread", tools_ci(600, {}, ["plain"], "exit 1")[1])
        lines = tools_ci(600, {}, ["plain"], "echo src/reading/xml/place.cc")[1]
        self.assertNotIn("sanitize called: thread", lines)
        self.assertEqual(lines[-1], "tools/ci: nothing was changed that several threads run: no tools/sanitize thread")

    def test_what_there_is_no_time_for_is_named(self):
        status, lines = tools_ci(10, {"check": 1, "sanitize": 1})
        self.assertEqual(status, 0)
        self.assertEqual([line for line in lines if "no time" not in line], PLAIN[:4] + SANITIZED[:3])
        self.assertEqual([line for line in lines if "no time" in line],
                         [f"tools/ci: no time was left for: {words}" for words in
                          ("env -u CI tools/test -R " + SKIPPED, "tools/check format layering scripts", "tools/tour --built --quick", "tools/check tidy",
                           "tools/sanitize thread", "env -u CI tools/test --release",
                           "tools/sanitize address --quick --report build/test_results/sanitized.xml")])


if __name__ == "__main__":
    unittest.main()
