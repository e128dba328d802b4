// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/quantiles.h"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace codesign {
namespace {

// No long double, whose width differs from platform to platform.
namespace policies = boost::math::policies;
using Policy = policies::policy<policies::promote_double<false>>;

/// t > 0 that is exceeded with probability `tail` below 1/2.
double student_exceeded_with(double tail, double degrees) {
  constexpr double kNormalFrom = 1e8;
  if (degrees >= kNormalFrom) return std::sqrt(2.0) * boost::math::erfc_inv(2.0 * tail, Policy());
  return quantile(complement(boost::math::students_t_distribution<double, Policy>(degrees), tail));
}

}  // namespace

double student_quantile(double p, double degrees) {
  if (p == 0.5) return 0.0;
  return p > 0.5 ? student_exceeded_with(1.0 - p, degrees) : -student_exceeded_with(p, degrees);
}

double interval_factor(double level, double degrees) { return student_exceeded_with(0.5 * (1.0 - level), degrees); }

double chi_squared_tail(double x, double degrees) { return boost::math::gamma_q(0.5 * degrees, 0.5 * x, Policy()); }

}  // namespace codesign
