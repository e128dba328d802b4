// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fuzz/command_inputs.h"
#include "fuzz/isolation.h"

namespace codesign::fuzz {

/// Sends a random request for an optimization or an evaluation through the job layer of the nodes,
/// without a ROS master, and returns a sentence about a fault of the answer, empty if there is
/// none: an unknown code, a failure without a sentence, a success with numbers that are not finite.
std::string run_request(const std::vector<Seed>& seeds, const Limits& limits, Dice* dice);

}  // namespace codesign::fuzz
