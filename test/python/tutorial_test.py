#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of doc/tutorials/ run, cell after cell, and print what stands in them. Usage: tutorial_test.py [--write]

--write puts the outputs of this run into the notebooks.
"""
import ast
import contextlib
import glob
import io
import json
import os
import re
import sys
import unittest

from fixture import ROOT

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def display(value):
    """The output that Jupyter stores for the value of a cell."""
    data = {"text/plain": repr(value).splitlines(True)}
    if hasattr(value, "_repr_html_"):
        data["text/html"] = value._repr_html_().splitlines(True)
    return data


def execute(source, names):
    """The outputs of a cell: what it prints, and the value of a last expression."""
    tree, printed = ast.parse(source), io.StringIO()
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    outputs = [{"name": "stdout", "output_type": "stream", "text": printed.getvalue().splitlines(True)}] if printed.getvalue() else []
    if value is not None:
        outputs.append({"data": display(value), "execution_count": None, "metadata": {}, "output_type": "execute_result"})
    return outputs


def run(path):
    """(notebook as it is, its cells of code, the outputs of this run)"""
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    cells, names, before = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"], {}, os.getcwd()
    os.chdir(os.path.dirname(path))
    try:
        return notebook, cells, [execute("".join(cell["source"]), names) for cell in cells]
    finally:
        os.chdir(before)


def paths():
    return sorted(glob.glob(os.path.join(ROOT, "doc/tutorials/*.ipynb")))


def write():
    for path in paths():
        notebook, cells, outputs = run(path)
        for count, (cell, output) in enumerate(zip(cells, outputs), 1):
            cell["execution_count"], cell["outputs"] = count, output
            for part in output:
                if "execution_count" in part:
                    part["execution_count"] = count
        with open(path, "w", encoding="utf-8") as file:
            json.dump(notebook, file, indent=1, ensure_ascii=False)
            file.write("\n")


class Tutorials(unittest.TestCase):
    def test_they_print_what_stands_in_them(self):
        self.assertGreater(len(paths()), 0)
        for path in paths():
            _, cells, outputs = run(path)
            for cell, output in zip(cells, outputs):
                with self.subTest(path, cell="".join(cell["source"])[:60]):
                    self.assertEqual([o["output_type"] for o in cell["outputs"]], [o["output_type"] for o in output], "outputs: tutorial_test.py --write")
                    for stored, found in zip(cell["outputs"], output):
                        self.compare("".join(stored.get("text", stored.get("data", {}).get("text/plain", []))),
                                     "".join(found.get("text", found.get("data", {}).get("text/plain", []))))
                        self.assertEqual("text/html" in stored.get("data", {}), "text/html" in found.get("data", {}))

    def compare(self, stored, found):
        """The same words, and numbers that another processor may round otherwise."""
        self.assertEqual(NUMBER.sub("#", found), NUMBER.sub("#", stored))
        for one, other in zip(NUMBER.findall(found), NUMBER.findall(stored)):
            self.assertAlmostEqual(float(one), float(other), delta=2e-3 * max(1.0, abs(float(other))), msg=f"{found} instead of {stored}")


if __name__ == "__main__":
    write() if sys.argv[1:] == ["--write"] else unittest.main()
