#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The pages of tools/doc: built without a warning, with links that lead somewhere, a search that finds, and no sideways scrolling in wide and narrow windows of
a headless Chromium; and rosdoc.yaml, run as rosdoc_lite does. Skipped where there is no sphinx. Usage: doc_test.py [-v]"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "test/scripts"))
import browser  # noqa: E402

NO_SPHINX = "no sphinx on this machine: the pages are not built; tools/setup --doc brings it"
NO_BROWSER = "the pages are not looked at: there is no chromium; tools/setup --pages brings it"
HAS_SPHINX = not subprocess.run([sys.executable, "-c", "import sphinx, myst_parser, furo"], stderr=subprocess.DEVNULL, check=False).returncode
# Decisions all have the same form: the first stands for all of them.
OF_ONE_FORM = "doc/decisions/00[1-9]|doc/decisions/000[3-9]|doc/decisions/0[1-9]"
# What is wider than the window and does not scroll by itself, and pictures that were not found.
OUTSIDE = """[...document.querySelectorAll('article *')].filter(e => {
  if (e.getBoundingClientRect().right <= innerWidth + 1) return false;
  for (let p = e.parentElement; p; p = p.parentElement) if (getComputedStyle(p).overflowX !== 'visible') return false;
  return true;
}).map(e => e.tagName + ' ' + e.textContent.slice(0, 40))"""
EMPTY = "[...document.images].filter(e => e.loading !== 'lazy' && e.complete && !e.naturalWidth).map(e => e.src)"


def tool(*arguments):
    return subprocess.run([ROOT / "tools/doc", *arguments], capture_output=True, text=True, check=False)


@unittest.skipUnless(HAS_SPHINX, NO_SPHINX)
class DocTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.html = pathlib.Path(folder.name) / "html"
        cls.built = tool("--output", cls.html)
        cls.pages = sorted(path.relative_to(cls.html).as_posix() for path in cls.html.rglob("*.html"))

    def test_it_builds_without_a_warning(self):
        self.assertEqual((self.built.returncode, self.built.stderr), (0, ""))
        for page in ("README", "doc/README", "doc/messages", "doc/tutorials/slider_crank", "gallery/README", "gallery/toggle_press/README", "CHANGELOG"):
            self.assertIn(f"{page}.html", self.pages)

    def test_links_lead_somewhere(self):
        checked = tool("--check", self.html)
        self.assertEqual((checked.returncode, checked.stdout), (0, ""))

    def test_links_that_lead_nowhere_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "index.html"
            page.write_text('<a id="here" href="#here"></a><a href="#there"></a><a href="none.html"></a><img src="../out.png"><a href="https://no.where/"></a>')
            (page.parent / "a.css").write_text("@import url(/javascript/b.css); p { background: url('a.css'); }")
            checked = tool("--check", folder)
        self.assertEqual(checked.returncode, 1)
        self.assertEqual(checked.stdout.splitlines(), ["index.html: #there leads nowhere", "index.html: none.html leads nowhere", "index.html: ../out.png leads nowhere",
                                                       "a.css: /javascript/b.css leads nowhere"])
        self.assertIn("no pages in", tool("--check", self.html / "doc").stderr)

    def test_the_index_of_the_search_has_all_pages(self):
        index = (self.html / "searchindex.js").read_text()
        names = re.search(r'"?docnames"?:\s*\[(.*?)\]', index).group(1)
        made = {page[:-len(".html")] for page in self.pages} - {"index", "genindex", "search"}
        self.assertEqual(set(re.findall(r'"([^"]+)"', names)), made)

    def test_models_and_studies_of_the_gallery_come_along(self):
        page = (self.html / "gallery/toggle_press/README.html").read_text()
        for name in ("model.urdf", "study.yaml"):
            path, = re.findall(rf'href="([^"]+/{name})"', page)
            self.assertEqual((self.html / "gallery/toggle_press" / path).read_text(), (ROOT / "gallery/toggle_press" / name).read_text())

    def test_the_first_page_has_a_picture_three_doors_and_the_gallery(self):
        page = (self.html / "doc/README.html").read_text()
        before = page[:page.index('id="tutorials"')]
        doors, machines = (re.search(rf'<table class="{name}">.*?</table>', before, re.DOTALL)[0] for name in ("doors", "machines"))
        self.assertEqual(re.findall("<b>(.*?)</b>", doors), ["A mechanism", "A robot", "A recording"])
        named = {path.parent.name for path in (ROOT / "gallery").glob("*/study.yaml")}
        self.assertEqual(set(re.findall(r'<img src="../gallery/(\w+)/picture.svg"', machines)), named)
        self.assertEqual(set(re.findall(r'<a href="../gallery/(\w+)/README.html">', machines)), named)
        self.assertIn("replay.png", before)

    def test_the_packages_are_those_of_the_set_up(self):
        listed = subprocess.run([ROOT / "tools/setup", "--list", "--core", "--doc"], capture_output=True, text=True, check=True).stdout.split()
        named = re.search(r'^PACKAGES = "(.*)"', (ROOT / "tools/doc").read_text(), re.MULTILINE).group(1).split()
        self.assertLessEqual(set(named), set(listed))
        self.assertIn(" ".join(named), (ROOT / "doc/building.md").read_text())

    @unittest.skipUnless(browser.PATH, NO_BROWSER)
    def test_in_a_browser(self):
        page = browser.Browser()
        self.addCleanup(page.close)
        looked_at = [name for name in self.pages if not re.match(OF_ONE_FORM, name)]
        self.assertGreater(len(looked_at), 50)
        formulas = 0
        for name in looked_at:
            page.open((self.html / name).as_uri())
            formulas += page.run("document.querySelectorAll('.katex').length")
            for width in (1280, 400):
                page.resize(width)
                with self.subTest(page=name, width=width):
                    self.assertLessEqual(page.run("document.documentElement.scrollWidth"), width)
                    self.assertEqual(page.run(OUTSIDE), [])
                    self.assertEqual(page.run(EMPTY), [])
            with self.subTest(page=name):
                self.assertEqual(page.run("document.querySelectorAll('.katex-error').length"), 0)
                self.assertEqual(page.errors, [])
            page.errors.clear()
        self.assertGreater(formulas, 100)
        page.open((self.html / "search.html").as_uri() + "?q=stribeck")
        page.wait("document.querySelectorAll('#search-results li a').length > 0")
        self.assertEqual(page.errors, [])

    @unittest.skipUnless(browser.PATH, NO_BROWSER)
    def test_a_search_has_decisions_and_changes_last(self):
        page = browser.Browser()
        self.addCleanup(page.close)
        links = "[...document.querySelectorAll('#search-results > ul > li')].map(e => e.querySelector('a').getAttribute('href'))"
        for words in ("friction", "posture"):
            page.open((self.html / "search.html").as_uri() + f"?q={words}")
            # The results come one after the other; what says how many there are comes last.
            page.wait("/found \\d+ page/.test(document.querySelector('#search-results').textContent)")
            last = [bool(re.search("decisions/|CHANGELOG", link)) for link in page.run(links)]
            self.assertIn(True, last)
            self.assertEqual(last, sorted(last), words)
        self.assertEqual(page.errors, [])

    @unittest.skipUnless(browser.PATH, NO_BROWSER)
    def test_sentences_of_wide_tables_are_legible_in_a_narrow_window(self):
        """Each row is a block, whose cells have the names of their columns and the width of the window."""
        page = browser.Browser(400)
        self.addCleanup(page.close)
        page.open((self.html / "doc/ros_api.html").as_uri())
        narrow = "[...document.querySelectorAll('article table.docutils td')].filter(e => e.textContent.length > 60 && e.getBoundingClientRect().width < 200).map(e => e.textContent.slice(0, 40))"
        self.assertEqual(page.run(narrow), [])
        label = "(() => { const cell = [...document.querySelectorAll('td')].find(e => e.textContent.startsWith('frames per second of the run')); return [getComputedStyle(cell, '::before').content, cell.getBoundingClientRect().width]; })()"
        content, width = page.run(label)
        self.assertEqual(content, '"meaning: "')
        self.assertGreater(width, 300)
        page.resize(1280)
        self.assertEqual(page.run(label)[0], "none")


class RosdocTest(unittest.TestCase):
    """rosdoc_lite itself is in no Debian."""
    @classmethod
    def setUpClass(cls):
        cls.builders = {entry["builder"]: entry for entry in yaml.safe_load((ROOT / "rosdoc.yaml").read_text())}

    @unittest.skipUnless(HAS_SPHINX, NO_SPHINX)
    def test_sphinx(self):
        """In the folder that rosdoc.yaml names, which tools/doc fills. HTML of the same files is tested above."""
        folder = ROOT / self.builders["sphinx"]["sphinx_root_dir"]
        if not (folder / "conf.py").exists():
            self.assertEqual(tool().returncode, 0)
        with tempfile.TemporaryDirectory() as output:
            done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-b", "dummy", "-d", ROOT / "build/doc/trees", ".", output], cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    @unittest.skipUnless(shutil.which("doxygen"), "no doxygen")
    def test_doxygen(self):
        """By the settings that rosdoc_lite makes of it: it reads the package's folder, with these patterns."""
        entry = self.builders["doxygen"]
        with tempfile.TemporaryDirectory() as folder:
            settings = {"INPUT": ROOT, "RECURSIVE": "YES", "EXCLUDE": f"{ROOT}/build/", "FILE_PATTERNS": entry["file_patterns"], "EXCLUDE_PATTERNS": entry["exclude_patterns"],
                        "OUTPUT_DIRECTORY": folder, "GENERATE_LATEX": "NO", "QUIET": "YES", "HAVE_DOT": "NO", "WARN_IF_UNDOCUMENTED": "NO"}
            done = subprocess.run(["doxygen", "-"], input="".join(f"{name} = {value}\n" for name, value in settings.items()), cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            made = {path.name for path in pathlib.Path(folder).rglob("*.html")}
        self.assertLessEqual({f"classcodesign_1_1{name}.html" for name in ("Problem", "Simulation", "Evaluator")}, made)
        self.assertEqual({name for name in made if name.endswith("_8h_source.html")}, {header.stem.replace("_", "__") + "_8h_source.html" for header in (ROOT / "include/mechanism_codesign").glob("*.h")})


if __name__ == "__main__":
    if not HAS_SPHINX:
        print(NO_SPHINX)
    elif not browser.PATH:
        print(NO_BROWSER)
    unittest.main()
