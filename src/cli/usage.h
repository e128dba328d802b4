// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_USAGE_H_
#define MECHANISM_CODESIGN_CLI_USAGE_H_

#include <string>

namespace codesign::cli {

/// The help text of a command; of all commands if there is none with this name.
std::string usage(const std::string& command = "");

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_USAGE_H_
