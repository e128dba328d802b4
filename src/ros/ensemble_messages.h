// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_ENSEMBLE_MESSAGES_H_
#define MECHANISM_CODESIGN_ROS_ENSEMBLE_MESSAGES_H_

#include <mechanism_codesign/OptimizeResult.h>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Sets the fields of the result about several runs, samples and starts: `scenarios`, `worst`, `value_at_risk`, `validation`, `searches`,
/// `optima`, `screened`, `unusable`. All stay empty for a study with one run and one start. Numbers of samples, scenarios and optima begin
/// at 1 in messages.
void set_ensemble(const OptimizationResult& result, mechanism_codesign::OptimizeResult* message);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_ENSEMBLE_MESSAGES_H_
