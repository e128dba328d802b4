// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/mesh_mass.h"

#include <cstdint>
#include <fstream>

#include "reading/urdf/starting_overlay.h"
#include "reading/urdf/urdf_fixture.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using Corners = std::vector<std::array<Eigen::Vector3d, 3>>;

/// The surface of a box from the origin to (1, 2, 3), outward.
Corners box_surface() {
  Corners triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const Eigen::Vector3d size(1.0, 2.0, 3.0);
      std::array<Eigen::Vector3d, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k].setZero();
        corners[k][axis] = far ? size[axis] : 0.0;
        corners[k][u] = k == 1 || k == 2 ? size[u] : 0.0;
        corners[k][v] = k >= 2 ? size[v] : 0.0;
      }
      if (!far) std::swap(corners[1], corners[3]);
      triangles.push_back({corners[0], corners[1], corners[2]});
      triangles.push_back({corners[0], corners[2], corners[3]});
    }
  return triangles;
}

std::string stl_words(const Corners& triangles) {
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& triangle : triangles) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const Eigen::Vector3d& p : triangle)
      text << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    text << "endloop\nendfacet\n";
  }
  return text.str() + "endsolid box\n";
}

std::string stl_bytes(const Corners& triangles) {
  std::string bytes(80, 's');
  const auto add = [&bytes](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int k = 0; k < 3; ++k) add(0.0F);
    for (const Eigen::Vector3d& p : triangle)
      for (int k = 0; k < 3; ++k) add(static_cast<float>(p[k]));
    add(std::uint16_t{0});
  }
  return bytes;
}

class MeshMass : public testing::Test {
 protected:
  std::optional<MassProperties<double>> mass(const std::string& stl, const std::string& mesh,
                                             const std::string& origin = "") {
    std::ofstream(folder_.path() / "a.stl", std::ios::binary) << stl;
    const XmlDocument document({"x.urdf", "<robot name=\"r\"><link name=\"l\"><visual>" + origin +
                                              "<geometry><mesh filename=\"" + mesh +
                                              "/></geometry></visual></link></robot>"});
    const XmlElement robot(document.robot(), &document);
    return mass_of_meshes(robot.only("link"), "visual", folder_.path().string(), 10.0);
  }

  const TemporaryDirectory folder_;
};

TEST_F(MeshMass, OfABoxIsThatOfTheFormula) {
  for (const std::string& stl : {stl_words(box_surface()), stl_bytes(box_surface())}) {
    const auto found = mass(stl, "a.stl\"");
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->mass, 60.0, 1e-10);
    EXPECT_LT((found->centre - Eigen::Vector3d(0.5, 1.0, 1.5)).norm(), 1e-12);
    const Eigen::Vector3d moments(4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0);
    EXPECT_LT((found->inertia - Eigen::Matrix3d((5.0 * moments).asDiagonal())).norm(), 1e-10);
  }
}

TEST_F(MeshMass, ScaleAndOriginCount) {
  const auto found =
      mass(stl_bytes(box_surface()),
           "file://" + (folder_.path() / "a.stl").string() + "\" scale=\"0.1 0.1 -0.1\"",
           "<origin xyz=\"0 0 1\" rpy=\"0 0 1.5707963267948966\"/>");
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->mass, 0.06, 1e-13);
  EXPECT_LT((found->centre - Eigen::Vector3d(-0.1, 0.05, 0.85)).norm(), 1e-12);
  EXPECT_NEAR(found->inertia(0, 0), 0.005 * 0.1, 1e-12) << "1 and 3 wide across";
}

TEST_F(MeshMass, WhatIsNotClosedOrNotReadHasNone) {
  Corners open = box_surface();
  open.pop_back();
  EXPECT_FALSE(mass(stl_words(open), "a.stl\"").has_value());
  EXPECT_FALSE(mass("solid x\nvertex 0 0\n", "a.stl\"").has_value());
  EXPECT_FALSE(mass(stl_bytes(box_surface()).substr(0, 300), "a.stl\"").has_value());
  EXPECT_FALSE(mass(stl_words(box_surface()), "b.stl\"").has_value());
  EXPECT_FALSE(mass(stl_words(box_surface()), "package://nobody/a.stl\"").has_value());
}

TEST_F(MeshMass, IsALineOfTheStartingOverlay) {
  std::ofstream(folder_.path() / "a.stl", std::ios::binary) << stl_bytes(box_surface());
  const SourceText urdf{
      (folder_.path() / "vendor.urdf").string(),
      "<robot name=\"vendor\">" + std::string(kGround) +
          link_with("arm",
                    "<collision><geometry><mesh filename=\"a.stl\"/></geometry></collision>") +
          joint_with("hinge", "continuous", "ground", "arm", "") + "</robot>"};
  const std::string text = starting_overlay(urdf);
  EXPECT_NE(text.find("of the inside of its meshes (collision) at a density"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("a ball of 1 kg"), std::string::npos) << text;
}

}  // namespace
}  // namespace codesign
