// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/init.h>
#include <rosbag/exceptions.h>

#include <cstdint>
#include <filesystem>

#include "mechanism_codesign/model/error.h"
#include "mechanism_codesign/optimization/optimizer.h"
#include "mechanism_codesign/ros/job.h"
#include "mechanism_codesign/ros/job_bag.h"
#include "mechanism_codesign/ros/request.h"

namespace codesign {
namespace {

mechanism_codesign::OptimizeResult to_message(const OptimizationResult& result, const std::vector<std::string>& parameters) {
  mechanism_codesign::OptimizeResult message;
  set_status(result.status, &message);
  message.parameters = parameters;
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
  return message;
}

/// A cancelled job keeps its best point and is recorded too; only a node that ends has no time for it.
BagSide run_side(const Problem& problem, const std::vector<double>& parameters, double rate) {
  return {write_tuned_urdf(problem.urdf, problem.overlays, parameters), record_run(problem, parameters, rate, ros::isShuttingDown)};
}

void compute(const Problem& problem, const JobOptions& options, const ProgressObserver& observer, const std::atomic<bool>& cancel,
             JobRecord* record, OptimizationOutcome* outcome) {
  const std::string path = new_bag_path(options.output_directory, problem.robot.name);
  const std::vector<std::string> parameters = problem.tuned_names();
  const auto observe = [&](const Trial& trial) {
    record->progress.push_back(optimization_progress(trial, parameters, ros::Time::now()));
    if (observer) observer(record->progress.back());
    return true;
  };
  const OptimizationResult result = optimize(problem.system, problem.study, observe, &cancel);
  outcome->result = to_message(result, parameters);
  outcome->result.warnings = warning_messages(problem.warnings, result.warnings);
  outcome->result.setup_seconds = problem.setup_seconds;
  if (result.gradient.size() == 0) return;  // not even the start has a value
  record->initial = run_side(problem, problem.parameters(result.initial_rho), options.rate);
  record->tuned = run_side(problem, problem.parameters(result.rho), options.rate);
  outcome->tuned_urdf = record->tuned.urdf;
  record->result = outcome->result;
  record->result.bag = path;
  write_bag(path, *record);
  outcome->result.bag = path;
}

}  // namespace

OptimizationOutcome run_optimization(const Problem& problem, const std::string& study, const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const ProgressObserver& observer, const std::atomic<bool>& cancel) {
  JobRecord record;
  record.request = request;
  record.study = study;
  OptimizationOutcome outcome;
  try {
    compute(apply_request(problem, request), options, observer, cancel, &record, &outcome);
  } catch (const InputError& error) {
    refuse("bad_input", error.what(), &outcome.result);
  } catch (const rosbag::BagException& error) {
    refuse("output_failed", error.what(), &outcome.result);
  } catch (const std::filesystem::filesystem_error& error) {
    refuse("output_failed", error.what(), &outcome.result);
  } catch (const std::exception& error) {
    refuse("internal_error", error.what(), &outcome.result);
  }
  return outcome;
}

}  // namespace codesign
