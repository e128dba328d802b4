#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""How tools/build calls CMake, with a stand-in for it; how many jobs tools/jobs allows; what tools/sanitize builds and runs; which home
folder tools/environment chooses.

Usage: build_test.py [-v]
"""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def program(folder, name, text):
    with open(os.path.join(folder, name), "w") as file:
        file.write("#!/bin/sh\n" + text)
    os.chmod(file.name, 0o755)


class Checkout:
    """A folder with tools/, and a PATH with a cmake that writes its arguments down, with or without ninja."""

    def __init__(self, ninja=True):
        self.folder = tempfile.TemporaryDirectory()
        self.root, self.bin = os.path.join(self.folder.name, "checkout"), os.path.join(self.folder.name, "bin")
        os.makedirs(os.path.join(self.root, "devel"))
        os.mkdir(self.bin)
        shutil.copytree(os.path.join(ROOT, "tools"), os.path.join(self.root, "tools"))
        for name in ("bash", "sh", "dirname", "awk", "nproc", "mkdir", "cat", "grep", "paste"):
            os.symlink(shutil.which(name), os.path.join(self.bin, name))
        program(self.bin, "cmake", f'echo "$*" >>{self.folder.name}/calls\n')
        if ninja:
            program(self.bin, "ninja", "")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.folder.cleanup()

    def build(self, *targets, **environment):
        subprocess.run([os.path.join(self.root, "tools", "build"), *targets], check=True, env={"PATH": self.bin, **environment})
        with open(os.path.join(self.folder.name, "calls")) as calls:
            return calls.read().splitlines()


class BuildTest(unittest.TestCase):
    def test_a_new_folder_is_built_with_ninja(self):
        with Checkout() as checkout:
            configure, build = checkout.build("all", "tests")
        self.assertEqual(configure, "-S . -B build -G Ninja")
        self.assertTrue(build.endswith("--target all tests"), build)

    def test_make_does_where_there_is_no_ninja(self):
        with Checkout(ninja=False) as checkout:
            self.assertEqual(checkout.build()[0], "-S . -B build")

    def test_a_configured_folder_and_a_wish_are_respected(self):
        with Checkout() as checkout:
            os.mkdir(os.path.join(checkout.root, "build"))
            with open(os.path.join(checkout.root, "build", "CMakeCache.txt"), "w"):
                pass
            self.assertEqual(checkout.build()[0], "-S . -B build")
        with Checkout() as checkout:
            self.assertEqual(checkout.build(CMAKE_GENERATOR="Unix Makefiles")[0], "-S . -B build")


def words_of(pattern, *path):
    """The words of a list in one of our files."""
    with open(os.path.join(ROOT, *path)) as file:
        return re.search(pattern, file.read()).group(1).split()


class JobsTest(unittest.TestCase):
    @staticmethod
    def jobs(processors, memory, **environment):
        """What tools/jobs says with so many processors, and memory for so many compilers."""
        with tempfile.TemporaryDirectory() as folder:
            program(folder, "nproc", f"echo {processors}\n")
            program(folder, "awk", f"echo {memory}\n")
            result = subprocess.run(["bash", "-ec", '. tools/jobs; echo "$jobs"'], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True,
                                    env={"PATH": folder + ":" + os.environ["PATH"], **environment})
        return int(result.stdout)

    def test_processors_and_memory_limit_them(self):
        self.assertEqual(self.jobs(4, 9), 4)
        self.assertEqual(self.jobs(64, 3), 3)
        self.assertEqual(self.jobs(4, 0), 1)

    def test_a_wish_is_respected(self):
        self.assertEqual(self.jobs(4, 2, JOBS="7"), 7)

    def test_in_continuous_integration_compilers_give_way(self):
        for variables, words in (({"CI": "true"}, "nice -n 10"), ({}, "")):
            result = subprocess.run(["bash", "-ec", '. tools/jobs; echo "${niced[*]}"'], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True,
                                    env={"PATH": os.environ["PATH"], **variables})
            self.assertEqual(result.stdout.strip(), words)


class SanitizeTest(unittest.TestCase):
    @staticmethod
    def sanitize(*words):
        """The targets that tools/sanitize builds, and the words for tools/run_tests."""
        with Checkout() as checkout:
            program(os.path.join(checkout.root, "tools"), "run_tests", 'echo "$*${GTEST_FILTER:+; without ${GTEST_FILTER#-}}"\n')
            os.makedirs(os.path.join(checkout.root, "build", words[0], "devel"))
            for room in ("forces", "reading"):
                os.makedirs(os.path.join(checkout.root, "test", room))
            with open(os.path.join(checkout.root, "test", "slow_cases.txt"), "w") as file:
                file.write("Slow.One\n*Slow.Two/*\n")
            with open(os.path.join(checkout.root, "build", words[0], "devel", "setup.bash"), "w"):
                pass
            result = subprocess.run([os.path.join(checkout.root, "tools", "sanitize"), *words], check=True, stdout=subprocess.PIPE, text=True,
                                    env={"PATH": checkout.bin})
            with open(os.path.join(checkout.folder.name, "calls")) as calls:
                return calls.read().splitlines()[1].split("--target ")[1], result.stdout.strip()

    def test_every_unit_test_runs_with_the_address_sanitizer(self):
        self.assertEqual(self.sanitize("address"), ("unit_tests", "build/address -L ^unit$"))
        self.assertEqual(self.sanitize("address", "--report", "a.xml"), ("unit_tests", "build/address -L ^unit$ --report a.xml"))

    def test_rooms_may_be_named(self):
        self.assertEqual(self.sanitize("address", "forces", "reading", "-V"),
                         ("codesign test_forces test_reading", "build/address -L ^unit$ -R ^(forces|reading)[._] -V"))

    def test_threads_have_a_program_of_their_own(self):
        self.assertEqual(self.sanitize("thread"), ("test_threads", r"build/thread -R ^threads\."))

    def test_the_slowest_cases_may_be_left_out(self):
        self.assertEqual(self.sanitize("address", "--quick", "forces"), ("codesign test_forces", "build/address -L ^unit$ -R ^(forces)[._]; without Slow.One:*Slow.Two/*"))

    def test_every_case_that_is_left_out_exists(self):
        """Names of cases without the shards and prefixes of parameters: test/slow_cases.txt, for --quick of tools/test and tools/sanitize."""
        sources = ""
        for folder, _, files in os.walk(os.path.join(ROOT, "test")):
            for name in files:
                if name.endswith((".cc", ".h")):
                    with open(os.path.join(folder, name)) as file:
                        sources += file.read()
        cases = {".".join(words) for words in re.findall(r"TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)", sources)}
        with open(os.path.join(ROOT, "test", "slow_cases.txt")) as file:
            names = file.read().split()
        self.assertGreater(len(names), 20)
        suites = {case.split(".")[0] for case in cases}
        for name in names:
            suite, case = name.lstrip("*").split("/")[0].split(".")
            self.assertTrue(suite in suites if case == "*" else f"{suite}.{case}" in cases, name)

    def test_every_test_of_threads_exists(self):
        names = words_of(r"set\(thread_tests ([^)]*)\)", "cmake", "Tests.cmake")
        self.assertIn("ros/common/worker", names)
        self.assertEqual([name for name in names if not os.path.isfile(os.path.join(ROOT, "test", name + "_test.cc"))], [])


class EnvironmentTest(unittest.TestCase):
    @staticmethod
    def home(checkout, **environment):
        with open(os.path.join(checkout.root, "devel", "setup.bash"), "w"):
            pass
        return subprocess.run(["bash", "-ec", '. tools/environment; echo "$HOME"'], cwd=checkout.root, check=True, stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.DEVNULL, env={"PATH": os.environ["PATH"], **environment}).stdout.strip()

    def test_the_home_folder_is_used_where_it_can_be_written(self):
        with Checkout() as checkout, tempfile.TemporaryDirectory() as home:
            self.assertEqual(self.home(checkout, HOME=home), home)

    def test_the_build_folder_takes_its_place_otherwise(self):
        with Checkout() as checkout:
            # Nobody, not even root, can make a folder there.
            home = self.home(checkout, HOME="/proc/nobody")
            self.assertEqual(home, os.path.join(checkout.root, "build", "home"))
            self.assertTrue(os.path.isdir(home))


if __name__ == "__main__":
    unittest.main()
