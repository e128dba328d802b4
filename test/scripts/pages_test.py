#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The pages: their links lead somewhere, and doc/study.md lists every key. Usage: pages_test.py [--write]

--write puts the table of all keys into doc/study.md.
"""
import html
import os
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = "| block or key | keys in it | page |\n|---|---|---|\n"


def pages():
    return sorted([*ROOT.glob("*.md"), *(ROOT / "doc").rglob("*.md"), *(ROOT / "gallery").rglob("*.md")])


def without_code(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)


def anchors(path):
    """The anchors of a page's headings, by the rule of GitHub."""
    found = set()
    for heading in re.findall(r"^#+ (.*)", without_code(path.read_text()), re.MULTILINE):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        anchor = re.sub(r"[^\w\- ]", "", html.unescape(text).strip().lower()).replace(" ", "-")
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


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        page, old, new = study()
        (ROOT / "doc/study.md").write_text(page.replace(old, new))
    else:
        unittest.main()
