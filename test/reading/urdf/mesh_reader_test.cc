// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/mesh_reader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "mechanism/mass_properties.h"
#include "reading/urdf/urdf_reader.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

namespace fs = std::filesystem;

/// A box of 2 x 4 x 6 with a corner in the origin, as OBJ.
const std::string kObj = R"(# a box
v 0 0 0
v 2 0 0
v 0 4 0
v 2 4 0
v 0 0 6
v 2 0 6
v 0 4 6
v 2 4 6
f 1 3 4 2
f 5/1 6/2/3 8 7
f 1 2 6 5
f 3 7 8 4
f -8 -4 -2 -6
f 2 4 8 6
)";

std::string as_text() {
  std::ostringstream text;
  text << "solid box\n";
  for (const Triangle& one : triangles_in(kObj, true)) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const Eigen::Vector3d& x : one) text << "vertex " << x.transpose() << "\n";
    text << "endloop\nendfacet\n";
  }
  return text.str() + "endsolid\n";
}

std::string as_binary(const std::string& head) {
  std::string bytes = head;
  bytes.resize(80, ' ');
  const auto add = [&bytes](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::vector<Triangle> triangles = triangles_in(kObj, true);
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& one : triangles) {
    for (int k = 0; k < 3; ++k) add(0.0F);
    for (const Eigen::Vector3d& x : one)
      for (int k = 0; k < 3; ++k) add(static_cast<float>(x[k]));
    add(std::uint16_t{0});
  }
  return bytes;
}

TEST(MeshReader, ReadsEachFormat) {
  EXPECT_EQ(triangles_in(kObj, true).size(), 12U);
  for (const std::string& content : {as_text(), as_binary("box"), as_binary("solid box")}) {
    const MeshMoments moments = moments_of(triangles_in(content, false));
    EXPECT_NEAR(moments.volume, 48.0, 1e-12);
    EXPECT_EQ(moments.holes, 0.0);
  }
  EXPECT_TRUE(triangles_in("solid box\nfacet\nvertex 0 0\n", false).empty());
  EXPECT_TRUE(triangles_in("v 0 0 0\nf 1 2 3\n", true).empty()) << "no such corner";
  EXPECT_TRUE(triangles_in("", false).empty());
  EXPECT_TRUE(triangles_in(as_binary("box").substr(0, 300), false).empty()) << "cut off";
}

class VendorsPackage : public ::testing::Test {
 protected:
  VendorsPackage() {
    fs::create_directories(folder() / "meshes");
    fs::create_directories(folder() / "urdf");
    write("meshes/box.stl", as_binary("box"));
    write("meshes/box.obj", kObj);
    write("meshes/box.dae", "<COLLADA/>");
    std::string open = kObj;
    open.resize(open.rfind("f "));
    write("meshes/open.obj", open);
  }
  fs::path folder() const { return fs::path(directory_.path()) / "arm_description"; }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder() / name, std::ios::binary) << content;
  }
  SourceText model(const std::string& mesh) const {
    return {(folder() / "urdf" / "arm.urdf").string(),
            "<robot name=\"arm\"><link name=\"base\"/><link name=\"arm\"><visual><origin xyz=\"1 0 "
            "0\" rpy=\"0 0 1.5707963267948966\"/><geometry><mesh filename=\"" +
                mesh +
                "\" scale=\"0.001 0.001 0.001\"/></geometry></visual></link><joint name=\"j\" "
                "type=\"continuous\"><parent link=\"base\"/><child link=\"arm\"/><axis xyz=\"0 0 "
                "1\"/></joint></robot>"};
  }
  TemporaryDirectory directory_;
  const SourceText overlay_{
      "density.xml",
      R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign"><link name="arm"><inertial codesign:density="2e9"/></link></robot>)"};
};

TEST_F(VendorsPackage, GetsMassAndInertiaByDensityOfAnOverlay) {
  for (const char* mesh : {"package://arm_description/meshes/box.stl", "../meshes/box.obj",
                           "model://arm_description/meshes/box.stl"}) {
    const RobotDescription robot = read_urdf(model(mesh), {overlay_});
    ASSERT_TRUE(robot.links[1].inertial) << mesh;
    const MassProperties<double> properties =
        mass_properties(*robot.links[1].inertial, std::vector<double>());
    const double mass = 2e9 * 48e-9;
    EXPECT_NEAR(properties.mass, mass, 1e-12 * mass);
    // The mesh's (1, 2, 3) mm, turned by a right angle about z.
    EXPECT_LT((properties.centre - Vector3<double>(1.0 - 2e-3, 1e-3, 3e-3)).norm(), 1e-12);
    EXPECT_NEAR(properties.inertia(0, 0), mass / 12.0 * (4.0 + 36.0) * 1e-6, 1e-12);
    EXPECT_NEAR(properties.inertia(1, 1), mass / 12.0 * (16.0 + 36.0) * 1e-6, 1e-12);
    EXPECT_NEAR(properties.inertia(2, 2), mass / 12.0 * (4.0 + 16.0) * 1e-6, 1e-12);
  }
}

TEST_F(VendorsPackage, TheMergedModelNeedsItsMeshesNoMore) {
  const SourceText vendor = model("package://arm_description/meshes/box.stl");
  const std::string merged = write_tuned_urdf(vendor, {overlay_}, {});
  EXPECT_EQ(merged.find("codesign:density"), std::string::npos) << merged;
  const RobotDescription robot = read_urdf({"/nowhere/merged.urdf", merged});
  EXPECT_NEAR(robot.links[1].inertial->mass.nominal(), 96.0, 1e-9);
}

TEST_F(VendorsPackage, SaysWhyAMeshHasNoMass) {
  const auto fault = [&](const std::string& mesh) -> std::string {
    try {
      read_urdf(model(mesh), {overlay_});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(fault("package://other/meshes/box.stl").find("its file is not here"),
            std::string::npos);
  EXPECT_NE(fault("../meshes/box.dae").find("meshes of this format"), std::string::npos);
  EXPECT_NE(fault("../meshes/open.obj").find("no closed surface"), std::string::npos)
      << fault("../meshes/open.obj");
  EXPECT_NE(fault("../meshes/open.obj").find("arm.urdf:1"), std::string::npos);
}

// Of a scale that is a parameter the mass follows it.
TEST_F(VendorsPackage, AScaleMayBeAParameter) {
  SourceText vendor = model("../meshes/box.obj");
  const std::string plain = "scale=\"0.001 0.001 0.001\"";
  vendor.text.replace(vendor.text.find(plain), plain.size(), plain);
  const RobotDescription robot = read_urdf(vendor, {overlay_});
  InertialDescription inertial = *robot.links[1].inertial;
  auto k = std::make_shared<const Expression>("k", std::vector<std::string>{"k"});
  inertial.shapes[0].size = {Quantity(0.001, k), Quantity(0.001), Quantity(-0.001)};
  const std::complex<double> step(0.002, 1e-30);
  const MassProperties<std::complex<double>> properties =
      mass_properties(inertial, std::vector<std::complex<double>>{step});
  EXPECT_NEAR(properties.mass.real(), 192.0, 1e-9);
  EXPECT_NEAR(properties.mass.imag() / 1e-30, 96000.0, 1e-6) << "a mirrored mesh has mass, too";
}

}  // namespace
}  // namespace codesign
