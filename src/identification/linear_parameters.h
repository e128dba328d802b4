// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_

#include <vector>

#include "identification/effort_model.h"

namespace codesign {

/// About `count` samples of a motion, chosen evenly, and the first sample of every recording.
MotionSamples thinned(const MotionSamples& motion, int count);

/// The tuned parameters that enter the efforts linearly together; a linear regression finds them for given values of the others.
struct LinearParameters {
  std::vector<int> linear;  ///< indices in rho, ascending: the efforts are affine in these parameters together
  std::vector<int> others;  ///< the others, ascending
};

/// Finds linear parameters by evaluation, theory (28d): each parameter is changed by a tenth, and conflicts with every parameter whose
/// column of the Jacobian changes. One parameter of each conflict is left out, beginning with the parameter that has most conflicts. A
/// parameter that cannot be changed, since every change gives an impossible design, counts as not linear.
/// @param model after begin() at `parameters`. A thinned motion suffices, and saves time, since p + 1 Jacobians are computed.
/// @param status receives the failure at `parameters` itself, after which the result is empty; may be null.
LinearParameters find_linear_parameters(EffortModel* model, const std::vector<double>& parameters, Status* status = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_
