// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/report.h"

#include "jobs/json.h"

namespace codesign::cli {

std::ostream& progress_of(const Arguments& arguments, const Console& console) {
  static std::ostream nothing(nullptr);
  return arguments.quiet ? nothing : console.err;
}

void print_warnings(const Arguments& arguments, const Warnings& warnings, const Console& console) {
  for (const Warning& warning : warnings)
    console.err << "codesign " << arguments.command << ": warning [" << warning.code
                << "]: " << warning.message << '\n';
  console.err.flush();
}

void add_warnings(const Arguments& arguments, const Problem& problem, const Warnings& of_run,
                  Json* object, const Console& console) {
  Warnings warnings = problem.warnings();
  append(of_run, &warnings);
  print_warnings(arguments, warnings, console);
  (*object)["setup_seconds"] = problem.setup_seconds();
  (*object)["warnings"] = to_json(warnings);
}

int finish(const Arguments& arguments, const Status& status, Json object, const Console& console,
           const std::vector<Failure>& failures) {
  const auto print_line = [&](const std::string& sentence) {
    console.err << "codesign " << arguments.command << ": " << sentence << std::endl;
  };
  if (!status.ok()) {
    object["error"] = to_json(status);
    print_line(describe(status));
  }
  for (const Failure& failure : failures) {
    print_line(failure.message);
    if (object.contains("error"))
      object["error"]["message"] =
          object["error"]["message"].get<std::string>() + "; " + failure.message;
    else
      object["error"] = {{"code", failure.code}, {"message", failure.message}};
  }
  if (arguments.json) print(object, console.out);
  return object.contains("error") ? kFailed : kDone;
}

}  // namespace codesign::cli
