// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/resting_mechanism.h"

#include <algorithm>

#include "assembly/assembly.h"
#include "control/reference.h"
#include "description/study.h"
#include "equations/iteration_matrix.h"
#include "linear/linear_coordinates.h"
#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kRankOfLoops = 1e-8;  // as rounding leaves of rows that depend on each other

/// The function at t = 0, for ever.
ReferenceDescription held(const ReferenceDescription& function,
                          const std::vector<double>& parameters) {
  return {Reference<double>(function, parameters).at(0.0).value};
}

// Where the integral itself is bounded, find_equilibrium() compares it with its bound.
ControlRealization settled(const ControlRealization& of) {
  ControlRealization statically;
  statically.output_limit = of.output_limit;
  statically.limit_has_corners = of.limit_has_corners || of.is_sampled();
  if (of.antiwindup != AntiWindup::kClamping && !of.is_sampled()) statically.i_clamp = of.i_clamp;
  return statically;
}

void hold(const std::vector<double>& parameters, ControllerDescription* controller) {
  if (controller->i.at(parameters) == 0.0) controller->i = Quantity(0.0);
  controller->setpoint = held(controller->setpoint, parameters);
  controller->feedforward = held(controller->feedforward, parameters);
  // At rest there are no rates, which signals of samples do not have, and the output of a filter is
  // its input.
  if (controller->kind->is_pid) controller->d = Quantity(0.0);
  controller->filters.clear();
  for (FeedbackTerm& term : controller->feedback) {
    term.reference = held(term.reference, parameters);
    term.filters.clear();
  }
  controller->realization = settled(controller->realization);
}

/// The study as it is at rest at t = 0, without what is judged.
Study study_at_rest(Study study, const std::vector<double>& parameters) {
  for (ControllerDescription& controller : study.controllers) hold(parameters, &controller);
  for (GivenMotion& motion : study.motion) motion.position = held(motion.position, parameters);
  for (InitialJointState& initial : study.initial_state) {
    initial.velocity.reset();
    initial.linear_velocity.reset();
    initial.angular_velocity.reset();
    initial.stuck = false;
  }
  study.integral.clear();
  study.terminal.clear();
  study.watched.clear();
  return study;
}

/// The mechanism whose currents are those at which they stay, but for those that controllers read.
RobotDescription robot_at_rest(const System& system) {
  RobotDescription robot = system.robot();
  const std::vector<Winding> read = read_windings(system);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    JointDescription& joint = robot.joints[j];
    const bool is_read = std::any_of(read.begin(), read.end(), [&](const Winding& winding) {
      return system.topology()
                     .pairs[to_index(winding.pair)]
                     .chain[to_index(winding.element)]
                     .joint == static_cast<int>(j) ||
             winding.joint == joint.name;
    });
    if (joint.has_winding() && !is_read) joint.actuator->winding->inductance = Quantity(0.0);
  }
  return robot;
}

}  // namespace

std::vector<Winding> read_windings(const System& system) {
  std::vector<Winding> read;
  for (const Winding& winding : system.windings()) {
    const auto is_its = [&](const SignalReference& term) {
      return term.kind == SignalKind::kCurrent &&
             system.motor_of(term.pair, term.element) ==
                 CoordinateIndex{winding.pair, winding.element};
    };
    const auto reads = [&](const Signal& signal) {
      return std::any_of(signal.begin(), signal.end(), is_its);
    };
    for (const Controller& controller : system.controllers())
      if (winding.state >= 0 &&
          (reads(controller.input) ||
           std::any_of(controller.feedback.begin(), controller.feedback.end(), reads))) {
        read.push_back(winding);
        break;
      }
  }
  return read;
}

RestingMechanism::RestingMechanism(const CompiledSystem& system,
                                   const std::vector<double>& parameters)
    : system_{std::make_shared<const CompiledSystem>(
                  robot_at_rest(system), study_at_rest(system.whole_study(), parameters),
                  system.sharing()),
              {},
              {}},
      layout_(system_.system->layout()),
      parameters_(parameters),
      motion_(system_) {
  motion_.set_design(parameters);
  derivatives_.resize(system_.system->patterns());
  for (const Controller& controller : system_.system->controllers())
    if (controller.state >= 0) integrals_.push_back(controller.state);
  for (const Controller& controller : system_.system->controllers())
    for (int k = 0; k < controller.states.estimates; ++k) {
      integrals_.push_back(controller.states.estimate + k);
      has_estimates_ = true;
    }
  for (const Winding& winding : read_windings(*system_.system)) {
    integrals_.push_back(winding.state);
    has_estimates_ = true;
  }
}

Status RestingMechanism::begin() {
  StartWorkspace start(*system_.system, parameters_);
  if (Status status = start.solve_positions(); !status.ok()) return status;
  theta_ = start.assembly.theta();
  state_.resize(layout_);
  state_.q = start.state.q;
  state_.turns = start.state.turns;
  return motion_.solve({}, &state_);
}

Status RestingMechanism::go_to(const Eigen::VectorXd& q, const Eigen::VectorXd& integrals) {
  State<double> trial = state_;
  trial.q = q;
  for (std::size_t k = 0; k < integrals_.size(); ++k)
    trial.s[integrals_[k]] = integrals[to_signed(k)];
  Status status = motion_.solve({}, &trial);
  if (!status.ok()) return status;
  motion_.equations().track_turns(&trial);
  state_ = std::move(trial);
  return status;
}

Eigen::VectorXd RestingMechanism::integrals() const {
  Eigen::VectorXd values(to_signed(integrals_.size()));
  for (std::size_t k = 0; k < integrals_.size(); ++k)
    values[to_signed(k)] = state_.s[integrals_[k]];
  return values;
}

Eigen::VectorXd RestingMechanism::errors() const {
  Eigen::VectorXd values(to_signed(integrals_.size()));
  for (std::size_t k = 0; k < integrals_.size(); ++k)
    values[to_signed(k)] = state_.z[layout_.state_column(integrals_[k])];
  return values;
}

std::vector<double> RestingMechanism::integral_of_controllers() const {
  std::vector<double> values;
  for (const Controller& controller : system_.system->controllers())
    values.push_back(controller.state < 0 ? 0.0 : state_.s[controller.state]);
  return values;
}

// G at accelerations of zero; what reactions add to it is normal to all free motions.
Eigen::VectorXd RestingMechanism::unbalanced_efforts(const Eigen::MatrixXd& N) {
  State<double> held = state_;
  held.z.head(layout_.n).setZero();
  VectorX<double> G;
  double g = 0.0;
  motion_.equations().residual(held, &G, &g);
  const Eigen::VectorXd efforts = -G.head(layout_.n);
  return product(N, transposed_product(N, efforts)).col(0);
}

std::vector<double> RestingMechanism::estimates_of_controllers() const {
  std::vector<double> values;
  for (const Controller& controller : system_.system->controllers())
    for (int k = 0; k < controller.states.estimates; ++k)
      values.push_back(state_.s[controller.states.estimate + k]);
  return values;
}

std::vector<double> RestingMechanism::currents() const {
  std::vector<double> values;
  for (const Winding& winding : read_windings(*system_.system))
    values.push_back(state_.s[winding.state]);
  return values;
}

Status RestingMechanism::linearize(Eigen::MatrixXd* N) {
  if (Status status = motion_.linearize(state_); !status.ok()) return status;
  motion_.equations().linearize(state_, &derivatives_);
  *N = orthogonal_complement(constraint_rows(*system_.system, derivatives_).transpose(),
                             kRankOfLoops);
  return {};
}

Eigen::MatrixXd RestingMechanism::slopes(const Eigen::MatrixXd& N, bool by_integrals) {
  const Eigen::Index own = by_integrals ? to_signed(integrals_.size()) : 0;
  Eigen::MatrixXd slopes(layout_.n + own, N.cols() + own);
  VectorX<double> change;
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) {
    State<double> direction;
    direction.resize(layout_);
    if (k < N.cols())
      direction.q = N.col(k);
    else
      direction.s[integrals_[to_index(k - N.cols())]] = 1.0;
    directional_derivative(*system_.system, derivatives_, direction, &change);
    VectorX<double> rates = -change.head(layout_.columns());
    motion_.lu().solve(rates);
    slopes.col(k).head(layout_.n) = rates.head(layout_.n);
    for (Eigen::Index error = 0; error < own; ++error)
      slopes(layout_.n + error, k) = rates[layout_.state_column(integrals_[to_index(error)])];
  }
  return slopes;
}

}  // namespace codesign
