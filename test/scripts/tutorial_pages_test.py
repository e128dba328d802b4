#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The tutorials doc/tutorials/*.md and the pages with worked examples are typed in a folder of their own, and print what stands there. Usage: tutorial_pages_test.py CODESIGN [--ros] [PAGE...]

The folder has `urdf` and `config` of the package. A block of xml, yaml or python that begins with a comment with a file's name is written to this file. In a block `console` the lines after "$ " are commands, each of which must
succeed; the lines below are what it prints. Standard output must be there completely; "..." stands for anything in a line, and alone for any lines. Of standard error, only the
lines that the page shows must be there. A block `console ros` is typed only if the program reads bags, as --ros says, a block `console without-ros` only if not. Words agree exactly, spaces in any number; numbers agree to 0.2 %.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
FILE = re.compile(r"(?:<\?xml[^\n]*\n)?(?:<!--|#) ([\w.]+\.\w+)(?: -->)?\n")
TOLERANCE = 2e-3
EXAMPLES = ["doc/actuators.md", "doc/study/postures.md"]
OPTIONS = sys.argv[2:]
NOT_TYPED = "without-ros" if "--ros" in OPTIONS else "ros"


def pages():
    return [option for option in OPTIONS if option != "--ros"] or sorted(glob.glob(os.path.join(ROOT, "doc/tutorials/*.md"))) + [os.path.join(ROOT, page) for page in EXAMPLES]


def blocks(text):
    """(kind, content) of those that are typed."""
    found = re.findall(r"^```(\w+)(?: (ros|without-ros))?\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    return [(kind, content) for kind, where, content in found if where != NOT_TYPED]


def commands(block):
    """(command, lines that it prints)"""
    found = []
    for line in block.splitlines():
        if line.startswith("$ "):
            found.append([line[2:], []])
        elif found and not found[-1][1] and found[-1][0].endswith("\\"):
            found[-1][0] += "\n" + line
        else:
            found[-1][1].append(line)
    return found


def agrees(shown, printed):
    """Whether a line of the page is this line of the output."""
    shown, printed = " ".join(shown.split()), " ".join(printed.split())
    pattern, numbers = "", []
    for part in re.split(rf"(\.\.\.|{NUMBER})", shown):
        if part == "...":
            pattern += ".*?"
        elif re.fullmatch(NUMBER, part):
            pattern += f"({NUMBER})"
            numbers.append(float(part))
        else:
            pattern += re.escape(part)
    match = re.fullmatch(pattern, printed)
    return bool(match) and all(abs(float(found) - number) <= TOLERANCE * abs(number) for number, found in zip(numbers, match.groups()))


def difference(shown, output, errors):
    """The first line of the page that is not printed, or the first one printed that is not on the page; "" if there is none."""
    output, errors, is_gap = list(output), list(errors), False
    for line in shown:
        if line.strip() == "...":
            is_gap = True
            continue
        place = next((k for k, printed in enumerate(output) if agrees(line, printed)), None)
        if place is not None and (is_gap or place == 0):
            del output[:place + 1]
            is_gap = False
            continue
        place = next((k for k, printed in enumerate(errors) if agrees(line, printed)), None)
        if place is None:
            return f"the page has\n  {line}\nstandard output goes on with\n  " + "\n  ".join(output[:5]) + "\nstandard error with\n  " + "\n  ".join(errors[:5])
        del errors[place]
    return "" if is_gap or not output else "not on the page:\n  " + "\n  ".join(output[:5])


class TutorialPages(unittest.TestCase):
    def test_what_is_typed_prints_what_is_shown(self):
        self.assertGreater(len(pages()), 0)
        environment = {**os.environ, "PATH": os.pathsep.join([os.path.dirname(sys.argv[1]), os.path.join(ROOT, "scripts"), os.environ["PATH"]])}
        for page in pages():
            with open(page, encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
                text = file.read()
                for shipped in ("urdf", "config"):
                    os.symlink(os.path.join(ROOT, shipped), os.path.join(folder, shipped))
                found = blocks(text)
                self.assertTrue(any(kind == "console" for kind, _ in found))
                self.assertNotRegex(text, r"(?m)^```\w+ (?!(ros|without-ros)$)")
                for kind, block in found:
                    name = FILE.match(block)
                    if name:
                        with open(os.path.join(folder, name.group(1)), "w", encoding="utf-8") as written:
                            written.write(block)
                    for command, shown in commands(block) if kind == "console" else ():
                        with self.subTest(page=os.path.basename(page), command=command):
                            done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, check=False)
                            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                            wrong = difference(shown, done.stdout.splitlines(), done.stderr.splitlines())
                            self.assertFalse(wrong, wrong)

    def test_a_wrong_page_is_found(self):
        output = ["length  0.5  0.3435", "objective 1.35 -> 0.438", "done in 0.02 s"]
        for right in (["length 0.5 0.3436", "objective 1.35 -> 0.438", "done in ... s"], ["...", "done in 0.02 s"], ["length 0.5 0.3435", "...", "a warning of 7"]):
            self.assertEqual(difference(right, output, ["a warning of 7"]), "")
        for wrong in (["length 0.5 0.36", "..."], ["length 0.5 0.3435"], ["objective 1.35 -> 0.438", "..."], ["...", "done in 0.03 s"], ["...", "a warning of 8"], ["width ...", "..."]):
            self.assertNotEqual(difference(wrong, output, ["a warning of 7"]), "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
