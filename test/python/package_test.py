#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The Python package as one finds it: names, documentation of every member, types, shipped cases."""
import ast
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from fixture import ARM, FIT, PENDULUM, ROOT, SWING, case, command_line, recorded

import mechanism_codesign as codesign
from mechanism_codesign import _core

PACKAGE = os.path.join(ROOT, "python/mechanism_codesign")
MYPY = shutil.which("mypy")
# What a user writes, for a checker of types.
PROGRAM = """from typing import List, Union
import threading

import numpy as np
import numpy.typing as npt

import mechanism_codesign as codesign

problem = codesign.Problem(**codesign.case("slider_crank"), set={"Kp": 10.0})
run: codesign.Run = problem.simulate(crank_length=0.07, signals=["slider_joint/friction"])
friction: npt.NDArray[np.float64] = run["slider_joint/friction"]
value, gradient = problem.gradient(np.array([0.07, 0.2, 0.1, 0.05, 10.0]))
slope: float = float(gradient[0]) + value
trials: List[Union[codesign.Trial, codesign.Stage]] = []
result = problem.optimize(progress=trials.append, cancel=threading.Event())
ok: bool = result.status.ok
fit = problem.identify(run.time, {"slider_joint": friction}, [[1.0]], progress=print)
number: codesign.Number = fit.numbers["mass"]
try:
    problem.objective()
except codesign.InputError as error:
    print(error.file, error.line + 1)
"""
WRONG = {'problem.simulate(samples="many")': "arg-type", "problem.optimize(cancel=True)": "arg-type", "result.best": "attr-defined",
         'codesign.Problem(codesign.case("slider_crank"))': "arg-type", "len(problem.duration)": "arg-type"}


class Names(unittest.TestCase):
    def test_its_names_are_there(self):
        self.assertEqual(codesign.version(), command_line("gradient", *case("inverted_pendulum"))["version"])
        self.assertEqual(codesign.__version__, codesign.version())
        self.assertLessEqual(set(codesign.__all__), set(dir(codesign)))
        for name in codesign.__all__:
            self.assertTrue(getattr(codesign, name).__doc__, name)
        with self.assertRaises(AttributeError):
            codesign.problem

    def test_it_loads_nothing_before_it_is_used(self):
        """Scripts that read messages import the same package."""
        code = "import mechanism_codesign, sys; assert not {'numpy', 'mechanism_codesign._core'} & set(sys.modules)"
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_a_python_without_the_extension_is_told_so(self):
        code = "import mechanism_codesign as m; m.__path__[:] = [p for p in m.__path__ if not p.endswith('build/python')]; m.Problem"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        self.assertIn("ImportError: mechanism_codesign has no extension for Python 3", done.stderr)
        self.assertIn("pybind11-dev", done.stderr)


class Cases(unittest.TestCase):
    def test_those_of_the_launch_files_and_of_the_gallery(self):
        self.assertEqual(codesign.case("slider_crank"), {"model": case("slider_crank")[0], "study": case("slider_crank")[1], "overlays": []})
        self.assertIn("payload", codesign.Problem(**codesign.case("vendor_arm")).names, "which its overlay declares")
        press = codesign.Problem(**codesign.case("gallery/toggle_press"))
        self.assertIn("toggle_press", repr(press))

    def test_an_unknown_one_is_refused_with_the_names(self):
        with self.assertRaisesRegex(codesign.InputError, r'^arguments: case: unknown case, did you mean "slider_crank"\? \(value: slidercrank, allowed: .*gallery/') as caught:
            codesign.case("slidercrank")
        self.assertEqual((caught.exception.element, caught.exception.value), ("case", "slidercrank"))
        self.assertIn("slider_crank, ", caught.exception.allowed)
        with self.assertRaises(codesign.InputError):
            codesign.case("gallery/../config")
        with self.assertRaises(codesign.InputError):
            codesign.case("")


def entries(of):
    """What the docstring of a class says of its members: "NAME, NAME: TEXT" by name, with lines that go on."""
    found = {}
    for names, text in re.findall(r"^((?:\w+, )*\w+): (.*(?:\n +.*)*)", inspect.cleandoc(type(of).__doc__), re.MULTILINE):
        found.update(dict.fromkeys(names.split(", "), text))
    return found


class Documentation(unittest.TestCase):
    """help() shows docstrings alone."""

    @staticmethod
    def objects():
        trials = []
        problem = codesign.Problem(PENDULUM, SWING)
        result = problem.optimize(progress=trials.append)
        fit = codesign.Problem(ARM, FIT).identify(*recorded(), progress=trials.append)
        stage = codesign.Stage("searching", "searching", 1, 2, 3, 0.5)
        failure = codesign.ComputationError(result.status, None)
        fault = codesign.InputError({key: "" for key in ("file", "line", "element", "value", "allowed", "message")})
        lift = [f"{ROOT}/gallery/goods_lift/{file}" for file in ("model.urdf", "tradeoff.yaml")]
        curve = codesign.Problem(*lift).tradeoff(points=3)
        recording = codesign.Recording(*recorded())
        twice = codesign.Problem(ARM.replace("${viscous}", "${viscous + other}").replace(
            '<link name="ground"/>', '<codesign:parameter name="other" value="0" lower="0" upper="5"/><link name="ground"/>'),
            "duration: 4.0\nparameters: {mass: {}, viscous: {}, other: {}}\n")
        base = next(iter(twice.identify(recording).base.values()))
        return [recording, twice.regressor(recording), base, curve, curve.points[0], problem, problem.parameters[0], problem.simulate(), problem.linearize(), codesign.TransferFunction(np.zeros(1, complex), np.zeros(2, complex), 1.0, None), result, result.status, fit, fit.numbers["mass"], trials[0], trials[-1], stage,
                failure, fault, codesign.Warning("code", "message")]

    def test_each_member_is_documented_with_shape_and_unit(self):
        objects = self.objects()
        shown = {type(of).__name__ for of in objects}
        self.assertEqual(shown | {"OutputError", "case", "version"}, set(codesign.__all__))
        for of in objects:
            inherited = set(dir(Exception())) | {"count", "index", "get", "items", "keys", "values"}
            for name in (n for n in dir(of) if not n.startswith("_") and n not in inherited):
                with self.subTest(type(of).__name__, member=name):
                    value, member = getattr(of, name), getattr(type(of), name, None)
                    is_field = name in getattr(of, "_fields", ()) or member is None
                    text = entries(of).get(name) if is_field else member.__doc__
                    self.assertTrue(text, "not in the docstring")
                    numbers = list(value.values()) if isinstance(value, dict) else [value]
                    if any(isinstance(number, np.ndarray) for number in numbers):
                        self.assertRegex(text, r"\bshape \(")
                    if any(isinstance(number, (np.ndarray, float)) for number in numbers):
                        self.assertRegex(text, r"\[.+\]|unit", "no unit")

    def test_nothing_else_is_named(self):
        for of in self.objects():
            for name in entries(of):
                self.assertTrue(hasattr(of, name), f"{type(of).__name__}.{name}")


def stub():
    """The classes and functions of _core.pyi, and the first word of each of its aliases."""
    with open(os.path.join(PACKAGE, "_core.pyi"), encoding="utf-8") as file:
        body = ast.parse(file.read()).body
    aliases = {node.targets[0].id: ast.unparse(node.value).partition("[")[0] for node in body if isinstance(node, ast.Assign)}
    return {node.name: node for node in body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}, aliases


class Types(unittest.TestCase):
    # By the first word of an annotation what pybind11 calls it; other words are the same.
    WORDS = {"npt.NDArray": "numpy.ndarray[numpy.float64]", "Dict": "dict", "List": "list", "Tuple": "tuple"}

    def same(self, annotation, written, where):
        """`written` is the type in a signature of pybind11, for which any Python object is `object`."""
        word = ast.unparse(annotation).partition("[")[0]
        word = stub()[1].get(word, word)
        if written != "object":
            self.assertEqual(self.WORDS.get(word, word), written.removeprefix("mechanism_codesign._core."), where)

    def test_the_stub_of_the_extension_has_what_is_there(self):
        self.assertEqual(set(stub()[0]), {name for name in dir(_core) if not name.startswith("_")})
        for name, node in stub()[0].items():
            if isinstance(node, ast.ClassDef):
                members = {part.name if isinstance(part, ast.FunctionDef) else part.target.id for part in node.body}
                there = {member for member in vars(getattr(_core, name)) if not member.startswith("_") or member == "__init__"}
                self.assertEqual(members | {"__init__"}, there | {"__init__"}, name)

    def test_its_signatures_are_those_of_the_extension(self):
        checked = 0
        for name, node in stub()[0].items():
            owner, parts = (getattr(_core, name), node.body) if isinstance(node, ast.ClassDef) else (_core, [node])
            for part in parts:
                member = part.name if isinstance(part, ast.FunctionDef) else part.target.id
                there, where = vars(owner)[member], f"{name}.{member}"
                text = there.fget.__doc__ if isinstance(there, property) else there.__doc__
                arguments, result = re.fullmatch(r"\w*\((.*)\) -> (.+)\n", text).groups()
                arguments = [argument.split(": ") for argument in arguments.split(", ")] if arguments else []
                if isinstance(part, ast.FunctionDef):
                    self.assertFalse(part.args.args and part.args.posonlyargs, where)
                    given = part.args.posonlyargs or part.args.args
                    self.assertEqual(len(given), len(arguments), where)
                    for argument, (called, written) in zip(given[1:], arguments[1:]):
                        self.assertTrue(argument in part.args.posonlyargs and re.fullmatch(r"arg\d+", called), f"{where}: {called} has no name in calls")
                        self.same(argument.annotation, written, where)
                self.same(part.returns if isinstance(part, ast.FunctionDef) else part.annotation, result, where)
                checked += 1
        self.assertGreater(checked, 30)

    def mypy(self, *arguments):
        with tempfile.TemporaryDirectory() as cache:
            return subprocess.run([MYPY, "--strict", "--cache-dir", cache, *arguments], capture_output=True, text=True, check=False,
                                  env={**os.environ, "MYPYPATH": os.path.dirname(PACKAGE)})

    @unittest.skipUnless(MYPY, "mypy is not installed: types are not checked; Debian's package mypy has it")
    def test_the_package_and_a_program_are_clean(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "program.py")
            with open(path, "w", encoding="utf-8") as file:
                file.write(PROGRAM)
            done = self.mypy(PACKAGE, path)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with open(path, "a", encoding="utf-8") as file:
                file.write("\n".join(WRONG))
            done = self.mypy(path)
            found = re.findall(r"program\.py:(\d+): error: .*\[([a-z-]+)\]", done.stdout)
            first = PROGRAM.count("\n") + 1
            self.assertEqual(found, [(str(first + k), code) for k, code in enumerate(WRONG.values())], done.stdout)


if __name__ == "__main__":
    unittest.main()
