// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/console.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>

#include "description/robot.h"
#include "description/study.h"
#include "ensemble/scenario.h"
#include "jobs/files.h"
#include "jobs/job_files.h"
#include "jobs/journal.h"
#include "jobs/optimization_records.h"
#include "jobs/result_folder.h"
#include "jobs/trial_lines.h"
#include "math/arrays.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/result_report.h"
#include "optimization/search_hooks.h"
#include "optimization/search_results.h"
#include "problem/load_problem.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/bags/job_bag.h"
#include "ros/jobs/feedback.h"
#include "ros/jobs/job.h"
#include "ros/jobs/messages.h"
#include "ros/jobs/request.h"

namespace codesign {
namespace {

/// Records both designs of a result in one scenario; the tuned design first, since it matters more
/// if time runs out.
BagRuns run_both(const Problem& problem, const OptimizationResult& result, const Scenario& scenario,
                 double rate, Patience* patience) {
  const auto side = [&](const Eigen::VectorXd& rho) {
    const std::vector<double> parameters = scenario.parameters(rho);
    const Laws& laws = robot_of(problem).laws;
    return BagSide{
        write_tuned_urdf(problem.urdf(), problem.overlays(), parameters,
                         find_friction(laws, scenario.friction_law), laws),
        record_run(scenario.system, parameters, rate, [patience] { return (*patience)(); })};
  };
  BagSide tuned = side(result.best.rho);
  return {side(result.initial.rho), std::move(tuned)};
}

JobFiles files_of(const std::string& resume, const std::string& directory,
                  const std::string& robot) {
  return resume.empty() ? JobFiles(directory, robot) : JobFiles::resume(directory, resume);
}

/// One optimization job, from the changed problem to its bag.
class Job {
 public:
  /// @param resume name of the job to go on with; empty: a new job.
  Job(const OptimizationRequest& request, const std::string& resume, const JobOptions& options,
      JobRecord* record, OptimizationOutcome* outcome)
      : problem_(request.problem),
        optimizer_options_(request.options),
        options_(options),
        files_(files_of(resume, options.output_directory, robot_of(problem_).name)),
        best_(files_.stem() + ".", problem_),
        record_(record),
        outcome_(outcome) {
    open_journal(!resume.empty());
  }

  /// Removes a journal without evaluations. After a cancel it stays, since the client knows the
  /// name of the job and may resume it.
  ~Job() {
    const bool is_of_use = journal_ && (journal_->evaluations() > 0 || is_interrupted());
    if (has_ended_ || !is_of_use) unlink(files_.journal().c_str());
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  void optimize(const FeedbackObserver& observer, const std::atomic<bool>& cancel) {
    JobFeedback feedback(files_.name(), problem_.tuned_names(), observer);
    ProgressMeter meter(optimizer_options_.max_evaluations,
                        [&](const Progress& progress) { feedback.publish(progress); });
    TrialLines lines(study_of(problem_));
    const auto observe = [&](const Trial& trial) {
      const Progress now = meter.now();
      best_.note(trial);
      ROS_INFO_STREAM(lines.line(trial, now));
      feedback.publish(trial, now);
      return true;
    };
    result_ = run_search(problem_, optimizer_options_,
                         {observe, nullptr, journal_, options_.ranks, &meter}, &cancel);
    feedback.finish(meter.now());
    record_->trials = feedback.take();
    outcome_->result = optimization_message(problem_, result_);
    outcome_->result.job = files_.name();
    outcome_->result.runs = static_cast<std::uint64_t>(meter.now().runs);
    outcome_->result.remembered_runs = static_cast<std::uint64_t>(meter.now().remembered);
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings());
    outcome_->result.setup_seconds = problem_.setup_seconds();
  }

  /// Records the runs and writes the bag; after that the journal is not needed, unless the job was
  /// cancelled. A cancelled job is recorded as well; before the first evaluation its tuned design
  /// is the start.
  void record(const std::atomic<bool>& cancel) {
    const bool is_evaluated = result_.best.gradient.size() > 0;
    has_ended_ = !is_evaluated && !is_interrupted();
    if (has_ended_) return;
    constexpr double kUnevaluated = std::numeric_limits<double>::quiet_NaN();
    if (!is_evaluated) outcome_->result.initial_objective = kUnevaluated;
    // Screening computes objectives without gradients.
    if (!is_evaluated && result_.multistart.screened <= result_.multistart.unusable)
      outcome_->result.objective = kUnevaluated;
    Patience patience(cancel);
    Scenario nominal;
    nominal.system = system_of(problem_);
    record_->nominal = run_both(problem_, result_, nominal, options_.rate, &patience);
    if (const int worst = worst_scenario(result_); worst >= 0)
      record_->worst = run_both(problem_, result_,
                                scenario_of(problem_, result_.ensemble.scenarios[to_index(worst)]),
                                options_.rate, &patience);
    outcome_->tuned_urdf = record_->nominal.tuned.urdf;
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings());
    record_->result = outcome_->result;
    record_->result.bag = files_.bag();
    write_bag(files_.bag(), *record_);
    outcome_->result.bag = files_.bag();
    // After the bag, so that the bag gets the space on a disk that is almost full.
    write_folder(cancel);
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings());
    best_.remove();
    has_ended_ = !is_interrupted();
  }

 private:
  /// The folder beside the bag. It has no runs if the job was cancelled and a client waits for the
  /// answer.
  void write_folder(const std::atomic<bool>& cancel) {
    const ResultFolder folder(files_.folder(), problem_);
    const std::string json = optimization_report(problem_, result_, warnings());
    try {
      std::filesystem::create_directory(files_.folder());
      folder_failures_ = folder.write_design(json, result_);
      const std::string convergence = folder.in_folder("convergence.csv");
      std::vector<std::vector<std::string>> rows;
      for (const LoggedTrial& logged : record_->trials)
        rows.push_back(convergence_row(logged.trial));
      write_whole_file(convergence,
                       csv_text(convergence_columns(problem_.tuned_names()), rows, convergence));
    } catch (const std::exception& error) {
      folder_failures_.push_back({"output_failed", error.what()});
    }
    if (is_interrupted() || !folder_failures_.empty()) return;
    folder_failures_ = folder.write_runs(result_, &cancel);
  }

  /// Whether the job was interrupted, so that it can be resumed.
  bool is_interrupted() const { return result_.status.is_interrupted(); }

  /// If the disk cannot take the journal of a new job, the job runs without a journal.
  void open_journal(bool resume) {
    const Journal::Mode mode = resume ? Journal::Mode::kResume : Journal::Mode::kNew;
    try {
      journal_ = std::make_shared<Journal>(files_.journal(), problem_, optimizer_options_, mode);
    } catch (const OutputError& error) {
      if (resume) throw;
      journal_failure_ = error.what();
      return;
    }
    for (const std::string& sentence : journal_->notes())
      ROS_INFO_STREAM(files_.name() << ": " << sentence);
  }

  Warnings warnings() const {
    Warnings warnings = result_.warnings;
    if (!best_.failure().empty())
      warnings.push_back(
          {"best_point_not_on_disk",
           "the best point so far was not on disk while the job ran: " + best_.failure(),
           {}});
    if (journal_) append(journal_->warnings(), &warnings);
    const std::string failure = journal_ ? journal_->failure() : journal_failure_;
    if (!failure.empty())
      warnings.push_back(
          {"journal_incomplete",
           "finished evaluations are missing in the journal, so that they would be computed again "
           "if the job had to be resumed: " +
               failure,
           {}});
    for (const Failure& failed : folder_failures_)
      warnings.push_back({"folder_incomplete", failed.message, {}});
    add_early_ends("", record_->nominal, &warnings);
    if (record_->worst) add_early_ends("worst ", *record_->worst, &warnings);
    return warnings;
  }

  static void add_early_ends(const std::string& which, const BagRuns& runs, Warnings* warnings) {
    const std::pair<const char*, const RecordedRun*> sides[] = {{"initial", &runs.initial.run},
                                                                {"tuned", &runs.tuned.run}};
    for (const auto& [side, run] : sides)
      if (!run->status.ok())
        warnings->push_back({"run_ends_early",
                             "the " + which + side + " run in the bag ends at t = " +
                                 std::to_string(run->status.time) + " s: " + run->status.cause,
                             {}});
  }

  const Problem problem_;
  const OptimizerOptions optimizer_options_;
  const JobOptions& options_;
  const JobFiles files_;
  BestRecord best_;
  std::shared_ptr<Journal> journal_;  ///< null if it cannot be written
  std::string journal_failure_;
  std::vector<Failure> folder_failures_;
  bool has_ended_ = false;  ///< whether the job has ended uninterrupted, with all files written
  JobRecord* record_;
  OptimizationOutcome* outcome_;
  OptimizationResult result_;
};

}  // namespace

OptimizationOutcome run_optimization(const Problem& problem, const std::string& study,
                                     const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const FeedbackObserver& observer,
                                     const std::atomic<bool>& cancel) {
  JobRecord record;
  record.request = request;
  record.request.version = version();
  record.study = study;
  for (const LoadedFile& one : contents_of(problem).files)
    record.study_files.push_back(one.source.text);
  OptimizationOutcome outcome;
  const auto failure = failure_of([&] {
    Job job(apply_request(problem, request), request.resume, options, &record, &outcome);
    job.optimize(observer, cancel);
    job.record(cancel);
  });
  if (failure) refuse(failure->code, failure->message, &outcome.result);
  return outcome;
}

}  // namespace codesign
