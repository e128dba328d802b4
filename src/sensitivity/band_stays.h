// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "description/motion_study.h"

namespace codesign {

/// A number with its derivatives by the tuned parameters; none without derivatives.
struct Differentiated {
  double value = 0.0;
  Eigen::VectorXd gradient;
};

/// When a watched signal is within its band, doc/theory.md (21e): its time of arrival or its dwell.
///
/// A value is within the band if lower <= value < upper. Between begin() and end(), cross() is
/// called wherever the signal enters or leaves the band, in the order of time.
class BandStays {
 public:
  /// Begins a run. @param parameters all named ones. @param count number of tuned parameters, or 0
  /// without derivatives.
  void start(const MotionStudy& study, const WatchedSignal& watched,
             const std::vector<double>& parameters, Eigen::Index count);

  double edge(bool upper) const { return (upper ? upper_ : lower_).value; }
  bool holds(double value) const { return !(value < lower_.value) && value < upper_.value; }
  /// Derivative of the time at which the signal meets an edge: -(x - edge)_rho / x'. @param slope
  /// x' [per s]. @param gradient x_rho at a fixed time.
  Eigen::VectorXd by_crossing(bool upper, double slope, const Eigen::VectorXd& gradient) const;

  /// The first instant of the interval [s] and the value there.
  void begin(double time, double value);
  /// The signal is inside or outside from `time` on; without effect if it was before.
  void cross(double time, const Eigen::VectorXd& by, bool inside);
  /// The time of arrival or the dwell. @param last value at the end of the interval. @param
  /// smallest, largest values in the interval.
  Differentiated end(double time, const Differentiated& last, const Differentiated& smallest,
                     const Differentiated& largest);

 private:
  Differentiated beyond(const Differentiated& value) const;

  WatchedSignal::Measure measure_ = WatchedSignal::Measure::kNone;
  Differentiated lower_, upper_;
  Differentiated since_, total_;  ///< begin of the present stay; time of all earlier ones [s]
  double span_ = 0.0;
  bool inside_ = false, ever_inside_ = false;
};

}  // namespace codesign
