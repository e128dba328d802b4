#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Checks the order of the rooms in the compiled library: no object uses a function that an object of a room above it defines.

Usage: check_symbols.py OBJECT_DIRECTORY... Their folders are the rooms; units of several files are named unity_ROOM..., in Unity/. Templates and inline functions, which every object holds, are left out.
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True
import check_layering  # noqa: E402


def symbols(path):
    """(defined, undefined) names of an object."""
    defined, undefined = set(), set()
    for line in subprocess.run(["nm", "-C", str(path)], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines():
        kind, _, name = line[17:].partition(" ")
        if kind in "TDBR":
            defined.add(name)
        elif kind == "U":
            undefined.add(name)
    return defined, undefined


def room_of(path, root):
    """The room whose code an object holds; None for none of the core's."""
    folder = path.relative_to(root).parts[0]
    if folder == "Unity":
        folder = path.name.split("_")[1]
    return folder if folder in check_layering.ROW_OF else None


def check(used_by, defined_by):
    """Violations, from the names that each room uses and the room that defines each name."""
    rows = check_layering.ROW_OF
    return sorted(f"{room}/ calls {name}, which {defined_by[name]}/ defines above it" for room, names in used_by.items() for name in names
                  if name in defined_by and defined_by[name] != room and rows[defined_by[name]] >= rows[room])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    roots = [pathlib.Path(name) for name in sys.argv[1:]]
    used_by, defined_by, objects = {}, {}, [(path, root) for root in roots for path in sorted(root.glob("**/*.o"))]
    for path, root in objects:
        room = room_of(path, root)
        if room is None:
            continue
        defined, undefined = symbols(path)
        used_by.setdefault(room, set()).update(undefined)
        defined_by.update({name: room for name in defined})
    if not used_by:
        sys.exit(f"no objects below {sys.argv[1:]}")
    violations = check(used_by, defined_by)
    print(f"{len(objects)} objects, {len(defined_by)} functions")
    for violation in violations:
        print(violation)
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
