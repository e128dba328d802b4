// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign {

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
