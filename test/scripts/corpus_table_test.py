#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""scripts/corpus_table on files of its own. Usage: corpus_table_test.py CODESIGN"""
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PENDULUM = """<robot name="pendulum"><link name="ground"/>
<link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="0 1 0"/>%s</joint></robot>"""


class CorpusTable(unittest.TestCase):
    def test_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, more in {"fine": "", "odd": "<dynamics damping='0.1' colour='red'/>", "wrong": "<dynamics/>"}.items():
                with open(os.path.join(folder, name + ".urdf"), "w", encoding="utf-8") as file:
                    file.write(PENDULUM % more)
            done = subprocess.run([os.path.join(ROOT, "scripts", "corpus_table"), folder, "--codesign", sys.argv[1], "--seconds", "0.1"],
                                  stdout=subprocess.PIPE, text=True, check=True)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()]
        self.assertEqual(len(rows), 5)
        self.assertEqual(rows[2][:4], ["fine.urdf", "yes", "0", "1"])
        self.assertGreater(float(rows[2][4]), 0.0)
        self.assertEqual(rows[3][:3], ["odd.urdf", "yes", "1: `unknown_attribute` 1"])
        self.assertTrue(rows[4][1].startswith("no: bad_input: line 4:"), rows[4])

    def test_an_empty_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([os.path.join(ROOT, "scripts", "corpus_table"), folder], stderr=subprocess.PIPE, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no *.urdf", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
