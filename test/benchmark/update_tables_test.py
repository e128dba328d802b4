#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Tests of benchmark/update_tables.py."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmark"))
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
        names = []
        for path, least in (("doc/performance.md", 10), ("benchmark/sweeps.md", 4)):
            document = (ROOT / path).read_text(encoding="utf-8")
            found = update_tables.TABLE.findall(document)
            self.assertEqual(document.count("<!-- table: "), len(found))
            self.assertEqual(document.count("<!-- end: "), len(found))
            self.assertGreater(len(found), least)
            names += found
        self.assertEqual(len(names), len(set(names)), "a table has one place")

    def test_a_table_needs_a_place_in_one_of_the_documents(self):
        with tempfile.TemporaryDirectory() as folder:
            first, second, tables = (pathlib.Path(folder) / name for name in ("first.md", "second.md", "tables.md"))
            first.write_text(table("a", "old"), encoding="utf-8")
            second.write_text(table("b", "old"), encoding="utf-8")
            program = [sys.executable, "-B", ROOT / "benchmark/update_tables.py", first, second, tables]
            tables.write_text(table("a", "new") + "\n" + table("b", "new"), encoding="utf-8")
            self.assertEqual(subprocess.run(program, check=False).returncode, 0)
            self.assertEqual([path.read_text(encoding="utf-8") for path in (first, second)], [table("a", "new"), table("b", "new")])
            tables.write_text(table("a", "newest") + "\n" + table("c", "new"), encoding="utf-8")
            failed = subprocess.run(program, check=False, capture_output=True, text=True)
            self.assertEqual((failed.returncode, failed.stderr.endswith("no place for the tables c\n")), (1, True))
            self.assertEqual(first.read_text(encoding="utf-8"), table("a", "new"))


if __name__ == "__main__":
    unittest.main()
