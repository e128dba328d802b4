// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

#include "description/signal_table.h"

namespace codesign {

// The loads along a joint coordinate, theory (13): which there are, not their numbers. Each has
//   kPower        the kind of its power, theory (14c); none: it is counted elsewhere
//   kBehindGear   it acts on the motor's side of a gear, else on the joint's
// and functions of its value in elements/joint_load.h: part_load(), and where it has them
// powered_load() and part_energy().

/// Friction of the bearing by an annotated law.
struct BearingFriction {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kFriction;
  static constexpr bool kBehindGear = false;
  bool direct = false;         ///< in N m or N, without a normal force; theory (10a)
  bool directional = false;    ///< its numbers differ with the sign of the velocity
  bool viscous_power = false;  ///< its viscous part has an exponent
};

/// `<dynamics damping>` and a torsion spring with its damper.
struct PassiveLoad {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kDamping;
  static constexpr bool kBehindGear = false;
  bool has_spring = false;  ///< it depends on the position
};

/// `<dynamics friction>`
struct DryFriction {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kFriction;
  static constexpr bool kBehindGear = false;
};

/// `<limit lower upper>` as stops, theory (13d).
struct StopLoad {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kDamping;
  static constexpr bool kBehindGear = false;
};

/// The joint's or the motor's side of an elastic gear, theory (9c).
struct ElasticGearSide {
  static constexpr std::optional<PowerKind> kPower{};
  static constexpr bool kBehindGear = false;
  int gear = -1;  ///< index in System::elastic_gears()
  bool is_motor = false;
};

/// An effort of the study, theory (13g).
struct GivenEffort {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kLoad;
  static constexpr bool kBehindGear = false;
  int load = -1;  ///< index in MotionStudy::loads
};

/// The losses of gear and motor, theory (9b).
struct GearLoss {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kFriction;
  static constexpr bool kBehindGear = true;
};

/// What controllers apply together.
struct ControllerEffort {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kActuator;
  static constexpr bool kBehindGear = true;
  std::vector<int> controllers;  ///< indices
  bool saturated = false;        ///< `<limit effort>` bounds their sum
};

/// The torque of a motor that a voltage moves, theory (9d).
struct WindingTorque {
  static constexpr std::optional<PowerKind> kPower = PowerKind::kActuator;
  static constexpr bool kBehindGear = true;
  int winding = -1;  ///< index in System::windings()
};

using JointLoadPart =
    std::variant<BearingFriction, PassiveLoad, DryFriction, StopLoad, ElasticGearSide, GivenEffort,
                 GearLoss, ControllerEffort, WindingTorque>;

/// All loads along one joint coordinate.
struct JointLoad {
  /// the coordinate: index in Topology::pairs and in the pair's chain
  int pair = -1, element = -1;
  std::vector<JointLoadPart> parts;  ///< those behind the gear at the end
  /// whether the torque that a gear transmits to the joint is known, ...
  bool has_gear_torque = false;
  /// ... and its index among the unknowns; -1: it follows from the wrench that the joint transmits
  int gear_unknown = -1;

  /// The first load of a kind; null: there is none.
  template <class Part>
  const Part* find() const {
    for (const JointLoadPart& part : parts)
      if (const auto* found = std::get_if<Part>(&part)) return found;
    return nullptr;
  }
  /// Calls visit(part) for each of them, with its own type.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const JointLoadPart& part : parts) std::visit(visit, part);
  }
  bool has_power(PowerKind kind) const {
    const auto is_of = [kind](const auto& part) { return part.kPower == kind; };
    return std::any_of(parts.begin(), parts.end(),
                       [&](const JointLoadPart& part) { return std::visit(is_of, part); });
  }
  bool has_friction() const { return has_power(PowerKind::kFriction); }
};

}  // namespace codesign
