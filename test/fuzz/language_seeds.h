// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fuzz/command_inputs.h"

namespace codesign::fuzz {

/// Small valid cases that the shipped ones leave out: constraints and peaks, sampled controllers,
/// way-points, samples with a measure, recordings as table and as bag, motions to record, gains for
/// a robot, values set by an overlay.
std::vector<Seed> language_seeds();

}  // namespace codesign::fuzz
