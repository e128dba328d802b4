// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_
#define MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_

#include "problem/load_problem.h"

namespace codesign {

/// A warning `unused_parameter` for each tuned parameter that neither a `${...}` of model, overlays and study nor a `basis` controller
/// uses.
/// @param texts the files as read; @param study which parameters are tuned.
Warnings unused_parameters(const Problem::Contents& texts, const Study& study);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_
