// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_REPORT_H_
#define MECHANISM_CODESIGN_CLI_REPORT_H_

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "cli/json_output.h"
#include "mechanism_codesign/status.h"

namespace codesign::cli {

/// `assembly_failed at t = 0 s: cause`
std::string describe(const Status& status);

/// Tells what is doubtful: each warning as a line on the error stream, and all as `warnings` of `object`, which also gets `setup_seconds`.
/// @param of_run what the run added to the warnings of the files.
void add_warnings(const Arguments& arguments, const Problem& problem, const Warnings& of_run, Json* object, const Console& console);

/// Something else than the computation that went wrong: a file that could not be written, a run that ends early.
struct Failure {
  std::string code;
  std::string message;
};

/// Ends a command: prints `object` if JSON was asked for, with an `error` if something failed, and names each failure on the error stream.
/// The status, or else the first of `failures`, gives the error its code. Returns the exit code.
int finish(const Arguments& arguments, const Status& status, Json object, const Console& console,
           const std::vector<Failure>& failures = {});

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_REPORT_H_
