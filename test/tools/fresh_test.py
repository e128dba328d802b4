#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The arguments of tools/fresh, and what it says where it cannot work; it makes no Debian here. Usage: fresh_test.py [-v]"""
import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def fresh(*arguments, **environment):
    return subprocess.run([os.path.join(ROOT, "tools", "fresh"), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, **environment}, stdin=subprocess.DEVNULL)


def plan(*arguments):
    result = fresh("--dry-run", *arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout.splitlines()


class FreshTest(unittest.TestCase):
    def test_types_the_commands_of_the_readme(self):
        self.assertEqual(plan(), ["release: bookworm", "user: root", "home: /root", "command: ./tools/demo", "command: ./tools/test"])

    def test_takes_a_release(self):
        self.assertEqual(plan("trixie")[0], "release: trixie")

    def test_takes_a_command_with_its_arguments(self):
        lines = plan("trixie", "./tools/test", "-R", "two words", "--user")
        self.assertEqual(lines[0], "release: trixie")
        self.assertEqual([line.strip() for line in lines[3:]], [r"command: ./tools/test -R two\ words --user"])
        self.assertEqual(plan("./tools/test")[0], "release: bookworm")

    def test_takes_options(self):
        lines = plan("--user", "--read-only-home", "--copy", "a/b", "--copy", "c", "--with", "tools", "bookworm")
        self.assertEqual(lines[1:3], ["user: user", "home: /home/user, read-only"])
        self.assertEqual(lines[-3:], ["with: tools", "copy: a/b", "copy: c"])

    def test_refuses_what_it_does_not_know(self):
        for arguments, complaint in ((["--usr"], "no such option: --usr"), (["sid"], "no such release here: sid"), (["--copy"], "--copy needs a path"),
                                     (["--with", "no/such"], "there is no no/such")):
            result = fresh(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(complaint, result.stderr)

    def test_help_shows_every_option(self):
        text = fresh("--help").stdout
        for option in ("--user", "--read-only-home", "--with", "--copy", "--dry-run", "RELEASE", "COMMAND"):
            self.assertIn(option, text)

    def test_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            # A machine without mount(8), where root calls.
            for program in ("bash", "dirname", "sed"):
                os.symlink(shutil.which(program), os.path.join(folder, program))
            for program in ("id", "git", "unshare", "chroot", "tar"):
                with open(os.path.join(folder, program), "w") as file:
                    file.write("#!/bin/sh\necho 0\n")
                os.chmod(file.name, 0o755)
            result = fresh(PATH=folder)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("a Debian system cannot be created here: the program mount is missing", result.stderr)


if __name__ == "__main__":
    unittest.main()
