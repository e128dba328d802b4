// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_check.h"

#include "reading/urdf/inertial_text.h"

namespace codesign {
namespace {

TEST(InertialCheck, WhatIsNoNumber) {
  expect_error(with_numbers("nan", "1", "1", "1"), {"value is not finite"});
  expect_error(with_numbers("heavy", "1", "1", "1"), {"is not a number"});
}

TEST(InertialCheck, WrittenValuesMustBeThoseOfTheShapes) {
  expect_error(with_inertial(from_shape("1000", "2.1"), kBox),
               {"mass, centre or inertia differ", "<mass value=\"2.1\"/>", "allowed: <origin xyz=\"0 0 0.1\"/> <mass value=\"2"});
  expect_error(with_inertial(from_shape("1000", "2", "0.00834"), kBox), {"mass, centre or inertia differ"});
  expect_error(with_inertial("<inertial codesign:density=\"1000\"/>", kBox), {"which other readers of URDF need", "<mass value=\"2"});
}

}  // namespace
}  // namespace codesign
