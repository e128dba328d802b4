#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of doc/tutorials/ run, cell after cell, and print what stands in them; so does the Python of README.md and doc/python.md. Usage: tutorial_test.py [--write]

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
import tempfile
import unittest

from fixture import ROOT
from jobs_test import ARM, FIT, recorded

import mechanism_codesign as codesign

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
    cells, names = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"], {}
    with folder(os.path.dirname(path)):
        return notebook, cells, [execute("".join(cell["source"]), names) for cell in cells]


def page(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def blocks(name):
    """The blocks of Python on a page."""
    return re.findall(r"^```python\n(.*?)^```", page(name), re.DOTALL | re.MULTILINE)


@contextlib.contextmanager
def folder(path):
    before = os.getcwd()
    os.chdir(path)
    try:
        yield
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

    def test_the_six_lines_of_the_readme(self):
        """On the files that its example writes."""
        files, names = re.findall(r"^cat > (\S+) <<'EOF'\n(.*?)^EOF", page("README.md"), re.DOTALL | re.MULTILINE), {}
        with tempfile.TemporaryDirectory() as place, folder(place):
            for name, text in files:
                with open(name, "w", encoding="utf-8") as file:
                    file.write(text)
            (block,) = blocks("README.md")
            execute(block, names)
        shown = re.search(r"^length +\S+ +(\S+)", page("README.md"), re.MULTILINE).group(1)
        self.assertAlmostEqual(names["result"].parameters["length"], float(shown), delta=1e-6)

    def test_the_page_of_the_interface(self):
        time, position, effort = recorded()
        first, scipy, identification = blocks("doc/python.md")
        names = {"time": time, "position": position, "effort": effort}
        with folder(ROOT):
            execute(first, names)
            execute(scipy, names)
            execute(identification, {**names, "problem": codesign.Problem(ARM, FIT)})

    def compare(self, stored, found):
        """The same words, and numbers that another processor may round otherwise."""
        self.assertEqual(NUMBER.sub("#", found), NUMBER.sub("#", stored))
        for one, other in zip(NUMBER.findall(found), NUMBER.findall(stored)):
            self.assertAlmostEqual(float(one), float(other), delta=2e-3 * max(1.0, abs(float(other))), msg=f"{found} instead of {stored}")


if __name__ == "__main__":
    write() if sys.argv[1:] == ["--write"] else unittest.main()
