// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "mechanism_codesign/gradient.h"

namespace codesign {

struct MotionStudy;

/// A line through a design along which a gradient is checked.
struct CheckedLine {
  Eigen::VectorXd direction;  ///< d, in the units of the tuned parameters
  double first_step = 0.0;    ///< the longest step along d
  bool is_two_sided = true;   ///< false: bounds leave room on the side of d alone
  double per_range = 0.0;     ///< the largest share of its extent by which d moves a parameter
};

/// A line along which every parameter has its part: d_k = +-c_k / max(|g_k|, 0.03 max_j |g_j|) by
/// parameters in units of their magnitudes, with c_k from 0.5 to 1.5 and the signs of the gradient,
/// so that no terms of d^T g cancel; but into the interior from a bound. Of a single parameter, its
/// derivative.
CheckedLine checked_line(const MotionStudy& study, const Eigen::VectorXd& rho,
                         const Eigen::VectorXd& gradient);

/// The derivative at 0 of a function by its values at steps h, h/4, h/16, ..., extrapolated to step
/// zero (Ridders, doc/theory.md [9]), with an error that also counts a kink at 0.
class LineDifferences {
 public:
  static constexpr int kMostLevels = 8;
  static constexpr double kShrink = 4.0;

  LineDifferences(double at_zero, bool is_two_sided)
      : at_zero_(at_zero), is_two_sided_(is_two_sided) {}

  /// @param h the step. @param forward, backward f(h) and f(-h); the latter is not read if steps
  /// are on one side.
  void add(double h, double forward, double backward);
  int levels() const { return levels_; }

  /// The derivative, and the change by its last extrapolation with half of the jump of the slope at
  /// 0; infinite below two levels.
  double value() const { return value_; }
  double error() const { return error_; }
  /// Whether the plain quotients grow from level to level up to the last one, by more than half
  /// as much each time as before and by a fifth of their size: beside a singular design nothing
  /// bounds what they grow to, and error() is none.
  bool diverges() const;
  /// The shortest step that value() uses, and its plain quotient.
  double step() const { return steps_[used_]; }
  double quotient() const { return table_[used_][0]; }
  /// (f(h) - f(-h)) / 2h, or (f(h) - f(0)) / h.
  double quotient(double h, double at_zero, double forward, double backward) const;
  /// Estimate of |f''(0)| from the last level.
  double curvature() const { return curvature_; }

 private:
  using Row = std::array<double, kMostLevels>;
  double at_zero_;
  bool is_two_sided_;
  int levels_ = 0;
  std::array<Row, kMostLevels> table_{};
  Row steps_{}, kinks_{};
  std::size_t used_ = 0;
  double value_ = 0.0, error_ = 0.0, curvature_ = 0.0;
};

/// By how much a gradient may differ, from the study's own tolerances: a share of its size, of the
/// objective over the ranges, and what moves an optimum by a small share of the ranges.
double allowed_difference(const IndependentCheck& check, const CheckedLine& line, double objective,
                          double curvature);

}  // namespace codesign
