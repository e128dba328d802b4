// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace codesign {

struct MotionStudy;

/// The two sums of the objective, theory (21): the integrand g and the terminal terms w.
enum class ObjectivePart { kIntegral, kTerminal };

/// Where a study has the term with this number: "objective.integral[0]", of a study with postures
/// "objective.sum[0]".
std::string term_name(const MotionStudy& study, ObjectivePart part, std::size_t term);

}  // namespace codesign
