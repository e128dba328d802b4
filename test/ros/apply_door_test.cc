// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply_door.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/error.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

TEST(PathOfAJob, LiesInTheOutputDirectory) {
  const TemporaryDirectory directory;
  const std::string folder = std::filesystem::canonical(directory.path()).string();
  EXPECT_EQ(path_in(folder, "arm_1"), folder + "/arm_1");
  EXPECT_EQ(path_in(folder, folder + "/arm_1.bag"), folder + "/arm_1.bag");
  for (const std::string& outside :
       {std::string("../arm_1"), std::string("/etc/passwd"), folder, folder + "_other/arm_1", std::string(".")})
    EXPECT_THROW(path_in(folder, outside), InputError) << outside;
}

}  // namespace
}  // namespace codesign
