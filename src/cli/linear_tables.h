// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "linear/linear_model.h"

namespace codesign::cli {

/// The verdict, then a table of the modes.
void print_stability(const LinearModel& model, std::ostream& out);
/// A table of the margins of each controller, one row per margin.
void print_margins(const LinearModel& model, std::ostream& out);

}  // namespace codesign::cli
