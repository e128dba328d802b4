// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linear/state_space.h"

namespace codesign {

/// A value of a loop's frequency response and where it occurs.
struct AtFrequency {
  double value = 0.0;
  double frequency = 0.0;  ///< [rad/s]
};

/// The margins of one controller's loop, opened at its output: L(s) with 1 + L = 0 at the poles of
/// the closed loop; theory (69). Absent: there is no such crossing, the margin is infinite. A loop
/// that is unstable has nothing to spare: all are absent but `gain_reduction`, if a lower gain
/// makes it stable.
struct LoopMargins {
  bool is_stable = true;  ///< whether no pole of the closed loop grows
  /// the smallest factor above 1 by which the gain may rise, and the largest one below 1 to which
  /// it may fall, where L crosses the negative real axis
  std::optional<AtFrequency> gain_margin, gain_reduction;
  std::optional<AtFrequency> phase_margin;  ///< smallest one where |L| = 1 [rad], a lead or a lag
  std::optional<AtFrequency> delay_margin;  ///< smallest further delay [s]
  /// value = frequency [rad/s]: |T| falls below |T(0)|/sqrt 2
  std::optional<AtFrequency> bandwidth;
  std::optional<AtFrequency> sensitivity;    ///< Ms, the largest |1/(1 + L)|
  std::optional<AtFrequency> complementary;  ///< Mt, the largest |L/(1 + L)|
  /// [rad/s] at which T is what it is at rest, for the bandwidth: 0, or a frequency far below all
  /// poles if T is not finite there
  double rest = 0.0;
  /// All crossings and peaks of each kind, the one that decides first: the first ones are the
  /// numbers above.
  struct All {
    std::vector<AtFrequency> gains, reductions, phases, delays, sensitivities, complementaries;
  };
  All all{};
};

/// The loop of a controller as a transfer function.
class OpenLoop {
 public:
  /// @param closed from an effort added to the controller's output to that output: H = -L/(1 + L).
  explicit OpenLoop(const StateSpace& closed);
  ~OpenLoop();
  OpenLoop(OpenLoop&&) noexcept;

  /// L at a frequency [rad/s]: at s = j w, or at z = exp(j w period).
  std::complex<double> at(double frequency) const;
  /// Frequencies at which L is to be seen, ascending: across all poles, finer near each.
  const std::vector<double>& grid() const { return grid_; }
  LoopMargins margins() const;

 private:
  struct Functions;

  /// Whether no pole grows with another gain.
  bool is_stable_with(double factor) const;
  void find_crossings(LoopMargins* margins) const;
  void find_peaks(LoopMargins* margins) const;
  std::complex<double> closed_at(double frequency) const;

  std::unique_ptr<Functions> functions_;
  double period_;
  bool is_stable_;
  StateSpace open_;
  std::vector<double> grid_;
};

}  // namespace codesign
