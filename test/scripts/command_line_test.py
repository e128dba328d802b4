#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Completion and the manual page know what the program knows, and a shell finds all three.

Usage: command_line_test.py CODESIGN [SETUP.BASH]
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BASH = os.path.join(ROOT, "completion", "codesign.bash")


def text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def usage():
    return subprocess.run([sys.argv[1], "--help"], capture_output=True, text=True, check=True).stdout


def complete(*typed, folder=ROOT, program="codesign"):
    """What bash offers for the last of the words."""
    quoted = " ".join(f"'{word}'" for word in (program, *typed))
    script = f'. "{BASH}"; COMP_WORDS=({quoted}); COMP_CWORD={len(typed)}; _codesign; printf "%s\\n" "${{COMPREPLY[@]}}"'
    done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True, cwd=folder)
    return done.stdout.split()


class CommandLine(unittest.TestCase):
    def test_all_know_the_same_words(self):
        options = set(re.findall(r"--[a-z]+", usage()))
        commands = set(re.findall(r"^  ([a-z]+) ", usage(), re.MULTILINE))
        self.assertIn("--result", options)
        self.assertIn("report", commands)
        for place in (("completion", "codesign.bash"), ("completion", "codesign.zsh"), ("man", "codesign.1.in")):
            text = text_of(*place).replace("\\-", "-")
            for word in options | commands:
                self.assertRegex(text, rf"(?<![a-z-]){word}(?![a-z])", f"{place} does not know {word}")

    def test_bash_offers_what_fits(self):
        self.assertEqual(complete("opt"), ["optimize"])
        self.assertEqual(complete("simulate", "--sa"), ["--samples"])
        self.assertEqual(complete("optimize", "--sa"), [])
        self.assertEqual(complete("gradient", "m", "--verify", "=", "rid"), ["ridders"])
        self.assertIn("urdf/governor.urdf", complete("check", "urdf/gov"))
        self.assertEqual(complete("check", "CMakeLi"), [])
        self.assertEqual(complete("optimize", "a", "b", "--output", "scri"), ["scripts"])
        self.assertEqual(complete("new", "mine", "--f"), ["--from"])
        self.assertEqual(complete("new", "mine", "--from", "tog", program=sys.argv[1]), ["toggle_press"])

    def test_a_start_without_bags_loads_no_library_of_ros(self):
        loaded = subprocess.run(["ldd", sys.argv[1]], capture_output=True, text=True, check=True).stdout
        self.assertIn("codesign_core", loaded)
        self.assertNotRegex(loaded, r"lib(rosbag|roscpp|rostime|class_loader|codesign_bags)")

    def test_a_shell_that_sources_the_setup_finds_it(self):
        if len(sys.argv) < 3:
            self.skipTest("there is no setup file without ROS")
        script = f'PS1=x; . "{sys.argv[2]}"; . "{sys.argv[2]}"; command -v codesign; complete -p codesign; echo "$PATH"'
        done = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True)
        program, completion, path = done.stdout.splitlines()
        self.assertEqual(os.path.realpath(program), os.path.realpath(sys.argv[1]))
        self.assertIn("_codesign", completion)
        self.assertEqual(path.split(":").count(os.path.dirname(program)), 1, "sourcing twice adds nothing")
        silent = subprocess.run(["bash", "--norc", "-c", f'. "{sys.argv[2]}"; complete -p codesign'], capture_output=True, text=True, check=False)
        self.assertNotEqual(silent.returncode, 0, "a script needs no completion")

    def test_the_manual_is_troff(self):
        text = text_of("man", "codesign.1.in").replace("@codesign_version@", "1.0")
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=text, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertIn("codesign report", re.sub(r"\x1b\[[0-9]*m|.\x08", "", done.stdout))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
