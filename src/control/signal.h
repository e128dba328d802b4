// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/expression.h"
#include "mechanism_codesign/parameter.h"

namespace codesign {

struct ControllerDescription;
struct RobotDescription;
struct SignalDescription;
struct Topology;

/// The quantity that one term of a signal reads; doc/study.md describes them.
enum class SignalKind {
  kJointPosition,
  kJointVelocity,
  kJointAcceleration,
  kJointEffort,
  kJointEffortRate,  ///< theory (54)
  kJointFriction,
  kGearTorque,  ///< torque that the gear of a joint transmits; theory (9b)
  kGearLoss,    ///< what gear and motor lose, on the child
  kJointNormalForce,
  kJointSlidingVelocity,
  kContactFriction,  ///< friction of a pair that slips isotropically; theory (13a)
  kContactSpeed,     ///< speed of slip of such a pair
  kLinkPosition,
  kLinkVelocity,
  kLinkAcceleration,
  kLinkAngularVelocity,
  kLinkOrientation,  ///< component w, x, y or z of the quaternion in the root link's frame; axis 0
                     ///< is w
  kReactionForce,    ///< on the child of a joint, in the axes of the joint frame that the child
                     ///< carries; theory (11a)
  kReactionTorque,   ///< likewise, about the origin of that frame
  kKineticEnergy,    ///< of the whole mechanism; theory (14b)
  kPotentialEnergy,
  kTotalEnergy,
  kFrictionPower,  ///< of a joint, or of the whole mechanism (pair -1); theory (14c)
  kDampingPower,
  kActuatorPower,
  kLoadPower,
  kControllerError,
  kControllerErrorRate,
  kControllerIntegral,
  kControllerOutput,
  kControllerSetpoint,
  kControllerSetpointRate,
  kSpringForce,  ///< tension of a spring-damper; theory (13b)
  kSpringLength,
  kSpringSpeed,  ///< rate of its length
  kMotorTorque,  ///< of the actuator of a joint: effort / gear ratio
  kMotorSpeed,   ///< gear ratio times the velocity of the motor's side
  kMotorPosition,
  kMotorAcceleration,
  kGearDeflection,  ///< motor's side less joint's side of an elastic gear; theory (9c)
  kGearDeflectionRate,
  kElasticTorque  ///< torque of an elastic gear, which depends on the motion alone
};

/// One term of a signal with its names resolved to indices.
struct SignalReference {
  double factor = 1.0;
  SignalKind kind = SignalKind::kJointPosition;
  int pair = -1, element = -1;  ///< of a joint: index in Topology::pairs and in the pair's chain
  int link = -1;                ///< index of a link
  int axis = 0;         ///< component of a vector (x, y, z) or a quaternion (w, x, y, z), from 0
  int controller = -1;  ///< index of a controller
  int spring = -1;      ///< index in RobotDescription::spring_dampers
};

/// An expression of signals with its names resolved.
struct ResolvedFormula {
  struct Variable {
    int term = -1;                                ///< index among the terms of the signal; or
    std::shared_ptr<const Expression> parameter;  ///< a parameter; neither: the time t
  };
  ExpressionSteps steps;
  std::vector<Variable> variables;
};

/// A sum of resolved terms, or an expression of them.
struct Signal : std::vector<SignalReference> {
  using std::vector<SignalReference>::vector;
  std::shared_ptr<const ResolvedFormula> formula;  ///< null: the sum
};

/// Whether a quantity depends on the positions and velocities of the mechanism and on nothing else,
/// so that loads may depend on it.
bool is_of_motion(SignalKind kind);

/// Whether a signal contains the time t.
bool reads_time(const Signal& signal);

/// Resolves the names of a signal. @param parameters that an expression may contain.
/// @throws InputError for unknown names and for quantities that cannot be read.
Signal resolve_signal(const SignalDescription& signal, const RobotDescription& robot,
                      const Topology& topology,
                      const std::vector<ControllerDescription>& controllers,
                      const std::vector<Parameter>& parameters = {});

/// The time derivative of a resolved signal; std::nullopt if the derivative of a term is not
/// available.
std::optional<Signal> differentiate(const Signal& resolved);

/// As above, with an error. @param signal, element for messages.
/// @throws InputError for a quantity whose derivative is not available.
Signal differentiate(const Signal& resolved, const SignalDescription& signal,
                     const std::string& element);

}  // namespace codesign
