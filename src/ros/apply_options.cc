// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply_options.h"

#include <cmath>

#include "mechanism_codesign/error.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// More than a day. The limit keeps the number of steps of a ramp within the range of int.
constexpr double kLongestTime = 1e5;

double checked_time(double value, const char* name, double fallback) {
  if (!(value >= 0.0 && value <= kLongestTime))
    throw InputError({{"request", 0}, name, "not a time", to_decimal(value), "0 for the default, or up to 100000 s"});
  return value == 0.0 ? fallback : value;
}

}  // namespace

RampOptions ramp_options(const mechanism_codesign::ApplyRequest& request) {
  RampOptions options;
  options.ramp = checked_time(request.ramp, "ramp", options.ramp);
  options.hold = checked_time(request.hold, "hold", options.hold);
  return options;
}

WatchOptions watch_options(const mechanism_codesign::ApplyRequest& request) {
  WatchOptions options;
  if (!request.joint_states.empty()) options.joint_states = request.joint_states;
  options.max_age = checked_time(request.max_age, "max_age", options.max_age);
  if (!std::isfinite(request.deviation) || request.deviation < 0.0)
    throw InputError({{"request", 0}, "deviation", "not a length or an angle", to_decimal(request.deviation), "0 for none, or more"});
  options.deviation = request.deviation;
  if (request.unwatched && (options.deviation > 0.0 || !request.joint_states.empty()))
    throw InputError({{"request", 0}, "unwatched", "joint states are named and left unwatched", "", "one of both"});
  if (request.unwatched) options.joint_states.clear();
  return options;
}

}  // namespace codesign
