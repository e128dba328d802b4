// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"

namespace codesign::cli {

/// The commands of the program. Each returns kDone or kFailed. @throws InputError for bad input,
/// OutputError for output that cannot be written.
int check(const Arguments& arguments, const Console& console);
int simulate(const Arguments& arguments, const Console& console);
int efforts(const Arguments& arguments, const Console& console);
int equilibrium(const Arguments& arguments, const Console& console);
int urdf(const Arguments& arguments, const Console& console);
int gradient(const Arguments& arguments, const Console& console);
int optimize(const Arguments& arguments, const Console& console);
int identify(const Arguments& arguments, const Console& console);
int excite(const Arguments& arguments, const Console& console);

/// Runs the program and reports every error. @param words the command line without the program's
/// name. @returns the exit code, an ExitCode.
int run(const std::vector<std::string>& words, const Console& console);

}  // namespace codesign::cli
