#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""tools/setup (Debian's packages) and package.xml (rosdep's keys) name the same dependencies. Usage: packages_test.py [-v]"""
import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# Keys of rosdep that are spelled otherwise than Debian's packages.
ODD_KEYS = {"bzip2": "libbz2-dev", "dynamic_reconfigure": "libdynamic-reconfigure-config-init-mutex-dev", "eigen": "libeigen3-dev", "nlohmann-json-dev": "nlohmann-json3-dev"}
# Packages for building and for taking pictures, and packages without a key of rosdep on every distribution.
NOT_IN_PACKAGE_XML = {
    "g++", "make", "ninja-build", "ccache", "cmake", "python3", "xvfb", "imagemagick", "libbenchmark-dev", "libsimbody-dev", "python3-venv",
    "python3-mpi4py", "python3-distributed",
    "mypy", "python3-nbclient", "python3-nbformat", "python3-ipykernel",
    "libsundials-dev", "libnlopt-dev", "libnlopt-cxx-dev", "libxbyak-dev", "libopenmpi-dev", "openmpi-bin"}

# What benchmark/peers measures in an environment of its own.
FROM_PYPI = {"casadi", "exudyn", "mujoco", "pinocchio", "pydrake"}


def listed(*options):
    output = subprocess.run([os.path.join(ROOT, "tools", "setup"), "--list", *options], check=True, stdout=subprocess.PIPE, text=True).stdout
    return set(output.split())


def keys():
    root = xml.etree.ElementTree.parse(os.path.join(ROOT, "package.xml")).getroot()
    return {element.text.strip() for element in root if element.tag.endswith("depend")}


def debian_names(key):
    """The packages that may stand for a key of rosdep."""
    name = key.replace("_", "-")
    return {ODD_KEYS.get(key, name), f"lib{name}-dev", f"libros-{name}-dev", f"ros-{name}", f"python3-{name}"}


def unserved(keys_, packages):
    return {key for key in keys_ if not debian_names(key) & packages}


def undeclared(packages, keys_):
    return packages - NOT_IN_PACKAGE_XML - {name for key in keys_ for name in debian_names(key)}


def python_files(*folders):
    """(path, text) of the Python files of these folders."""
    for folder in folders:
        for path, _, files in os.walk(os.path.join(ROOT, folder)):
            for file in (os.path.join(path, name) for name in files):
                with open(file, errors="replace") as opened:
                    text = opened.read()
                if text.startswith("#!/usr/bin/python3") or file.endswith(".py"):
                    yield file, text


def imported(*folders):
    """The modules that the Python files of these folders import from elsewhere."""
    own = set()
    for file, _ in python_files("scripts", "python", "test", "benchmark"):
        module = os.path.basename(file).split(".")[0]
        own.add(os.path.basename(os.path.dirname(file)) if module == "__init__" else module)
    modules = {module for _, text in python_files(*folders) for module in re.findall(r"^\s*(?:from|import) ([A-Za-z0-9_]+)", text, re.MULTILINE)}
    return modules - own


class PackagesTest(unittest.TestCase):
    def test_every_key_has_a_package(self):
        self.assertEqual(unserved(keys(), listed()), set())

    def test_every_package_has_a_key(self):
        self.assertEqual(undeclared(listed("--benchmark"), keys()), set())

    def test_what_is_missing_is_found(self):
        self.assertEqual(unserved({"tf2_ros", "roscpp"}, {"libroscpp-dev"}), {"tf2_ros"})
        self.assertEqual(undeclared({"g++", "python3-tf2-ros", "python3-rosbag"}, {"tf2_ros"}), {"python3-rosbag"})

    def test_python_modules_are_installed_by_name(self):
        """A module that a script imports comes from python3-MODULE, which a machine may have by accident."""
        for folders, options, known in ((("scripts", "python", "test"), (), "tf2_ros"), (("benchmark",), ("--benchmark",), "mpi4py")):
            packages = listed("--headless", *options)
            modules = imported(*folders) - set(sys.stdlib_module_names) - {"mechanism_codesign"} - FROM_PYPI
            self.assertIn(known, modules)
            self.assertEqual({m for m in modules if "python3-" + m.replace("_", "-") not in packages}, set())

    def test_the_core_needs_no_ros(self):
        core = listed("--core")
        self.assertIn("libsundials-dev", core)
        self.assertEqual({p for p in core if re.match(r"ros-|catkin|rosbash|libros|librviz|python3-(?!yaml|jinja2|jsonschema|dev|numpy|scipy|nbclient|nbformat|ipykernel)", p)}, set())
        self.assertLess(core, listed("--headless"))
        self.assertLess(listed("--headless"), listed())


if __name__ == "__main__":
    unittest.main()
