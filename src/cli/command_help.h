// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign::cli {

/// The names of the commands, in the order of the help. Completion and the manual page are made
/// from it.
std::vector<std::string> command_names();

/// The help text of a command; of all commands if there is none with this name.
std::string usage(const std::string& command = "");

}  // namespace codesign::cli
