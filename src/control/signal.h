// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_SIGNAL_H_
#define MECHANISM_CODESIGN_CONTROL_SIGNAL_H_

#include <string>
#include <vector>

#include "description/robot.h"
#include "description/study.h"
#include "mechanism/topology.h"

namespace codesign {

/// What one term of a signal reads.
enum class SignalKind {
  kJointPosition,
  kJointVelocity,
  kJointAcceleration,
  kJointEffort,
  kJointFriction,
  kJointNormalForce,
  kJointSlidingVelocity,
  kContactFriction,  ///< of a pair that slips isotropically
  kContactSpeed,
  kLinkPosition,
  kLinkVelocity,
  kLinkAcceleration,
  kLinkAngularVelocity,
  kLinkOrientation,  ///< component w, x, y or z of the quaternion in the root link's frame; axis 0 is w
  kReactionForce,    ///< on the child of a joint, at and in the joint frame that it carries
  kReactionTorque,
  kKineticEnergy,  ///< of the whole mechanism
  kPotentialEnergy,
  kTotalEnergy,
  kFrictionPower,  ///< of a joint, or of the whole mechanism (pair -1); see PowerKind
  kDampingPower,
  kActuatorPower,
  kLoadPower,
  kControllerError,
  kControllerErrorRate,
  kControllerIntegral,
  kControllerOutput
};

/// A term with its names resolved to indices.
struct SignalReference {
  double factor = 1.0;
  SignalKind kind = SignalKind::kJointPosition;
  int pair = -1, element = -1;  ///< joints: the pair and its chain element
  int link = -1;                ///< links
  int axis = 0;                 ///< of a vector or a quaternion
  int controller = -1;          ///< controllers
};

/// A sum of resolved terms.
using Signal = std::vector<SignalReference>;

/// Resolves names against a mechanism. @throws InputError for what does not exist or cannot be read.
Signal resolve_signal(const SignalDescription& signal, const RobotDescription& robot, const Topology& topology,
                      const std::vector<ControllerDescription>& controllers);

/// The time derivative of a signal. @throws InputError, naming `signal`, for a quantity whose derivative is not available.
Signal differentiate(const Signal& resolved, const SignalDescription& signal, const std::string& element);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_SIGNAL_H_
