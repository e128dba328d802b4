// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "linear/state_space.h"

namespace codesign {

/// What becomes of a small disturbance: it stays small, it grows, or a motion without force leads
/// away.
enum class Stability { kStable, kUnstable, kNeutral };
/// "stable", "unstable", "neutral".
const char* name_of(Stability stability);

/// A small motion exp(s t) about a state, theory (67); one of each conjugate pair. A sampled system
/// has it at the ends of its periods, z = exp(s period).
struct Pole {
  std::complex<double> value;  ///< s [1/s], Im s >= 0
  double uncertainty = 0.0;    ///< by rounding [1/s]
  bool is_pair = false;        ///< whether its conjugate is a pole, too
  Eigen::VectorXcd vector;     ///< of the states
  Eigen::VectorXcd left;       ///< SystemEigen::left

  double growth() const { return value.real(); }  ///< Re s [1/s]; negative: it decays
  double frequency() const;                       ///< Im s/(2 pi) [Hz]
  double damping_ratio() const;                   ///< -Re s/|s| [-]; 0 for s = 0
  double radius(double period) const;             ///< |z|
  /// Whether it cannot be told from a motion that nothing drives or slows.
  /// @param duration [s] below 1e-5 of which growth and turn are no motion.
  bool is_zero(double duration) const;
};

/// The poles, the largest growth first, at equal growth the slower one. Poles of a sampled system
/// whose states are gone after a period are left out: z = 0 within rounding.
std::vector<Pole> poles_of(const StateSpace& system);

/// kUnstable if a pole grows, else kNeutral if one is zero, else kStable: it decays or, without
/// damping, stays.
Stability judge(const std::vector<Pole>& poles, double duration);

/// "slowest pole -0.8 1/s": the pole that decides, and of a sampled system the spectral radius.
std::string decisive_text(const std::vector<Pole>& poles, Stability stability, double period);

}  // namespace codesign
