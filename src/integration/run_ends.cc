// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/run_ends.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>

#include "assembly/determined_motion.h"
#include "assembly/friction_jam.h"
#include "control/reference.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Speeds beyond this multiple of the typical one are suspicious.
constexpr double kBeyondReason = 10.0;
constexpr std::int64_t kWindow = 500;  // steps over which the pace is measured
// Expected steps, relative to maximum_steps, from which a suspicious run ends.
constexpr double kPatience = 0.1;
constexpr double kLeastPatience = 5000.0;  // [steps] lower limit of the same

constexpr int kInstants = 64;  // instants at which setpoints and references are sampled

constexpr SignalKind kVelocities[] = {SignalKind::kJointVelocity, SignalKind::kJointSlidingVelocity,
                                      SignalKind::kLinkVelocity, SignalKind::kLinkAngularVelocity};
constexpr SignalKind kPositions[] = {SignalKind::kJointPosition, SignalKind::kLinkPosition};

template <std::size_t N>
bool reads(const Signal& signal, const SignalKind (&kinds)[N]) {
  return std::any_of(signal.begin(), signal.end(), [&kinds](const SignalReference& term) {
    return std::find(std::begin(kinds), std::end(kinds), term.kind) != std::end(kinds);
  });
}

bool is_commanded(const ReferenceDescription& description) {
  return description.kind == ReferenceDescription::Kind::kLive &&
         description.live.function->commanded;
}

/// The largest speed that commands ask for at this time. With an effort that is commanded every
/// speed can be meant.
double commanded_speed(const CompiledSystem& system, double t) {
  double largest = 0.0;
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const ControllerDescription& controller = system.study().controllers[c];
    if (is_commanded(controller.feedforward) && controller.feedforward.live.function->c[0] != 0.0)
      return std::numeric_limits<double>::infinity();
    if (!is_commanded(controller.setpoint)) continue;
    const ReferenceMotion<double> asked =
        LiveReference<double>::commanded_at(*controller.setpoint.live.function, t);
    if (reads(system.controllers()[c].input, kVelocities))
      largest = std::max(largest, std::abs(asked.value));
    if (reads(system.controllers()[c].input, kPositions))
      largest = std::max(largest, std::abs(asked.rate));
  }
  return largest;
}

constexpr std::int64_t kPaceWindow = 100;  // the pace is checked once in this number of steps
constexpr double kNever = 20000.0;         // remaining steps from which a run counts as stalled
// Smallest singular value, relative to its value at the start, below which the position counts as
// singular: kStalled for a stalled run, where reactions are then fifty times as large as at the
// start; kNearby for a failed one, since friction can lock a mechanism before the position.
constexpr double kStalled = 0.02, kNearby = 0.1;
// A pair is named if its load in the self-stress exceeds this fraction of the largest.
constexpr double kTakesPart = 0.1;
// Larger numbers of coordinates are not analysed, since the decomposition is dense.
constexpr int kLargestAnalysed = 400;

bool may_be_singular(StatusCode code) {
  return code == StatusCode::kStepSizeTooSmall || code == StatusCode::kSingularMatrix ||
         code == StatusCode::kConstraintDrift || code == StatusCode::kEnergyError ||
         code == StatusCode::kTooManySteps;
}

/// Largest distance of a free body from the mean of all [m]; 1 if that is zero.
double size_of(const VectorX<double>& q, const Layout& layout) {
  std::vector<Eigen::Vector3d> places;
  for (int b = 0; b < layout.bodies; ++b)
    if (layout.is_free(b)) places.emplace_back(q.segment<3>(layout.column(b)));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) middle += place / static_cast<double>(places.size());
  double size = 0.0;
  for (const Eigen::Vector3d& place : places) size = std::max(size, (place - middle).norm());
  return size > 0.0 ? size : 1.0;
}

std::vector<int> enforced_rows(const CompiledSystem& system) {
  const std::vector<int>& dropped = system.dropped_rows();
  std::vector<int> rows;
  for (int row = 0; row < system.layout().constraints(); ++row)
    if (!std::binary_search(dropped.begin(), dropped.end(), row)) rows.push_back(row);
  return rows;
}

/// Phi_q without units: columns of r of free bodies multiplied by the mechanism's size, then all
/// rows normalized.
Eigen::MatrixXd scaled_jacobian(const CompiledSystem& system, const State<double>& state,
                                Equations<double>* equations) {
  Eigen::MatrixXd rows = constraint_jacobian(system, equations, state);
  const Layout& layout = system.layout();
  const double size = size_of(state.q, layout);
  for (int b = 0; b < layout.bodies; ++b)
    if (layout.is_free(b)) rows.middleCols(layout.column(b), 3) *= size;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) rows.row(r).normalize();
  return rows;
}

Eigen::MatrixXd enforced_part(const CompiledSystem& system, const Eigen::MatrixXd& all) {
  const std::vector<int> enforced = enforced_rows(system);
  Eigen::MatrixXd rows(to_signed(enforced.size()), all.cols());
  for (std::size_t k = 0; k < enforced.size(); ++k) rows.row(to_signed(k)) = all.row(enforced[k]);
  return rows;
}

/// The singular value number `rank` (from 1) in descending order.
double singular_value(const Eigen::MatrixXd& rows, Eigen::Index rank) {
  return singular_values(rows).values[rank - 1];
}

void add_name(const std::string& name, std::string* list) {
  *list += (list->empty() ? "'" : ", '") + name + "'";
}

/// Names of the joints and loops that a self-stress (one multiplier per enforced row) loads.
std::string loaded_pairs(const CompiledSystem& system, const Eigen::VectorXd& stress) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(system.layout().constraints());
  const std::vector<int> enforced = enforced_rows(system);
  for (std::size_t k = 0; k < enforced.size(); ++k)
    all[enforced[k]] = std::abs(stress[to_signed(k)]);
  const std::vector<Pair>& pairs = system.topology().pairs;
  std::vector<double> loads;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const int first = system.layout().pair_row[p],
              count = system.layout().pair_end(static_cast<int>(p)) - first;
    loads.push_back(count > 0 ? all.segment(first, count).maxCoeff() : 0.0);
  }
  const double least = kTakesPart * *std::max_element(loads.begin(), loads.end());
  std::string names;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (loads[p] > least) add_name(pairs[p].name, &names);
  return names;
}

std::string frictions_in_loops(const CompiledSystem& system) {
  std::string names;
  for (int p : system.sharing().pairs)
    if (const int joint = system.topology().pairs[to_index(p)].friction_joint;
        joint >= 0 && !system.topology().pairs[to_index(p)].friction_is_direct)
      add_name(system.robot().joints[to_index(joint)].name, &names);
  return names;
}

std::string cause(const CompiledSystem& system, const Eigen::MatrixXd& rows, bool all_lose_rank) {
  const SingularValues svd = singular_values(rows, SingularVectors::kLeft);
  const std::string names = loaded_pairs(system, svd.U.col(svd.values.size() - 1)),
                    frictions = frictions_in_loops(system);
  const std::string rank = std::to_string(rows.rows() - 1), usual = std::to_string(rows.rows());
  if (!all_lose_rank)
    return "the constraints that were independent at the start have rank " + rank + " instead of " +
           usual + " here, although all constraints together keep their rank: rows of " + names +
           " that were dropped as redundant would have to replace others; end the study before "
           "this position, or start it nearer to here";
  return "the mechanism approaches a singular position, where its independent constraints have "
         "rank " +
         rank + " instead of " + usual + ": reactions of " + names +
         " grow without bound on the way there" +
         (frictions.empty() ? ""
                            : ", and the friction of " + frictions +
                                  " with them, so that the motion beyond it is not determined") +
         "; end the study before this position, or start from another one";
}

bool finite(std::initializer_list<double> values) {
  for (double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

bool finite(const JointSample& s) {
  return finite({s.position, s.velocity, s.acceleration, s.effort});
}
bool finite(const FrictionSample& s) {
  return finite({s.friction, s.normal_force, s.sliding_velocity}) && s.position.allFinite() &&
         s.force.allFinite() && s.torque.allFinite();
}
bool finite(const ControllerSample& s) {
  return finite({s.setpoint, s.input, s.error, s.integral, s.output});
}
bool finite(const LinkSample& s) {
  return s.position.allFinite() && s.orientation.coeffs().allFinite();
}

template <class Sample>
std::string look(const char* what, const std::vector<std::string>& names,
                 const std::vector<Sample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (!finite(samples[k]))
      return std::string(what) + " \"" + (k < names.size() ? names[k] : std::to_string(k)) +
             "\" is not finite";
  return "";
}

}  // namespace

MotionWatch::Speeds MotionWatch::speeds(const State<double>& state) const {
  Speeds fastest;
  motion_.move(state.q, state.v);
  for (int b = 0; b < system_.layout().bodies; ++b) {
    const auto [linear, angular] = motion_.speed(b, state.v);
    if (linear > fastest.linear) {
      fastest.linear = linear;
      fastest.linear_body = b;
    }
    if (angular > fastest.angular) {
      fastest.angular = angular;
      fastest.angular_body = b;
    }
  }
  return fastest;
}

// The largest speed that given motions, setpoints and references ask for. Angles and lengths are
// not distinguished: it counts for both kinds of speed.
double MotionWatch::target(const Equations<double>& equations) const {
  const MotionStudy& study = system_.study();
  double largest = 0.0;
  const auto look = [&](const Signal& signal, const Reference<double>& reference) {
    if (signal.formula) return;
    const bool velocity = reads(signal, kVelocities), position = reads(signal, kPositions);
    for (int k = 0; (velocity || position) && k <= kInstants; ++k) {
      const ReferenceMotion<double> asked = reference.at(study.duration * k / kInstants);
      largest = std::max(largest, std::abs(velocity ? asked.value : asked.rate));
    }
  };
  const Design<double>& design = equations.formulas().view().design;
  for (const Reference<double>& motion : design.motion)
    for (int k = 0; k <= kInstants; ++k)
      largest = std::max(largest, std::abs(motion.at(study.duration * k / kInstants).rate));
  for (std::size_t c = 0; c < study.controllers.size(); ++c)
    look(system_.controllers()[c].input, design.controllers[c].setpoint);
  for (const ResolvedTerm& term : system_.integral())
    look(term.signal, design.integral.references[to_index(term.description)]);
  for (const ResolvedTerm& term : system_.terminal())
    look(term.signal, design.terminal.references[to_index(term.description)]);
  return largest;
}

void MotionWatch::start(const Equations<double>& equations, const State<double>& initial) {
  mark_time_ = initial.t;
  mark_work_ = 0;
  motion_.set_design(equations);
  linear_bound_ = angular_bound_ = system_.study().solver.maximum_speed;
  double size = 0.0;
  motion_.move(initial.q, initial.v);
  for (int b = 0; b < system_.layout().bodies; ++b)
    size = std::max(size, motion_.distance(b, initial.q));
  const double g = Eigen::Vector3d(system_.study().gravity.data()).norm(), aim = target(equations);
  const Speeds begun = speeds(initial);
  typical_linear_ = std::max({begun.linear, aim, std::sqrt(2.0 * g * size)});
  typical_angular_ = std::max({begun.angular, aim, size > 0.0 ? std::sqrt(2.0 * g / size) : 0.0});
  // A mechanism without controllers cannot gain energy but from loads, so it needs no automatic
  // limit.
  if (linear_bound_ > 0.0 || system_.study().controllers.empty()) return;
  linear_bound_ = kBeyondReason * typical_linear_;
  angular_bound_ = kBeyondReason * typical_angular_;
}

Status MotionWatch::judge_failure(const Status& status, const State<double>& state) const {
  constexpr double kRunaway = 1e4;
  const bool may_be = may_be_singular(status.code) || status.code == StatusCode::kNonFinite;
  if (status.ok() || !may_be || !system_.study().motion.empty()) return status;
  const double usual = 1.0 / std::max(system_.study().duration, 1e-3);
  const Speeds now = speeds(state);
  const bool turns = !(now.angular <= kRunaway * std::max(typical_angular_, usual)),
             moves = !(now.linear <= kRunaway * std::max(typical_linear_, usual));
  if (!turns && !moves) return status;
  const int body = turns ? now.angular_body : now.linear_body;
  return {StatusCode::kUnstableMotion, state.t,
          "the motion runs away: link '" + system_.topology().bodies[to_index(body)].name + "' " +
              (turns ? "turns at " + readable(now.angular, 3) + " rad/s"
                     : "moves at " + readable(now.linear, 3) + " m/s") +
              ", until the solver fails; check loads and controllers that grow with the motion, "
              "and their signs"};
}

double MotionWatch::expected_work(double time, std::int64_t work) const {
  const double rest = std::max(0.0, system_.study().duration - time),
               pace = static_cast<double>(work - mark_work_) / (time - mark_time_);
  return static_cast<double>(work) + rest * pace;
}

Status MotionWatch::exceeded(const State<double>& state, const std::string& advice) const {
  const Speeds now = speeds(state);
  const auto sentence = [&](int body, const char* verb, double speed, const char* unit,
                            double bound) {
    return "the motion runs away: link '" + system_.topology().bodies[to_index(body)].name + "' " +
           verb + " at " + std::to_string(std::llround(speed)) + " " + unit + ", beyond " +
           to_decimal(bound) + "; " + advice;
  };
  if (angular_bound_ > 0.0 && now.angular > angular_bound_)
    return {StatusCode::kUnstableMotion, state.t,
            sentence(now.angular_body, "turns", now.angular, "rad/s", angular_bound_)};
  if (linear_bound_ > 0.0 && now.linear > linear_bound_)
    return {StatusCode::kUnstableMotion, state.t,
            sentence(now.linear_body, "moves", now.linear, "m/s", linear_bound_)};
  return {};
}

Status MotionWatch::check(const State<double>& state, std::int64_t work) {
  const SolverOptions& options = system_.study().solver;
  if (options.maximum_speed > 0.0) return exceeded(state, "the limit is solver.maximum_speed");
  if (work - mark_work_ < kWindow) return {};
  const double expected = expected_work(state.t, work);
  mark_time_ = state.t;
  mark_work_ = work;
  if (expected <= std::max(kLeastPatience, kPatience * options.maximum_steps)) return {};
  const double commanded = kBeyondReason * commanded_speed(system_, state.t);
  linear_bound_ = std::max(linear_bound_, commanded);
  angular_bound_ = std::max(angular_bound_, commanded);
  return exceeded(state, "the study would take some " + std::to_string(std::llround(expected)) +
                             " steps. Check signs and bounds of the gains, or set "
                             "solver.maximum_speed if such speeds are intended");
}

Status judge_standstill(const Status& status, const CompiledSystem& system,
                        const State<double>& initial, const State<double>& state, double step_size,
                        const Statistics& statistics, Equations<double>* equations) {
  if (!system.sharing().drops() || system.layout().n > kLargestAnalysed) return status;
  const bool slow =
      statistics.steps % kPaceWindow == 0 && system.study().duration - state.t > kNever * step_size;
  if (!(status.ok() ? slow : may_be_singular(status.code)) || !state.q.allFinite()) return status;
  const Eigen::MatrixXd all = scaled_jacobian(system, state, equations),
                        before = scaled_jacobian(system, initial, equations);
  const Eigen::MatrixXd rows = enforced_part(system, all);
  const Eigen::Index rank = rows.rows();
  const double limit = status.ok() ? kStalled : kNearby;
  if (singular_value(rows, rank) > limit * singular_value(enforced_part(system, before), rank))
    return status;
  const bool all_lose_rank =
      singular_value(all, rank) <= 2.0 * limit * singular_value(before, rank);
  return {StatusCode::kSingularConfiguration, state.t, cause(system, rows, all_lose_rank)};
}

std::string singular_sentence(const CompiledSystem& system, const State<double>& state,
                              Equations<double>* equations) {
  const std::string jam = jam_advice(system, state, equations);
  return "the equations of motion become singular: a dead point or lock-up" +
         (jam.empty() ? "" : "; perhaps " + jam);
}

std::string find_not_finite(const FrameNames& names, const Frame& frame) {
  std::string fault = look("the motion of joint", names.joints, frame.joints);
  if (fault.empty()) fault = look("the friction of joint", names.frictions, frame.frictions);
  if (fault.empty()) fault = look("controller", names.controllers, frame.controllers);
  if (fault.empty()) fault = look("the pose of link", names.links, frame.links);
  for (std::size_t k = 0; fault.empty() && k < frame.signals.size(); ++k)
    if (!std::isfinite(frame.signals[k]))
      fault = "signal number " + std::to_string(k + 1) + " of the requested ones is not finite";
  return fault;
}

}  // namespace codesign
