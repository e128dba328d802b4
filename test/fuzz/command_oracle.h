// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fuzz/input.h"
#include "fuzz/isolation.h"

namespace codesign::fuzz {

/// Runs a command line in an empty folder and returns a sentence about a fault, empty if there is
/// none. Faults are: an exit code other than 0, 1, 2; a crash; too much time or memory; a message
/// on bad input without file and line; a failure without a status; a success with numbers that are
/// not finite; an exit code or a text other than the input expects.
std::string run_command(const Input& input, const Limits& limits);

}  // namespace codesign::fuzz
