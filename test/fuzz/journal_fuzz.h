// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fuzz/command_inputs.h"
#include "fuzz/isolation.h"

namespace codesign::fuzz {

/// Optimizes a case, damages its journal, resumes from it, and returns a sentence about a fault,
/// empty if there is none: the resumed job has another result, or fails otherwise than by bad input
/// with file and line. Some damaged lines get the checksum of their new text, as no accident gives
/// it; their numbers may change the result, but must not end the process.
std::string run_resumed(const std::vector<Seed>& seeds, const Limits& limits, Dice* dice);

}  // namespace codesign::fuzz
