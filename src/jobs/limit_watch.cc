// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/limit_watch.h"

#include <algorithm>
#include <cmath>

#include "text/number_text.h"

namespace codesign {

LimitWatch::LimitWatch(const Problem& problem, const std::vector<double>& parameters, const FrameNames& names)
    : absolute_margin_(problem.study().solver.absolute_tolerance), relative_margin_(problem.study().solver.relative_tolerance) {
  const LimitOptions& enforced = problem.study().limits;
  for (const JointDescription& joint : problem.robot().joints) {
    const auto found = std::find(names.joints.begin(), names.joints.end(), joint.name);
    if (!joint.limit || found == names.joints.end()) continue;
    const auto watch = [&](const char* limit, const Quantity& bound) {
      watched_.push_back({static_cast<std::size_t>(found - names.joints.begin()), joint.name, limit, bound.at(parameters), -1});
    };
    if (has_stops(joint) && !enforced.position) {
      watch("lower", joint.limit->lower);
      watch("upper", joint.limit->upper);
    }
    if (joint.limit->bounds_velocity()) watch("velocity", joint.limit->velocity);
    if (joint.limit->bounds_effort() && !enforced.effort) watch("effort", joint.limit->effort);
  }
}

void LimitWatch::observe(const Frame& frame) {
  for (Watched& watched : watched_) {
    const JointSample& sample = frame.joints[watched.sample];
    const double margin = absolute_margin_ + relative_margin_ * std::abs(watched.bound);
    if (watched.limit == "lower") note(&watched, sample.position, sample.position < watched.bound - margin, frame.time);
    if (watched.limit == "upper") note(&watched, sample.position, sample.position > watched.bound + margin, frame.time);
    if (watched.limit == "velocity") note(&watched, sample.velocity, std::abs(sample.velocity) > watched.bound + margin, frame.time);
    if (watched.limit == "effort") note(&watched, sample.effort, std::abs(sample.effort) > watched.bound + margin, frame.time);
  }
}

void LimitWatch::note(Watched* watched, double value, bool beyond, double time) {
  if (!beyond) return;
  if (watched->crossing < 0) {
    watched->crossing = static_cast<int>(crossings_.size());
    crossings_.push_back({watched->joint, watched->limit, watched->bound, value, time});
  }
  LimitCrossing& crossing = crossings_[static_cast<std::size_t>(watched->crossing)];
  const bool position = watched->limit == "lower" || watched->limit == "upper";
  const double excess = position ? std::abs(value - watched->bound) : std::abs(value);
  const double largest = position ? std::abs(crossing.worst - watched->bound) : std::abs(crossing.worst);
  if (excess > largest) crossing.worst = value;
}

std::string describe(const LimitCrossing& crossing) {
  return "joint '" + crossing.joint + "' exceeds its " + crossing.limit + " limit " + readable(crossing.bound) +
         " from t = " + readable(crossing.time) + " s; the worst value is " + readable(crossing.worst);
}

}  // namespace codesign
