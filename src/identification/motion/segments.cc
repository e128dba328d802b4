// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assembly/assembly.h"
#include "identification/fit/residual_fit.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "mechanism/motor_sides.h"
#include "optimization/levenberg_marquardt.h"
#include "recordings/measured_motion.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostRuns = 8, kFewRuns = 3;
// Of the value: a start with a smaller predicted decrease is the best one.
constexpr double kEnough = 1e-8;
// Factor of kEnough with each run, since predictions of less are noise of step sizes.
constexpr double kPatience = 10.0;
// Share of the sum of squares of the recorded values that a simulation does not resolve.
constexpr double kResolved = 1e-14;

/// Columns scaled to length one, so that the rank does not depend on units.
class StartColumns {
 public:
  explicit StartColumns(const Eigen::MatrixXd& columns)
      : lengths_(lengths_of(columns)), scaled_(columns * lengths_.cwiseInverse().asDiagonal()) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const {
    return lengths_.cwiseInverse().asDiagonal() * scaled_.solve(right);
  }
  /// Decrease of the sum of squares by the best start, to first order.
  double predicted_decrease(const Eigen::VectorXd& residuals) const {
    return scaled_.explained(residuals);
  }

 private:
  static Eigen::VectorXd lengths_of(const Eigen::MatrixXd& columns) {
    const Eigen::VectorXd lengths = columns.colwise().norm().transpose();
    return lengths.unaryExpr([](double length) { return length > 0.0 ? length : 1.0; });
  }

  Eigen::VectorXd lengths_;
  PivotedLeastSquares scaled_;
};

/// The cost of a segment as a function of its start. Keeps the best point and, if derivatives by x
/// are computed, its derivative by x.
class StartCost final : public LeastSquaresModel {
 public:
  StartCost(const SegmentProblem& problem, SegmentLanes lanes, SegmentRun* run,
            SegmentSolution* best)
      : problem_(problem), lanes_(lanes), run_(*run), best_(*best) {
    const Eigen::MatrixXd& recorded = problem.segment.recorded;
    for (Eigen::Index k = 0; k < recorded.cols(); ++k)
      resolved_ += kResolved * (recorded.col(k) / problem.spreads[k]).squaredNorm();
  }

  Outcome evaluate(const Eigen::VectorXd& start, LeastSquaresPoint* point) override {
    const Segment& segment = problem_.segment;
    const Status status = run_.run(problem_.of.parameters(problem_.variables, problem_.x, start),
                                   segment.begin, segment.times, lanes_);
    ++best_.runs;
    if (lanes_ == SegmentLanes::kAll) ++best_.whole_runs;
    if (!status.ok()) {
      if (!is_begun_) best_.status = status;
      return status.code == StatusCode::kCancelled ? stop(status) : Outcome::kFailed;
    }
    compare();
    const WeightedResiduals weighted = weigh(residuals_, &by_all_, problem_.spreads, problem_.loss);
    const Eigen::MatrixXd by_start = weighted.jacobian.rightCols(problem_.of.starts);
    point->value = weighted.value;
    point->gradient = 2.0 * (by_start.transpose() * weighted.residuals.reshaped());
    point->root = triangular_root(by_start);
    const StartColumns columns(by_start);
    const double predicted_decrease = columns.predicted_decrease(weighted.residuals.reshaped());
    if (!is_begun_ || weighted.value < best_.value)
      keep(start, weighted, columns, predicted_decrease > resolved_ ? predicted_decrease : 0.0);
    const double enough = kEnough * std::pow(kPatience, best_.runs - 1) * weighted.value;
    return predicted_decrease <= std::max(enough, resolved_) ? Outcome::kStop : Outcome::kUsable;
  }
  bool is_begun() const { return is_begun_; }

 private:
  Outcome stop(const Status& status) {
    best_.status = status;
    return Outcome::kStop;
  }

  /// Residuals of the last run and their derivatives: by x in the first columns, unless only the
  /// derivatives by the start are computed, then by the start.
  void compare() {
    const Eigen::Index rows = run_.values().rows(), lanes = run_.slopes().cols(),
                       sensors = lanes - problem_.of.starts;
    residuals_ = run_.values() - problem_.segment.recorded;
    by_all_.setZero(run_.slopes().rows(), problem_.x.size() + problem_.of.starts);
    for (Eigen::Index k = 0; lanes_ == SegmentLanes::kAll && k < sensors; ++k)
      by_all_.col(problem_.of.columns[to_index(k)]) = run_.slopes().col(k);
    by_all_.rightCols(problem_.of.starts) = run_.slopes().rightCols(problem_.of.starts);
    for (std::size_t k = 0; k < problem_.of.outputs.size(); ++k)
      if (problem_.efforts[k]) sense(k, to_signed(k) * rows);
  }

  /// The residuals of a recorded effort, (28c). @param first row of its derivatives
  void sense(std::size_t output, Eigen::Index first) {
    const std::string& joint = problem_.of.outputs[output].joint;
    const EffortSensor sensor = problem_.variables.sensor(joint, problem_.x);
    const FitVariables::SensorColumns at = problem_.variables.columns(joint);
    const auto column = to_signed(output);
    for (Eigen::Index k = 0; k < residuals_.rows(); ++k) {
      const double time = problem_.segment.times[to_index(k)];
      const EffortResidual residual =
          effort_residual(sensor, *problem_.efforts[output], time, run_.values()(k, column));
      residuals_(k, column) = residual.value;
      by_all_.row(first + k) *= residual.by_effort;
      if (at.scale >= 0) by_all_(first + k, at.scale) += residual.by_scale;
      if (at.delay >= 0) by_all_(first + k, at.delay) += residual.by_delay;
      if (at.offset >= 0) by_all_(first + k, at.offset) += residual.by_effort;
    }
  }

  void keep(const Eigen::VectorXd& start, const WeightedResiduals& weighted,
            const StartColumns& columns, double predicted_decrease) {
    is_begun_ = true;
    best_.status = {};
    best_.start = start;
    best_.value = weighted.value;
    best_.predicted_decrease = predicted_decrease;
    best_.residuals = residuals_;
    best_.correction = columns.solve(weighted.residuals.reshaped());
    if (lanes_ != SegmentLanes::kAll) return;
    best_.slope = columns.solve(weighted.jacobian.leftCols(problem_.x.size()));
    best_.jacobian = by_all_.leftCols(problem_.x.size()) -
                     product(by_all_.rightCols(problem_.of.starts), best_.slope);
  }

  const SegmentProblem& problem_;
  const SegmentLanes lanes_;
  SegmentRun& run_;
  SegmentSolution& best_;
  double resolved_ = 0.0;
  Eigen::MatrixXd residuals_, by_all_;
  bool is_begun_ = false;
};

using Samples = std::vector<std::size_t>;

constexpr double kSmallMove = 0.1;  // [rad or m] positions are followed in steps of this size
constexpr double kMostMoves = 1e4;

/// The samples that count, by segment. The last segment is up to a half longer or shorter than the
/// others.
std::vector<Samples> samples_by_segment(const JointRecording& recording,
                                        const IdentificationDescription& options) {
  const double begin = recording.times.front(), span = recording.times.back() - begin;
  const double last = std::max(1.0, std::round(span / options.segment)) - 1.0;
  // Only segments with samples are made: a short `segment` may divide the recording into any number
  // of them.
  std::vector<Samples> segments;
  double current = -1.0;
  for (std::size_t k = 0; k < recording.times.size(); k += to_index(options.filter.decimate)) {
    const double segment =
        std::min(std::floor((recording.times[k] - begin) / options.segment * (1.0 + 1e-12)), last);
    if (segment != current) segments.emplace_back();
    current = segment;
    segments.back().push_back(k);
  }
  return segments;
}

void require_enough(const JointRecording& recording, const std::vector<Samples>& segments,
                    const SegmentSystem& of, const IdentificationDescription& options) {
  const auto least = to_index(of.starts) / of.outputs.size() + 2;
  for (const Samples& samples : segments)
    if (samples.size() < least)
      throw InputError(
          {options.where, "identify.segment",
           "the segment at " + readable(recording.times[samples.front()], 6) + " s has " +
               std::to_string(samples.size()) +
               " samples that count, too few for its start and the parameters: " + recording.file,
           readable(options.segment),
           "longer segments, with at least " + std::to_string(least) + " samples each"});
}

/// The start that was measured at a time of the recording.
Eigen::VectorXd measured_start(const MeasuredMotion& motion, const RobotDescription& robot,
                               const std::vector<std::string>& independent, double time,
                               int starts) {
  const auto nearest = to_signed(std::llround((time - motion.times.start) / motion.times.step));
  const Eigen::Index at = std::clamp<Eigen::Index>(nearest, 0, motion.times.count - 1);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(starts);
  for (std::size_t k = 0; k < independent.size(); ++k)
    for (const JointMotion& joint : motion.joints)
      if (joint.joint == joint_of_motor(robot, independent[k])) {
        start[to_signed(k)] = joint.position[at];
        start[to_signed(independent.size() + k)] = joint.velocity[at];
      }
  return start;
}

Eigen::MatrixXd recorded_at(const JointRecording& recording, const SegmentSystem& of,
                            const FitVariables& variables, const Samples& samples) {
  Eigen::MatrixXd recorded(to_signed(samples.size()), to_signed(of.outputs.size()));
  for (std::size_t output = 0; output < of.outputs.size(); ++output) {
    const MotionOutput& at = of.outputs[output];
    const std::vector<double>& column = at.recorded(recording);
    const double scale =
        at.is_effort() ? variables.sensor(at.joint, variables.start()).start_scale : 1.0;
    for (std::size_t k = 0; k < samples.size(); ++k)
      recorded(to_signed(k), to_signed(output)) = scale * column[samples[k]];
  }
  return recorded;
}

/// Moves the independent joints of a mechanism from where they are, on one branch.
class Follower {
 public:
  Follower(const SegmentSystem& of, std::vector<double> parameters, VectorX<double> theta)
      : first_(parameters.size() - to_index(of.starts)),
        parameters_(std::move(parameters)),
        theta_(std::move(theta)),
        equations_(*of.system),
        assembly_(*of.system) {
    equations_.compiled().allow(false);
    equations_.set_design(parameters_);
  }

  /// @param time of the system [s], for motions that are given
  Status move_to(const Eigen::VectorXd& positions, double time) {
    const Eigen::VectorXd from = position_;
    const double begin = time_;
    const double way = from.size() > 0 ? (positions - from).cwiseAbs().maxCoeff() : 0.0;
    const int moves = static_cast<int>(std::clamp(std::ceil(way / kSmallMove), 1.0, kMostMoves));
    for (int move = 1; move <= moves; ++move) {
      position_ =
          from.size() > 0 ? Eigen::VectorXd(from + (positions - from) * move / moves) : positions;
      std::copy(position_.begin(), position_.end(), parameters_.begin() + to_signed(first_));
      time_ = begin + (time - begin) * move / moves;
      assembly_.begin_at(time_, theta_);
      if (Status status = assembly_.solve_positions(parameters_, &equations_, &state_);
          !status.ok())
        return status;
      theta_ = assembly_.theta();
    }
    return {};
  }
  void is_at(const Eigen::VectorXd& positions) { position_ = positions; }
  const VectorX<double>& theta() const { return theta_; }

 private:
  std::size_t first_;
  std::vector<double> parameters_;
  VectorX<double> theta_;
  double time_ = 0.0;
  Eigen::VectorXd position_;
  Equations<double> equations_;
  Assembly assembly_;
  State<double> state_;
};

Eigen::VectorXd positions_at(const JointRecording& recording, const RobotDescription& robot,
                             const std::vector<std::string>& independent, std::size_t sample) {
  Eigen::VectorXd positions(to_signed(independent.size()));
  for (std::size_t k = 0; k < independent.size(); ++k)
    positions[to_signed(k)] =
        recording.find(joint_of_motor(robot, independent[k]))->position[sample];
  return positions;
}

/// Positions of the independent joints in the tree coordinates.
Eigen::VectorXd positions_of(const StartWorkspace& start, const RobotDescription& robot,
                             const std::vector<std::string>& independent) {
  Eigen::VectorXd positions(to_signed(independent.size()));
  for (std::size_t k = 0; k < independent.size(); ++k)
    for (std::size_t joint = 0; joint < robot.joints.size(); ++joint)
      if (robot.joints[joint].name == independent[k])
        positions[to_signed(k)] = start.assembly.theta()[start.assembly.tree().offset[joint]];
  return positions;
}

}  // namespace

SegmentSolution fit_segment(const SegmentProblem& problem,
                            const std::vector<Eigen::VectorXd>& guesses, SegmentWork work,
                            SegmentRun* run) {
  LevenbergMarquardtOptions options;
  options.max_evaluations = work == SegmentWork::kBetterStart ? kFewRuns : kMostRuns;
  options.relative_tolerance = kEnough;
  options.largest_first_step = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd open =
      Eigen::VectorXd::Constant(problem.of.starts, std::numeric_limits<double>::infinity());
  SegmentSolution best;
  for (const Eigen::VectorXd& guess : guesses) {
    StartCost cost(problem,
                   work == SegmentWork::kElimination ? SegmentLanes::kAll : SegmentLanes::kStart,
                   run, &best);
    Eigen::VectorXd start = guess;
    LeastSquaresPoint point;
    // Where motions are given for all joints, no start is left to seek.
    if (work == SegmentWork::kElimination || problem.of.starts == 0)
      cost.evaluate(start, &point);
    else
      minimize_squares(options, -open, open, &cost, &start, &point);
    if (cost.is_begun() || best.status.code == StatusCode::kCancelled) break;
  }
  return best;
}

std::vector<Segment> cut_into_segments(const JointRecording& recording, const SegmentSystem& of,
                                       const FitVariables& variables,
                                       const std::vector<std::string>& independent,
                                       const IdentificationDescription& options,
                                       Warnings* warnings) {
  const std::vector<Samples> parts = samples_by_segment(recording, options);
  require_enough(recording, parts, of, options);
  FilterOptions filter = options.filter;
  filter.residual_cutoff = 0.0;  // residuals in motion are not filtered
  filter.decimate = 1;
  Warnings found;
  const MeasuredMotion motion = measured_motion(recording, filter, &found);
  for (const Warning& warning : found)
    if (warning.code != "recording_not_filtered" && warning.code != "recording_resampled")
      append({warning}, warnings);
  std::vector<Segment> segments;
  for (const Samples& samples : parts) {
    Segment& segment = segments.emplace_back();
    for (std::size_t k : samples) segment.times.push_back(recording.times[k] - of.epoch);
    segment.begin.time = segment.times.front();
    segment.recorded = recorded_at(recording, of, variables, samples);
    segment.start = measured_start(motion, of.system->robot(), independent,
                                   recording.times[samples.front()], of.starts);
  }
  return segments;
}

Status set_branches(const JointRecording& recording, const SegmentSystem& of,
                    const CompiledSystem& usual, const FitVariables& variables,
                    const Eigen::VectorXd& x, const std::vector<std::string>& independent,
                    const std::atomic<bool>* cancel, std::vector<Segment>* segments) {
  StartWorkspace start(usual, variables.parameters(x));
  if (Status status = start.solve_positions(); !status.ok()) return status;
  const bool has_loops = start.assembly.loops().rows() > 0;
  Follower follower(of, of.parameters(variables, x, segments->front().start),
                    start.assembly.theta());
  follower.is_at(positions_of(start, usual.robot(), independent));
  std::size_t sample = 0;
  for (Segment& segment : *segments) {
    for (; has_loops && sample < recording.times.size() &&
           recording.times[sample] - of.epoch <= segment.begin.time;
         ++sample) {
      if (is_set(cancel)) return {StatusCode::kCancelled, 0.0, "cancelled"};
      const double time = recording.times[sample] - of.epoch;
      Status status =
          follower.move_to(positions_at(recording, usual.robot(), independent, sample), time);
      status.time = recording.times[sample];
      if (!status.ok()) return status;
    }
    segment.begin.theta = follower.theta();
  }
  return {};
}

}  // namespace codesign
