// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/sentences.h"

#include "text/number_text.h"

namespace codesign {

namespace {

/// "at t = 0.5 s", or nothing for what ended a search, which has no time of a run.
std::string moment(const Status& status) {
  switch (status.code) {
    case StatusCode::kCancelled:
    case StatusCode::kInfeasible:
    case StatusCode::kAlgorithmFailed:
    case StatusCode::kWorkerLost:
    case StatusCode::kNonFiniteGradient:
    case StatusCode::kNotIdentifiable:
      if (status.time == 0.0) return "";
      break;
    default:
      break;
  }
  return "at t = " + readable(status.time) + " s";
}

}  // namespace

std::string describe(const Status& status) {
  const std::string at = moment(status);
  return std::string(name_of(status.code)) + (at.empty() ? "" : " " + at) + (status.cause.empty() ? "" : ": " + status.cause);
}

std::string reason(const Status& status) {
  const std::string at = moment(status);
  return status.cause + (at.empty() ? "" : " (" + at + ")");
}

}  // namespace codesign
