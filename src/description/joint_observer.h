// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/expression.h"

namespace codesign {

/// An observer of one joint, theory (49a): a mass that the efforts of the joint's controllers drive
/// follows a measured position.
struct ObserverDescription {
  std::string joint;
  std::vector<std::string> efforts;  ///< the controllers whose outputs it counts
  Quantity inertia{1.0};             ///< at the joint [kg m^2 or kg]
  bool has_disturbance = false;      ///< whether it estimates an effort beside theirs
  // One of three ways to its gains.
  std::vector<double> real, imaginary;  ///< poles [1/s], one per state
  std::optional<Quantity> bandwidth;    ///< [Hz] all poles at -2 pi bandwidth
  /// intensity of the white noise that is a further effort [N^2 s or (N m)^2 s], or the rate of the
  /// disturbance [N^2/s or (N m)^2/s]
  std::optional<Quantity> process;
  /// of the measured position: intensity [m^2 s or rad^2 s]; sampled: variance [m^2 or rad^2]
  std::optional<Quantity> measurement;

  /// Number of its states: position, velocity, disturbance.
  int order() const { return has_disturbance ? 3 : 2; }
};

}  // namespace codesign
