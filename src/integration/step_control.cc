// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/step_control.h"

#include <algorithm>

#include "description/excursions.h"

namespace codesign {

BreakTimes::BreakTimes(const MotionStudy& study) : apart_(1e-12 * study.duration) {
  for (const ControllerDescription& controller : study.controllers) {
    const BasisDescription& basis = controller.basis;
    // A linear basis has kinks at the knots, where each coefficient begins to act; a cubic one is
    // smooth until its end.
    for (int k = 0; k < basis.count() && basis.shape == BasisShape::kLinear; ++k)
      times_.push_back(basis.support(k)[0]);
    if (basis.count() > 0) times_.push_back(basis.duration);
  }
  visit_functions(study, [this](const ReferenceDescription& function) { add(function); });
  times_.insert(times_.end(), study.excursions.begin(), study.excursions.end());
  std::sort(times_.begin(), times_.end());
}

void BreakTimes::add(const ReferenceDescription& reference) {
  if (reference.kind == ReferenceDescription::Kind::kSampled)
    for (double time : reference.sampled.samples->times())
      times_.push_back(time - reference.sampled.delay.nominal());
  if (reference.kind == ReferenceDescription::Kind::kLive) add(*reference.live.planned);
  if (reference.kind == ReferenceDescription::Kind::kIntegral) add(*reference.integral.rate);
  if (reference.kind == ReferenceDescription::Kind::kWaypoints)
    times_.insert(times_.end(), reference.waypoints.times.begin(), reference.waypoints.times.end());
}

double BreakTimes::next(double t, double limit) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), t + apart_);
  return after == times_.end() ? limit : std::min(*after, limit);
}

}  // namespace codesign
