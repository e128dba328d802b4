// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEST_FUZZ_COMMAND_ORACLE_H_
#define MECHANISM_CODESIGN_TEST_FUZZ_COMMAND_ORACLE_H_

#include <string>

#include "fuzz/input.h"
#include "fuzz/isolation.h"

namespace codesign::fuzz {

/// Runs a command line in an empty folder of its own and returns what is wrong with what came of it, empty if nothing is:
/// an exit code but 0, 1, 2; a crash; too much time or memory; bad input without its file and line; a failure without a status of its own;
/// a success whose numbers are not all finite; what the input expects and does not get.
std::string run_command(const Input& input, const Limits& limits);

}  // namespace codesign::fuzz

#endif  // MECHANISM_CODESIGN_TEST_FUZZ_COMMAND_ORACLE_H_
