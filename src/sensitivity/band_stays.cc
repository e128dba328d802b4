// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/band_stays.h"

#include "math/arrays.h"

namespace codesign {
namespace {

Differentiated evaluate(const Quantity& quantity, const MotionStudy& study,
                        const std::vector<double>& parameters, Eigen::Index count) {
  Differentiated result{quantity.at(parameters), Eigen::VectorXd::Zero(count)};
  if (!quantity.is_constant())
    for (Eigen::Index k = 0; k < count; ++k)
      result.gradient[k] = quantity.expression()->derivative(study.tuned[to_index(k)], parameters);
  return result;
}

}  // namespace

void BandStays::start(const MotionStudy& study, const WatchedSignal& watched,
                      const std::vector<double>& parameters, Eigen::Index count) {
  measure_ = watched.measure;
  span_ = watched.before - watched.after;
  lower_ = evaluate(watched.band_lower, study, parameters, count);
  upper_ = evaluate(watched.band_upper, study, parameters, count);
}

Eigen::VectorXd BandStays::by_crossing(bool upper, double slope,
                                       const Eigen::VectorXd& gradient) const {
  return ((upper ? upper_ : lower_).gradient - gradient) / slope;
}

void BandStays::begin(double time, double value) {
  inside_ = ever_inside_ = holds(value);
  since_ = {time, Eigen::VectorXd::Zero(lower_.gradient.size())};
  total_ = {0.0, since_.gradient};
}

void BandStays::cross(double time, const Eigen::VectorXd& by, bool inside) {
  if (inside == inside_) return;
  inside_ = inside;
  if (inside) {
    ever_inside_ = true;
    since_ = {time, by};
  } else {
    total_.value += time - since_.value;
    total_.gradient += by - since_.gradient;
  }
}

/// How far a value is outside, as a part of the band's width, times the duration of the interval
/// [s].
Differentiated BandStays::beyond(const Differentiated& value) const {
  const Differentiated& edge = value.value < lower_.value ? lower_ : upper_;
  const double sign = value.value < lower_.value ? -1.0 : 1.0,
               distance = sign * (value.value - edge.value), width = upper_.value - lower_.value;
  if (!(distance > 0.0)) return {0.0, Eigen::VectorXd::Zero(lower_.gradient.size())};
  return {span_ * distance / width, span_ / width *
                                        (sign * (value.gradient - edge.gradient) -
                                         distance / width * (upper_.gradient - lower_.gradient))};
}

Differentiated BandStays::end(double time, const Differentiated& last,
                              const Differentiated& smallest, const Differentiated& largest) {
  const Eigen::VectorXd fixed = Eigen::VectorXd::Zero(lower_.gradient.size());
  // A jump at the end of the interval.
  cross(time, fixed, holds(last.value));
  if (measure_ == WatchedSignal::Measure::kArrival) {
    if (inside_) return since_;
    const Differentiated missed = beyond(last);
    return {time + missed.value, missed.gradient};
  }
  if (ever_inside_) {
    cross(time, fixed, false);
    return total_;
  }
  // A signal that jumps over the band has values on both sides of it.
  if (smallest.value < lower_.value && largest.value > upper_.value) return {0.0, fixed};
  const Differentiated missed = beyond(smallest.value < lower_.value ? largest : smallest);
  return {-missed.value, -missed.gradient};
}

}  // namespace codesign
