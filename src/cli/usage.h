// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign::cli {

/// The help text of a command; of all commands if there is none with this name.
std::string usage(const std::string& command = "");

}  // namespace codesign::cli
