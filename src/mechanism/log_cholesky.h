// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "mechanism/mass_properties.h"

namespace codesign {

/// The names of the ten numbers below, which follow the name of the link: LINK_alpha and so on.
inline constexpr std::array<const char*, 10> kLogCholeskyNames{"alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3"};
/// Their units: alpha is half the logarithm of the mass in kg, d the logarithm of a length in m.
inline constexpr std::array<const char*, 10> kLogCholeskyUnits{"", "", "", "", "m", "m", "m", "m", "m", "m"};

/// The ten numbers of mass, centre and inertia by the logarithmic Cholesky factor of the pseudo-inertia (Rucker and Wensing [18]), theory
/// (28e): for all values of the ten numbers there is a distribution of positive mass with these properties, and every such distribution has
/// ten numbers.
/// @param properties in the link's axes.
/// @returns in the order of kLogCholeskyNames; std::nullopt if mass or extent along some direction is not positive, as for points, rods and
/// plates, or if a principal moment is not below the sum of the others.
std::optional<std::array<double, 10>> log_cholesky(const MassProperties<double>& properties);
/// The mass properties for any ten numbers; the inverse of log_cholesky().
MassProperties<double> properties_of(const std::array<double, 10>& numbers);

}  // namespace codesign
