// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/report.h"

#include "cli/table.h"

namespace codesign::cli {

std::string describe(const Status& status) {
  return std::string(name_of(status.code)) + " at t = " + readable(status.time) + " s" + (status.cause.empty() ? "" : ": " + status.cause);
}

void add_warnings(const Arguments& arguments, const Problem& problem, const Warnings& of_run, Json* object, const Console& console) {
  Warnings warnings = problem.warnings;
  append(of_run, &warnings);
  for (const Warning& warning : warnings) console.err << "codesign " << arguments.command << ": warning: " << warning.message << '\n';
  console.err.flush();
  (*object)["setup_seconds"] = problem.setup_seconds;
  (*object)["warnings"] = to_json(warnings);
}

int finish(const Arguments& arguments, const Status& status, Json object, const Console& console) {
  if (!status.ok()) {
    object["error"] = to_json(status);
    console.err << "codesign " << arguments.command << ": " << describe(status) << std::endl;
  }
  if (arguments.json) print(object, console.out);
  return status.ok() ? kDone : kFailed;
}

}  // namespace codesign::cli
