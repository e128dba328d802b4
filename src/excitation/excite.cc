// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "assembly/assembly.h"
#include "description/study.h"
#include "engine/thread_engine.h"
#include "excitation/base_precision.h"
#include "excitation/given_trajectory.h"
#include "identification/judgement.h"
#include "math/arrays.h"
#include "math/cpu_timer.h"
#include "math/dense.h"
#include "problem/load_problem.h"
#include "recordings/measured_motion.h"
#include "sampling/sampler.h"
#include "statistics/parameter_covariance.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Number of mixed trajectories that decide which numbers trajectories determine.
constexpr int kTold = 8;
// Number of mixed trajectories drawn for each start, since some may not be followed.
constexpr int kDrawsPerStart = 4;
constexpr double kInsideLimits = 0.99;  // a search begins within this share of the limits

/// Positions of the excited joints at the study's start.
Eigen::VectorXd start_positions(const Problem& problem, const std::vector<MeasuredJoint>& joints) {
  StartWorkspace start(*system_of(problem), problem.parameters());
  if (Status status = start.solve_positions(); !status.ok())
    throw InputError({{study_of(problem).file, 0},
                      "initial_state",
                      status.cause,
                      "",
                      "a start that can be assembled"});
  Eigen::VectorXd positions(to_signed(joints.size()));
  for (std::size_t k = 0; k < joints.size(); ++k)
    for (std::size_t joint = 0; joint < robot_of(problem).joints.size(); ++joint)
      if (robot_of(problem).joints[joint].name == joints[k].name)
        positions[to_signed(k)] = start.assembly.theta()[start.assembly.tree().offset[joint]];
  return positions;
}

std::vector<std::string> names_of(const std::vector<MeasuredJoint>& joints) {
  std::vector<std::string> names;
  names.reserve(joints.size());
  for (const MeasuredJoint& joint : joints) names.push_back(joint.name);
  return names;
}

/// One call of excite().
class Excitation {
 public:
  Excitation(const Problem& problem, const ExcitationObserver& observer,
             const std::atomic<bool>* cancel, const JointRecording* compared)
      : problem_(problem),
        description_(*study_of(problem).excitation),
        observer_(observer),
        cancel_(cancel),
        limits_(motion_limits(problem)),
        variables_(study_of(problem), &robot_of(problem)),
        information_(variables_, names_of(limits_.joints), limits_.noise),
        start_(start_positions(problem, limits_.joints)),
        space_(description_, limits_, start_),
        motion_(*system_of(problem), limits_.joints, limits_.followers, problem.parameters(),
                worker_threads(study_of(problem).ensemble.engine)),
        scan_(space_, limits_, &motion_),
        probe_(space_, limits_, information_, {}, &motion_) {
    if (compared)
      given_ = given_motion(*compared, study_of(problem).identification->filter, limits_.joints,
                            &result_.warnings);
  }

  ExcitationResult run();

 private:
  bool find_plain();
  bool move_within(Eigen::VectorXd* x);
  Status find_told();
  void search(const Eigen::VectorXd& start);
  void search_all();
  void take(Eigen::VectorXd x, const std::string& termination);
  Status record(const Eigen::VectorXd& x, TrajectoryPoints* points, Eigen::MatrixXd* J);
  void predict_before();
  void set_numbers(const ParameterCovariance& known, double PredictedNumber::*deviation,
                   double PredictedNumber::*half);
  void compare();
  void conclude();
  Eigen::VectorXd mixed(int k) const { return space_.mixed(numbers_.row(k).transpose()); }

  const Problem& problem_;
  const ExcitationDescription& description_;
  const ExcitationObserver& observer_;
  const std::atomic<bool>* cancel_;
  const MotionLimits limits_;
  const FitVariables variables_;
  const Information information_;
  const Eigen::VectorXd start_;
  const TrajectorySpace space_;
  ExcitedMotion motion_;
  LimitScan scan_;
  ExcitationProgram probe_;  ///< only for limits
  Eigen::MatrixXd numbers_;
  Eigen::VectorXd plain_, best_;
  LimitScan::Extremes plain_extremes_, extremes_;
  std::vector<int> told_;
  BasePrecision base_;
  std::optional<MeasuredMotion> given_;
  std::vector<bool> is_determined_;
  bool is_rest_decided_ = false;  // by the prior
  bool interrupted_ = false;
  ExcitationResult result_;
};

// Finds a plain trajectory around the middle of the joints' ranges or, if the mechanism cannot be
// assembled or held there, around the study's start.
bool Excitation::find_plain() {
  for (const bool at_start : {false, true}) {
    plain_ = at_start ? space_.plain_around(start_) : space_.plain();
    result_.status = motion_.begin(space_.rest(plain_));
    if (result_.status.is_interrupted()) return false;
    if (result_.status.ok() && scan_.fit(&plain_, &plain_extremes_)) return true;
    if (is_set(cancel_)) {
      result_.status = {StatusCode::kCancelled, 0.0, "cancelled"};
      return false;
    }
  }
  if (!result_.status.ok()) return false;
  result_.status = plain_extremes_.status;
  if (!result_.status.ok()) return false;
  result_.status = {StatusCode::kInfeasible, 0.0,
                    "not even at rest are all limits kept; the worst is at " +
                        readable(100.0 * plain_extremes_.worst) + " % of its limit"};
  return false;
}

/// Reduces the excursions until the samples of the search are within the limits.
bool Excitation::move_within(Eigen::VectorXd* x) {
  constexpr int kMostSteps = 60;
  for (int k = 0; k < kMostSteps && !is_set(cancel_); ++k) {
    const double worst = probe_.worst_of(*x);
    if (worst <= kInsideLimits) return true;
    *x = space_.shrunk(
        *x, std::isfinite(worst) ? std::max(0.5, 1.0 - 1.2 * (worst - 0.98 * kInsideLimits)) : 0.7);
  }
  return false;
}

/// Finds the numbers that some trajectory determines, by the rank of the stacked Jacobians of
/// several trajectories.
Status Excitation::find_told() {
  const double rate = description_.sample_rate;
  const std::vector<double> times = times_in_period(
      description_.period,
      std::min<Eigen::Index>(400, static_cast<Eigen::Index>(description_.period * rate)));
  const SampledShapes shapes(space_.basis(), times);
  Eigen::MatrixXd stacked(0, variables_.size());
  for (int k = -1; k < kTold; ++k) {
    Eigen::VectorXd x = k < 0 ? plain_ : mixed(k);
    if (is_set(cancel_)) return {StatusCode::kCancelled, 0.0, "cancelled"};
    if (!move_within(&x)) continue;
    PathResponse response;
    if (!motion_.respond(space_.path(x, shapes), true, &response).ok()) continue;
    const Eigen::MatrixXd J = information_.jacobian(response, times[1]);
    Eigen::MatrixXd both(stacked.rows() + J.rows(), J.cols());
    both << stacked, J;
    stacked = upper_factor(both);
  }
  const Identifiability found = find_identifiable(stacked);
  base_ = BasePrecision(variables_, stacked);
  for (int column = 0; column < static_cast<int>(variables_.size()); ++column)
    if (std::find(found.dependent.begin(), found.dependent.end(), column) == found.dependent.end())
      told_.push_back(column);
  is_determined_ = found.is_determined;
  result_.undetermined = describe_undetermined(found, variables_.names());
  std::vector<int> all(to_index(variables_.size()));
  std::iota(all.begin(), all.end(), 0);
  is_rest_decided_ = decides(variables_.prior(), variables_.start(), all, found);
  result_.counted = static_cast<int>(told_.size());
  return {};
}

/// The way-points of a trajectory, and the Jacobian of the residuals of its recording; theory (46).
Status Excitation::record(const Eigen::VectorXd& x, TrajectoryPoints* points, Eigen::MatrixXd* J) {
  const double step = 1.0 / description_.sample_rate,
               duration = description_.period * description_.periods;
  points->joints = names_of(limits_.joints);
  points->times.clear();
  for (Eigen::Index k = 0; static_cast<double>(k) * step < duration * (1.0 + 1e-9); ++k)
    points->times.push_back(static_cast<double>(k) * step);
  DrivePath path = space_.path(x, SampledShapes(space_.basis(), points->times));
  PathResponse response;
  if (Status status = motion_.respond(path, true, &response); !status.ok()) return status;
  *J = information_.jacobian(response, step);
  points->position = std::move(path.position);
  points->velocity = std::move(path.velocity);
  points->acceleration = std::move(path.acceleration);
  points->effort = std::move(response.effort);
  return {};
}

void Excitation::set_numbers(const ParameterCovariance& known, double PredictedNumber::*deviation,
                             double PredictedNumber::*half) {
  for (std::size_t k = 0; k < result_.numbers.size(); ++k) {
    const auto i = to_signed(k);
    result_.numbers[k].*deviation = std::sqrt(known.covariance(i, i));
    result_.numbers[k].*half = known.above[i];
  }
}

void Excitation::predict_before() {
  Eigen::MatrixXd J;
  result_.status = record(plain_, &result_.before, &J);
  if (!result_.status.ok()) return;
  for (Eigen::Index k = 0; k < variables_.size(); ++k) {
    const auto i = to_index(k);
    PredictedNumber number;
    number.name = variables_.names()[i];
    number.unit = variables_.units()[i];
    number.nominal = variables_.start()[k];
    number.is_determined = is_determined_[i];
    result_.numbers.push_back(std::move(number));
  }
  const double level = study_of(problem_).identification->intervals.level;
  set_numbers(predicted_covariance(J, J.rows(), level), &PredictedNumber::deviation_before,
              &PredictedNumber::half_before);
  result_.criterion_before = information_criterion(J, told_, nullptr);
  const BasePrecision::Merit merit = base_.of(J);
  result_.condition_before = merit.condition;
  for (std::size_t k = 0; base_.has_combinations() && k < base_.names().size(); ++k)
    result_.base.push_back({base_.names()[k], merit.deviations[to_signed(k)], 0.0});
  best_ = plain_;
  extremes_ = plain_extremes_;
  result_.criterion = result_.criterion_before;
}

/// Changes the trajectory of a search until it is within all limits between the samples, too, and
/// keeps it if it is the best so far.
void Excitation::take(Eigen::VectorXd x, const std::string& termination) {
  // After a cancel, too, the result is completed, since little work is left.
  motion_.obey(nullptr);
  LimitScan::Extremes extremes;
  TrajectoryPoints points;
  Eigen::MatrixXd J;
  if (scan_.fit(&x, &extremes) && record(x, &points, &J).ok()) {
    const double criterion = information_criterion(J, told_, nullptr);
    if (criterion < result_.criterion) {
      result_.criterion = criterion;
      result_.termination = termination;
      best_ = std::move(x);
      extremes_ = std::move(extremes);
    }
  }
  motion_.obey(cancel_);
}

void Excitation::search(const Eigen::VectorXd& start) {
  ExcitationProgram program(space_, limits_, information_, told_, &motion_);
  const auto watching = [this](const ExcitationTrial& trial) {
    interrupted_ = interrupted_ || (observer_ && !observer_(trial)) || is_set(cancel_);
    return !interrupted_;
  };
  const TrajectorySearchResult found = search_trajectory(
      description_, start, static_cast<int>(result_.starts.size()) + 1, watching, &program);
  result_.starts.push_back(
      {found.initial_criterion, found.criterion, found.evaluations, found.termination});
  result_.evaluations += found.evaluations;
  if (std::isfinite(found.criterion)) take(found.x, found.termination);
}

void Excitation::search_all() {
  int next = 0;
  for (int start = 0; start < description_.starts && !interrupted_ && !is_set(cancel_); ++start) {
    Eigen::VectorXd x = plain_;
    bool usable = start == 0 && move_within(&x);
    while (!usable && next < numbers_.rows() && !is_set(cancel_)) {
      x = mixed(next++);
      usable = move_within(&x);
    }
    if (usable) search(x);
  }
}

/// Judges the given trajectory as it is.
void Excitation::compare() {
  const DrivePath path = path_of(*given_, limits_.joints);
  ComparedTrajectory compared;
  compared.samples = path.samples();
  compared.rate = given_->times.rate();
  PathResponse response;
  compared.status = motion_.begin(path.position.col(0));
  if (compared.status.ok()) compared.status = motion_.respond(path, true, &response);
  if (compared.status.ok()) {
    const Eigen::MatrixXd J = information_.jacobian(response, given_->times.step);
    const ParameterCovariance known =
        predicted_covariance(J, J.rows(), study_of(problem_).identification->intervals.level);
    const BasePrecision::Merit merit = base_.of(J);
    compared.criterion = information_criterion(J, told_, nullptr);
    compared.condition = merit.condition;
    compared.deviations = known.covariance.diagonal().cwiseSqrt();
    compared.halves = known.above;
    compared.base = merit.deviations;
    compared.limits = reached_limits(limits_, path, response);
  }
  result_.compared = std::move(compared);
}

void Excitation::conclude() {
  motion_.obey(nullptr);
  Eigen::MatrixXd J;
  result_.status = record(best_, &result_.points, &J);
  if (!result_.status.ok()) return;
  const double level = study_of(problem_).identification->intervals.level;
  set_numbers(predicted_covariance(J, J.rows(), level), &PredictedNumber::deviation,
              &PredictedNumber::half);
  const BasePrecision::Merit merit = base_.of(J);
  result_.condition = merit.condition;
  for (std::size_t k = 0; k < result_.base.size(); ++k)
    result_.base[k].deviation = merit.deviations[to_signed(k)];
  if (given_) compare();
  result_.rest = space_.rest(best_);
  result_.coefficients = space_.coefficients(best_);
  for (std::size_t s = 0; s < limits_.signals.size(); ++s)
    result_.limits.push_back({limits_.signals[s], extremes_.signals[s]});
  if (is_set(cancel_) || interrupted_) {
    result_.status = {StatusCode::kCancelled, 0.0, "cancelled"};
    result_.termination = "cancelled";
  } else if (!result_.undetermined.empty() && !is_rest_decided_) {
    result_.status = not_identifiable("no trajectory determines all numbers", result_.undetermined);
  } else if (!std::isfinite(result_.criterion)) {
    result_.status = {StatusCode::kNotIdentifiable, 0.0,
                      "no single trajectory was found that determines all numbers"};
  }
}

ExcitationResult Excitation::run() {
  const CpuTimer timer(CpuTimer::Of::kProcess);
  motion_.obey(cancel_);
  result_.termination = "start_failed";
  numbers_ = unit_points(SamplerKind::kSobol, std::max(kTold, kDrawsPerStart * description_.starts),
                         static_cast<int>(space_.size()), description_.seed);
  if (find_plain()) {
    result_.status = find_told();
    if (result_.status.ok()) predict_before();
    if (result_.status.ok()) {
      result_.termination = "no_search_succeeded";
      search_all();
      conclude();
    }
  }
  if (result_.status.code == StatusCode::kCancelled) result_.termination = "cancelled";
  result_.cpu_seconds = timer.seconds();
  return std::move(result_);
}

}  // namespace

double ExcitationResult::volume_factor() const {
  return std::exp(0.5 * (criterion_before - criterion));
}

ExcitationResult excite(const Problem& problem, const ExcitationObserver& observer,
                        const std::atomic<bool>* cancel, const JointRecording* compared) {
  return Excitation(problem, observer, cancel, compared).run();
}

}  // namespace codesign
