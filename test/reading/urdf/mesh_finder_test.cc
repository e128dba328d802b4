// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "temporary_directory.h"

namespace codesign {
namespace {

/// Sets ROS_PACKAGE_PATH while it lives.
class PackagePath {
 public:
  explicit PackagePath(const std::string& value) {
    const char* const before = std::getenv("ROS_PACKAGE_PATH");
    had_one_ = before != nullptr;
    if (had_one_) before_ = before;
    setenv("ROS_PACKAGE_PATH", value.c_str(), 1);
  }
  ~PackagePath() {
    if (had_one_)
      setenv("ROS_PACKAGE_PATH", before_.c_str(), 1);
    else
      unsetenv("ROS_PACKAGE_PATH");
  }
  PackagePath(const PackagePath&) = delete;
  PackagePath& operator=(const PackagePath&) = delete;

 private:
  bool had_one_ = false;
  std::string before_;
};

TEST(MeshFinder, FindsFilesOfPackagesBelowTheEntriesOfThePath) {
  const TemporaryDirectory workspace;
  const std::filesystem::path package = workspace.path() / "vendor" / "arm_description";
  std::filesystem::create_directories(package / "meshes");
  std::ofstream(package / "meshes" / "link.stl") << "solid";
  {
    const PackagePath path("/no/such/folder:" + workspace.path().string());
    MeshFinder meshes;
    EXPECT_TRUE(meshes.is_there("package://arm_description/meshes/link.stl"));
    EXPECT_FALSE(meshes.is_there("package://arm_description/meshes/other.stl"));
    EXPECT_FALSE(meshes.is_there("package://arm/meshes/link.stl"));
    EXPECT_FALSE(meshes.is_there("package://arm_description"));
  }
  const PackagePath path(package.string());
  EXPECT_TRUE(MeshFinder().is_there("package://arm_description/meshes/link.stl"))
      << "the entry is the package";
  EXPECT_TRUE(MeshFinder().is_there("file://" + (package / "meshes" / "link.stl").string()));
  EXPECT_FALSE(MeshFinder().is_there("file://" + (package / "meshes").string())) << "a folder";
  EXPECT_FALSE(MeshFinder().is_there("meshes/link.stl")) << "viewers want a scheme";
  EXPECT_TRUE(MeshFinder().is_there("https://example.org/link.stl"));
}

}  // namespace
}  // namespace codesign
