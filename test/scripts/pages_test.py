#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The pages: their links lead somewhere, doc/study.md lists every key, doc/theory.md every equation, and doc/messages.md, doc/warnings.md and doc/statuses.md every sentence and code of the sources. Usage: pages_test.py [--write]

--write puts the table of all keys into doc/study.md, that of equations into doc/theory.md, and the sentences into doc/messages.md.
"""
import functools
import html
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = "| block or key | keys in it | page |\n|---|---|---|\n"
EQUATIONS = "| chapter | equations |\n|---|---|\n"


def pages():
    return sorted([*ROOT.glob("*.md"), *(ROOT / "doc").rglob("*.md"), *(ROOT / "gallery").rglob("*.md")])


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
def messages():
    """doc/messages.md as the sources have it."""
    return subprocess.run([sys.executable, "-B", ROOT / "tools/message_index"], capture_output=True, text=True, check=True).stdout


def sources():
    return "".join(path.read_text() for pattern in ("*.cc", "*.h") for path in sorted([*(ROOT / "src").rglob(pattern), *(ROOT / "include").rglob(pattern)]))


def codes_of(page):
    """The codes that begin the rows of a table."""
    cells = re.findall(r"^\| (`\w+`[^|]*) \|", (ROOT / "doc" / page).read_text(), re.MULTILINE)
    return [code for cell in cells for code in re.findall(r"`(\w+)`", cell)]


class Pages(unittest.TestCase):
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

    def test_every_message_is_in_the_index(self):
        page, right = (ROOT / "doc/messages.md").read_text(), messages()
        differing = set(page.splitlines()) ^ set(right.splitlines())
        self.assertTrue(page == right, f"pages_test.py --write; of these lines page and sources differ: {sorted(differing)[:5]}")

    def test_every_message_has_a_remedy(self):
        """An allowed value, a code with a page, or an entry of doc/remedies.txt; and each entry has its message."""
        check = subprocess.run([sys.executable, "-B", ROOT / "tools/message_index", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual((check.stdout.split("\n")[:5], check.returncode), (["", ""], 0), "correct doc/remedies.txt")
        rows = [re.split(r"(?<!\\) \| ", line) for line in messages().splitlines() if line.startswith(("| `", "| ``"))]
        self.assertGreater(len(rows), 900)
        self.assertEqual([row[0] for row in rows if not row[1].strip()], [])

    def test_the_index_has_what_a_user_sees(self):
        index = (ROOT / "doc/messages.md").read_text().splitlines()
        for row in ("| `nothing is uncertain` | `at least one PARAMETER: {uniform: [lower, upper]}` |", "| `more than \N{HORIZONTAL ELLIPSIS} steps (solver.maximum_steps)` | [too_many_steps](statuses.md) |",
                    "| `the slope is \N{HORIZONTAL ELLIPSIS} of the start's` |",
                    # of Python: raised, told the parser of arguments, put together before, printed to stderr
                    "| `identify() with arrays needs their times` | `identify(time, position=..., effort=...)`, ", "| `--port: out of range` | `0 to 65535` | scripts/panel, scripts/watch |",
                    "| `\N{HORIZONTAL ELLIPSIS} = \N{HORIZONTAL ELLIPSIS} was not taken; there is no such parameter; the warnings of the run say why` | a value within its bounds ",
                    "| `\N{HORIZONTAL ELLIPSIS} cells, the first line has \N{HORIZONTAL ELLIPSIS}; the table is damaged` | the folder of a running or finished ",
                    "| `a file of this job is damaged, or written by another version of this program; run the job again` | the file that the message names "):
            self.assertTrue(any(line.startswith(row) for line in index), row)

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
