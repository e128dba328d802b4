// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/motion_residuals.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "engine/thread_engine.h"
#include "identification/motion/segments.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Of the segment's previous predicted decrease, and of the sum of all: a start with a larger
// predicted decrease is slow.
constexpr double kSlowStart = 0.1;
constexpr std::size_t kFew = 4;  // slow starts are helped if at most one segment in so many has one
// Of the value: a smaller sum of predicted decreases does not hinder a fit.
constexpr double kWorthHelp = 1e-6;
// Of the value of a segment: a start with a smaller predicted decrease counts as the best one.
constexpr double kBestStartShare = 1e-8;

/// Recorded positions at a few instants, joints x instants.
Eigen::MatrixXd positions_of_some(const JointRecording& recording,
                                  const std::vector<MeasuredJoint>& joints) {
  constexpr Eigen::Index kInstants = 4;
  Eigen::MatrixXd some(to_signed(joints.size()), kInstants);
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (Eigen::Index k = 0; k < kInstants; ++k)
      some(to_signed(j), k) =
          recording.find(joints[j].name)
              ->position[(recording.times.size() - 1) * to_index(k) / kInstants];
  return some;
}

/// @throws InputError naming the joint: a simulated motion begins at measured positions and is
/// compared with them.
void require_positions(const std::vector<JointRecording>& recordings) {
  for (const JointRecording& recording : recordings)
    for (const JointSamples& samples : recording.joints)
      if (samples.position.empty())
        throw InputError({recording.where, recording.element,
                          "residuals in motion need recorded positions", samples.joint,
                          "positions of each joint, or residual: effort, which integrates "
                          "velocities from a start"});
}

/// Recordings do not show the deflection of bristles at the begin of a segment.
void warn_of_friction_states(const CompiledSystem& system, const IdentificationDescription& options,
                             Warnings* warnings) {
  if (system.bristles().empty()) return;
  append({warn("segment_friction_states",
               {options.where, "identify.segment",
                "friction with states begins each segment as it slides, at rest unloaded: a joint "
                "that sticks there "
                "gives way by the deflection of its bristles, "
                "and its first slip counts as a change of the start",
                readable(options.segment),
                "segments that begin while the joint moves, or longer ones"})},
         warnings);
}

/// The variation of each column, a first guess of the spread of its residuals.
Eigen::VectorXd variation_of(const Eigen::MatrixXd& recorded) {
  Eigen::VectorXd variation =
      about_mean_of(recorded).array().square().colwise().mean().sqrt().transpose();
  for (double& each : variation)
    if (!(each > 0.0)) each = 1.0;
  return variation;
}

/// Values without their mean, and without their slope over time if `has_slope`.
Eigen::VectorXd without_line(const std::vector<double>& times, const Eigen::VectorXd& values,
                             bool has_slope) {
  const Eigen::VectorXd about_mean = about_mean_of(values);
  if (!has_slope || times.size() < 2) return about_mean;
  const Eigen::Map<const Eigen::VectorXd> t(times.data(), to_signed(times.size()));
  const Eigen::VectorXd from_middle = about_mean_of(t);
  return about_mean - from_middle * (from_middle.dot(about_mean) / from_middle.squaredNorm());
}

double value_of(const std::vector<SegmentSolution>& solutions) {
  double value = 0.0;
  for (const SegmentSolution& solution : solutions) value += solution.value;
  return value;
}

}  // namespace

/// The workspace of one thread: a run per recording, made when first needed.
struct MotionResiduals::MotionWorker {
  std::vector<std::unique_ptr<SegmentRun>> runs;
};

MotionResiduals::MotionResiduals(const CompiledSystem& system, const FitVariables& variables,
                                 const IdentificationDescription& options,
                                 const std::vector<MeasuredJoint>& joints,
                                 std::vector<JointRecording> recordings, int threads,
                                 Warnings* warnings)
    : system_(system), variables_(variables), recordings_(std::move(recordings)) {
  require_positions(recordings_);
  warn_of_friction_states(system, options, warnings);
  independent_ = independent_joints(system, joints, positions_of_some(recordings_.front(), joints));
  const std::vector<MotionOutput> outputs = motion_outputs(system, joints, recordings_);
  for (const MotionOutput& output : outputs) names_.push_back(output.name());
  signals_ = recordings_.front().signals.size();
  Eigen::Index rows = 0;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    const JointRecording& recording = recordings_[r];
    systems_.push_back(
        make_segment_system(system, variables, joints, independent_, outputs, recording));
    segments_.push_back(
        cut_into_segments(recording, systems_.back(), variables, independent_, options, warnings));
    std::vector<double> times = recording.times;
    for (double& time : times) time -= systems_.back().epoch;
    efforts_.emplace_back();
    for (const MotionOutput& output : outputs) {
      std::optional<RecordedEffort>& effort = efforts_.back().emplace_back();
      if (output.is_effort()) effort.emplace(times, recording.find(output.joint)->effort);
    }
    const Eigen::Index begin = rows;
    for (std::size_t k = 0; k < segments_.back().size(); ++k) {
      places_.push_back({r, k, rows});
      pieces_.push_back(segments_.back()[k].recorded.rows());
      rows += pieces_.back();
    }
    lengths_.push_back(rows - begin);
  }
  recorded_.resize(rows, to_signed(outputs.size()));
  for (const SegmentRow& place : places_) {
    const Eigen::MatrixXd& part = segments_[place.recording][place.segment].recorded;
    recorded_.middleRows(place.row, part.rows()) = part;
  }
  spreads_ = variation_of(recorded_);
  for (int k = 0; k < std::max(threads, 1); ++k)
    workers_.push_back(std::make_unique<MotionWorker>());
}

MotionResiduals::~MotionResiduals() = default;

std::vector<double> MotionResiduals::times() const {
  std::vector<double> times;
  for (const SegmentRow& place : places_)
    for (const double time : segments_[place.recording][place.segment].times)
      times.push_back(time + systems_[place.recording].epoch);
  return times;
}

Eigen::MatrixXd MotionResiduals::variation() const {
  Eigen::MatrixXd result = RecordingResiduals::variation();
  for (const SegmentRow& place : places_) {
    const Segment& segment = segments_[place.recording][place.segment];
    const std::vector<MotionOutput>& outputs = systems_[place.recording].outputs;
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (!outputs[k].signal && !outputs[k].is_effort())
        result.col(to_signed(k)).segment(place.row, segment.recorded.rows()) =
            without_line(segment.times, segment.recorded.col(to_signed(k)),
                         outputs[k].quantity == MeasuredQuantity::kPosition);
  }
  return result;
}

Eigen::Index MotionResiduals::own_unknowns() const {
  Eigen::Index sum = 0;
  for (const SegmentRow& place : places_) sum += systems_[place.recording].starts;
  return sum;
}

Status MotionResiduals::failure_of(std::size_t place, Status status) const {
  if (status.code == StatusCode::kCancelled) return status;
  const SegmentRow& at = places_[place];
  const double begin =
      segments_[at.recording][at.segment].begin.time + systems_[at.recording].epoch;
  status.cause = "segment at " + readable(begin, 6) + " s of " + recordings_[at.recording].element +
                 ": " + status.cause;
  return status;
}

Status MotionResiduals::begin(const Eigen::VectorXd& x) {
  for (std::unique_ptr<MotionWorker>& worker : workers_) worker->runs.clear();
  best_ = {};
  best_starts_ = {};
  is_recounted_ = true;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    Status status = set_branches(recordings_[r], systems_[r], system_, variables_, x, independent_,
                                 cancel_, &segments_[r]);
    if (!status.ok()) {
      status.cause = recordings_[r].element + ": " + status.cause;
      return status;
    }
  }
  return {};
}

void MotionResiduals::count_by(const Eigen::VectorXd& spreads, const LossOptions& loss) {
  spreads_ = spreads;
  loss_ = loss;
  is_recounted_ = true;
}

MotionResiduals::Guesses MotionResiduals::guesses(const Eigen::VectorXd& x) const {
  Guesses guesses(places_.size());
  for (std::size_t place = 0; place < places_.size(); ++place) {
    std::vector<Eigen::VectorXd>& starts = guesses[place];
    const bool has_best_starts = best_starts_.x.size() > 0,
               is_here = has_best_starts && is_recounted_ && best_starts_.x == x;
    if (is_here) starts.push_back(best_starts_.starts[place]);
    if (best_.x.size() > 0) {
      starts.push_back(best_.starts[place] - best_.corrections[place] -
                       best_.slopes[place] * (x - best_.x));
      starts.push_back(best_.starts[place]);
    }
    if (has_best_starts && !is_here) starts.push_back(best_starts_.starts[place]);
    starts.push_back(segments_[places_[place].recording][places_[place].segment].start);
  }
  return guesses;
}

Status MotionResiduals::solve(const Eigen::VectorXd& x, const Guesses& guesses, SegmentWork work,
                              std::vector<SegmentSolution>* solutions) {
  std::atomic<std::size_t> next{0};
  side_by_side(workers_.size(), static_cast<int>(workers_.size()), [&](std::size_t worker) {
    std::vector<std::unique_ptr<SegmentRun>>& runs = workers_[worker]->runs;
    runs.resize(recordings_.size());
    for (std::size_t k = next++; k < places_.size() && !is_set(cancel_); k = next++) {
      if (guesses[k].empty()) continue;
      const SegmentRow& place = places_[k];
      std::unique_ptr<SegmentRun>& run = runs[place.recording];
      if (!run)
        run = std::make_unique<SegmentRun>(systems_[place.recording],
                                           segments_[place.recording].front().begin);
      run->obey(cancel_);
      const SegmentProblem problem{systems_[place.recording],
                                   variables_,
                                   efforts_[place.recording],
                                   segments_[place.recording][place.segment],
                                   x,
                                   spreads_,
                                   loss_};
      (*solutions)[k] = fit_segment(problem, guesses[k], work, run.get());
    }
  });
  if (is_set(cancel_)) return {StatusCode::kCancelled, 0.0, "cancelled"};
  Status failure;
  for (std::size_t k = 0; k < solutions->size(); ++k) {
    if (guesses[k].empty()) continue;
    runs_ += (*solutions)[k].runs;
    whole_runs_ += (*solutions)[k].whole_runs;
    if (failure.ok() && !(*solutions)[k].status.ok())
      failure = failure_of(k, (*solutions)[k].status);
  }
  return failure;
}

/// Looks for better starts of some segments. @param from starts to begin with. @param improved on
/// return the starts that are better; empty for the other segments. The derivatives in `solutions`
/// still belong to the previous starts.
Status MotionResiduals::improve(const Eigen::VectorXd& x, Guesses from, SegmentWork work,
                                std::vector<SegmentSolution>* solutions, Guesses* improved) {
  std::vector<SegmentSolution> found(places_.size());
  if (Status status = solve(x, from, work, &found); !status.ok()) return status;
  improved->assign(places_.size(), {});
  for (std::size_t k = 0; k < places_.size(); ++k) {
    SegmentSolution& solution = (*solutions)[k];
    if (from[k].empty() || !(found[k].value < solution.value)) continue;
    (*improved)[k] = {found[k].start};
    solution.value = found[k].value;
    solution.predicted_decrease = found[k].predicted_decrease;
    solution.residuals = found[k].residuals;
  }
  return {};
}

/// A point may be worse than the best point only because the step of its starts was too long.
/// Replaces these starts by the best starts. If the point is then better than the best point so
/// far, computes its derivatives at these starts, too.
Status MotionResiduals::solve_all(const Eigen::VectorXd& x,
                                  std::vector<SegmentSolution>* solutions) {
  Guesses unsettled(places_.size()), improved;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if ((*solutions)[k].predicted_decrease > kBestStartShare * (*solutions)[k].value)
      // From these starts the value can only fall; for small steps of x it is near the value of the
      // best point.
      unsettled[k] = {best_.starts[k] - best_.slopes[k] * (x - best_.x), best_.starts[k],
                      (*solutions)[k].start};
  if (Status status =
          improve(x, std::move(unsettled), SegmentWork::kBestStart, solutions, &improved);
      !status.ok())
    return status;
  if (!(value_of(*solutions) < best_.value)) return {};
  return solve(x, improved, SegmentWork::kElimination, solutions);
}

/// If the residuals of a segment are large and curved, its start converges only linearly, and a few
/// such segments would delay the whole fit. Their starts take a few more steps.
Status MotionResiduals::help_slow_starts(const Eigen::VectorXd& x,
                                         std::vector<SegmentSolution>* solutions) {
  double inner_decrease = 0.0;
  for (const SegmentSolution& solution : *solutions) inner_decrease += solution.predicted_decrease;
  Guesses slow(places_.size()), improved;
  std::size_t count = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const SegmentSolution& solution = (*solutions)[k];
    if (!(solution.predicted_decrease >
          kSlowStart * std::max(inner_decrease, best_.predicted_decreases[k])))
      continue;
    slow[k] = {solution.start - solution.correction, solution.start};
    ++count;
  }
  if (count == 0 || kFew * count > places_.size() ||
      !(inner_decrease > kWorthHelp * value_of(*solutions)))
    return {};
  if (Status status = improve(x, std::move(slow), SegmentWork::kBetterStart, solutions, &improved);
      !status.ok())
    return status;
  return solve(x, improved, SegmentWork::kElimination, solutions);
}

void MotionResiduals::remember(const Eigen::VectorXd& x, double value,
                               const std::vector<SegmentSolution>& solutions) {
  if (!is_recounted_ && !(value < best_.value)) return;
  is_recounted_ = false;
  best_ = {x, value, {}, {}, {}, {}};
  for (const SegmentSolution& solution : solutions) {
    best_.starts.push_back(solution.start);
    best_.corrections.push_back(solution.correction);
    best_.slopes.push_back(solution.slope);
    best_.predicted_decreases.push_back(solution.predicted_decrease);
  }
}

Status MotionResiduals::evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                                 Eigen::MatrixXd* jacobian) {
  std::vector<SegmentSolution> solutions(places_.size());
  const SegmentWork work = jacobian ? SegmentWork::kElimination : SegmentWork::kBestStart;
  if (Status status = solve(x, guesses(x), work, &solutions); !status.ok()) return status;
  if (jacobian) {
    if (!is_recounted_) {
      const bool is_better = value_of(solutions) < best_.value;
      if (Status status = is_better ? help_slow_starts(x, &solutions) : solve_all(x, &solutions);
          !status.ok())
        return status;
    }
    remember(x, value_of(solutions), solutions);
    inner_decrease_ = 0.0;
    for (const SegmentSolution& solution : solutions)
      inner_decrease_ += solution.predicted_decrease;
  } else {
    best_starts_ = {x, {}};
    for (const SegmentSolution& solution : solutions) best_starts_.starts.push_back(solution.start);
  }
  const Eigen::Index outputs = recorded_.cols();
  residuals->resize(rows(), outputs);
  if (jacobian) jacobian->resize(rows() * outputs, x.size());
  for (std::size_t k = 0; k < solutions.size(); ++k) {
    const Eigen::MatrixXd& part = solutions[k].residuals;
    residuals->middleRows(places_[k].row, part.rows()) = part;
    for (Eigen::Index output = 0; jacobian && output < outputs; ++output)
      jacobian->middleRows(output * rows() + places_[k].row, part.rows()) =
          solutions[k].jacobian.middleRows(output * part.rows(), part.rows());
  }
  return {};
}

}  // namespace codesign
