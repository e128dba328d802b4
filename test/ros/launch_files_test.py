#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Every launch file is started by a rostest. Usage: launch_files_test.py ROOT"""
import pathlib
import sys


def main():
    root = pathlib.Path(sys.argv[1])
    tests = "".join(path.read_text() for path in (root / "test" / "ros").iterdir() if path.suffix == ".test" or path.name.endswith("_rostest.py"))
    missing = [path.name for path in (root / "launch").glob("*.launch") if path.name not in tests]
    sys.exit(f"no rostest starts {', '.join(missing)}" if missing else 0)


if __name__ == "__main__":
    main()
