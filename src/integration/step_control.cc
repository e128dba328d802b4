// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/step_control.h"

#include <algorithm>

namespace codesign {

BreakTimes::BreakTimes(const MotionStudy& study) : apart_(1e-12 * study.duration) {
  for (const ControllerDescription& controller : study.controllers) {
    add(controller.setpoint);
    add(controller.feedforward);
    for (const FeedbackTerm& term : controller.feedback) add(term.reference);
    const BasisDescription& basis = controller.basis;
    // A linear basis has kinks at the knots, where each coefficient begins to act; a cubic one is
    // smooth until its end.
    for (int k = 0; k < basis.count() && basis.shape == BasisShape::kLinear; ++k)
      times_.push_back(basis.support(k)[0]);
    if (basis.count() > 0) times_.push_back(basis.duration);
  }
  for (const LoadDescription& load : study.loads) {
    add(load.effort.of_time);
    for (const auto* components : {&load.force, &load.torque})
      for (const LoadFunction& component : *components) add(component.of_time);
  }
  for (const GivenMotion& motion : study.motion) add(motion.position);
  for (const ObjectiveTerm& term : study.integral) add(term.reference);
  for (const WatchedSignal& watched : study.watched) add(watched.reference);
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
