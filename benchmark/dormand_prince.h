// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace codesign {

/// The pair of orders 5 and 4 of Dormand and Prince with the usual step control, for y' = f(y):
/// Hairer, Norsett and Wanner, Solving ODE I, II.4 and II.5. Steps allocate nothing.
/// @tparam Rates `void rates(const VectorXd& y, VectorXd* y_rate)`.
template <class Rates>
class DormandPrince {
 public:
  DormandPrince(Rates rates, Eigen::VectorXd y, double tolerance)
      : rates_(std::move(rates)), tolerance_(tolerance), y_(std::move(y)), next_(y_), error_(y_) {
    k_.fill(y_);
    rates_(y_, &k_[0]);
    h_ = 0.01 * std::sqrt((y_.squaredNorm() + 1e-12) / (k_[0].squaredNorm() + 1e-12));
  }

  const Eigen::VectorXd& state() const { return y_; }
  long steps() const { return steps_; }

  /// Integrates to time t, where the last step ends.
  void advance_to(double t) {
    while (t_ < t) {
      const bool last = t_ + h_ >= t;
      const double h = last ? t - t_ : h_, error = attempt(h);
      const double factor = std::clamp(0.9 * std::pow(error, -0.2), 0.2, 5.0);
      // A step that only the end cut short says nothing about the next one.
      if (!last || error > 1.0) h_ = h * factor;
      if (!(error <= 1.0)) continue;
      t_ = last ? t : t_ + h;
      y_.swap(next_);
      k_[0].swap(k_[6]);
      ++steps_;
    }
  }

 private:
  static constexpr double kA[6][6] = {
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr double kE[7] = {71.0 / 57600,      0.0,        -71.0 / 16695, 71.0 / 1920,
                                   -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

  /// The last stage is the end of the step and the first stage of the next one. @return the scaled
  /// error.
  double attempt(double h) {
    for (std::size_t stage = 0; stage < 6; ++stage) {
      next_ = y_;
      for (std::size_t j = 0; j <= stage; ++j)
        if (kA[stage][j] != 0.0) next_.noalias() += (h * kA[stage][j]) * k_[j];
      rates_(next_, &k_[stage + 1]);
    }
    error_.setZero();
    for (std::size_t j = 0; j < 7; ++j) error_.noalias() += (h * kE[j]) * k_[j];
    double largest = 0.0;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      largest = std::max(
          largest, std::abs(error_[i]) / (0.1 + std::max(std::abs(y_[i]), std::abs(next_[i]))));
    return largest / tolerance_;
  }

  Rates rates_;
  double tolerance_, t_ = 0.0, h_ = 0.0;
  Eigen::VectorXd y_, next_, error_;
  std::array<Eigen::VectorXd, 7> k_;
  long steps_ = 0;
};

}  // namespace codesign
