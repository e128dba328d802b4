// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/job.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "description/study.h"
#include "identification/fit/fit_variables.h"
#include "identification/identify.h"
#include "jobs/files.h"
#include "jobs/identification_records.h"
#include "jobs/job_files.h"
#include "jobs/trial_lines.h"
#include "problem/load_problem.h"
#include "ros/bags/bag_files.h"
#include "ros/bags/job_bag.h"
#include "ros/jobs/messages.h"
#include "ros/jobs/request.h"

namespace codesign {
namespace {

/// One identification, from the changed problem to its files.
class IdentificationJob {
 public:
  IdentificationJob(Problem problem, const JobOptions& options,
                    const IdentificationObserver& observer, IdentificationOutcome* outcome)
      : problem_(std::move(problem)),
        options_(options),
        files_(options.output_directory, robot_of(problem_).name),
        feedback_(files_.name(), FitVariables(study_of(problem_)).names(),
                  problem_.optimizer_options().max_evaluations, observer),
        outcome_(outcome) {}

  void fit(const std::string& folder, const std::atomic<bool>& cancel) {
    feedback_.begin("reading");
    recordings_ = load_recordings(*study_of(problem_).identification, robot_of(problem_), folder,
                                  cancellable_bag_reader(cancel), &warnings_, &cancel);
    FitLines lines(problem_.optimizer_options().max_evaluations);
    const auto observe = [&](const FitTrial& trial) {
      const std::string line = lines.line(trial);
      if (!line.empty()) ROS_INFO_STREAM(line);
      feedback_.publish(trial);
      return !cancel;
    };
    result_ = identify(problem_, recordings_, observe, &cancel);
    append(result_.warnings, &warnings_);
    outcome_->result = identification_message(problem_, result_);
    outcome_->result.job = files_.name();
    set_warnings();
  }

  /// Writes all files, if the result has a point. The bag comes last: after a cancel it gets the
  /// remaining time.
  void write(const mechanism_codesign::IdentifyGoal& request, const std::atomic<bool>& cancel) {
    if (result_.numbers.empty()) return;
    feedback_.begin("recording");
    Patience patience(cancel);
    ComparedMotion motion = compare_motion(problem_, recordings_, result_, shown_rate(cancel),
                                           [&patience] { return patience(); });
    for (const ComparedRecording& recording : motion.recordings)
      if (!recording.status.ok())
        warnings_.push_back(
            {"run_ends_early",
             recording.element + " ends early in the bag: " + describe(recording.status),
             {}});
    set_warnings();
    const std::string json = identification_report(problem_, result_, warnings_);
    write_texts(json);
    write_bag(request, identification_show(problem_, result_, json, std::move(motion)));
    feedback_.finish();
    if (!failure_.empty()) refuse("output_failed", failure_, &outcome_->result);
  }

 private:
  /// Rate of the instants in the bag. A cancelled job shows few instants, so that all recordings
  /// are written in the remaining time.
  double shown_rate(bool is_cancelled) const {
    constexpr double kCancelledInstants = 1000.0;
    double seconds = 0.0;
    for (const std::vector<JointRecording>* list : {&recordings_.data, &recordings_.holdout})
      for (const JointRecording& recording : *list)
        seconds += recording.times.back() - recording.times.front();
    return is_cancelled ? std::min(options_.rate, kCancelledInstants / seconds) : options_.rate;
  }

  void set_warnings() {
    outcome_->result.warnings = warning_messages(problem_.warnings(), warnings_);
  }

  /// The path of a file if it was written, else empty.
  template <class Write>
  std::string try_to(Write write, const std::string& path) {
    try {
      write();
      return path;
    } catch (const OutputError& error) {
      failure_ += (failure_.empty() ? "" : "; ") + std::string(error.what());
      return "";
    }
  }

  void write_texts(const std::string& json) {
    mechanism_codesign::IdentifyResult& result = outcome_->result;
    const std::pair<const char*, std::string*> texts[] = {
        {"identification.json", &result.report},
        {"identified_overlay.urdf", &result.overlay},
        {"identified.urdf", &result.urdf},
        {"residuals.csv", &result.residuals}};
    for (const IdentificationFile& file : identification_files(problem_, result_, json)) {
      const std::string path = files_.stem() + "." + file.name;
      const std::string written = try_to([&] { write_whole_file(path, file.text()); }, path);
      for (const auto& [name, place] : texts)
        if (file.name == name) *place = written;
    }
  }

  void write_bag(const mechanism_codesign::IdentifyGoal& request, const IdentificationShow& show) {
    outcome_->identified_urdf = show.urdf;
    IdentificationAnswer answer{request, outcome_->result, feedback_.take()};
    answer.request.version = version();
    answer.result.bag = files_.bag();
    outcome_->result.bag =
        try_to([&] { write_identification_bag(files_.bag(), show, &answer); }, files_.bag());
  }

  const Problem problem_;
  const JobOptions& options_;
  const JobFiles files_;
  IdentificationFeedback feedback_;
  IdentificationOutcome* outcome_;
  StudyRecordings recordings_;
  IdentificationResult result_;
  Warnings warnings_;    ///< of recordings, fit and bag
  std::string failure_;  ///< about files
};

}  // namespace

IdentificationOutcome run_identification(const Problem& problem, const std::string& folder,
                                         const mechanism_codesign::IdentifyGoal& request,
                                         const JobOptions& options,
                                         const IdentificationObserver& observer,
                                         const std::atomic<bool>& cancel) {
  IdentificationOutcome outcome;
  const auto failure = failure_of([&] {
    IdentificationJob job(apply_request(problem, request), options, observer, &outcome);
    job.fit(folder, cancel);
    job.write(request, cancel);
  });
  if (failure) refuse(failure->code, failure->message, &outcome.result);
  return outcome;
}

}  // namespace codesign
