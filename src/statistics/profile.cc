// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/profile.h"

#include <algorithm>
#include <cmath>

#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

constexpr double kTolerance = 1e-4;   // relative to the distance from the optimum
constexpr double kFarthest = 1e3;     // in first steps
constexpr int kMostEvaluations = 40;  // per side

/// One side of the optimum, as a function of the distance s from it.
class ProfileSide {
 public:
  ProfileSide(const ProfileProblem& problem, const ProfiledCost& cost, double direction,
              ProfileInterval* interval)
      : problem_(problem), cost_(cost), direction_(direction), interval_(interval) {}

  struct End {
    double distance;
    ProfileEnd kind;
  };
  End find() {
    const double bound =
        direction_ > 0.0 ? problem_.upper - problem_.optimum : problem_.optimum - problem_.lower;
    const double farthest = std::min(bound, kFarthest * problem_.step);
    double inside = 0.0, inside_height = -std::sqrt(problem_.threshold);
    for (double s = std::min(problem_.step, bound); evaluations_ < kMostEvaluations;
         s = std::min(2.0 * s, farthest)) {
      if (!(s > inside)) break;
      const std::optional<double> height = height_at(s);
      if (!height) return {inside, ProfileEnd::kFailed};
      if (is_end(*height)) return {s, ProfileEnd::kFound};
      if (*height > 0.0) return {crossing(inside, inside_height, s, *height), ProfileEnd::kFound};
      inside = s;
      inside_height = *height;
    }
    return {inside, farthest < bound ? ProfileEnd::kUnbounded : ProfileEnd::kBound};
  }

 private:
  bool is_end(double height) const {
    return std::abs(height) < kTolerance * std::sqrt(problem_.threshold);
  }

  /// sqrt(excess) - sqrt(threshold): negative inside.
  std::optional<double> height_at(double s) {
    ++evaluations_;
    ++interval_->evaluations;
    const std::optional<double> cost = cost_(problem_.optimum + direction_ * s);
    if (!cost || !std::isfinite(*cost)) return std::nullopt;
    const double excess = *cost - problem_.cost;
    if (excess < -1e-6 * problem_.threshold) interval_->found_better = true;
    return std::sqrt(std::max(excess, 0.0)) - std::sqrt(problem_.threshold);
  }

  /// Illinois method: a secant in which the value at an end that stays twice is halved.
  double crossing(double a, double fa, double b, double fb) {
    int stays = 0;
    while (evaluations_ < kMostEvaluations && b - a > kTolerance * b) {
      const double s =
          std::clamp((a * fb - b * fa) / (fb - fa), a + 1e-3 * (b - a), b - 1e-3 * (b - a));
      const std::optional<double> height = height_at(s);
      if (!height) break;
      if (is_end(*height)) return s;
      if (*height < 0.0) {
        a = s;
        fa = *height;
        if (stays == 1) fb *= 0.5;
        stays = 1;
      } else {
        b = s;
        fb = *height;
        if (stays == -1) fa *= 0.5;
        stays = -1;
      }
    }
    return b;
  }

  const ProfileProblem& problem_;
  const ProfiledCost& cost_;
  double direction_;
  ProfileInterval* interval_;
  int evaluations_ = 0;
};

}  // namespace

ProfileInterval profile_interval(const ProfileProblem& problem, const ProfiledCost& cost) {
  ProfileInterval interval;
  const auto below = ProfileSide(problem, cost, -1.0, &interval).find(),
             above = ProfileSide(problem, cost, 1.0, &interval).find();
  interval.lower = problem.optimum - below.distance;
  interval.upper = problem.optimum + above.distance;
  interval.lower_end = below.kind;
  interval.upper_end = above.kind;
  return interval;
}

double profile_threshold(double level, double residual_variance, double inflation, double degrees) {
  const double factor = interval_factor(level, degrees);
  return factor * factor * residual_variance * inflation;
}

}  // namespace codesign
