// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_INPUTS_H_
#define MECHANISM_CODESIGN_CLI_INPUTS_H_

#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// Reads the files a command line names, and tells the console if one is given. @throws InputError
Problem load(const Arguments& arguments, const Console* console = nullptr);

/// The same, for a command that differentiates. @throws InputError if the study tunes nothing.
Problem load_tunable(const Arguments& arguments, const Console* console = nullptr);

/// The signals asked for, or the default ones. @throws InputError for one that does not exist.
std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_INPUTS_H_
