// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/feedback.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace codesign {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The time left after `done` of `of` equal parts. @param seconds the time of the finished parts
/// together
double seconds_left(double seconds, int done, int of) {
  return done > 0 ? seconds * std::max(of - done, 0) / done : kUnknown;
}

}  // namespace

void TrialLog::add(LoggedTrial trial) {
  last_ = std::move(trial);
  if (count_++ % stride_ != 0) return;
  if (kept_.size() == capacity_) {
    for (std::size_t k = 1; 2 * k < kept_.size(); ++k) kept_[k] = std::move(kept_[2 * k]);
    kept_.resize(capacity_ / 2);
    stride_ *= 2;
  }
  kept_.push_back(last_);
}

std::vector<LoggedTrial> TrialLog::take() {
  if (!kept_.empty() && kept_.back().trial.evaluation != last_.trial.evaluation)
    kept_.push_back(last_);
  return std::move(kept_);
}

JobFeedback::JobFeedback(std::string job, std::vector<std::string> parameters,
                         FeedbackObserver observer)
    : job_(std::move(job)), parameters_(std::move(parameters)), observer_(std::move(observer)) {
  last_.objective = last_.best_objective = last_.gradient_norm = kUnknown;
  last_.job = job_;
}

void JobFeedback::publish(const Trial& trial, const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_ = optimization_progress(trial, job_, parameters_);
  send(progress);
  log_.add({trial, latest_});
}

void JobFeedback::publish(const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  send(progress);
}

void JobFeedback::send(const Progress& progress) {
  if (progress.runs >= latest_.runs) latest_ = progress;
  set_progress(latest_, &last_);
  last_.header.stamp = ros::Time::now();
  if (observer_) observer_(last_);
}

void JobFeedback::finish(Progress progress) {
  progress.seconds_left = 0.0;
  progress.is_bound = false;
  publish(progress);
}

std::vector<LoggedTrial> JobFeedback::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return log_.take();
}

IdentificationFeedback::IdentificationFeedback(std::string job, std::vector<std::string> names,
                                               int most_evaluations,
                                               IdentificationObserver observer)
    : most_evaluations_(most_evaluations),
      observer_(std::move(observer)),
      begin_(ros::WallTime::now()),
      stage_begin_(begin_) {
  last_.job = std::move(job);
  last_.names = std::move(names);
  last_.cost = kUnknown;
}

void IdentificationFeedback::set_stage(const std::string& stage) {
  if (stage == last_.stage) return;
  last_.stage = stage;
  stage_begin_ = ros::WallTime::now();
  last_.done = last_.of = 0;
  last_.seconds_left = kUnknown;
  last_.at_most = false;
}

void IdentificationFeedback::begin(const std::string& stage) {
  set_stage(stage);
  send();
}

void IdentificationFeedback::publish(const FitTrial& trial) {
  const bool is_fit = trial.profile == 0;
  set_stage(is_fit ? "fitting" : "profiling");
  const int done = is_fit ? trial.evaluation : trial.profile - 1,
            of = is_fit ? most_evaluations_ : trial.profiles;
  last_.done = static_cast<std::uint32_t>(done);
  last_.of = static_cast<std::uint32_t>(of);
  last_.seconds_left = seconds_left((ros::WallTime::now() - stage_begin_).toSec(), done, of);
  last_.at_most = is_fit;
  last_.evaluation = static_cast<std::uint32_t>(trial.evaluation);
  last_.iteration = static_cast<std::uint32_t>(trial.iteration);
  last_.code = name_of(trial.status.code);
  last_.message = trial.status.cause;
  last_.cost = trial.cost;
  last_.joints = trial.outputs;
  last_.rms = to_array(trial.rms);
  last_.values = to_array(trial.x);
  send();
  if (is_fit) kept_.push_back(last_);
}

void IdentificationFeedback::finish() {
  last_.seconds_left = 0.0;
  last_.at_most = false;
  send();
}

void IdentificationFeedback::send() {
  last_.header.stamp = ros::Time::now();
  last_.seconds = (ros::WallTime::now() - begin_).toSec();
  if (observer_) observer_(last_);
}

}  // namespace codesign
