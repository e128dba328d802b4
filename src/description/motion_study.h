// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "description/control_realization.h"
#include "description/expression.h"
#include "description/joint_observer.h"
#include "description/loss_law.h"
#include "description/reference.h"
#include "description/signal.h"
#include "description/solver_options.h"
#include "forces/control_law.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/parameter.h"

namespace codesign {

struct ParameterSwitch;

/// The initial state of one joint; the assembly finds absent values, theory (19).
struct InitialJointState {
  std::string joint;
  std::optional<Quantity> position;  ///< value of an independent coordinate [rad or m]
  std::optional<Quantity> velocity;  ///< [rad/s or m/s]
  /// Values of `position` in the postures of the study, MotionStudy::postures of them; empty:
  /// `position` is that of all.
  std::vector<Quantity> positions;
  /// start of the assembly for a dependent coordinate, which selects the branch [rad or m]
  std::optional<double> guess;
  // For planar and floating joints only, in the joint frame at zero position, which is fixed in the
  // parent. A planar joint turns about its normal only: its rotation and angular_velocity use the
  // last component.
  std::optional<QuantityVector> translation;  ///< of the child's frame [m]
  /// of the child: fixed-axis roll, pitch, yaw, as URDF's rpy [rad]
  std::optional<QuantityVector> rotation;
  std::optional<QuantityVector> linear_velocity;   ///< of the child's frame [m/s]
  std::optional<QuantityVector> angular_velocity;  ///< of the child [rad/s]
  bool stuck = false;               ///< at rest, held by the bristles of its friction, theory (13h)
  std::optional<Quantity> current;  ///< of its motor's winding [A]
  SourceLocation where;
};

/// One term gain * (signal - reference) of state feedback; theory (C7).
struct FeedbackTerm {
  SignalDescription signal;
  ReferenceDescription reference;
  Quantity gain;
  std::vector<FilterDescription> filters;  ///< of the signal, in the order in which it passes them
};

/// A controller that drives one joint; the members that are used depend on `kind`.
struct ControllerDescription {
  std::string name;
  ControllerKind kind = ControllerKind::kPid;
  SignalDescription input;        ///< only if kind->has_error(), or kObserver
  ReferenceDescription setpoint;  ///< only if kind->has_error()
  /// only if kind->has_error(): of the input, in the order in which it passes them
  std::vector<FilterDescription> filters;
  /// the joint it drives, by a torque [N m], a force [N], or the voltage of its motor [V]; empty:
  /// only other controllers read it
  std::string output;
  /// its output is an effort, even where a joint has a winding and others are voltages
  bool gives_effort = false;
  Quantity p, i, d;                    ///< gains; only those that kind->gains names
  ReferenceDescription feedforward;    ///< kStateFeedback
  std::vector<FeedbackTerm> feedback;  ///< kStateFeedback
  BasisDescription basis;              ///< kBasis
  ObserverDescription observer;        ///< kObserver
  ControlRealization realization;      ///< how a robot runs it
  SourceLocation where;

  /// Whether one of its signals passes a filter.
  bool has_filters() const {
    return !filters.empty() ||
           std::any_of(feedback.begin(), feedback.end(),
                       [](const FeedbackTerm& term) { return !term.filters.empty(); });
  }
};

/// A component of a load: a function of time, or an expression of signals.
struct LoadFunction {
  ReferenceDescription of_time;
  std::shared_ptr<const SignalDescription> of_signals;  ///< null: of_time
};

/// A load: an effort on a joint, or a wrench on a link.
struct LoadDescription {
  std::string joint;  ///< one of joint and link is empty
  std::string link;
  LoadFunction effort;                        ///< of a joint, along its coordinate [N m or N]
  std::array<LoadFunction, 3> force, torque;  ///< on a link [N], [N m]
  QuantityVector point;                       ///< where the force acts, in the link's frame [m]
  /// components of force and torque in the link's axes, turning with it; else in the root link's
  /// axes
  bool in_link_frame = false;
  SourceLocation where;
};

/// A joint whose motion is given; theory (8b).
struct GivenMotion {
  std::string joint;  ///< revolute, continuous or prismatic, of the tree or a loop
  /// of its coordinate [rad or m]; kIntegral if its velocity is given
  ReferenceDescription position;
  SourceLocation where;
};

/// One term weight * rho(signal - reference) of the objective, with its loss rho; theory (21).
struct ObjectiveTerm {
  SignalDescription signal;
  ReferenceDescription reference;
  Quantity weight{1.0};
  LossKind loss = LossKind::kSquare;
  Quantity scale{1.0};  ///< of a loss with has_scale, > 0 [unit of the signal]
  SourceLocation where;
};

/// Which limits of URDF's `<limit>` are enforced, and the properties of the stops; theory (13c),
/// (13d). Numbers that are not given follow the machine, (13i).
struct LimitOptions {
  bool effort = false;              ///< saturates the controllers' output
  bool position = false;            ///< adds stops at `lower` and `upper`
  std::optional<double> stiffness;  ///< k of a stop [N/m or N m/rad]
  /// c of a stop: relative increase of its force per speed [s/m or s/rad]
  std::optional<double> dissipation;
  std::optional<double> width;  ///< w: depth over which the force sets in smoothly [m or rad]
};

/// What of a study the equations of motion, their start, their integration and their gradients
/// read.
struct MotionStudy {
  // Defined in one file: the members of all lists would else be compiled wherever one is copied or
  // destroyed.
  MotionStudy();
  MotionStudy(const MotionStudy&);
  MotionStudy(MotionStudy&&) noexcept;
  MotionStudy& operator=(const MotionStudy&);
  MotionStudy& operator=(MotionStudy&&) noexcept;
  ~MotionStudy();

  /// [s]; of a study with postures: the number of its last one; of runs whose end depends on the
  /// design, the longest one that is possible.
  double duration = 0.0;
  /// The duration of a run by its parameters [s], theory (21g); null: `duration`.
  std::shared_ptr<const Expression> duration_of_design;
  /// The condition at which a run ends before its duration, theory (21g); null: none.
  std::shared_ptr<const SignalDescription> until;
  /// [s] Over which the energy of a run is balanced, theory (17a); 0: the whole run. A run that
  /// goes on beyond the study's duration balances over that duration, again and again.
  double balance_time = 0.0;
  /// Number of postures that take the place of a motion, theory (21f); 0: a motion. Time is the
  /// number of a posture, from 0.
  int postures = 0;
  std::array<double, 3> gravity{0.0, 0.0, -9.81};  ///< [m/s^2], in the root link's frame
  std::vector<InitialJointState> initial_state;
  /// Extra states at the start, in the order of Layout::states; missing entries at the end are
  /// zero. No file gives them: a study starts from zero, a segment of a recording from anywhere.
  std::vector<Quantity> initial_extra_states;
  std::vector<ControllerDescription> controllers;
  std::vector<LoadDescription> loads;
  std::vector<GivenMotion> motion;
  /// find_excursions() of the study as it was read: break times of its expressions of the time [s].
  std::vector<double> excursions;
  bool rigid_gears = false;  ///< gears with a stiffness are rigid, since the motion is given
  /// All named parameters: the model's in their order, then the study's own. `parameters[tuned[k]]`
  /// is rho_k.
  std::vector<Parameter> parameters;
  /// Indices of the parameters that a number of model or study depends on. Dependence of
  /// constraints does not count: a constraint alone has no effect on the motion.
  std::set<int> used_parameters;
  std::vector<ParameterSwitch> switches;  ///< of its numbers and those of the model
  std::vector<int> tuned;                 ///< indices of the tuned parameters; p of them
  /// terms of the integrand g, or of the sum over postures; theory (21), (21f)
  std::vector<ObjectiveTerm> integral;
  std::vector<ObjectiveTerm> terminal;  ///< terms at the end of the study, w; theory (21)
  /// constraints on signals and peaks in the objective; theory (21a)
  std::vector<WatchedSignal> watched;
  LimitOptions limits;
  SolverOptions solver;
  std::string file;  ///< the file it was read from, for messages
};

/// Whether the objective has a term: an integral, a terminal one or a peak.
bool has_objective(const MotionStudy& study);

/// Whether some of it is a number of a run, or none of it is: only what is linearized at rest,
/// theory (70), needs no run.
bool needs_run(const MotionStudy& study);
/// Whether some watched signal is a number of the linearization at rest.
bool needs_linearization(const MotionStudy& study);

/// Whether the end of a run depends on its design.
bool has_moving_end(const MotionStudy& study);
/// The duration of a run with these parameters [s], all named ones; the longest one with `until`.
double duration_at(const MotionStudy& study, const std::vector<double>& parameters);

/// Whether the study gives the motion of this joint.
bool has_given_motion(const MotionStudy& study, const std::string& joint);

}  // namespace codesign
