// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/hand_over.h"

#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

TEST(HandOver, FindsTheScriptsOfABuildAndOfAnInstallation) {
  const ScratchFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.path("devel/lib/mechanism_codesign"));
  fs::create_directories(folder.path("devel/share/mechanism_codesign"));
  fs::create_directories(folder.path("source/scripts"));
  std::ofstream(folder.path("source/scripts/report")) << "";
  EXPECT_EQ(find_script("report", folder.path("devel/lib/mechanism_codesign")), "");
  std::ofstream(folder.path("devel/share/mechanism_codesign/scripts.path"))
      << folder.path("source/scripts") << '\n';
  EXPECT_EQ(find_script("report", folder.path("devel/lib/mechanism_codesign")),
            fs::canonical(folder.path("source/scripts/report")));
  EXPECT_EQ(find_script("other", folder.path("devel/lib/mechanism_codesign")), "");
  EXPECT_EQ(find_gallery(folder.path("devel/lib/mechanism_codesign")), "");
  fs::create_directories(folder.path("source/gallery"));
  EXPECT_EQ(find_gallery(folder.path("devel/lib/mechanism_codesign")),
            fs::canonical(folder.path("source/gallery")));
  // An installation, here one without ROS.
  fs::create_directories(folder.path("usr/bin"));
  fs::create_directories(folder.path("usr/share/mechanism_codesign/scripts"));
  std::ofstream(folder.path("usr/share/mechanism_codesign/scripts/report")) << "";
  EXPECT_EQ(find_script("report", folder.path("usr/bin")),
            fs::canonical(folder.path("usr/share/mechanism_codesign/scripts/report")));
  EXPECT_EQ(find_gallery(folder.path("usr/bin")), "");
  fs::create_directories(folder.path("usr/share/mechanism_codesign/gallery"));
  EXPECT_EQ(find_gallery(folder.path("usr/bin")),
            fs::canonical(folder.path("usr/share/mechanism_codesign/gallery")));
}

TEST(HandOver, FindsAProgramBesideThisOne) {
  const ScratchFolder folder;
  EXPECT_EQ(find_program("apply", folder.path("")), "");
  std::ofstream(folder.path("apply")) << "#!/bin/sh\n";
  EXPECT_EQ(find_program("apply", folder.path("")), "") << "not a program";
  std::filesystem::permissions(folder.path("apply"), std::filesystem::perms::owner_all);
  EXPECT_NE(find_program("apply", folder.path("")), "");
  std::filesystem::create_directory(folder.path("folder"));
  EXPECT_EQ(find_program("folder", folder.path("")), "");
}

}  // namespace
}  // namespace codesign::cli
