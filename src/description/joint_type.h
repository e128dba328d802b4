// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace codesign {

/// The types of joints and loops, as files name them.
enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic, kPlanar, kFloating, kSpherical, kUniversal, kCylindrical, kDistance };

/// Whether the only coordinate of a type is an angle.
constexpr bool is_turn(JointType type) { return type == JointType::kRevolute || type == JointType::kContinuous; }
/// Whether a type has exactly one coordinate, and with it a scalar position, velocity, acceleration and effort.
constexpr bool has_one_coordinate(JointType type) { return is_turn(type) || type == JointType::kPrismatic; }

/// The places in which a type is allowed, with its spelling.
struct JointTypeName {
  JointType type;
  const char* of_joints;  ///< value of `<joint type>`; null: no joint of the tree has this type
  const char* of_loops;   ///< value of `<loop type>`; null: no loop has it
};

constexpr std::array<JointTypeName, 10> kJointTypeNames{{
    {JointType::kFixed, "fixed", "fixed"},
    {JointType::kRevolute, "revolute", "revolute"},
    {JointType::kContinuous, "continuous", "continuous"},
    {JointType::kPrismatic, "prismatic", "prismatic"},
    {JointType::kPlanar, "planar", "planar"},
    {JointType::kFloating, "floating", nullptr},
    {JointType::kSpherical, nullptr, "codesign:spherical"},
    {JointType::kUniversal, nullptr, "codesign:universal"},
    {JointType::kCylindrical, nullptr, "codesign:cylindrical"},
    {JointType::kDistance, nullptr, "codesign:distance"},
}};

}  // namespace codesign
