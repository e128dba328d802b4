// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_STUDY_H_
#define MECHANISM_CODESIGN_DESCRIPTION_STUDY_H_

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/basis.h"
#include "description/quantity.h"
#include "description/reference.h"
#include "description/solver_options.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/optimizer_options.h"
#include "mechanism_codesign/parameter.h"

namespace codesign {

/// One term of a signal: `+ crank_joint/velocity`, `- plate/position/x`.
struct SignalTerm {
  double factor = 1.0;  ///< +1 or -1
  std::string object;   ///< name of a joint, loop, link or controller
  std::string
      quantity;  ///< position, velocity, acceleration, effort, friction, normal_force, sliding_velocity, angular_velocity, error, ...
  std::string component;  ///< x, y or z for link signals, else empty
};

/// A sum or difference of named signals, see doc/study.md.
struct SignalDescription {
  std::string text;
  std::vector<SignalTerm> terms;
  SourceLocation where;
};

/// Splits `a/position/x - b/position/x` into terms. Names are resolved later, against a model.
/// @throws InputError if the text is no signal.
SignalDescription parse_signal(const std::string& text, const SourceLocation& where, const std::string& element);

struct InitialJointState {
  std::string joint;
  std::optional<Quantity> position;  ///< an independent coordinate's value [rad or m]
  std::optional<Quantity> velocity;  ///< [rad/s or m/s]
  std::optional<double> guess;       ///< start of the assembly for a dependent joint; chooses between its branches
  // Of planar and floating joints; all in the joint frame that the parent carries. A planar joint turns about its normal alone: its
  // rotation and angular_velocity have one number, the last.
  std::optional<QuantityVector> translation;       ///< of the child's frame [m]
  std::optional<QuantityVector> rotation;          ///< fixed-axis roll, pitch, yaw, as URDF's rpy [rad]
  std::optional<QuantityVector> linear_velocity;   ///< of the child's frame [m/s]
  std::optional<QuantityVector> angular_velocity;  ///< of the child [rad/s]
  SourceLocation where;
};

/// The laws of control; doc/theory.md (C3)-(C8).
enum class ControllerKind {
  kPid,             ///< p e + i int e dt + d de/dt, with e = setpoint - input
  kPdGravity,       ///< p e + d de/dt + what holds the joint against gravity
  kComputedTorque,  ///< inverse dynamics of the tree at the acceleration setpoint'' + d de/dt + p e
  kStateFeedback,   ///< feedforward - sum gain (signal - reference)
  kBasis            ///< a shaped function of time
};

/// Whether a law compares an input with a setpoint.
constexpr bool has_error(ControllerKind kind) { return kind != ControllerKind::kStateFeedback && kind != ControllerKind::kBasis; }

/// gain * (signal - reference)
struct FeedbackTerm {
  SignalDescription signal;
  ReferenceDescription reference;
  Quantity gain;
};

struct ControllerDescription {
  std::string name;
  ControllerKind kind = ControllerKind::kPid;
  SignalDescription input;        ///< where has_error()
  ReferenceDescription setpoint;  ///< where has_error()
  std::string output;             ///< the joint it drives [N m or N]
  Quantity p, i, d;
  ReferenceDescription feedforward;    ///< kStateFeedback
  std::vector<FeedbackTerm> feedback;  ///< kStateFeedback
  BasisDescription basis;              ///< kBasis
  SourceLocation where;
};

/// A constant load: an effort on a joint, or a wrench on a link.
struct LoadDescription {
  std::string joint;  ///< one of joint and link is empty
  std::string link;
  Quantity effort;               ///< of a joint, along its coordinate [N m or N]
  QuantityVector force, torque;  ///< of a link [N], [N m]
  QuantityVector point;          ///< where the force acts, in the link's frame [m]
  bool in_link_frame = false;    ///< the components of force and torque turn with the link; else they are the root link's
  SourceLocation where;
};

/// weight * (signal - reference)^2
struct ObjectiveTerm {
  SignalDescription signal;
  ReferenceDescription reference;
  Quantity weight{1.0};
  SourceLocation where;
};

/// A constraint among parameters, value(rho) >= 0.
struct ParameterConstraint {
  std::string text;
  std::shared_ptr<const Expression> margin;
  SourceLocation where;
};

/// Which of URDF's `<limit>` are enforced, and what the stops are made of; doc/theory.md (13c), (13d).
struct LimitOptions {
  bool effort = false;       ///< saturates what controllers apply
  bool position = false;     ///< stops at lower and upper
  double stiffness = 1e4;    ///< of a stop [N/m or N m/rad]
  double dissipation = 1.0;  ///< of a stop: relative growth of its force per speed [s/m or s/rad]
  double width = 1e-3;       ///< over which a stop takes hold [m or rad]
};

/// What to do with the model, as its author wrote it.
struct Study {
  double duration = 0.0;                           ///< [s]
  std::array<double, 3> gravity{0.0, 0.0, -9.81};  ///< [m/s^2], in the root link's frame
  std::vector<InitialJointState> initial_state;
  std::vector<ControllerDescription> controllers;
  std::vector<LoadDescription> loads;
  /// All named parameters: the model's in their order, then the study's own. `parameters[tuned[k]]` is rho_k.
  std::vector<Parameter> parameters;
  std::vector<int> tuned;
  std::vector<ObjectiveTerm> integral;
  std::vector<ObjectiveTerm> terminal;
  std::vector<ParameterConstraint> constraints;
  LimitOptions limits;
  SolverOptions solver;
  OptimizerOptions optimizer;
  std::string file;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_STUDY_H_
