#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Builds the program that doc/api.md prints, outside the project, as a plain CMake project and as a catkin package, and runs it.

Usage: api_page_test.py SOURCE_DIRECTORY CONFIG_DIRECTORY CODESIGN_PROGRAM BUILD_DIRECTORY [--catkin]
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, CONFIG, CODESIGN, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
CATKIN = "--catkin" in sys.argv
PACKAGE_XML = """<package format="2"><name>program_package</name><version>0.1.0</version><description>A test</description>
<maintainer email="nobody@example.org">nobody</maintainer><license>BSD</license>
<buildtool_depend>catkin</buildtool_depend><depend>mechanism_codesign</depend></package>
"""


def blocks(language):
    """The fenced blocks of a language on the page."""
    return re.findall(rf"^```{language}\n(.*?)^```", (SOURCE / "doc/api.md").read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def run(*words):
    # The system's Python first, as on a plain Debian: catkin takes the first in PATH.
    environment = dict(os.environ, PATH="/usr/bin:" + os.environ["PATH"])
    result = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                            env=environment)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))} exits with {result.returncode}:\n{result.stdout}")
    return result.stdout


class ThePage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "program.cc").write_text(blocks("cpp")[0])

    def expect_what_codesign_says(self, program):
        case = [SOURCE / "urdf/slider_crank_haug.urdf", SOURCE / "config/slider_crank_haug.yaml"]
        lines = dict(line.split(" ", 1) for line in run(program, *case).splitlines())
        expected = json.loads(run(CODESIGN, "gradient", *case, "--json"))
        self.assertEqual(float(lines["objective"]), expected["objective"])
        self.assertEqual([float(word) for word in lines["gradient"].split()], list(expected["gradient"].values()))
        self.assertLess(float(lines["optimum"].split()[0]), 0.5 * expected["objective"])

    def configure_plain(self, config):
        (self.folder / "CMakeLists.txt").write_text(blocks("cmake")[0])
        run("cmake", "-S", self.folder, "-B", self.folder / "build", f"-Dmechanism_codesign_DIR={config}")
        found = re.findall(r"^(\w+)_DIR:PATH=", (self.folder / "build/CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(set(found) - {"Eigen3", "mechanism_codesign"}, set(), "packages that the library alone does not need")

    def configure_catkin(self, config):
        (self.folder / "CMakeLists.txt").write_text(blocks("cmake")[1])
        (self.folder / "package.xml").write_text(PACKAGE_XML)
        run("cmake", "-S", self.folder, "-B", self.folder / "build", f"-Dmechanism_codesign_DIR={config}",
            f"-DCATKIN_DEVEL_PREFIX={self.folder}/devel")

    def expect_libraries_in(self, place):
        """That what links the program takes the library from there."""
        files = [self.folder / "build/CMakeFiles/program.dir/link.txt", self.folder / "build/build.ninja"]
        text = "\n".join(file.read_text(encoding="utf-8") for file in files if file.exists())
        self.assertEqual({str(pathlib.Path(path).resolve().parent) for path in re.findall(r"(/\S*/libcodesign_core\.\w+)", text)},
                         {str(pathlib.Path(place).resolve())})

    def test_a_plain_cmake_project_builds_it(self):
        self.configure_plain(CONFIG)
        run("cmake", "--build", self.folder / "build")
        self.expect_what_codesign_says(self.folder / "build/program")

    def expect_python_in(self, prefix):
        """The Python package of an installation computes what codesign says, and has the messages where there are any."""
        package = next(prefix.glob("**/mechanism_codesign/__init__.py")).parent
        if not list(package.glob("_core.*.so")):
            return
        case = [str(SOURCE / "urdf/slider_crank_haug.urdf"), str(SOURCE / "config/slider_crank_haug.yaml")]
        code = ("import sys, mechanism_codesign as codesign; problem = codesign.Problem(*sys.argv[1:3]); assert 'svg' in problem.simulate()._repr_html_(); "
                + ("from mechanism_codesign.msg import Signals; from mechanism_codesign.srv import Evaluate; " if CATKIN else "") +
                "print(problem.gradient()[0], codesign.__file__)")
        environment = dict(os.environ, PYTHONPATH=str(package.parent), PYTHONDONTWRITEBYTECODE="1")
        done = subprocess.run(["/usr/bin/python3", "-c", code, *case], capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        value, file = done.stdout.split()
        self.assertEqual(float(value), json.loads(run(CODESIGN, "gradient", *case, "--json"))["objective"])
        self.assertEqual(pathlib.Path(file).resolve().parent, package.resolve())

    def test_an_installation_is_found_where_it_is(self):
        """Not where the project was configured to be installed."""
        prefix = self.folder / "elsewhere"
        run("cmake", "--install", BUILD, "--prefix", prefix)
        moved = self.folder / "moved"
        prefix.rename(moved)
        config = next(moved.glob("**/mechanism_codesignConfig.cmake")).parent
        library = next(moved.glob("**/libcodesign_core.*")).parent
        self.expect_python_in(moved)
        self.configure_plain(config)
        self.expect_libraries_in(library)
        if CATKIN:
            shutil.rmtree(self.folder / "build")
            self.configure_catkin(config)
            self.expect_libraries_in(library)

    @unittest.skipUnless(CATKIN, "no catkin here")
    def test_a_catkin_package_builds_it(self):
        self.configure_catkin(CONFIG)
        run("cmake", "--build", self.folder / "build", "--target", "program")
        program = [path for path in self.folder.glob("**/program") if path.is_file()]
        self.expect_what_codesign_says(program[0])

    def test_public_headers_are_few_and_stand_alone(self):
        headers = sorted((SOURCE / "include/mechanism_codesign").glob("*.h"))
        self.assertLessEqual(len(headers), 15)
        text = "\n".join(header.read_text(encoding="utf-8") for header in headers)
        for word in ["Lanes", "Traced", "sundials", "SUNDIALS", "N_Vector"]:
            self.assertNotIn(word, text)
        page = (SOURCE / "doc/api.md").read_text(encoding="utf-8")
        for header in headers:
            self.assertIn(f"`{header.name}`", page)
            run("c++", "-std=c++17", "-fsyntax-only", f"-I{SOURCE}/include", "-isystem", "/usr/include/eigen3", "-x", "c++", header)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
