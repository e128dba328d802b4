#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Completion and the manual page know what the program knows, and a shell finds all three.

Usage: command_line_test.py CODESIGN MANUAL [SETUP.BASH]
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BASH = os.path.join(ROOT, "completion", "codesign.bash")


def usage():
    return subprocess.run([sys.argv[1], "--help"], capture_output=True, text=True, check=True).stdout


def manual_page():
    with open(sys.argv[2], encoding="utf-8") as file:
        return file.read()


def complete(*typed, folder=ROOT, program=None):
    """What bash offers for the last of the words."""
    quoted = " ".join(f"'{word}'" for word in (program or sys.argv[1], *typed))
    script = f'. "{BASH}"; COMP_WORDS=({quoted}); COMP_CWORD={len(typed)}; _codesign; printf "%s\\n" "${{COMPREPLY[@]}}"'
    done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True, cwd=folder)
    return done.stdout.split()


class CommandLine(unittest.TestCase):
    def test_all_know_the_same_words(self):
        options = set(re.findall(r"--[a-z]+", usage()))
        commands = set(re.findall(r"^  ([a-z]+) ", usage(), re.MULTILINE))
        self.assertIn("--result", options)
        self.assertIn("report", commands)
        self.assertGreaterEqual(set(complete("")), commands)
        manual = manual_page().replace("\\-", "-")
        offered = {word for command in commands for word in complete(command, "-")}
        for word in options | commands:
            self.assertRegex(manual, rf"(?<![a-z-]){word}(?![a-z])", f"the manual page does not know {word}")
        self.assertLessEqual(options, offered)

    def test_zsh_offers_the_same(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed")
        for command in set(re.findall(r"^  ([a-z]+) ", usage(), re.MULTILINE)) - {"help"}:
            script = (f'source {ROOT}/completion/codesign.zsh; _arguments() {{ print -rl -- "$@"; }}; '
                      f'words=({sys.argv[1]} {command} ""); CURRENT=3; _codesign')
            done = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, check=True)
            self.assertEqual(set(re.findall(r"^\*?(--?[a-z][a-z-]*)", done.stdout, re.MULTILINE)) | {"--help"}, set(complete(command, "-")))

    def test_bash_offers_what_fits(self):
        self.assertEqual(complete("opt"), ["optimize"])
        self.assertEqual(complete("simulate", "--sa"), ["--samples"])
        self.assertEqual(complete("optimize", "--sa"), [])
        self.assertEqual(complete("gradient", "m", "--verify", "=", "rid"), ["ridders"])
        self.assertIn("urdf/governor.urdf", complete("check", "urdf/gov"))
        self.assertEqual(complete("check", "CMakeLi"), [])
        self.assertEqual(complete("optimize", "a", "b", "--output", "scri"), ["scripts"])
        self.assertEqual(complete("new", "mine", "--f"), ["--from"])
        self.assertEqual(complete("new", "mine", "--from", "tog"), ["toggle_press"])

    def test_a_start_without_bags_loads_no_library_of_ros(self):
        loaded = subprocess.run(["ldd", sys.argv[1]], capture_output=True, text=True, check=True).stdout
        self.assertIn("codesign_core", loaded)
        self.assertNotRegex(loaded, r"lib(rosbag|roscpp|rostime|class_loader|codesign_bags)")

    def test_a_shell_that_sources_the_setup_finds_it(self):
        if len(sys.argv) < 4:
            self.skipTest("there is no setup file without ROS")
        script = f'PS1=x; . "{sys.argv[3]}"; . "{sys.argv[3]}"; command -v codesign; complete -p codesign; echo "$PATH"'
        done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True)
        program, completion, path = done.stdout.splitlines()
        self.assertEqual(os.path.realpath(program), os.path.realpath(sys.argv[1]))
        self.assertIn("_codesign", completion)
        self.assertEqual(path.split(":").count(os.path.dirname(program)), 1, "sourcing twice adds nothing")
        silent = subprocess.run(["bash", "--norc", "-c", f'  . "{sys.argv[3]}"; complete -p codesign'], capture_output=True, text=True, check=False)
        self.assertNotEqual(silent.returncode, 0, "a script needs no completion")

    def test_the_manual_is_troff(self):
        text = manual_page()
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=text, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertIn("codesign report", re.sub(r"\x1b\[[0-9]*m|.\x08", "", done.stdout))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
