// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/OptimizeResult.h>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Sets the fields of the result about several runs, samples and starts: `scenarios`, `worst`, `value_at_risk`, `validation`, `searches`,
/// `optima`, `screened`, `unusable`. All stay empty for a study with one run and one start. Numbers of samples, scenarios and optima begin
/// at 1 in messages.
void set_ensemble(const OptimizationResult& result, mechanism_codesign::OptimizeResult* message);

}  // namespace codesign
