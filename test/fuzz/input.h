// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace codesign::fuzz {

/// One command line with its files. It is stored as a small YAML file:
///
///     arguments: [simulate, SHIPPED/urdf/governor.urdf, study.yaml]   # SHIPPED: the package
///     files: {study.yaml: "duration: 1\n"}  # or [part, {repeat: part, times: 1000}, ...];
///                                           # !!binary for bytes that are not UTF-8
///     disk: 1000                  # bytes that may be written to a file; unlimited by default
///     exit: 2                     # expected exit code; optional
///     says: "study.yaml:1: "      # expected part of the output; optional
struct Input {
  std::vector<std::string> arguments;
  std::map<std::string, std::string> files;
  std::optional<long> disk;
  std::optional<int> exit;
  std::string says;
};

Input load_input(const std::string& path);
void save_input(const std::string& path, const Input& input);

}  // namespace codesign::fuzz
