// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEST_FUZZ_LANGUAGE_SEEDS_H_
#define MECHANISM_CODESIGN_TEST_FUZZ_LANGUAGE_SEEDS_H_

#include <vector>

#include "fuzz/command_inputs.h"

namespace codesign::fuzz {

/// Small valid cases that the shipped ones leave out: constraints and peaks, sampled controllers, way-points, samples with a measure,
/// recordings as table and as bag, motions to record, gains for a robot, values set by an overlay.
std::vector<Seed> language_seeds();

}  // namespace codesign::fuzz

#endif  // MECHANISM_CODESIGN_TEST_FUZZ_LANGUAGE_SEEDS_H_
