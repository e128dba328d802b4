// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/request_fuzz.h"

#include <ros/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "description/study.h"
#include "problem/load_problem.h"
#include "ros/jobs/job.h"

namespace codesign::fuzz {
namespace {

double odd_number(double usual, Dice* dice) {
  static const std::vector<double> kOdd = {0.0,    -1.0,         1e308,    -1e308,
                                           1e-300, std::nan(""), HUGE_VAL, -HUGE_VAL};
  return dice->one_in(4) ? dice->pick(kOdd)
                         : usual * (0.9 + 0.02 * static_cast<double>(dice->below(10)));
}

std::string odd_name(const std::string& usual, Dice* dice) {
  static const std::vector<std::string> kOdd = {"",    "nosuch", "\xff", std::string(100000, 'x'),
                                                "Kp ", "../x"};
  return dice->one_in(6) ? dice->pick(kOdd) : usual;
}

void choose(const Problem& problem, Dice* dice, std::vector<std::string>* names,
            std::vector<double>* values) {
  for (const Parameter& parameter : study_of(problem).parameters) {
    if (dice->one_in(2)) continue;
    names->push_back(odd_name(parameter.name, dice));
    values->push_back(odd_number(parameter.value, dice));
  }
  if (dice->one_in(6)) values->push_back(1.0);
  // No list of very long names: the request alone would exceed the memory limit.
  if (dice->one_in(12) && !names->empty() && names->front().size() < 1000)
    names->resize(20000, names->front());
}

template <class Reply>
std::string judge(const Reply& reply, const std::vector<std::vector<double>>& numbers) {
  if (reply.code.empty() || reply.code == "internal_error" || reply.code == "failed")
    return "code \"" + reply.code + "\": " + reply.message;
  if (!reply.success) return reply.message.empty() ? "a failure that says nothing" : "";
  for (const std::vector<double>& list : numbers)
    if (!std::all_of(list.begin(), list.end(), [](double number) { return std::isfinite(number); }))
      return "success with numbers that are not finite";
  return "";
}

std::string optimize_once(const Problem& problem, const std::string& study,
                          const std::atomic<bool>& cancel, Dice* dice) {
  static const std::vector<std::string> kAlgorithms = {"",
                                                       "",
                                                       "lbfgs",
                                                       "slsqp",
                                                       "mma",
                                                       "cobyla",
                                                       "bobyqa",
                                                       "auglag_lbfgs",
                                                       "levenberg_marquardt",
                                                       "nosuch"};
  mechanism_codesign::OptimizeGoal goal;
  choose(problem, dice, &goal.parameters, &goal.start);
  if (dice->one_in(2)) goal.start.clear();
  goal.max_evaluations =
      dice->one_in(8) ? 4294967295U : 1 + static_cast<std::uint32_t>(dice->below(3));
  goal.algorithm = dice->pick(kAlgorithms);
  goal.relative_tolerance = dice->one_in(2) ? 0.0 : odd_number(1e-6, dice);
  if (dice->one_in(8)) goal.resume = odd_name("robot_2026-01-01-00-00-00", dice);
  JobOptions options;
  options.output_directory =
      (std::filesystem::temp_directory_path() / ("codesign_fuzz_bags_" + std::to_string(getpid())))
          .string();
  options.rate = 200.0;
  const OptimizationOutcome outcome = run_optimization(problem, study, goal, options, {}, cancel);
  std::filesystem::remove_all(options.output_directory);
  const auto& r = outcome.result;
  return judge(r, {{r.objective, r.initial_objective},
                   r.gradient,
                   r.initial_gradient,
                   r.tuned,
                   r.initial,
                   r.margins});
}

std::string evaluate_once(const Problem& problem, const std::atomic<bool>& cancel, Dice* dice) {
  static const std::vector<std::string> kChecks = {"", "", "complex_step", "ridders", "nosuch"};
  mechanism_codesign::EvaluateRequest request;
  choose(problem, dice, &request.parameters, &request.values);
  request.check = dice->pick(kChecks);
  request.objective_only = dice->one_in(2);
  const mechanism_codesign::EvaluateResponse reply = run_evaluation(problem, request, cancel);
  return judge(
      reply,
      {{reply.objective, reply.largest_relative_difference}, reply.gradient, reply.reference});
}

}  // namespace

std::string run_request(const std::vector<Seed>& seeds, const Limits& limits, Dice* dice) {
  const Seed& seed = dice->pick(seeds);
  if (!seed.files.empty()) return "";  // requests of identification read files
  const Problem problem = load_problem({"model.urdf", seed.urdf}, {}, {"study.yaml", seed.study});
  if (study_of(problem).tuned.empty()) return "";
  const bool evaluates = dice->one_in(2);
  return run_isolated(
      [&](const std::atomic<bool>& cancel) {
        ros::Time::init();
        return evaluates ? evaluate_once(problem, cancel, dice)
                         : optimize_once(problem, seed.study, cancel, dice);
      },
      limits);
}

}  // namespace codesign::fuzz
