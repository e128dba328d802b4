// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// The design in a result.json, best.json or identification.json: every entry of its `parameters`, to the last bit.
/// @throws InputError naming file and line if it is not JSON, has a number beyond the range of double, or no object `parameters` of
/// numbers.
ParameterSettings read_result(const SourceText& json);
/// The same, with the name of the file.
inline SavedDesign read_design(const SourceText& json) { return {json.name, read_result(json)}; }

/// What became of a request to give a robot the values of a result; doc/ros_api.md, Apply.
struct ApplyRecord {
  struct Change {
    std::string server, name;
    double before, after, now;
  };
  bool success;
  std::string code, message;
  std::vector<Change> changes;
  double rollback_seconds;
};

/// The output of the node apply with --json.
std::string apply_text(const ApplyRecord& record);

}  // namespace codesign
