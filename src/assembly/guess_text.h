// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "math/scalar.h"

namespace codesign {

struct MotionStudy;
struct RobotDescription;
struct TreeLayout;

/// Guesses for a study's initial_state, of joints with one coordinate: a: {guess: 0.1}, b: {guess:
/// 0.2}.
/// @param theta tree coordinates [rad or m]. @param coordinates those to be guessed.
std::string guess_text(const RobotDescription& robot, const TreeLayout& tree,
                       const VectorX<double>& theta, const std::vector<int>& coordinates);

/// The tuned parameters with their values: a = 0.1, b = 0.2.
std::string design_text(const MotionStudy& study, const std::vector<double>& parameters);

}  // namespace codesign
