// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ApplyRequest.h>

#include "ros/gain_ramp.h"
#include "ros/robot_watch.h"

namespace codesign {

/// The times of the ramp in a request. Zero: the default. @throws InputError for a time below 0 or above 100000 s.
RampOptions ramp_options(const mechanism_codesign::ApplyRequest& request);

/// The options of a request for watching the robot. Zero: the default. @throws InputError for a wrong number, or if the request both names
/// a topic of joint states and switches their watch off.
WatchOptions watch_options(const mechanism_codesign::ApplyRequest& request);

}  // namespace codesign
