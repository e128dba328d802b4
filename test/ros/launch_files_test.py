#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Every launch file is started by a rostest; `roslaunch --ros-args` prints a meaning of each of its arguments, and doc/ros_api.md names them.
Usage: launch_files_test.py ROOT"""
import os
import pathlib
import re
import sys


def documented(page):
    """{launch file: arguments that the table of the page names}, those of all files included."""
    table = page[page.index("## Launch files"):]
    rows = dict(re.findall(r"^\| `(\w+\.launch)` \|(.*)\|$", table, re.MULTILINE))
    shared = {"model", "study", "overlays", "case", "set"}
    return {file: shared | set(re.findall(r"`(\w+)`", row)) for file, row in rows.items()}


def faults(root):
    tests = "".join(path.read_text() for path in (root / "test" / "ros").iterdir() if path.suffix == ".test" or path.name.endswith("_rostest.py"))
    named = documented((root / "doc" / "ros_api.md").read_text())
    os.environ["ROS_PACKAGE_PATH"] = str(root)
    from roslaunch.arg_dump import get_args  # after its environment is set
    for path in sorted((root / "launch").glob("*.launch")):
        if path.name not in tests:
            yield f"no rostest starts {path.name}"
        for name, (meaning, _) in get_args([str(path)]).items():
            if not meaning:
                yield f"{path.name}: {name} has no doc"
            if name not in named.get(path.name, ()):
                yield f"{path.name}: doc/ros_api.md does not name {name}"


def main():
    found = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    sys.exit("\n".join(found) if found else 0)


if __name__ == "__main__":
    main()
