// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The quantities that one term of a signal reads; doc/study/signals.md describes them.
enum class SignalKind {
  kNext = -2,  ///< of a row: the quantity of the row behind it
  kNone,       ///< no quantity; of a row: one that no code names
  kJointPosition,
  kJointVelocity,
  kJointAcceleration,
  kJointEffort,
  kJointEffortRate,  ///< theory (54)
  kActuatorPower,    ///< of a joint; theory (14c)
  kDampingPower,
  kLoadPower,
  kMotorTorque,  ///< of the actuator of a joint: effort / gear ratio
  kMotorSpeed,   ///< gear ratio times the velocity of the motor's side
  kMotorPosition,
  kCurrent,          ///< of the winding of a joint's motor; theory (9d)
  kVoltage,          ///< likewise
  kElectricalPower,  ///< voltage times current
  kCopperLoss,       ///< R i^2
  kGearDeflection,   ///< motor's side less joint's side of an elastic gear; theory (9c)
  kJointFriction,
  kJointNormalForce,
  kJointSlidingVelocity,
  kFrictionPower,
  kGearLoss,    ///< what gear and motor lose, on the child
  kGearTorque,  ///< torque that the gear of a joint transmits; theory (9b)
  /// on the child of a joint, in the axes of the joint frame that the child carries; theory (11a)
  kReactionForce,
  kReactionTorque,  ///< likewise, about the origin of that frame
  kControllerError,
  kControllerSetpoint,
  kControllerSetpointRate,
  kControllerSetpointAcceleration,
  kControllerIntegral,
  kControllerOutput,
  kObservedPosition,  ///< estimates of an observer; theory (49a)
  kObservedVelocity,
  kObservedDisturbance,
  kLinkPosition,
  kLinkVelocity,
  kLinkAcceleration,
  kLinkAngularVelocity,
  kLinkAngularAcceleration,
  /// component w, x, y or z of the quaternion in the root link's frame; axis 0 is w
  kLinkOrientation,
  kImuAcceleration,     ///< proper acceleration of a link's origin, in its own axes; theory (11c)
  kImuAngularVelocity,  ///< of a link, in its own axes
  kKineticEnergy,       ///< of the whole mechanism; theory (14b)
  kPotentialEnergy,
  kTotalEnergy,
  kTotalFrictionPower,  ///< of the whole mechanism; theory (14c)
  kTotalDampingPower,
  kTotalActuatorPower,
  kTotalLoadPower,
  kTotalElectricalPower,  ///< of all windings; theory (9d)
  kTotalCopperLoss,
  kMagneticEnergy,
  kShakingForce,   ///< what the motion of all bodies exerts on the ground; theory (11b)
  kShakingMoment,  ///< likewise, about the ground's origin or that of the link in whose axes it is
  // What no file names: derivatives, and what stands for a quantity of special joints.
  kMotorAcceleration,
  kGearDeflectionRate,
  kElasticTorque,    ///< torque of an elastic gear, which depends on the motion alone
  kContactFriction,  ///< friction of a pair that slips isotropically; theory (13a)
  kContactSpeed,     ///< speed of slip of such a pair
  kImuAngularAcceleration,
  kControllerErrorRate
  // Quantities that no code names follow, in the order of their rows.
};

/// The kinds of power that go into a mechanism, doc/theory.md (14c); their sum is the rate of the
/// mechanical energy. Gravity, springs and the elastic part of stops are not among them, since
/// their work is in the potential energy.
enum class PowerKind {
  kFriction,  ///< `<codesign:friction>` with its viscous part, `<dynamics friction>`, and gears
  /// `<dynamics damping>`, the dampers of torsion springs, spring-dampers and elastic gears, and
  /// the dissipation of stops
  kDamping,
  kActuator,  ///< controllers, as applied within the effort limits, and drives
  kLoad       ///< the study's efforts and wrenches
};

/// On what a quantity depends, besides time and parameters.
enum class SignalNeeds {
  kMotion,     ///< on positions and velocities alone, so that loads may depend on it
  kControl,    ///< on controllers that are defined before the reader
  kForces,     ///< on accelerations or loads, too
  kReactions,  ///< on the wrenches that joints transmit, too
  kEfforts     ///< on the outputs of all controllers, so that no controller reads it
};

/// The components of a quantity: none, x y z, or w x y z.
enum class SignalShape { kScalar, kVector, kQuaternion };

/// The axes of a vector unless a term names a link, `NAME/QUANTITY/x@LINK`.
enum class SignalAxes {
  kNone,        ///< no vector, or one that is told in the root's axes only
  kRootLink,    ///< of the root link
  kChildFrame,  ///< of the joint frame that the child of a joint carries
  kOwnLink      ///< of the link that has the quantity
};

}  // namespace codesign
