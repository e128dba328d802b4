// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_REPORT_H_
#define MECHANISM_CODESIGN_CLI_REPORT_H_

#include "cli/arguments.h"
#include "cli/console.h"
#include "cli/json_output.h"
#include "mechanism_codesign/dynamics/status.h"

namespace codesign::cli {

/// `assembly_failed at t = 0 s: cause`
std::string describe(const Status& status);

/// Tells what is doubtful: each warning as a line on the error stream, and all as `warnings` of `object`, which also gets `setup_seconds`.
/// @param of_run what the run added to the warnings of the files.
void add_warnings(const Arguments& arguments, const Problem& problem, const Warnings& of_run, Json* object, const Console& console);

/// Ends a command: prints `object` if JSON was asked for, with an `error` if the status is one, and names a failure on the error stream.
/// Returns the exit code.
int finish(const Arguments& arguments, const Status& status, Json object, const Console& console);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_REPORT_H_
