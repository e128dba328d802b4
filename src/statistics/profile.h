// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <optional>

namespace codesign {

/// The smallest sum of squares of the residuals, all other parameters fitted again, where one
/// parameter has the value x; std::nullopt if this fit fails or is cancelled.
using ProfiledCost = std::function<std::optional<double>(double x)>;

/// Where one end of a profile lies.
enum class ProfileEnd {
  kFound,  ///< the cost crosses the threshold at the value
  kBound,  ///< the parameter's bound comes first
  /// the cost stays below the threshold within 1000 first steps: the data do not bound the
  /// parameter
  kUnbounded,
  /// a fit failed before the threshold was crossed; the value is the farthest value with a
  /// successful fit
  kFailed
};

/// The profile to compute.
struct ProfileProblem {
  double optimum = 0.0;    ///< the fitted value
  double cost = 0.0;       ///< sum of squares at the optimum
  double threshold = 0.0;  ///< allowed excess of the sum of squares, positive: profile_threshold()
  /// first step from the optimum, positive, such as the half width of the linear interval
  double step = 0.0;
  double lower = -std::numeric_limits<double>::infinity();  ///< bounds of the parameter
  double upper = std::numeric_limits<double>::infinity();
};

/// An interval of the profile likelihood.
struct ProfileInterval {
  double lower = 0.0, upper = 0.0;
  ProfileEnd lower_end = ProfileEnd::kFound, upper_end = ProfileEnd::kFound;
  int evaluations = 0;
  /// A fit of the profile was better than the optimum by more than rounding: the search had not
  /// found the best point.
  bool found_better = false;
};

/// The values of one parameter between which the profiled cost stays below cost + threshold;
/// doc/theory.md (38). Steps double until the threshold is crossed. Then the secant (Illinois)
/// finds the crossing on the root of the excess, which is straight for a quadratic cost, to 1e-4 of
/// the interval's half.
ProfileInterval profile_interval(const ProfileProblem& problem, const ProfiledCost& cost);

/// The excess of the sum of squares at which a profile ends. @param residual_variance of the fit.
/// @param inflation variance of the parameter with correlated noise divided by its variance with
/// white noise; 1 for white noise. @param degrees of freedom of Student's t
double profile_threshold(double level, double residual_variance, double inflation, double degrees);

}  // namespace codesign
