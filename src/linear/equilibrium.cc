// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "control/signal.h"
#include "description/signal_table.h"
#include "linear/integral_rest.h"
#include "linear/linear_coordinates.h"
#include "linear/resting_mechanism.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "observation/observer.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostSteps = 1000;
constexpr int kMostTries = 40;        // of shorter steps
constexpr double kLongestStep = 0.2;  // of any coordinate [rad or m]
constexpr double kSmallStep = 1e-10;  // relative to the coordinates; the next one would be rounding
constexpr double kLongest = 1e3;      // time that a step stands for, in durations of the study
constexpr double kGrowthInAStep = 0.5;  // of a motion that leads away

/// The free motions about a posture, in the coordinates y of a basis N.
struct FreeMotions {
  Eigen::MatrixXd N, A;  ///< y'' = A y
  GeneralEigen eigen;

  double largest_square() const {
    double largest = 0.0;
    for (Eigen::Index k = 0; k < eigen.values.size(); ++k)
      largest = std::max(largest, eigen.values[k].real());
    return largest;
  }
};

Status find_free_motions(RestingMechanism* mechanism, FreeMotions* free) {
  if (Status status = mechanism->linearize(&free->N); !status.ok()) return status;
  free->A = transposed_product(free->N, mechanism->slopes(free->N, false));
  free->eigen = general_eigen(free->A);
  return {};
}

/// The step of coordinates in the square of a time, c: (I/c - A) dy = N^T a. For a small c it goes
/// along the acceleration, for a large one to the equilibrium of the linear equations.
Eigen::VectorXd step_in(double c, const FreeMotions& free, const Eigen::VectorXd& a) {
  Eigen::MatrixXd matrix = -free.A;
  matrix.diagonal().array() += 1.0 / c;
  return free.N * least_norm(matrix).solve(transposed_product(free.N, a)).col(0);
}

/// The largest entry of a vector and the coordinate that it belongs to.
std::string largest_of(const Eigen::VectorXd& values, const std::string& unit,
                       const RestingMechanism& mechanism) {
  int place = 0;
  const double largest = values.cwiseAbs().maxCoeff(&place);
  return readable(largest, 3) + unit + ", of " +
         linear_state_names(mechanism.system(), {place}).front();
}

Status not_found(RestingMechanism* mechanism, const std::string& why) {
  const std::string acceleration = largest_of(mechanism->acceleration(), " per s^2", *mechanism);
  Eigen::MatrixXd N;
  if (!mechanism->linearize(&N).ok() || N.cols() == 0)
    return {StatusCode::kNoEquilibrium, 0.0,
            "no posture at rest was found near the start: " + why +
                "; there the largest acceleration of a coordinate is " + acceleration};
  return {StatusCode::kNoEquilibrium, 0.0,
          "no posture at rest was found near the start: " + why +
              "; there the largest acceleration of a coordinate is " + acceleration +
              ", and the largest effort that nothing balances " +
              largest_of(mechanism->unbalanced_efforts(N), " N or N m", *mechanism)};
}

/// Whether an acceleration is no more than rounding leaves. @param stiffest largest entry of A.
bool is_still(const Eigen::VectorXd& a, double stiffest) {
  constexpr double kSlow = 1e-10, kRounding = 1e-14;  // [per s^2], relative
  return a.cwiseAbs().maxCoeff() <= kSlow + kRounding * stiffest;
}

/// Creeps to the equilibrium. @param longest the square of the longest time that a step stands for.
Status creep(double longest, const std::atomic<bool>* cancel, RestingMechanism* mechanism,
             FreeMotions* free, int* steps) {
  Eigen::VectorXd last;
  double allowed = kLongestStep;
  for (*steps = 0; *steps < kMostSteps; ++*steps) {
    if (is_set(cancel)) return {StatusCode::kCancelled, 0.0, "cancelled"};
    if (Status status = find_free_motions(mechanism, free); !status.ok()) return status;
    if (free->N.cols() == 0) return {};
    const Eigen::VectorXd a = mechanism->acceleration();
    if (is_still(a, free->A.cwiseAbs().maxCoeff())) return {};
    const double away = free->largest_square();
    double c = away * longest > kGrowthInAStep ? kGrowthInAStep / away : longest;
    const double smallest = kSmallStep * (1.0 + mechanism->q().cwiseAbs().maxCoeff());
    Status status{StatusCode::kNoEquilibrium, 0.0, "the acceleration is not finite"};
    Eigen::VectorXd step;
    int tries = 0;
    for (; tries < kMostTries && !status.ok(); ++tries, c *= 0.25) {
      step = step_in(c, *free, a);
      if (step.cwiseAbs().maxCoeff() <= allowed) status = mechanism->go_to(mechanism->q() + step);
    }
    if (!status.ok()) return not_found(mechanism, "the way ends, " + status.cause);
    if (tries == 1 && step.cwiseAbs().maxCoeff() <= smallest)
      return find_free_motions(mechanism, free);
    // A step that goes back, as across the edge of a stop, must not be followed by the same again.
    if (last.size() == step.size() && last.dot(step) < 0.0) allowed *= 0.5;
    last = step;
  }
  return not_found(mechanism, "the motion goes on after " + std::to_string(kMostSteps) + " steps");
}

/// Names the controllers that read what their own outputs determine, where that leaves no solution.
Status with_readers(Status status, const CompiledSystem& system) {
  if (status.code != StatusCode::kSingularMatrix) return status;
  const auto reads_forces = [](const Signal& signal) {
    return std::any_of(signal.begin(), signal.end(), [](const SignalReference& term) {
      const SignalNeeds needs = facts_of(term.kind).needs;
      return needs == SignalNeeds::kForces || needs == SignalNeeds::kReactions;
    });
  };
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const Controller& controller = system.controllers()[c];
    if (reads_forces(controller.input) ||
        std::any_of(controller.feedback.begin(), controller.feedback.end(), reads_forces))
      status.cause += "; the controller \"" + system.study().controllers[c].name +
                      "\" reads accelerations or forces that its output determines, an algebraic "
                      "loop";
  }
  return status;
}

/// A sampled observer whose model does not rest moves between its samples.
Status check_estimates(const RestingMechanism& mechanism, const MotionStudy& study) {
  constexpr double kStill = 1e-8;  // [q/s]
  const std::vector<double> estimates = mechanism.estimates_of_controllers();
  std::size_t place = 0;
  for (const ControllerDescription& controller : study.controllers) {
    if (controller.kind->input != ControlInput::kObserved) continue;
    const double speed = estimates[place + 1];
    place += to_index(controller.observer.order());
    if (controller.realization.is_sampled() && std::abs(speed) > kStill)
      return {StatusCode::kNoEquilibrium, 0.0,
              "the estimates of the sampled observer \"" + controller.name +
                  "\" move between samples at rest: its model does not know the effort that holds "
                  "the joint; give it disturbance: true"};
  }
  return {};
}

}  // namespace

Equilibrium find_equilibrium(const CompiledSystem& system, const std::vector<double>& parameters,
                             const std::vector<SignalDescription>& signals,
                             const std::atomic<bool>* cancel, const LinearQuestion& question) {
  if (system.study().postures > 0)
    throw InputError({{system.study().file, 1},
                      "positions",
                      "an equilibrium is sought from one start, and positions are many postures",
                      "",
                      "a study with duration and initial_state"});
  RestingMechanism mechanism(system, parameters);
  Observer observer(mechanism.system(), signals);
  Equilibrium found;
  found.names = observer.names();
  found.status = mechanism.begin();
  if (!found.status.ok()) {
    found.status = with_readers(found.status, system);
    return found;
  }
  const double longest = kLongest * system.study().duration;
  FreeMotions free;
  // Efforts that follow estimates do not lead to a rest before these have settled.
  if (!mechanism.has_estimates())
    found.status = creep(longest * longest, cancel, &mechanism, &free, &found.steps);
  // Without its integrals the mechanism may have no posture at rest.
  if (mechanism.integrals().size() > 0 && found.status.code != StatusCode::kCancelled)
    found.status =
        rest_without_error(&mechanism, parameters, system.whole_study(), cancel, &found.steps);
  mechanism.observe(&observer, &found.frame);
  if (found.status.ok()) found.status = check_estimates(mechanism, system.study());
  if (!found.status.ok()) return found;
  found.state = mechanism.state();
  found.integrals = mechanism.integral_of_controllers();
  for (const std::vector<double>& more :
       {mechanism.estimates_of_controllers(), mechanism.currents()})
    found.integrals.insert(found.integrals.end(), more.begin(), more.end());
  found.linear = linear_model({&system, parameters, question, true, found.integrals},
                              mechanism.state(), mechanism.theta());
  found.status = found.linear.status;
  return found;
}

}  // namespace codesign
