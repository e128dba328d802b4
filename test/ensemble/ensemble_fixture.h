// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// A block that slides along x on the ground, with friction, held by a PD controller. Fast to
/// simulate.
/// @param ensemble further blocks of the study. @param parameters further entries of `parameters`,
/// each after a comma.
Problem block(const std::string& ensemble, const std::string& optimizer = "{algorithm: slsqp}",
              const std::string& parameters = "");

/// Further blocks of its study: two runs at four samples, whose laws of friction differ. Each run
/// and law is a system of its own, and those of one law switch.
extern const char* const kRunsAndLaws;

}  // namespace codesign
