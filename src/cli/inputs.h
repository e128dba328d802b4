// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// Opens a file for writing; called before the computation, so that a bad path is reported at once.
/// @param option the option with the path.
/// @throws InputError that names the option, if the file cannot be opened.
void open_output(const std::string& path, const std::string& option, std::ofstream* file);

/// Loads the problem from the files that a command line names, and calls Console::loaded if it is
/// set. Without a study the mechanism is loaded alone; with --run its problem is that of the run.
/// @throws InputError as load_problem(), and for files that cannot be read.
Problem load(const Arguments& arguments, const Console* console = nullptr);

/// load() for commands that need a gradient. @throws InputError also if the study has no objective
/// or tunes no parameter.
Problem load_tunable(const Arguments& arguments, const Console* console = nullptr);

/// The signals of the option `--signals`, or default_signals() without it. @throws InputError for a
/// signal that does not exist.
std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem);
/// The same with `standard` in place of default_signals(). @param controllers whose signals exist.
std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem,
                                              const std::vector<ControllerDescription>& controllers,
                                              const std::vector<std::string>& standard);

}  // namespace codesign::cli
