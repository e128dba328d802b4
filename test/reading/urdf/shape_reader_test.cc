// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/shape_reader.h"

#include "mechanism/mass_properties.h"
#include "reading/urdf/inertial_text.h"

namespace codesign {
namespace {

TEST(ShapeReader, ShapesWithoutMass) {
  const auto with_shape = [](const std::string& shape) {
    return with_inertial(from_shape("1000", "2"), "<visual><geometry>" + shape + "</geometry></visual>");
  };
  expect_error(with_inertial(from_shape("1000", "2")), {"the link has no <visual>"});
  expect_error(with_shape("<mesh filename=\"x.stl\"/>"), {"mass cannot be computed from this shape (value: <mesh>"});
  expect_error(with_shape("<box size=\"1 0 1\"/>"), {"the box has no volume"});
  expect_error(with_shape("<sphere radius=\"-1\"/>"), {"radius is not positive"});
  expect_error(with_shape(""), {"exactly one shape"});
  expect_error(with_inertial(from_shape("-1", "2"), kBox), {"the density is not positive"});
  expect_error(with_inertial("<inertial codesign:density=\"1\" codesign:from=\"colision\"/>", kBox),
               {"value: colision, allowed: visual or collision"});
  expect_error(with_inertial("<inertial codesign:from=\"visual\"/>", kBox), {"without codesign:density no mass can be computed"});
}

}  // namespace
}  // namespace codesign
