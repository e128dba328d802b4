#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Replaces the tables of documents by new ones of the same names.

Usage: update_tables.py DOCUMENT... TABLES. A table stands between the lines `<!-- table: NAME -->` and `<!-- end: NAME -->` in all files. A table that
no document has a place for is an error; one that is not among the new tables stays as it is.
"""
import pathlib
import re
import sys

TABLE = re.compile(r"<!-- table: (\w+) -->\n.*?<!-- end: \1 -->", re.DOTALL)


def updated(document, tables):
    """The document with every table that `tables` holds replaced, and the names of tables without a place."""
    new = {match.group(1): match.group(0) for match in TABLE.finditer(tables)}
    homeless = set(new) - {match.group(1) for match in TABLE.finditer(document)}
    return TABLE.sub(lambda match: new.get(match.group(1), match.group(0)), document), sorted(homeless)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    *documents, tables = map(pathlib.Path, sys.argv[1:])
    new = tables.read_text(encoding="utf-8")
    made = {path: updated(path.read_text(encoding="utf-8"), new) for path in documents}
    if homeless := set.intersection(*(set(names) for _, names in made.values())):
        sys.exit(f"{', '.join(map(str, documents))}: no place for the tables {', '.join(sorted(homeless))}")
    for path, (text, _) in made.items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
