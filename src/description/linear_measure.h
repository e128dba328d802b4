// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace codesign {

/// A number of the linearization about rest that a study bounds or minimizes, theory (70): of the
/// poles, or of the loop of a controller.
struct LinearMeasure {
  enum class Kind {
    kGrowth,        ///< largest Re p of a pole [1/s]
    kDampingRatio,  ///< smallest -Re p/|p| of a pole [-]
    kRadius,        ///< largest |z| over the period of sampled loops [-]
    kGainMargin,    ///< these as LoopMargins
    kGainReduction,
    kPhaseMargin,  ///< [rad]
    kDelayMargin,  ///< [s]
    kBandwidth,    ///< [rad/s]
    kSensitivity,
    kComplementarySensitivity
  };
  Kind kind = Kind::kGrowth;
  std::string controller;  ///< whose loop it is; of poles empty

  /// How many of the poles count, those that decide first; a pair counts twice, so that each place
  /// is continuous where a pair becomes two real poles.
  static constexpr int kPoles = 6;
  /// How many of the crossings or peaks of a loop count.
  static constexpr int kCrossings = 3;
  bool is_of_poles() const { return kind <= Kind::kRadius; }
  int places() const { return is_of_poles() ? kPoles : kind == Kind::kBandwidth ? 1 : kCrossings; }
  /// Whether the smallest of the numbers counts, not the largest.
  bool counts_smallest() const {
    return kind == Kind::kDampingRatio || kind == Kind::kGainMargin || kind == Kind::kPhaseMargin ||
           kind == Kind::kDelayMargin;
  }
};

/// The kinds as files name them, in their order: three of poles, then those of loops.
constexpr std::array<const char*, 10> kLinearMeasureNames{
    "growth",       "damping_ratio", "radius",    "gain_margin", "gain_reduction",
    "phase_margin", "delay_margin",  "bandwidth", "sensitivity", "complementary_sensitivity"};
constexpr std::size_t kPoleMeasures = 3;

}  // namespace codesign
