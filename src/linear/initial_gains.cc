// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/initial_gains.h"

#include <algorithm>
#include <cmath>

#include "assembly/make_system.h"
#include "control/reference.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "linear/linear_model.h"
#include "linear/resting_mechanism.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "math/state_feedback.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// What the search for gains of one controller reads.
struct Plant {
  const Study& study;
  const InitialGains& of;
  const ControllerDescription& controller;

  [[noreturn]] void fail(const std::string& message, const std::string& allowed) const {
    throw InputError({of.where, "controllers." + controller.name + ".gains", message, "", allowed});
  }
};

/// The joint whose position a signal is; empty if it is something else.
std::string joint_of(const SignalDescription& signal) {
  const SignalTerm* const term = signal.only_term();
  return term && term->quantity == "position" && term->component.empty() ? term->object : "";
}

/// The study with gains of zero, at rest in the posture of the references.
Study plant_study(const Plant& plant, const std::vector<double>& parameters) {
  Study study = plant.study;
  for (const int parameter : plant.of.parameters) study.parameters[to_index(parameter)].value = 0.0;
  ControllerDescription& controller = study.controllers[plant.of.controller];
  controller.realization = {};
  for (const FeedbackTerm& term : controller.feedback) {
    const std::string joint = joint_of(term.signal);
    if (joint.empty()) continue;
    const auto named = [&joint](const InitialJointState& state) { return state.joint == joint; };
    auto found = std::find_if(study.initial_state.begin(), study.initial_state.end(), named);
    if (found == study.initial_state.end()) {
      study.initial_state.emplace_back().joint = joint;
      found = study.initial_state.end() - 1;
      found->where = controller.where;
    }
    found->position = Quantity(Reference<double>(term.reference, parameters).at(0.0).value);
    found->guess.reset();
  }
  study.integral.clear();
  study.terminal.clear();
  study.watched.clear();
  study.until.reset();
  study.constraints.clear();
  study.initial_gains.clear();
  return study;
}

void require_rest(const Plant& plant, const RestingMechanism& mechanism) {
  constexpr double kStillEnough = 1e-6;  // [per s^2]
  const Eigen::VectorXd a = mechanism.acceleration();
  const double largest = a.size() == 0 ? 0.0 : a.cwiseAbs().maxCoeff();
  if (largest > kStillEnough)
    plant.fail(
        "the posture of the references is none at rest: without feedback a coordinate "
        "accelerates by " +
            readable(largest, 4) + " per s^2",
        "references at an equilibrium, or a feedforward that holds the posture");
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// x' = A x + b u, signals = C x.
struct StateEquations {
  Eigen::MatrixXd A, C;
  Eigen::VectorXd b;
};

StateEquations equations_of(const Plant& plant, const StateSpace& system) {
  const auto input =
      std::find(system.inputs.begin(), system.inputs.end(), plant.controller.name + "/disturbance");
  const auto column = static_cast<Eigen::Index>(input - system.inputs.begin());
  if (system.period > 0.0)
    plant.fail(
        "another controller is sampled, and gains by lqr and by poles are those of a "
        "continuous loop",
        "numbers for the gains");
  if (system.C.rows() != system.A.rows())
    plant.fail("the feedback has " + std::to_string(system.C.rows()) + " signals, and the motion " +
                   std::to_string(system.A.rows()) + " states: " + list_of(system.states),
               "one signal per state");
  const Eigen::VectorXd rows = system.C.cwiseAbs().rowwise().maxCoeff();
  if (pivot_columns(system.C, 1e-10).rank < system.C.rows() || !system.D.col(column).isZero(0.0))
    plant.fail("the signals of the feedback do not determine the states " + list_of(system.states),
               "independent signals, none of which reads accelerations or forces");
  return {system.A, system.C, system.B.col(column)};
}

std::optional<Eigen::RowVectorXd> gains_of(const Plant& plant, const StateEquations& of) {
  const InitialGains& asked = plant.of;
  const Eigen::Index n = of.A.rows();
  if (asked.weights.empty()) {
    std::vector<std::complex<double>> poles;
    for (std::size_t k = 0; k < asked.real.size(); ++k)
      poles.emplace_back(asked.real[k], asked.imaginary[k]);
    if (to_signed(poles.size()) != n)
      plant.fail(
          "found " + std::to_string(poles.size()) + " poles for " + std::to_string(n) + " states",
          "one per state, a pair as two");
    return gains_of_poles(of.A, of.b, poles);
  }
  const Eigen::Map<const Eigen::VectorXd> weights(asked.weights.data(), n);
  const Eigen::MatrixXd weighted = weights.asDiagonal() * of.C;
  return lqr_gains(of.A, of.b, transposed_product(of.C, weighted), asked.effort);
}

}  // namespace

std::vector<double> find_initial_gains(const RobotDescription& robot, const Study& study,
                                       const InitialGains& of) {
  const Plant plant{study, of, study.controllers[of.controller]};
  const Study plain = plant_study(plant, start_parameters(study));
  const std::vector<double> parameters = start_parameters(plain);
  Warnings warnings;
  const std::shared_ptr<const CompiledSystem> system = make_system(robot, plain, &warnings);
  RestingMechanism mechanism(*system, parameters);
  if (const Status status = mechanism.begin(); !status.ok())
    plant.fail("the posture of the references: " + describe(status), "a posture that exists");
  require_rest(plant, mechanism);
  LinearQuestion question;
  for (const FeedbackTerm& term : plant.controller.feedback)
    question.outputs.push_back(term.signal);
  const LinearModel model = linear_model({system.get(), parameters, question, true, {}},
                                         mechanism.state(), mechanism.theta());
  if (!model.status.ok())
    plant.fail("the posture of the references: " + describe(model.status), "a regular posture");
  const StateEquations equations = equations_of(plant, model.system);
  const std::optional<Eigen::RowVectorXd> by_states = gains_of(plant, equations);
  if (!by_states)
    plant.fail(
        "no gains give this: the output does not reach all states, or the weights do not see "
        "a motion that is not stable by itself",
        "weights above zero for all positions, and a joint that moves all others");
  const Eigen::MatrixXd gains = least_norm(equations.C.transpose()).solve(by_states->transpose());
  std::vector<double> result;
  for (Eigen::Index k = 0; k < gains.rows(); ++k) result.push_back(gains(k, 0));
  return result;
}

}  // namespace codesign
