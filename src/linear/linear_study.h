// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "description/robot.h"
#include "description/study.h"

namespace codesign {

/// What of friction a linearization counts.
enum class LinearFriction {
  kOff,          ///< nothing but its viscous part
  kRegularised,  ///< all of it, with the slope of its smooth law at the speed of the state
  /// about rest all of it, with the slope at the speeds of the study's start; what does not move
  /// there as kRegularised
  kGivenSpeed
};
/// The spelling of each enumerator, in their order.
constexpr std::array<const char*, 3> kLinearFrictionNames{"off", "regularised", "given_speed"};

/// A study whose inputs are parameters: what a user may vary about a state, theory (67).
struct LinearStudy {
  Study study;
  /// of the study, then one per input, then functions of time that are no inputs; at the state
  std::vector<double> parameters;
  std::size_t first = 0;  ///< index in `parameters` of the first input
  std::vector<std::string> inputs;
  /// per controller: index in `inputs` of the effort beside its output; -1: it drives no joint
  std::vector<int> disturbances;
  /// of the parameters from `first` on: the function of time whose value at `time` they are
  std::vector<ReferenceDescription> functions;
  double time = 0.0;  ///< [s]

  /// The parameters at another design, at rest. @param design those before `first`.
  template <class T>
  std::vector<T> parameters_at(std::vector<T> design) const;
};

/// The inputs are `CONTROLLER/setpoint`, with its rate and acceleration where the law reads them,
/// `CONTROLLER/reference[k]` of state feedback, `CONTROLLER/disturbance`, an effort beside the
/// controller's on the joint that it drives, and the components `loads[k]/effort`,
/// `loads[k]/force/x`, ... of the loads. Set-points have at time t [s] the value and, unless the
/// study is at rest, the rates that the study prescribes.
LinearStudy with_inputs(Study study, const std::vector<double>& parameters, double t, bool at_rest);

/// A model without friction, at a design: coefficients, constant torques and losses in proportion
/// to a torque are zero, damping and viscous friction stay.
RobotDescription without_friction(RobotDescription robot);

/// Takes the losses of a gear away, but viscous ones, and with them the states of bristles, whose
/// poles would be zero.
void remove_losses(GearDescription* gear);

}  // namespace codesign
