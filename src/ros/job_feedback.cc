// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job_feedback.h"

#include <array>
#include <limits>
#include <utility>

#include "ros/conversions.h"

namespace codesign {
namespace {

constexpr std::array<const char*, 3> kStageNames{"screening", "searching", "validating"};

}  // namespace

JobFeedback::JobFeedback(std::string job, std::vector<std::string> parameters, FeedbackObserver observer)
    : job_(std::move(job)), parameters_(std::move(parameters)), observer_(std::move(observer)) {
  last_.objective = last_.best_objective = last_.gradient_norm = std::numeric_limits<double>::quiet_NaN();
  last_.job = job_;
}

void JobFeedback::tell(const Trial& trial, const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_ = optimization_progress(trial, parameters_, ros::Time::now());
  last_.job = job_;
  set_progress(progress);
  log_.add(last_);
  if (observer_) observer_(last_);
}

void JobFeedback::tell(const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_.header.stamp = ros::Time::now();
  set_progress(progress);
  if (observer_) observer_(last_);
}

void JobFeedback::set_progress(const Progress& progress) {
  if (progress.runs >= latest_.runs) latest_ = progress;
  last_.stage = kStageNames[static_cast<std::size_t>(latest_.stage)];
  last_.done = static_cast<std::uint64_t>(latest_.done);
  last_.of = static_cast<std::uint64_t>(latest_.of);
  last_.runs = static_cast<std::uint64_t>(latest_.runs);
  last_.remembered_runs = static_cast<std::uint64_t>(latest_.remembered);
  last_.runs_per_second = latest_.runs_per_second;
  last_.seconds_left = latest_.seconds_left.value_or(std::numeric_limits<double>::quiet_NaN());
  last_.at_most = latest_.is_bound;
}

void JobFeedback::finish(Progress progress) {
  progress.seconds_left = 0.0;
  progress.is_bound = false;
  tell(progress);
}

std::vector<mechanism_codesign::OptimizationProgress> JobFeedback::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return log_.take();
}

}  // namespace codesign
