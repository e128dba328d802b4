// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// A failure outside the main computation, such as a file that could not be written or a recorded run that ended early.
struct Failure {
  std::string code;  ///< snake case, for `error.code`
  std::string message;
};

}  // namespace codesign
