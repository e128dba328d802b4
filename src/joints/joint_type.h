// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The types of joints and loops to which other parts of a file refer, such as limits, lengths and poses. kOther: only its row of the table
/// of joints (JointLaw) tells about it.
enum class JointType {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  kPlanar,
  kFloating,
  kSpherical,
  kUniversal,
  kCylindrical,
  kDistance,
  kOther
};

/// Whether the only coordinate of a type is an angle.
constexpr bool is_turn(JointType type) { return type == JointType::kRevolute || type == JointType::kContinuous; }
/// Whether a type has exactly one coordinate, and with it a scalar position, velocity, acceleration and effort.
constexpr bool has_one_coordinate(JointType type) { return is_turn(type) || type == JointType::kPrismatic; }

}  // namespace codesign
