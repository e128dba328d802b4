// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_OUTPUT_ERROR_H_
#define MECHANISM_CODESIGN_JOBS_OUTPUT_ERROR_H_

#include <stdexcept>
#include <string>

namespace codesign {

/// Something computed that could not be written. Not bad input: the disk is full, or the folder may not be written to.
///
/// `what()` reads `path: cannot be written: No space left on device`.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& cause);

  /// The cause as the system names it. @param number errno of the call that failed; 0: no cause is known.
  static OutputError of_system(const std::string& path, int number);
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_OUTPUT_ERROR_H_
