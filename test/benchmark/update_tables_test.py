#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Tests of benchmark/update_tables.py."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmark"))
import update_tables  # noqa: E402


def table(name, content):
    return f"<!-- table: {name} -->\n{content}\n<!-- end: {name} -->"


class UpdatedTest(unittest.TestCase):
    def test_replaces_tables_of_the_same_name_only(self):
        document = f"Before\n{table('a', 'old a')}\nbetween\n{table('b', 'old b')}\nafter\n"
        text, homeless = update_tables.updated(document, table("b", "new \\1 b") + "\n")
        self.assertEqual(text, document.replace("old b", "new \\1 b"))
        self.assertEqual(homeless, [])

    def test_names_tables_without_a_place(self):
        text, homeless = update_tables.updated(table("a", "old"), table("a", "new") + "\n" + table("c", "new"))
        self.assertEqual(text, table("a", "new"))
        self.assertEqual(homeless, ["c"])

    def test_the_documents_tables_are_whole(self):
        document = (pathlib.Path(update_tables.__file__).resolve().parents[1] / "doc" / "performance.md").read_text(encoding="utf-8")
        self.assertEqual(document.count("<!-- table: "), len(update_tables.TABLE.findall(document)))
        self.assertEqual(document.count("<!-- end: "), len(update_tables.TABLE.findall(document)))
        self.assertGreater(len(update_tables.TABLE.findall(document)), 10)


if __name__ == "__main__":
    unittest.main()
