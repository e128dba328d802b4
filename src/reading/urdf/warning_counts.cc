// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reading/urdf/urdf_checks.h"

namespace codesign {
namespace {

/// Codes of faults that exporters repeat at many elements of a file.
constexpr std::array<std::string_view, 9> kRepeated{
    "dynamics_ignored", "inertia_not_positive", "limit_ignored",
    "limits_reversed",  "loop_ignored",         "mimic_ignored",
    "negative_mass",    "negative_value",       "triangle_inequality"};

/// A warning, and how many more of its code there are in its file.
struct Counted {
  Warning first;
  int further = 0, last_line = 0;
};

bool is_repetition(const Warning& warning, const Counted& of) {
  return warning.code == of.first.code && warning.where.file == of.first.where.file &&
         std::find(kRepeated.begin(), kRepeated.end(), warning.code) != kRepeated.end();
}

}  // namespace

std::string further_places(int count, int last_line) {
  return "; the same at " + std::to_string(count) +
         (count == 1 ? " further place" : " further places") + " of this file, the last in line " +
         std::to_string(last_line);
}

void count_repetitions(Warnings* warnings) {
  std::vector<Counted> kept;
  for (Warning& warning : *warnings) {
    const auto found = std::find_if(kept.begin(), kept.end(),
                                    [&](const Counted& of) { return is_repetition(warning, of); });
    if (found == kept.end()) {
      kept.push_back({std::move(warning)});
      continue;
    }
    ++found->further;
    found->last_line = warning.where.line;
  }
  warnings->clear();
  for (Counted& one : kept) {
    if (one.further > 0) one.first.message += further_places(one.further, one.last_line);
    warnings->push_back(std::move(one.first));
  }
}

}  // namespace codesign
