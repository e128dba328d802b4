// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "jobs/files.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "mechanism_codesign/status.h"

namespace codesign::cli {

/// Writes to_text(object) and flushes.
inline void print(const Json& object, std::ostream& out) { out << to_text(object) << std::flush; }

/// The stream for progress: the error stream, or with --quiet one that drops everything.
std::ostream& progress_of(const Arguments& arguments, const Console& console);

/// Writes each warning with its code as a line to the error stream.
void print_warnings(const Arguments& arguments, const Warnings& warnings, const Console& console);

/// print_warnings() of all warnings of the problem, and writes all of them to `warnings` of
/// `object`; also sets its `setup_seconds`.
/// @param of_run warnings of the run, in addition to the warnings of the input files.
void add_warnings(const Arguments& arguments, const Problem& problem, const Warnings& of_run,
                  Json* object, const Console& console);

/// Ends a command: prints `object` if --json was given, with an `error` if something failed, and
/// writes each failure to the error stream. The code of the error is the code of `status` or, if
/// that is ok, of the first of `failures`. @returns the exit code.
int finish(const Arguments& arguments, const Status& status, Json object, const Console& console,
           const std::vector<Failure>& failures = {});

}  // namespace codesign::cli
