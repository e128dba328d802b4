#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of doc/tutorials/ run, cell after cell, in Jupyter where it is installed, and print what stands in them; so does the Python of README.md and
doc/python.md. Usage: tutorial_test.py [--write]

--write puts the outputs of this run into the notebooks.
"""
import ast
import contextlib
import glob
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from fixture import ARM, FIT, ROOT, recorded

import mechanism_codesign as codesign
from mechanism_codesign import _core

JUPYTER = all(importlib.util.find_spec(name) for name in ("nbformat", "nbclient", "ipykernel"))
NO_JUPYTER = "Jupyter is not installed: notebooks run without it; Debian's packages python3-nbclient and python3-ipykernel have it"
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
    """(notebook as it is, its cells of code, the outputs of this run); in a folder of its own, as a notebook needs no file beside it"""
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    cells, names = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"], {}
    with tempfile.TemporaryDirectory() as place, folder(place):
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


def installation(prefix):
    """Puts what an installation has where it has it, by links; returns the folder that Python finds."""
    package, share = (os.path.join(prefix, place, "mechanism_codesign") for place in ("lib/python3/dist-packages", "share"))
    shutil.copytree(os.path.join(ROOT, "python/mechanism_codesign"), package, ignore=shutil.ignore_patterns("__pycache__"))
    os.symlink(_core.__file__, os.path.join(package, os.path.basename(_core.__file__)))
    os.makedirs(os.path.join(share, "scripts"))
    for name in ("urdf", "config", "gallery", "scripts/codesign_report"):
        os.symlink(os.path.join(ROOT, name), os.path.join(share, name))
    os.symlink("../../../../share/mechanism_codesign/scripts/codesign_report", os.path.join(package, "codesign_report"))  # as cmake/Python.cmake does
    return os.path.dirname(package)


def script(name):
    """A script of this package as a module."""
    loader = importlib.machinery.SourceFileLoader("script", os.path.join(ROOT, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("script", loader))
    loader.exec_module(module)
    return module


def joined(outputs):
    """A kernel sends what a cell prints in parts."""
    whole = []
    for output in outputs:
        if whole and output["output_type"] == whole[-1]["output_type"] == "stream":
            whole[-1] = {**whole[-1], "text": "".join(whole[-1]["text"]) + "".join(output["text"])}
        else:
            whole.append(output)
    return whole


def write():
    for path in paths():
        notebook, cells, outputs = run(path)
        for count, (cell, output) in enumerate(zip(cells, outputs), 1):
            cell["execution_count"], cell["outputs"] = count, output
            for part in output:
                if "execution_count" in part:
                    part["execution_count"] = count
        text = json.dumps(notebook, indent=1, ensure_ascii=False).replace(ROOT, "/usr/share/mechanism_codesign")  # as from a package, not of this machine
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + "\n")


class Tutorials(unittest.TestCase):
    def test_they_print_what_stands_in_them(self):
        self.assertGreater(len(paths()), 0)
        for path in paths():
            _, cells, outputs = run(path)
            self.compare_outputs(path, cells, outputs)

    @unittest.skipUnless(JUPYTER, NO_JUPYTER)
    def test_they_run_in_jupyter(self):
        import nbclient
        import nbformat
        for path in paths():
            stored = nbformat.read(path, 4)
            nbformat.validate(stored)
            found = nbformat.read(path, 4)
            with tempfile.TemporaryDirectory() as place:
                nbclient.NotebookClient(found, timeout=600, kernel_name="python3", resources={"metadata": {"path": place}}).execute()
            nbformat.validate(found)
            cells, outputs = ([cell for cell in notebook.cells if cell.cell_type == "code"] for notebook in (stored, found))
            self.compare_outputs(path, cells, [joined(cell.outputs) for cell in outputs])

    def test_they_run_from_an_installation(self):
        """Which has no checkout beside its pages."""
        with tempfile.TemporaryDirectory() as place:
            environment = {**os.environ, "PYTHONPATH": installation(os.path.join(place, "prefix"))}
            for path in paths():
                with open(path, encoding="utf-8") as file:
                    sources = ["".join(cell["source"]) for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
                sources.append("print(codesign.__file__, codesign.case('slider_crank')['model'])")
                done = subprocess.run([sys.executable, "-B", "-c", "\n".join(sources)], env=environment, cwd=place, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.splitlines()[-1].startswith(os.path.join(place, "prefix/lib/")), done.stdout)

    def test_their_pages_show_tables_and_pictures(self):
        """Of tools/doc, as Jupyter shows them."""
        for path in paths():
            with open(path, encoding="utf-8") as file:
                outputs = [output for cell in json.load(file)["cells"] for output in cell.get("outputs", [])]
            html = ["".join(output["data"]["text/html"]) for output in outputs if "text/html" in output.get("data", {})]
            self.assertGreater(len(html), 0)
            page = script("tools/doc").notebook(pathlib.Path(path))
            blocks = re.findall(r"^```\{raw\} html\n(.*?)\n```$", page, re.DOTALL | re.MULTILINE)
            self.assertEqual(re.findall("src=\"(data:image/svg[^\"]*)", "".join(blocks)), re.findall("src=\"(data:image/svg[^\"]*)", "".join(html)))
            self.assertEqual([re.sub("<[^>]*>", "", block) for block in blocks], [re.sub("<[^>]*>", "", text) for text in html])
            self.assertIn(f"{{download}}`This page as a notebook <{os.path.basename(path)}>`", page)
            for output in outputs:
                if "text/html" in output.get("data", {}):
                    self.assertNotIn("".join(output["data"]["text/plain"]), page)

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

    def compare_outputs(self, path, cells, outputs):
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
