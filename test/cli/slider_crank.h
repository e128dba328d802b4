// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "cli/run_fixture.h"

namespace codesign::cli {

inline const std::string kModel = shipped("urdf/slider_crank.urdf");
inline const std::string kStudy = shipped("config/slider_crank.yaml");
inline const std::vector<std::string> kTuned = {"crank_length", "rod_length", "slider_length",
                                                "slider_width", "Kp"};

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline void expect_keys(const Json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

/// The shipped study with a short duration, for quick tests of the output format.
inline std::string short_study(const ScratchFolder& folder) {
  const std::string path =
      folder.edited("short.yaml", read_text_file(kStudy), "duration: 2.0", "duration: 0.1");
  return folder.edited("short.yaml", read_text_file(path), "max_evaluations: 200",
                       "max_evaluations: 4");
}

}  // namespace codesign::cli
