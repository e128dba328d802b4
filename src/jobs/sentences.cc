// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/sentences.h"

#include "text/number_text.h"

namespace codesign {

std::string describe(const Status& status) {
  return std::string(name_of(status.code)) + " at t = " + readable(status.time) + " s" + (status.cause.empty() ? "" : ": " + status.cause);
}

std::string reason(const Status& status) { return status.cause + " (at t = " + readable(status.time) + " s)"; }

}  // namespace codesign
