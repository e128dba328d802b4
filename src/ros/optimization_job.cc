// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/init.h>

#include <cstdint>
#include <limits>
#include <utility>

#include "ensemble/scenario.h"
#include "jobs/best_record.h"
#include "jobs/ensemble_records.h"
#include "jobs/job_files.h"
#include "jobs/output_error.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_hooks.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/ensemble_messages.h"
#include "ros/job.h"
#include "ros/job_bag.h"
#include "ros/progress_log.h"
#include "ros/request.h"

namespace codesign {
namespace {

mechanism_codesign::OptimizeResult to_message(const OptimizationResult& result, const Problem& problem) {
  mechanism_codesign::OptimizeResult message;
  set_status(result.status, &message);
  message.parameters = problem.tuned_names();
  for (const ParameterConstraint& constraint : problem.study().constraints) message.constraints.push_back(constraint.text);
  message.margins = to_array(result.margins);
  message.initial = to_array(result.initial_rho);
  message.tuned = to_array(result.rho);
  message.initial_objective = result.initial_objective;
  message.objective = result.objective;
  message.initial_gradient = to_array(result.initial_gradient);
  message.gradient = to_array(result.gradient);
  message.termination = result.termination;
  message.iterations = static_cast<std::uint32_t>(result.iterations);
  message.evaluations = static_cast<std::uint32_t>(result.evaluations);
  message.failed_evaluations = static_cast<std::uint32_t>(result.failed_evaluations);
  message.steps = static_cast<std::uint64_t>(result.statistics.steps);
  message.rejected_steps = static_cast<std::uint64_t>(result.statistics.rejected_steps);
  message.cpu_seconds = result.statistics.cpu_seconds;
  message.constraint_drift = result.statistics.constraint_drift;
  message.energy_error = result.statistics.energy_error;
  set_ensemble(result, &message);
  return message;
}

/// Limits the time for recording the runs of a job after it was cancelled (30 s) or the node is shutting down (8 s): roslaunch kills a node
/// after 15 s.
class Patience {
 public:
  explicit Patience(const std::atomic<bool>& cancel) : cancel_(cancel) {}

  bool operator()() {
    const ros::WallTime now = ros::WallTime::now();
    return is_over(ros::isShuttingDown(), 8.0, now, &shutdown_) || is_over(cancel_, 30.0, now, &cancelled_);
  }

 private:
  static bool is_over(bool told, double seconds, const ros::WallTime& now, ros::WallTime* since) {
    if (!told) return false;
    if (since->isZero()) *since = now;
    return now - *since > ros::WallDuration(seconds);
  }

  const std::atomic<bool>& cancel_;
  ros::WallTime shutdown_, cancelled_;  ///< time of the first call that saw it
};

/// Both designs of a result in one scenario.
BagRuns run_both(const Problem& problem, const OptimizationResult& result, const Scenario& scenario, double rate, Patience* patience) {
  const auto side = [&](const Eigen::VectorXd& rho) {
    const std::vector<double> parameters = scenario.parameters(rho);
    return BagSide{write_tuned_urdf(problem.urdf(), problem.overlays(), parameters),
                   record_run(scenario.system, parameters, rate, [patience] { return (*patience)(); })};
  };
  return {side(result.initial_rho), side(result.rho)};
}

/// One optimization job, from the changed problem to its bag.
class Job {
 public:
  Job(const OptimizationRequest& request, const JobOptions& options, JobRecord* record, OptimizationOutcome* outcome)
      : problem_(request.problem),
        optimizer_options_(request.options),
        options_(options),
        files_(options.output_directory, problem_.robot().name),
        best_(files_.stem() + ".", problem_),
        record_(record),
        outcome_(outcome) {}

  void optimize(const FeedbackObserver& observer, const std::atomic<bool>& cancel) {
    const std::vector<std::string> parameters = problem_.tuned_names();
    ProgressLog log;
    const auto observe = [&](const Trial& trial) {
      best_.note(trial);
      log.add(optimization_progress(trial, parameters, ros::Time::now()));
      if (observer) observer(log.last());
      return true;
    };
    result_ = run_search(problem_, optimizer_options_, {observe, nullptr, nullptr, options_.ranks}, &cancel);
    record_->progress = log.take();
    outcome_->result = to_message(result_, problem_);
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings());
    outcome_->result.setup_seconds = problem_.setup_seconds();
  }

  /// Records the runs and writes the bag. A cancelled job is recorded as well; before the first evaluation its tuned design is the start.
  void record(const std::atomic<bool>& cancel) {
    const bool is_evaluated = result_.gradient.size() > 0;
    if (!is_evaluated && !result_.status.is_interrupted()) return;
    if (!is_evaluated) outcome_->result.initial_objective = outcome_->result.objective = std::numeric_limits<double>::quiet_NaN();
    Patience patience(cancel);
    Scenario nominal;
    nominal.system = problem_.system();
    record_->nominal = run_both(problem_, result_, nominal, options_.rate, &patience);
    if (const int worst = worst_scenario(result_); worst >= 0)
      record_->worst = run_both(problem_, result_, make_scenarios(problem_)[static_cast<std::size_t>(worst)], options_.rate, &patience);
    outcome_->tuned_urdf = record_->nominal.tuned.urdf;
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings());
    record_->result = outcome_->result;
    record_->result.bag = files_.bag();
    write_bag(files_.bag(), *record_);
    outcome_->result.bag = files_.bag();
    best_.remove();
  }

 private:
  Warnings warnings() const {
    Warnings warnings = result_.warnings;
    if (!best_.failure().empty())
      warnings.push_back({"best_point_not_on_disk", "the best point so far was not on disk while the job ran: " + best_.failure(), {}});
    add_early_ends("", record_->nominal, &warnings);
    if (record_->worst) add_early_ends("worst ", *record_->worst, &warnings);
    return warnings;
  }

  static void add_early_ends(const std::string& which, const BagRuns& runs, Warnings* warnings) {
    const std::pair<const char*, const RecordedRun*> sides[] = {{"initial", &runs.initial.run}, {"tuned", &runs.tuned.run}};
    for (const auto& [side, run] : sides)
      if (!run->status.ok())
        warnings->push_back(
            {"run_ends_early",
             "the " + which + side + " run in the bag ends at t = " + std::to_string(run->status.time) + " s: " + run->status.cause,
             {}});
  }

  const Problem problem_;
  const OptimizerOptions optimizer_options_;
  const JobOptions& options_;
  const JobFiles files_;
  BestRecord best_;
  JobRecord* record_;
  OptimizationOutcome* outcome_;
  OptimizationResult result_;
};

}  // namespace

OptimizationOutcome run_optimization(const Problem& problem, const std::string& study, const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const FeedbackObserver& observer, const std::atomic<bool>& cancel) {
  JobRecord record;
  record.request = request;
  record.request.version = version();
  record.study = study;
  OptimizationOutcome outcome;
  try {
    Job job(apply_request(problem, request), options, &record, &outcome);
    job.optimize(observer, cancel);
    job.record(cancel);
  } catch (const InputError& error) {
    refuse("bad_input", error.what(), &outcome.result);
  } catch (const OutputError& error) {
    refuse("output_failed", error.what(), &outcome.result);
  } catch (const std::exception& error) {
    refuse("internal_error", error.what(), &outcome.result);
  }
  return outcome;
}

}  // namespace codesign
