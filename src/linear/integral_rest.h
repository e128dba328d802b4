// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "linear/resting_mechanism.h"

namespace codesign {

struct Study;

/// Goes from a posture to one at rest in which the errors of all controllers with an integral are
/// zero: Newton's method for the coordinates and the integrals, theory (66a). Where several
/// postures or integrals fit, the nearest ones.
/// @param study with the bounds of its controllers. @param steps grows by the steps taken. @returns
/// kNoEquilibrium if there is none near the posture, or if an integral would have to exceed its
/// bound; kCancelled.
Status rest_without_error(RestingMechanism* mechanism, const std::vector<double>& parameters,
                          const Study& study, const std::atomic<bool>* cancel, int* steps);

}  // namespace codesign
