// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_

#include <vector>

#include "identification/effort_model.h"

namespace codesign {

/// About `count` samples of a motion, evenly chosen, with the first of every recording.
MotionSamples thinned(const MotionSamples& motion, int count);

/// Which tuned parameters enter the efforts linearly together, so that a linear regression finds them for any values of the others.
struct LinearParameters {
  std::vector<int> linear;  ///< indices in rho, ascending: the efforts are affine in these parameters together
  std::vector<int> others;  ///< the others, ascending
};

/// Found by evaluation, theory (28d): each parameter is changed by a tenth, and every column of the Jacobian that changes with it is in
/// conflict with it. Of each conflict one parameter is left out, beginning with the one that has most. A parameter by which no change is
/// possible (it would give an impossible design) counts as not linear.
/// @param model begun at `parameters`; a thinned motion serves, since p + 1 Jacobians are computed.
/// @param status receives the failure at `parameters` itself, after which the result is empty; may be null.
LinearParameters find_linear_parameters(EffortModel* model, const std::vector<double>& parameters, Status* status = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_LINEAR_PARAMETERS_H_
