// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace codesign {

/// A result could not be written, for example because the disk is full or the folder is not writable. Not a case of bad input.
///
/// `what()` reads `path: cannot be written: No space left on device`.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& cause);

  /// An error with the system's text for the cause. @param number errno of the failed call; 0: unknown cause.
  static OutputError of_system(const std::string& path, int number);
};

}  // namespace codesign
