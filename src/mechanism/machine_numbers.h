// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism/machine_scale.h"

namespace codesign {

struct Topology;
template <class T>
struct Constants;

// The numbers that neither model nor study give follow the machine, doc/theory.md (13i): the same
// machine in other units of mass, length and time gets the same dimensionless numbers.

/// epsilon of a bearing per weight that hangs on it, and of a gear per torque of this weight [-].
constexpr double kSmoothingShare = 1e-5;
/// Transition velocity of friction in N m or N, and of gears, per velocity of the machine [-].
constexpr double kTransitionShare = 2e-4;
/// w of a stop per stroke [-].
constexpr double kStopWidthShare = 1e-3;
/// The part of its stroke by which a stop gives way, without dissipation, where the joint arrives
/// with the speed of (13i) [-].
constexpr double kStopDepthShare = 0.01;

/// Sets the numbers of `constants` that follow the machine: FrictionNumbers::smoothing of bearings
/// and gears and FrictionDescription::transition_follows where the model has none, and
/// JointDynamicsConstants::stop, which the study may give. They depend on the parameters as masses,
/// lengths and limits do.
/// @param constants of evaluate_constants() at the same parameters. @param scale overwritten.
template <class T>
void set_machine_numbers(const RobotDescription& robot, const Topology& topology,
                         const MotionStudy& study, const std::vector<T>& parameters,
                         MachineScale<T>* scale, Constants<T>* constants);

/// A number that follows the machine, for people.
struct MachineNumber {
  std::string joint;  ///< joint or loop
  /// `smoothing`, `transition velocity`, of a gear `gear smoothing`, `gear transition velocity`; of
  /// stops `stop stiffness`, `stop dissipation`, `stop width`
  std::string number;
  std::string unit;
  double value = 0.0;
};

/// The numbers of a design that neither model nor study give, in the order of the joints. @param
/// robot of a system, with its motors.
std::vector<MachineNumber> machine_numbers(const RobotDescription& robot, const Topology& topology,
                                           const MotionStudy& study,
                                           const Constants<double>& constants);

}  // namespace codesign
