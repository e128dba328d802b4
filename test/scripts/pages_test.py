#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The pages: their links lead somewhere, doc/study.md lists every key, doc/theory.md every equation, every message of the sources says what to do or has a row in doc/messages.md, and every code one in doc/warnings.md or doc/statuses.md. Usage: pages_test.py [--write]

--write puts the table of all keys into doc/study.md, that of equations into doc/theory.md, and the remedies of messages into doc/messages.md.
"""
import functools
import html
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import sys
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = "| block or key | keys in it | page |\n|---|---|---|\n"
EQUATIONS = "| chapter | equations |\n|---|---|\n"


def pages():
    return sorted([*ROOT.glob("*.md"), *(ROOT / "doc").rglob("*.md"), *(ROOT / "gallery").rglob("*.md"), *(ROOT / "benchmark").rglob("*.md")])


def without_code(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)


def anchor_of(heading):
    """The anchor of a heading that no other heading of the page equals, by the rule of GitHub."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", html.unescape(text).strip().lower()).replace(" ", "-")


def anchors(path):
    """The anchors of a page's headings, by the rule of GitHub."""
    found = set()
    for heading in re.findall(r"^#+ (.*)", without_code(path.read_text()), re.MULTILINE):
        anchor = anchor_of(heading)
        number = 0
        while (unique := f"{anchor}-{number}" if number else anchor) in found:
            number += 1
        found.add(unique)
    return found


def keys_of(page):
    """Its keys by block, as the table of its section Keys has them: {"solver": ["integrator", ...], "gravity": []}."""
    section = re.search(r"^## Keys\n(.*?)(?=^## |\Z)", page.read_text(), re.DOTALL | re.MULTILINE)
    blocks = {}
    for cell in re.findall(r"^\| (`.*?) \| ", section.group(1) if section else "", re.MULTILINE):
        keys = re.findall(r"`([^`]+)`", cell)
        for key in keys:
            if key.startswith("."):
                key = keys[0].rpartition(".")[0] + key
            block, _, name = key.rpartition(".")
            names = blocks.setdefault(block or name, [])
            if block and name not in names:
                names.append(name)
    return blocks


def table_of_keys(linked):
    """The rows of doc/study.md, of the pages in the order in which it links them."""
    rows = [f"| `{block}` | {', '.join(f'`{name}`' for name in names)} | [{title}](study/{page}.md) |"
            for title, page in linked for block, names in keys_of(ROOT / f"doc/study/{page}.md").items()]
    return HEAD + "\n".join(rows) + "\n"


def study():
    """(the page doc/study.md, its table of keys as it is, and as it should be)"""
    text = (ROOT / "doc/study.md").read_text()
    table = re.search(re.escape(HEAD) + r"(\|.*\n)+", text).group(0)
    linked = dict.fromkeys(re.findall(r"\[([^\]]+)\]\(study/(\w+)\.md\) \|$", table, re.MULTILINE))
    return text, table, table_of_keys(linked)


def equations_of(chapter):
    """[(number, anchor)] of its headings and formulas: [("21a", "21a-watched-signals"), ("21b", "21a-watched-signals"), ...]."""
    found = []
    for heading, text in re.findall(r"^## (\([^\n]*)\n(.*?)(?=^## |\Z)", chapter.read_text(), re.DOTALL | re.MULTILINE):
        numbers = re.findall(r"^\((\w+)\)", heading) + re.findall(r"\\qquad \((\w+'?)\)\s*\$\$", text)
        found += [(number, anchor_of(heading)) for number in dict.fromkeys(numbers)]
    return found


def theory():
    """(the page doc/theory.md, its table of equations as it is, and as it should be)"""
    text = (ROOT / "doc/theory.md").read_text()
    table = re.search(re.escape(EQUATIONS) + r"(\|.*\n)*", text).group(0)
    linked = {name: title for title, name in reversed(re.findall(r"\[([^\]]+)\]\(theory/(\w+)\.md\)", text[:text.index(EQUATIONS)]))}
    rows = [f"| [{title}](theory/{name}.md) | {', '.join(f'[({number})](theory/{name}.md#{anchor})' for number, anchor in equations_of(ROOT / f'doc/theory/{name}.md'))} |\n"
            for name, title in reversed(linked.items())]
    return text, table, EQUATIONS + "".join(rows)


@functools.lru_cache(maxsize=None)
def message_index():
    """The program tools/message_index as a module, which reads the sources once for all tests."""
    loader = importlib.machinery.SourceFileLoader("message_index", str(ROOT / "tools/message_index"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    with unittest.mock.patch("sys.dont_write_bytecode", True):
        loader.exec_module(module)
    return module


def remedies():
    return (ROOT / "doc/remedies.txt").read_text()


def messages():
    """doc/messages.md as the sources have it."""
    return "\n".join(message_index().index(remedies())[0]).rstrip() + "\n"


def sources():
    return "".join(path.read_text() for pattern in ("*.cc", "*.h") for path in sorted([*(ROOT / "src").rglob(pattern), *(ROOT / "include").rglob(pattern)]))


def codes_of(page):
    """The codes that begin the rows of a table."""
    cells = re.findall(r"^\| (`\w+`[^|]*) \|", (ROOT / "doc" / page).read_text(), re.MULTILINE)
    return [code for cell in cells for code in re.findall(r"`(\w+)`", cell)]


class Pages(unittest.TestCase):
    def test_diffs_apply(self):
        """Each file of a diff is there, or is a new one of a folder, and its places and the lines that it keeps or takes away are there."""
        for page in pages():
            for block in re.findall(r"^```diff\n(.*?)^```$", page.read_text(), re.DOTALL | re.MULTILINE):
                for name, changes in re.findall(r"^--- (\S+)\n(.*?)(?=^--- |\Z)", block, re.DOTALL | re.MULTILINE):
                    with self.subTest(page=page.name, file=name):
                        path = ROOT / name
                        text = " ".join(path.read_text().split()) if path.exists() else ""
                        places = re.findall(r"^@@ (.*)", changes, re.MULTILINE)
                        self.assertTrue(path.exists() or (path.parent.is_dir() and not places))
                        for place in places:
                            self.assertTrue(place in text, place)
                        for line in re.findall(r"^[- ]\s*(\S.*)", changes, re.MULTILINE):
                            self.assertTrue(" ".join(line.split()) in text, line)

    def test_links_lead_somewhere(self):
        known = {}
        for page in pages():
            for target in re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text())):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, anchor = target.partition("#")
                place = pathlib.Path(os.path.normpath(page.parent / path)) if path else page
                with self.subTest(page=str(page.relative_to(ROOT)), link=target):
                    self.assertTrue(place.exists())
                    if anchor and place.suffix == ".md":
                        if place not in known:
                            known[place] = anchors(place)
                        self.assertIn(anchor, known[place])

    def test_every_decision_is_in_the_index_once(self):
        index = (ROOT / "doc/decisions/README.md").read_text()
        listed = re.findall(r"^- \d+: \[.*\]\((\S+\.md)\)", index, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(path.name for path in (ROOT / "doc/decisions").glob("0*.md")))

    def test_the_study_page_lists_all_keys(self):
        text, table, right = study()
        self.assertEqual(table, right, "pages_test.py --write")
        for page in (ROOT / "doc/study").glob("*.md"):
            self.assertIn(f"](study/{page.name})", text)

    def test_the_theory_page_leads_to_all_equations(self):
        """Those of its chapters, and those that comments cite."""
        text, table, right = theory()
        self.assertEqual(table, right, "pages_test.py --write")
        for chapter in (ROOT / "doc/theory").glob("*.md"):
            self.assertIn(f"](theory/{chapter.name})", text)
        cited = set(re.findall(r"doc/theory\.md(?:\s|///?)+\((\w+)\)", sources()))
        self.assertGreater(len(cited), 70)
        self.assertEqual(cited - set(re.findall(r"\[\((\w+)\)\]", table)), set())

    def test_the_page_of_messages_is_that_of_the_sources(self):
        page, right = (ROOT / "doc/messages.md").read_text(), messages()
        differing = set(page.splitlines()) ^ set(right.splitlines())
        self.assertTrue(page == right, f"pages_test.py --write; of these lines page and sources differ: {sorted(differing)[:5]}")

    def test_every_message_has_a_remedy(self):
        """An allowed value, a code with a page, or an entry of doc/remedies.txt; and each entry has its message."""
        _, faults, listed = message_index().index(remedies())
        self.assertEqual(faults[:5], [], "correct doc/remedies.txt")
        self.assertGreater(len(listed), 1000)

    def test_the_check_finds_what_is_missing(self):
        """A message of which nobody has said anything, one that says itself what it needs, patterns that excuse, codes and messages that do not exist."""
        text = remedies()
        clear = "\n… takes no value\n"
        self.assertEqual(text.count(clear), 1)
        for changed, fault in ((text.replace(clear, "\n"), "Command line: no remedy for: … takes no value"),
                               (text.replace(clear, "\n… takes no *\n"), "Command line: a pattern is not clear by itself, write the messages: … takes no *"),
                               (text.replace(clear, clear + "the name of the new folder is not given\n"),
                                "Command line: has an allowed value or a code, and needs no entry: the name of the new folder is not given"),
                               (text.replace(clear, clear + "  [no_such_code](warnings.md)\n"), "Command line: no row for the code no_such_code: … takes no value"),
                               (text.replace(clear, clear + "nobody says this\n"), "Command line: no message for the remedy of: nobody says this")):
            self.assertIn(fault, message_index().index(changed)[1])

    def test_what_a_user_sees_is_found(self):
        listed = message_index().index(remedies())[2]
        for row in ("Study: runs, samples, starts: nothing is uncertain | `at least one PARAMETER: {uniform: [lower, upper]}` |",
                    "Runs and gradients: more than … steps (solver.maximum_steps) | [too_many_steps](statuses.md) |",
                    # of Python: raised, told the parser of arguments, put together before, printed to stderr
                    "Python: identify() with arrays needs their times | = |", "Panel, page of a running search: --port: out of range | `0 to 65535` | scripts/panel, scripts/watch"):
            self.assertTrue(any(line.startswith(row) for line in listed), row)
        page = (ROOT / "doc/messages.md").read_text()
        for row in ("the slope is … of the start's` |", "… = … was not taken; there is no such parameter; the warnings of the run say why` | a value within its bounds ",
                    "… cells, the first line has …; the table is damaged` | the folder of a running or finished ",
                    "| `a file of this job is damaged, or written by another version of this program; run the job again`"):
            self.assertIn(row, page)
        self.assertNotIn("nothing is uncertain", page, "the message says what is allowed")

    def test_every_warning_has_a_row(self):
        code = sources()
        said = set(re.findall(r'(?:\bwarn\w*|warning\w*|\bdoubt|warnings\w*\.push_back|Warning)[({]+\s*"([a-z]+(?:_[a-z]+)+)"', code))
        rows = codes_of("warnings.md")
        self.assertGreater(len(said), 50)
        self.assertEqual(said - set(rows), set())
        self.assertEqual(len(rows), len(set(rows)), "a code has one row")
        for row in rows:
            self.assertTrue(f'"{row}"' in code, f"no source knows {row}")

    def test_every_status_has_a_row(self):
        named = re.findall(r'return "(\w+)";', (ROOT / "src/text/status.cc").read_text())
        rows = codes_of("statuses.md")
        self.assertGreater(len(named), 15)
        self.assertEqual(set(named) - {"unknown"} - set(rows), set())
        self.assertEqual(len(rows), len(set(rows)), "a code has one row")


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        page, old, new = study()
        (ROOT / "doc/study.md").write_text(page.replace(old, new))
        page, old, new = theory()
        (ROOT / "doc/theory.md").write_text(page.replace(old, new))
        (ROOT / "doc/messages.md").write_text(messages())
    else:
        unittest.main()
