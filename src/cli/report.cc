// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/report.h"

#include "cli/table.h"

namespace codesign::cli {

std::string describe(const Status& status) {
  return std::string(name_of(status.code)) + " at t = " + readable(status.time) + " s" + (status.cause.empty() ? "" : ": " + status.cause);
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
