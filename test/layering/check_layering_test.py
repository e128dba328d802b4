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
import check_symbols  # noqa: E402


class PlantedViolations(unittest.TestCase):
    def setUp(self):
        self._directory = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._directory.name)
        self.addCleanup(self._directory.cleanup)
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
        self.plant("src/mechanism/b.cc", '#include <map>\n#include "mechanism_codesign/simulation.h"\n')
        self.assert_only("src/mechanism/b.cc:2", "mechanism/ includes integration/")

    def test_backward_include_of_an_internal_header(self):
        self.plant("src/reading/urdf/b.cc", '#include "system/system.h"\n')
        self.assert_only("src/reading/urdf/b.cc:1", "reading/ includes system/")

    def test_backward_include_of_a_public_header(self):
        self.plant("include/mechanism_codesign/status.h", '#include "mechanism_codesign/frame.h"\n')
        self.assert_only("include/mechanism_codesign/status.h:1", "text/ includes observation/")

    def test_a_circle_of_includes_and_a_long_chain(self):
        self.plant("src/math/b.h", '#include "math/b.h"\n')
        self.assert_only("math/b.h:1", "leads back to itself")
        self.plant("src/math/b.h", "\n")
        for k in range(check_layering.MAX_DEPTH + 1):
            self.plant(f"src/math/c{k + 1}.h", f'#include "math/c{k}.h"\n')
        self.plant("src/math/c0.h", "\n")
        self.assert_only(f"math/c{check_layering.MAX_DEPTH + 1}.h:1", f"{check_layering.MAX_DEPTH + 1} headers deep")

    def test_a_declaration_of_a_class_above(self):
        self.plant("src/equations/code.h", "class Code {\n};\n")
        self.plant("src/system/b.h", "class Code;\n")
        self.assert_only("src/system/b.h:1", "system/ declares Code, which equations/ defines above it")
        self.plant("src/system/b.h", "\n")
        self.plant("src/assembly/b.h", "class Code;\n")
        self.assertEqual(self.violations(), [])

    def test_a_public_header_needs_a_room(self):
        self.plant("include/mechanism_codesign/misc.h", "\n")
        self.assert_only("include/mechanism_codesign/misc.h:1", "no place")

    def test_two_types_of_one_name_in_one_namespace(self):
        self.plant("src/text/b.h", "namespace codesign {\nstruct Bytes {\n  int count;\n};\n}\n")
        self.plant("src/math/b.cc", "namespace codesign {\nnamespace {\ntemplate <class T>\nclass Bytes final : public A<T> {\n};\n}\n}\n")
        self.assert_only("src/text/b.h:2", "Bytes is also defined in src/math/b.cc:4")

    def test_equal_names_in_other_scopes_are_two(self):
        self.plant("src/text/b.h", "namespace codesign {\nstruct Holder { struct Bytes {}; };\nnamespace other { enum class Bytes { kOne }; }\n}\n")
        for name in ("c", "d"):
            self.plant(f"src/math/{name}.cc", "namespace codesign {\nnamespace {\nstruct Words {\n};\n}\n}\n")
        self.plant("src/math/b.cc", "namespace codesign {\nstruct Bytes {\n};\nvoid f() { struct Bytes {}; }\n// struct Bytes {\nstruct Bytes copy() { return {}; }\n}\n")
        self.assertEqual(self.violations(), [])

    def test_neighbours_in_one_row(self):
        self.plant("src/ros/b.cc", '#include "cli/console.h"\n')
        self.assert_only("src/ros/b.cc:1", "ros/ includes cli/")

    def test_command_line_does_not_include_ros(self):
        self.plant("src/cli/b.cc", '#include "ros/common/door.h"\n')
        self.assert_only("src/cli/b.cc:1", "cli/ includes ros/")

    def test_backward_include_inside_ros(self):
        self.plant("src/ros/bags/b.cc", '#include <ros/time.h>\n#include "ros/scene/markers.h"\n#include "ros/common/worker.h"\n')
        self.assert_only("src/ros/bags/b.cc:3", "ros/bags/ includes ros/common/")
        self.plant("src/ros/bags/b.cc", "\n")
        self.plant("src/ros/simulation/b.cc", '#include "ros/apply/apply.h"\n')
        self.assert_only("src/ros/simulation/b.cc:1", "ros/simulation/ includes ros/apply/")

    def test_files_beside_the_inner_rooms_have_a_place_in_their_order(self):
        self.plant("src/identification/fit/b.cc", '#include "identification/identify.h"\n')
        self.assert_only("src/identification/fit/b.cc:1", "identification/fit/ includes identification/")
        self.plant("src/identification/fit/b.cc", "\n")
        self.plant("src/identification/identify.cc", '#include "identification/motion/segments.h"\n')
        self.plant("src/reading/study/b.cc", '#include "reading/table.h"\n')
        self.assertEqual(self.violations(), [])

    def test_features_are_known_at_their_doors_only(self):
        self.plant("src/ros/nodes/b.cc", '#include "ros/apply/plan.h"\n#include "mpi/ranks.h"\n')
        self.plant("src/jobs/journal.cc", '#include "jobs/journal.h"\n')
        self.assertEqual(self.violations(), [])
        self.plant("src/jobs/b.cc", '#include "jobs/files.h"\n#include "jobs/journal.h"\n')
        self.assert_only("src/jobs/b.cc:2", "jobs/journal is a feature")

    def test_unknown_folder_inside_ros(self):
        self.plant("src/ros/misc/b.cc", "\n")
        self.assert_only("src/ros/misc/b.cc:1", "no place")

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

    def test_long_file_of_a_test(self):
        self.plant("test/math/b_test.cc", "\n" * 401)
        self.assert_only("test/math/b_test.cc:401", "401 lines")

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

    def test_a_call_of_a_function_above(self):
        defined_by = {"codesign::make_system()": "assembly", "codesign::factor()": "sparse"}
        self.assertEqual(check_symbols.check({"equations": {"codesign::factor()", "std::terminate()"}}, defined_by), [])
        self.assertEqual(check_symbols.check({"equations": {"codesign::make_system()"}}, defined_by),
                         ["equations/ calls codesign::make_system(), which assembly/ defines above it"])

    def test_the_room_of_an_object_or_unit(self):
        root = pathlib.Path("/build")
        self.assertEqual(check_symbols.room_of(root / "math/scalar.cc.o", root), "math")
        self.assertEqual(check_symbols.room_of(root / "Unity/unity_reading_urdf_cxx.cxx.o", root), "reading")
        self.assertIsNone(check_symbols.room_of(root / "cmake_pch.hxx.o", root))


if __name__ == "__main__":
    unittest.main()
