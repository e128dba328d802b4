// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// Something doubtful that does not stop the work. doc/warnings.md lists the codes.
struct Warning {
  std::string code;  ///< snake case, stable: "undetermined_friction"
  /// the sentence shown to the user: file, line, value, what was done and how to silence the
  /// warning
  std::string message;
  /// an empty file and line 0 where the warning has no single cause in a file
  SourceLocation where;
};

using Warnings = std::vector<Warning>;

/// A warning about a place in a file. Its message has the form of InputError::what().
/// @param code in snake case, listed in doc/warnings.md.
/// @param fault its `message` says what was done and what to write to silence the warning.
Warning warn(const std::string& code, const InputFault& fault);

/// Appends those warnings of `more` whose pair of code and message `warnings` does not contain yet.
void append(const Warnings& more, Warnings* warnings);

}  // namespace codesign
