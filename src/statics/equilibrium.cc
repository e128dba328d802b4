// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "control/reference.h"
#include "equations/compiled_system.h"
#include "identification/effort/driven_motion.h"
#include "linear/linear_coordinates.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "observation/observer.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostSteps = 1000;
constexpr int kMostTries = 40;        // of shorter steps
constexpr double kLongestStep = 0.2;  // of any coordinate [rad or m]
constexpr double kSmallStep = 1e-10;  // relative to the coordinates; the next one would be rounding
constexpr double kRankOfRows = 1e-8;  // as rounding leaves of rows that depend on each other
constexpr double kLongest = 1e3;      // time that a step stands for, in durations of the study
constexpr double kGrowthInAStep = 0.5;  // of a motion that leads away

/// The function at t = 0, for ever.
ReferenceDescription held(const ReferenceDescription& function,
                          const std::vector<double>& parameters) {
  return {Reference<double>(function, parameters).at(0.0).value};
}

void hold(const std::vector<double>& parameters, ControllerDescription* controller) {
  if (controller->i.at(parameters) != 0.0)
    throw InputError(
        {controller->where, "controllers." + controller->name + ".gains.i",
         "a controller with an integral rests where its error is zero, whatever output "
         "this needs",
         to_decimal(controller->i.at(parameters)),
         "0; the output comes from `codesign efforts` in the posture of its setpoint"});
  controller->setpoint = held(controller->setpoint, parameters);
  controller->feedforward = held(controller->feedforward, parameters);
  for (FeedbackTerm& term : controller->feedback) term.reference = held(term.reference, parameters);
  ControlRealization statically;
  statically.output_limit = controller->realization.output_limit;
  controller->realization = statically;
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

/// The mechanism at rest in one posture after the other.
class RestingMechanism {
 public:
  RestingMechanism(const CompiledSystem& system, const std::vector<double>& parameters)
      : system_{std::make_shared<const CompiledSystem>(
                    system.robot(), study_at_rest(system.whole_study(), parameters),
                    system.sharing()),
                {},
                {}},
        layout_(system_.system->layout()),
        parameters_(parameters),
        motion_(system_) {
    motion_.set_design(parameters);
    derivatives_.resize(system_.system->patterns());
  }

  const CompiledSystem& system() const { return *system_.system; }

  Status begin() {
    StartWorkspace start(*system_.system, parameters_);
    if (Status status = start.solve_positions(); !status.ok()) return status;
    theta_ = start.assembly.theta();
    state_.resize(layout_);
    state_.q = start.state.q;
    state_.turns = start.state.turns;
    return motion_.solve({}, &state_);
  }

  /// Goes to coordinates near the present ones; stays after a failure.
  Status go_to(const Eigen::VectorXd& q) {
    State<double> trial = state_;
    trial.q = q;
    Status status = motion_.solve({}, &trial);
    if (!status.ok()) return status;
    motion_.equations().track_turns(&trial);
    state_ = std::move(trial);
    return status;
  }

  const VectorX<double>& q() const { return state_.q; }
  Eigen::VectorXd acceleration() const { return state_.z.head(layout_.n); }

  /// An orthonormal basis N of the velocities that the constraints allow, and the derivatives of
  /// the acceleration along its columns.
  Status linearize(Eigen::MatrixXd* N, Eigen::MatrixXd* slopes) {
    if (Status status = motion_.linearize(state_); !status.ok()) return status;
    motion_.equations().linearize(state_, &derivatives_);
    *N = orthogonal_complement(constraint_rows(*system_.system, derivatives_).transpose(), kRankOfRows);
    slopes->resize(layout_.n, N->cols());
    State<double> direction;
    direction.resize(layout_);
    VectorX<double> change;
    for (Eigen::Index k = 0; k < N->cols(); ++k) {
      direction.q = N->col(k);
      directional_derivative(*system_.system, derivatives_, direction, &change);
      VectorX<double> rates = -change.head(layout_.columns());
      motion_.lu().solve(rates);
      slopes->col(k) = rates.head(layout_.n);
    }
    return {};
  }

  void observe(Observer* observer, Frame* frame) {
    observer->observe(state_, 0.0, theta_, &motion_.equations(), frame);
  }
  const State<double>& state() const { return state_; }
  const VectorX<double>& theta() const { return theta_; }

 private:
  const DrivenSystem system_;  ///< nothing is driven
  const Layout& layout_;
  const std::vector<double> parameters_;
  DrivenMotion motion_;
  Linearization<double> derivatives_;
  State<double> state_;
  VectorX<double> theta_;
};

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
  Eigen::MatrixXd slopes;
  if (Status status = mechanism->linearize(&free->N, &slopes); !status.ok()) return status;
  free->A = transposed_product(free->N, slopes);
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

Status not_found(const RestingMechanism& mechanism, const std::string& why) {
  return {StatusCode::kNoEquilibrium, 0.0,
          "no posture at rest was found near the start: " + why +
              "; there the largest acceleration "
              "of a coordinate is " +
              readable(mechanism.acceleration().cwiseAbs().maxCoeff(), 3) + " per s^2"};
}

/// Whether an acceleration is no more than rounding leaves. @param stiffest largest entry of A.
bool is_still(const Eigen::VectorXd& a, double stiffest) {
  constexpr double kStill = 1e-10, kRounding = 1e-14;  // [per s^2], relative
  return a.cwiseAbs().maxCoeff() <= kStill + kRounding * stiffest;
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
    if (!status.ok()) return not_found(*mechanism, "the way ends, " + status.cause);
    if (tries == 1 && step.cwiseAbs().maxCoeff() <= smallest)
      return find_free_motions(mechanism, free);
    // A step that goes back, as across the edge of a stop, must not be followed by the same again.
    if (last.size() == step.size() && last.dot(step) < 0.0) allowed *= 0.5;
    last = step;
  }
  return not_found(*mechanism, "the motion goes on after " + std::to_string(kMostSteps) + " steps");
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
  if (!found.status.ok()) return found;
  const double longest = kLongest * system.study().duration;
  FreeMotions free;
  found.status = creep(longest * longest, cancel, &mechanism, &free, &found.steps);
  mechanism.observe(&observer, &found.frame);
  if (!found.status.ok()) return found;
  found.linear = linear_model({&system.robot(), &system.whole_study(), system.sharing(), parameters,
                               question, true},
                              mechanism.state(), mechanism.theta());
  found.status = found.linear.status;
  return found;
}

}  // namespace codesign
