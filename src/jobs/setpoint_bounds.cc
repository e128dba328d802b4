// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/setpoint_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "control/reference.h"
#include "description/study.h"
#include "jobs/effort_recorder.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kInstants = 401;
constexpr double kBeyond = 0.01;  // of the bound

/// A bound along the set-points.
struct Bound {
  const WatchedSignal* watched;
  Reference<double> reference;
  double lower, upper;  ///< infinite without one
  double worst = 0.0, excess = 0.0, time = 0.0;

  void observe(double t, double signal) {
    if (t < watched->after || t > watched->before) return;
    const double value = signal - reference.at(t).value;
    const double beyond = std::max(value - upper, lower - value);
    if (!(beyond > excess)) return;
    excess = beyond;
    worst = value;
    time = t;
  }
  double nearest() const { return worst > upper ? upper : lower; }
};

/// Whether the signal can be read along a motion without controllers.
bool is_readable(const WatchedSignal& watched, const RobotDescription& robot) {
  if (watched.role != WatchedSignal::Role::kPath) return false;
  try {
    check_signal(watched.signal, robot, {}, watched.element);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

std::vector<Bound> bounds_of(const Problem& problem, const std::vector<double>& parameters) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<Bound> bounds;
  for (const WatchedSignal& watched : study_of(problem).watched)
    if (is_readable(watched, robot_of(problem)))
      bounds.push_back({&watched, Reference<double>(watched.reference, parameters),
                        watched.lower ? watched.lower->at(parameters) : -kNone,
                        watched.upper ? watched.upper->at(parameters) : kNone});
  return bounds;
}

}  // namespace

Warnings find_bounds_beyond_setpoints(const Problem& problem, const std::vector<double>& parameters,
                                      const std::atomic<bool>* cancel) {
  const Study& study = study_of(problem);
  std::vector<Bound> bounds = bounds_of(problem, parameters);
  if (bounds.empty() || study.postures > 0 || !study.grid.empty()) return {};
  std::vector<SignalDescription> signals;
  for (const Bound& bound : bounds) signals.push_back(bound.watched->signal);
  const auto look = [&](const std::vector<double>& row) {
    const std::size_t first = row.size() - bounds.size();
    for (std::size_t k = 0; k < bounds.size(); ++k) bounds[k].observe(row[0], row[first + k]);
  };
  try {
    record_efforts(problem, parameters, signals, kInstants, look, cancel);
  } catch (const InputError&) {  // the set-points determine no motion
    return {};
  }
  Warnings warnings;
  for (const Bound& bound : bounds)
    if (bound.excess > kBeyond * std::abs(bound.nearest()) && std::isfinite(bound.excess))
      warnings.push_back(
          warn("bound_beyond_setpoints",
               {bound.watched->where, bound.watched->element,
                "the motion of the set-points needs " + readable(bound.worst, 4) + " of " +
                    bound.watched->signal.text + " at t = " + readable(bound.time, 4) +
                    " s, beyond this bound: no controller that follows them keeps it; widen the "
                    "bound, slow down the set-points, or lighten what they move",
                readable(bound.nearest()), "what codesign efforts says of the set-points"}));
  return warnings;
}

}  // namespace codesign
