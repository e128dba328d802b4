#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What the files of a clone take: 12.8 MB at most. Usage: clone_test.py [-v]"""
import os
import shutil
import subprocess
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ALL_FILES, ONE_FILE = 12_800_000, 210_000  # [bytes]


def sizes():
    """The size of each file that git tracks, by its name; empty where there is no git, or this is no checkout."""
    if not shutil.which("git"):
        return {}
    # Root may work in a checkout of another user.
    listed = subprocess.run(["git", "-c", f"safe.directory={ROOT}", "ls-files", "-z"], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    paths = {name: os.path.join(ROOT, name) for name in listed.stdout.split("\0") if name}
    return {name: os.path.getsize(path) for name, path in paths.items() if os.path.exists(path)}


@unittest.skipUnless(sizes(), "no git, or no checkout of it")
class CloneTest(unittest.TestCase):
    def test_all_files_together(self):
        largest = sorted(sizes().items(), key=lambda each: -each[1])[:10]
        self.assertLess(sum(sizes().values()), ALL_FILES, f"the largest files: {largest}")

    def test_no_file_is_a_recording(self):
        self.assertEqual([each for each in sizes().items() if each[1] > ONE_FILE], [])

    def test_pictures_have_a_palette(self):
        """Figures then take a quarter: doc/building.md has the command."""
        for name in sizes():
            if name.endswith(".png"):
                with open(os.path.join(ROOT, name), "rb") as file:
                    self.assertEqual(file.read(26)[25], 3, name)


if __name__ == "__main__":
    unittest.main()
