#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The Dockerfile: what it copies, runs and installs is there, and its commands call apt as they should. No image is made. Usage: image_test.py [-v]"""
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from debian_packages_test import ROOT, packages  # pylint: disable=wrong-import-position


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def instructions():
    """(instruction, its text), with comments left out and continued lines joined."""
    text = re.sub(r"^#.*\n", "", read("Dockerfile"), flags=re.MULTILINE).replace("\\\n", " ")
    return [tuple(line.split(None, 1)) for line in text.splitlines() if line.strip()]


def texts(kind):
    return [text for name, text in instructions() if name == kind]


def arguments():
    """The defaults of the arguments, by name."""
    return {name: shlex.split(value)[0] for name, _, value in (text.partition("=") for text in texts("ARG"))}


def called_by(command, programs, **environment):
    """The calls of some programs by a command of the shell, with stand-ins for them."""
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            with open(os.path.join(folder, program), "w", encoding="utf-8") as file:
                file.write(f'#!/bin/sh\necho {program} "$@"\n')
            os.chmod(file.name, 0o755)
        done = subprocess.run(["/bin/sh", "-c", command], env={"PATH": folder, **environment}, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def installed_by(chosen):
    """What apt-get is called with when the packages of the second stage are installed, where the first one has made all packages."""
    mount, command = re.fullmatch(r"(--mount=\S+)\s+(.*)", texts("RUN")[-1]).groups()
    target = re.search(r"target=([^,\s]+)", mount).group(1)
    with tempfile.TemporaryDirectory() as made:
        for package in packages.PACKAGES:
            with open(os.path.join(made, f"{package}_1.0~deb12_amd64.deb"), "w", encoding="utf-8"):
                pass
        return called_by(command.replace(target, made), ("apt-get", "rm"), PACKAGES=chosen)


class ImageTest(unittest.TestCase):
    def test_its_systems_are_those_that_packages_are_made_for(self):
        release = arguments()["RELEASE"]
        self.assertIn(f"  {release} | ", read("tools/fresh"))
        self.assertEqual({text.split()[0].replace("${RELEASE}", release) for text in texts("FROM")}, {f"debian:{release}-slim"})

    def test_what_is_copied_is_there(self):
        ignored = set(read(".dockerignore").split("\n", 1)[1].split())
        # Else a file of the sources would be missing in the image.
        self.assertLessEqual(ignored, {line.strip("/") for line in read(".gitignore").split()} | {".git"})
        (source, target), = (text.split() for text in texts("COPY"))
        self.assertEqual(source, ".")
        self.assertEqual(texts("WORKDIR")[0], target)
        made = f"{target}/{re.search(r'packages=.PWD/([a-z/]+)', read('tools/package')).group(1)}"
        stages = [text.split(" AS ")[1] for text in texts("FROM") if " AS " in text]
        mount, = re.findall(r"from=(\w+),source=([^,]+)", "\n".join(texts("RUN")))
        self.assertEqual(mount, (stages[0], made))

    def test_what_is_run_is_there(self):
        tool = texts("RUN")[0].split()
        self.assertEqual(len(tool), 1, "tools/package takes other options for trials")
        self.assertTrue(os.access(os.path.join(ROOT, tool[0]), os.X_OK))

    def test_its_own_command_is_the_demo(self):
        command, = texts("CMD")
        optimize, report = called_by(command, ("codesign",))
        share = "/usr/share/mechanism_codesign/"
        self.assertRegex(optimize, rf"^codesign optimize {share}\S+ {share}\S+ --output job$")
        self.assertEqual(report, "codesign report job -o job.html")
        for path in ["bin/codesign", *(f"share/mechanism_codesign/{name}" for name in re.findall(rf"{share}(\S+)", optimize))]:
            self.assertIn(packages.package_of(path), arguments()["PACKAGES"].split())
        for name in re.findall(rf"{share}(\S+)", optimize):
            self.assertTrue(os.path.exists(os.path.join(ROOT, name)), name)

    def test_the_packages_are_installed(self):
        named = re.findall(r'PACKAGES="([^"]+)"', read("Dockerfile"))
        self.assertGreater(len(named), 1)
        self.assertIn(arguments()["PACKAGES"], named)
        for chosen in named:
            self.assertLessEqual(set(chosen.split()), set(packages.PACKAGES))
            update, install, remove = installed_by(chosen)
            self.assertEqual(update, "apt-get update")
            self.assertEqual(install, "apt-get install -y --no-install-recommends " + " ".join(f"./{package}_1.0~deb12_amd64.deb" for package in chosen.split()))
            self.assertTrue(remove.startswith("rm -rf /var/lib/apt/lists"))


if __name__ == "__main__":
    unittest.main()
