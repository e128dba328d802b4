#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The layering check must notice each kind of violation when one is planted, and nothing in a tree without any."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True
import check_layering  # noqa: E402


class PlantedViolations(unittest.TestCase):
    def setUp(self):
        self._directory = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._directory.name)
        self.addCleanup(self._directory.cleanup)
        self.plant("include/mechanism_codesign/error.h", "#include <string>\n")
        self.plant("src/math/a.h", "#include <Eigen/Core>\n")
        self.plant("src/ros/node.cc", '#include <ros/ros.h>\n#include "mechanism_codesign/Optimize.h"\n#include "math/a.h"\n')

    def plant(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def violations(self):
        return check_layering.check(self.root)[0]

    def assert_only(self, place, words):
        violations = self.violations()
        self.assertEqual(len(violations), 1, violations)
        self.assertTrue(violations[0].startswith(place), violations)
        self.assertIn(words, violations[0])

    def test_a_clean_tree_has_none(self):
        self.assertEqual(self.violations(), [])

    def test_backward_include(self):
        self.plant("src/mechanism/b.cc", '#include <map>\n#include "equations/equations.h"\n')
        self.assert_only("src/mechanism/b.cc:2", "mechanism/ includes equations/")

    def test_backward_include_of_a_public_header(self):
        self.plant("src/math/b.cc", '#include "mechanism_codesign/error.h"\n#include "mechanism_codesign/frame.h"\n')
        self.assert_only("src/math/b.cc:2", "math/ includes observation/")

    def test_public_header_without_a_room(self):
        self.plant("include/mechanism_codesign/b.h", "\n")
        self.assert_only("include/mechanism_codesign/b.h:1", "no place")

    def test_neighbours_in_one_row(self):
        self.plant("src/joints/b.cc", '#include "forces/friction.h"\n')
        self.assert_only("src/joints/b.cc:1", "joints/ includes forces/")

    def test_command_line_does_not_include_ros(self):
        self.plant("src/cli/b.cc", '#include "ros/conversions.h"\n')
        self.assert_only("src/cli/b.cc:1", "cli/ includes the ROS header")

    def test_ros_header_outside_ros(self):
        for header in ["ros/ros.h", "sensor_msgs/JointState.h", "rosbag/bag.h", "mechanism_codesign/JointFriction.h", "tf2_ros/buffer.h"]:
            self.plant("src/optimization/b.cc", f"#include <{header}>\n")
            self.assert_only("src/optimization/b.cc:1", "ROS header")

    def test_unknown_folder(self):
        self.plant("src/misc/b.cc", "\n")
        self.assert_only("src/misc/b.cc:1", "no place")

    def test_long_file(self):
        self.plant("src/math/b.cc", "\n" * 400)
        self.assertEqual(self.violations(), [])
        self.plant("src/math/b.cc", "\n" * 401)
        self.assert_only("src/math/b.cc:401", "401 lines")

    def test_long_function(self):
        body = '  if (x) { y("}{"); }  // }\n'
        for head in ["int f(int x) {\n", "template <class T>\nauto Outer<T>::f(int x) const -> int {\n"]:
            allowed = 60 - head.count("\n") - 1
            self.plant("src/math/b.cc", "namespace n {\n" + head + body * allowed + "}\n}  // namespace n\n")
            self.assertEqual(self.violations(), [])
            self.plant("src/math/b.cc", "namespace n {\n" + head + body * (allowed + 1) + "}\n}  // namespace n\n")
            self.assert_only("src/math/b.cc:2", "function of 61 lines")

    def test_long_class_or_table_is_no_function(self):
        self.plant("src/math/b.cc", "struct S {\n" + "  int f() { return 1; }\n" * 80 + "};\nconst int t[] = {\n" + "  1,\n" * 80 + "};\n")
        self.assertEqual(self.violations(), [])

    def test_long_member_function_inside_a_class(self):
        self.plant("src/math/b.cc", "class S {\n public:\n  int f() {\n" + "    g();\n" * 70 + "  }\n};\n")
        self.assert_only("src/math/b.cc:3", "function of 72 lines")


if __name__ == "__main__":
    unittest.main()
