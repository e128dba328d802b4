// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/plain_numbers.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(PlainNumbers, WhatIsMissingOrNoNumberIsZero) {
  tinyxml2::XMLDocument document;
  document.Parse("<a n='2.5' bad='two' v='1 two 3 4'/>");
  const tinyxml2::XMLElement* a = document.RootElement();
  EXPECT_EQ(plain_number(a, "n"), 2.5);
  EXPECT_EQ(plain_number(a, "bad"), 0.0);
  EXPECT_EQ(plain_number(a, "missing"), 0.0);
  EXPECT_EQ(plain_number(nullptr, "n"), 0.0);
  EXPECT_EQ(plain_vector(a, "v"), Eigen::Vector3d(1.0, 0.0, 3.0));
  EXPECT_EQ(plain_vector(nullptr, "v"), Eigen::Vector3d(0.0, 0.0, 0.0));
}

TEST(PlainOrigin, TurnsAboutFixedAxesXThenYThenZ) {
  tinyxml2::XMLDocument document;
  document.Parse("<visual><origin xyz='1 2 3' rpy='1.5707963267948966 0 1.5707963267948966'/></visual>");
  // About x the y axis becomes z, which the turn about z leaves.
  const Eigen::Isometry3d pose = plain_origin(document.RootElement());
  EXPECT_TRUE((pose * Eigen::Vector3d(0.0, 1.0, 0.0)).isApprox(Eigen::Vector3d(1.0, 2.0, 4.0), 1e-12));
  EXPECT_TRUE(plain_origin(document.RootElement()->FirstChildElement()).isApprox(pose)) << "an element with its own xyz and rpy";
  EXPECT_TRUE(plain_origin(nullptr).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace codesign
