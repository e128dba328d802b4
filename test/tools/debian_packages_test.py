#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Which Debian package a file belongs to, and Debian's changelog; tools/package --try makes and installs the packages. Usage: debian_packages_test.py [-v]"""
import importlib.machinery
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("debian_packages", os.path.join(ROOT, "tools", "debian_packages"))
packages = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(packages)


class DebianPackagesTest(unittest.TestCase):
    def test_what_needs_ros_is_apart(self):
        for path, package in (("bin/codesign", "mechanism-codesign"), ("lib/libcodesign_core.so", "mechanism-codesign"), ("lib/x86_64-linux-gnu/libcodesign_core.so", "mechanism-codesign"), ("lib/aarch64-linux-gnu/libcodesign_bags.so", "ros-mechanism-codesign"),
                              ("lib/mechanism_codesign/codesign", "mechanism-codesign"), ("lib/mechanism_codesign/simulation", "ros-mechanism-codesign"),
                              ("share/mechanism_codesign/scripts/codesign_report/page.py", "mechanism-codesign"), ("share/mechanism_codesign/scripts/panel", "ros-mechanism-codesign"),
                              ("lib/python3/dist-packages/mechanism_codesign/_problem.py", "python3-mechanism-codesign"),
                              ("lib/python3/dist-packages/mechanism_codesign/srv/_Optimize.py", "ros-mechanism-codesign"),
                              ("include/mechanism_codesign/problem.h", "mechanism-codesign-dev"), ("include/mechanism_codesign/OptimizeRequest.h", "ros-mechanism-codesign")):
            self.assertEqual(packages.package_of(path), package, path)

    def test_no_file_is_lost(self):
        with self.assertRaisesRegex(SystemExit, "/usr/libexec/x belongs to no package; add a rule"):
            packages.package_of("libexec/x")

    def test_the_changelog_begins_with_this_version(self):
        text = packages.debian_changelog("~deb12")
        version = xml.etree.ElementTree.parse(os.path.join(ROOT, "package.xml")).findtext("version")
        self.assertTrue(text.startswith(f"mechanism-codesign ({version}~deb12) unstable; urgency=medium\n\n  * "), text[:200])
        self.assertIn("\nmechanism-codesign (0.1.0~deb12) unstable; urgency=medium\n", text)
        self.assertEqual(re.findall(r"\n -- the .*>  (.*)", text)[-1], "Sat, 21 Nov 2026 00:00:00 +0000")
        # Every line of the changelog is there, in the shape that Debian's own reader, where it is installed, takes.
        with open(os.path.join(ROOT, "CHANGELOG.rst"), encoding="utf-8") as file:
            released = re.split(r"^[0-9.]+ \(", file.read(), maxsplit=1, flags=re.MULTILINE)[1]
        self.assertEqual(len(re.findall(r"^  \* ", text, re.MULTILINE)), len(re.findall(r"^\* ", released, re.MULTILINE)))
        for line in text.splitlines():
            self.assertRegex(line, r"^$|^mechanism-codesign \([0-9.]+~deb12\) unstable; urgency=medium$|^  \* \S|^    \S|^ -- .+ <\S+>  \w{3}, \d\d \w{3} \d{4} [0-9:]{8} \+0000$")
        if not shutil.which("dpkg-parsechangelog"):
            return
        read = subprocess.run(["dpkg-parsechangelog", "--all", "-l", "-"], input=text, capture_output=True, text=True, check=True)
        self.assertEqual(read.stderr, "")
        self.assertIn(f"Version: {version}~deb12\n", read.stdout)


if __name__ == "__main__":
    unittest.main()
