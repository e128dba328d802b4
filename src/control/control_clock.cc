// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/control_clock.h"

#include <algorithm>

namespace codesign {

double ControlClock::Sampled::next() const {
  const double next_sample = period * static_cast<double>(sample);
  return delay > 0.0 ? std::min(next_sample, period * static_cast<double>(apply) + delay)
                     : next_sample;
}

ControlClock::ControlClock(const MotionStudy& study) {
  for (std::size_t c = 0; c < study.controllers.size(); ++c) {
    const ControlRealization& realization = study.controllers[c].realization;
    if (realization.is_sampled())
      controllers_.push_back(
          {static_cast<int>(c), realization.sample_time, realization.delay, 0, 0});
  }
  start();
}

void ControlClock::start() {
  for (Sampled& controller : controllers_) {
    controller.sample = 1;
    controller.apply = 0;
  }
  events_.clear();
  events_.reserve(2 * controllers_.size());
}

double ControlClock::next(double limit) const {
  for (const Sampled& controller : controllers_) limit = std::min(limit, controller.next());
  return limit;
}

const std::vector<ControlEvent>& ControlClock::due(double t) {
  events_.clear();
  for (Sampled& c : controllers_)
    while (c.delay > 0.0 && c.is_reached(c.period * static_cast<double>(c.apply) + c.delay, t))
      events_.push_back({ControlEvent::Kind::kApply, c.controller, c.apply++});
  for (Sampled& c : controllers_)
    while (c.is_reached(c.period * static_cast<double>(c.sample), t))
      events_.push_back({ControlEvent::Kind::kSample, c.controller, c.sample++});
  return events_;
}

}  // namespace codesign
