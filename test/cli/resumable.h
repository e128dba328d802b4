// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/slider_crank.h"

namespace codesign::cli {

/// Many searches over two runs at three samples, each evaluation quick.
constexpr const char* kResumable = R"(
runs:
  slow: {}
  fast: {controllers: {crank_speed: {setpoint: -12.0}}}
uncertain: {slider_width: {uniform: [0.02, 0.03]}}
robust: {measure: mean, samples: 3, validate: 5}
multistart: {starts: 4, screen: 16}
)";

/// @param engine the block of that name; may be empty.
inline std::string resumable_study(const ScratchFolder& folder, const std::string& engine) {
  const std::string text = read_text_file(short_study(folder)) + kResumable + engine;
  return folder.edited("ensemble.yaml", text, "slider_width: {tune: true}",
                       "slider_width: {tune: false}");
}

/// The finished lines of a journal; none if there is no journal.
inline std::vector<std::string> finished_lines(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  const std::string text = read_text_file(path);
  return lines_of(text.substr(0, text.rfind('\n') + 1));
}

/// Without processor times, which are the only thing that differs from run to run.
inline Json without_times(Json object) {
  object.erase("cpu_seconds");
  object.erase("setup_seconds");
  return object;
}

/// The content of all lines except the header, without processor times and thus without checksums,
/// in any order.
inline std::multiset<std::string> evaluations_of(const std::string& path) {
  std::multiset<std::string> evaluations;
  for (const std::string& line : finished_lines(path)) {
    Json object = Json::parse(line);
    if (object.contains("journal")) continue;
    object["statistics"]["cpu_seconds"] = 0.0;
    object.erase("checksum");
    evaluations.insert(object.dump());
  }
  return evaluations;
}

}  // namespace codesign::cli
