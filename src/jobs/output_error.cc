// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/output_error.h"

#include <system_error>

namespace codesign {

OutputError::OutputError(const std::string& path, const std::string& cause) : std::runtime_error(path + ": cannot be written: " + cause) {}

OutputError OutputError::of_system(const std::string& path, int number) {
  return OutputError(path, number == 0 ? "a write failed" : std::generic_category().message(number));
}

}  // namespace codesign
