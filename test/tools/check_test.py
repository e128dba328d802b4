#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""tools/check must fail on each kind of fault when one is planted in a tiny tree, and on nothing else. Usage: check_test.py [-v]"""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# The programs that tools/check needs in every case.
PROGRAMS = ("bash", "dirname", "find", "xargs", "mktemp", "rm", "git", "sort", "nproc", "grep", "sed", "paste", "awk", "env")


class CheckTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root, self.bin = os.path.join(folder.name, "checkout"), os.path.join(folder.name, "bin")
        os.mkdir(self.bin)
        for name in ("tools/changed", "tools/check", "tools/jobs", "test/layering/check_layering.py", ".clang-format"):
            os.makedirs(os.path.dirname(os.path.join(self.root, name)), exist_ok=True)
            shutil.copy(os.path.join(ROOT, name), os.path.join(self.root, name))
        self.plant("src/math/twice.h", "inline int twice(int x) { return 2 * x; }\n")
        self.plant("src/math/twice.cc", '#include "math/twice.h"\n')

    def plant(self, name, text):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(text)
        return path

    def program(self, name, text):
        """A stand-in, which is found before the program that it stands in for."""
        with open(os.path.join(self.bin, name), "w") as file:
            file.write("#!/bin/bash\n" + text)
        os.chmod(file.name, 0o755)

    def check(self, *arguments, path=None):
        """Exit code, results by check, and all output."""
        result = subprocess.run([os.path.join(self.root, "tools", "check"), *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={"PATH": path or self.bin + ":" + os.environ["PATH"], "GIT_CEILING_DIRECTORIES": os.path.dirname(self.root)})
        return result.returncode, dict(re.findall(r"^(\w+) +(ok|FAILED|skipped) +\d+ s$", result.stdout, re.MULTILINE)), result.stdout

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", "-c", "init.defaultBranch=main", *arguments], cwd=self.root, check=True,
                       stdout=subprocess.DEVNULL)

    def compile_database(self, *names):
        flags = "-O3 -mmove-max=256 -mstore-max=256 --param=large-function-growth=2000 -Wno-maybe-uninitialized -Wall -Winvalid-pch -include /b/cmake_pch.hxx"
        entries = [{"directory": self.root, "file": os.path.join(self.root, name), "command": f"/usr/bin/ccache /usr/bin/c++ {flags} -c {name}"}
                   for name in names]
        self.plant("build/compile_commands.json", json.dumps(entries))

    @unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
    def test_format(self):
        self.assertEqual(self.check("format")[:2], (0, {"format": "ok"}))
        self.plant("src/math/ugly.cc", "int  ugly( ){return 1 ;}\n")
        status, results, output = self.check("format")
        self.assertEqual((status, results), (1, {"format": "FAILED"}))
        self.assertIn("src/math/ugly.cc:1:", output)

    def test_layering(self):
        self.assertEqual(self.check("layering")[:2], (0, {"layering": "ok"}))
        self.plant("src/math/early.cc", '#include "joints/pair_rows.h"\n')
        status, results, output = self.check("layering")
        self.assertEqual((status, results), (1, {"layering": "FAILED"}))
        self.assertIn("src/math/early.cc:1: math/ includes joints/", output)

    def test_scripts(self):
        self.program("shellcheck", "exit 0\n")
        self.plant("scripts/good", "#!/usr/bin/python3\nprint(1)\n")
        self.assertEqual(self.check("scripts")[:2], (0, {"scripts": "ok"}))
        for script in ("#!/usr/bin/env bash\nif true; then\n", "#!/usr/bin/python3\nprint(1\n"):
            path = self.plant("scripts/bad", script)
            status, results, output = self.check("scripts")
            self.assertEqual((status, results), (1, {"scripts": "FAILED"}), output)
            self.assertIn("scripts/bad", output)
            os.remove(path)
        for name in ("python/package/_part.py", "python/package/_core.pyi", "scripts/report/page.py"):  # modules have no first line
            path = self.plant(name, "def f(:\n    pass\n")
            status, results, output = self.check("scripts")
            self.assertEqual((status, results), (1, {"scripts": "FAILED"}), output)
            self.assertIn(name, output)
            os.remove(path)
        shutil.rmtree(os.path.join(self.root, "scripts/report"))
        self.program("shellcheck", "exit 1\n")
        self.assertEqual(self.check("scripts")[0], 1)
        self.assertEqual([name for name in os.listdir(os.path.join(self.root, "scripts")) if name != "good"], [])

    def test_tidy_reads_what_clang_understands(self):
        self.program("clang-tidy", 'echo "$*"; cat build/tidy/compile_commands.json; echo\n')
        self.compile_database("src/math/twice.cc")
        status, results, output = self.check("tidy", "src/math/twice.cc")
        self.assertEqual((status, results), (0, {"tidy": "ok"}), output)
        self.assertIn("--warnings-as-errors=*", output)
        with open(os.path.join(self.root, "build", "tidy", "compile_commands.json")) as file:
            self.assertEqual(json.load(file)[0]["arguments"], ["/usr/bin/c++", "-O3", "-Wall", "-c", "src/math/twice.cc"])

    def test_a_finding_of_tidy_is_an_error(self):
        self.program("clang-tidy", "exit 1\n")
        self.compile_database("src/math/twice.cc")
        self.assertEqual(self.check("tidy", "src/math/twice.cc")[:2], (1, {"tidy": "FAILED"}))

    @unittest.skipUnless(shutil.which("git"), "git is not installed")
    def test_tidy_looks_at_what_was_changed(self):
        self.program("clang-tidy", 'echo "tidy of ${!#}"\n')
        self.compile_database("src/math/twice.cc", "src/math/old.cc", "src/math/new.cc")
        self.plant("src/math/old.cc", "")
        self.git("init", "-q")
        self.git("add", "src")
        self.git("commit", "-qm", "one")
        self.git("checkout", "-qb", "topic")
        self.assertNotIn("tidy of", self.check("tidy")[2])
        self.plant("src/math/twice.h", "inline int twice(int x) { return x + x; }\n")
        self.git("commit", "-qam", "two")
        self.plant("src/math/new.cc", "")
        output = self.check("tidy")[2]
        self.assertEqual(sorted(re.findall("tidy of (.*)", output)), ["src/math/new.cc", "src/math/twice.cc"], output)

    @unittest.skipUnless(all(shutil.which(name) for name in PROGRAMS), "a program is not installed")
    def test_without_arguments_missing_programs_are_skipped(self):
        for name in PROGRAMS:
            os.symlink(shutil.which(name), os.path.join(self.bin, name))
        status, results, output = self.check(path=self.bin)
        self.assertEqual((status, results), (0, {"format": "skipped", "layering": "ok", "scripts": "ok", "tidy": "skipped"}), output)
        self.assertIn("clang-format is not installed", output)
        self.assertEqual(self.check("format", path=self.bin)[:2], (1, {"format": "FAILED"}))

    def test_sanitizers(self):
        os.chmod(self.plant("tools/sanitize", '#!/bin/bash\necho "sanitize $*"\n[ "$1" = address ]\n'), 0o755)
        status, results, output = self.check("address", "thread")
        self.assertEqual((status, results), (1, {"address": "ok", "thread": "FAILED"}))
        self.assertIn("sanitize address", output)

    def test_an_unknown_check_is_refused(self):
        status, _, output = self.check("formatt")
        self.assertEqual(status, 2)
        self.assertIn("formatt", output)
        self.assertIn("--all", output)


if __name__ == "__main__":
    unittest.main()
