// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/report.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kNear = 1e-4;  // of the best known objective
constexpr const char* kAlgorithms[] = {
    "auto", "levenberg_marquardt", "slsqp",  "lbfgs", "var2", "tnewton", "mma", "ccsaq",
    "var1", "auglag_lbfgs",        "cobyla", "bobyqa"};

struct Subject {
  std::string model, study;
};

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list = [] {
    std::vector<Subject> all;
    for (const char* shipped :
         {"slider_crank", "slider_crank_haug", "governor", "governor_multistart",
          "inverted_pendulum", "inverted_pendulum_frictionless", "pendulum_robust", "two_link_arm",
          "arm_limits", "gantry", "feed_axis"})
      all.push_back(
          {std::string("urdf/") + shipped + ".urdf", std::string("config/") + shipped + ".yaml"});
    for (const auto& [model, study] :
         {std::pair("arm", "pendulum_length"), std::pair("arm", "spring_balance"),
          std::pair("arm", "arm_pid"), std::pair("arm", "arm_torque_bound"),
          std::pair("arm", "arm_peak"), std::pair("four_bar", "four_bar_path"),
          std::pair("cart_pole", "cart_pole_feedback"), std::pair("cart_pole", "cart_pole_worst"),
          std::pair("cart_pole", "cart_pole_cvar"), std::pair("cart_pole", "cart_pole_deviation"),
          std::pair("cart_pole", "cart_pole_shape")})
      all.push_back({std::string("benchmark/stops/") + model + ".urdf",
                     std::string("benchmark/stops/") + study + ".yaml"});
    return all;
  }();
  return list;
}

/// One search, with the best feasible objective after each evaluation.
struct Run {
  OptimizationResult result;
  std::vector<double> best;

  /// The evaluation after which the objective is near `known`; nothing if it never is.
  std::optional<std::size_t> first_near(double known, double size) const {
    const auto found = std::find_if(best.begin(), best.end(),
                                    [&](double one) { return one <= known + kNear * size; });
    return found == best.end() ? std::nullopt
                               : std::optional(static_cast<std::size_t>(found - best.begin()) + 1);
  }
};

/// Nothing if the algorithm does not take the problem.
std::optional<Run> run(const Problem& problem, const std::string& algorithm) {
  OptimizerOptions options = problem.optimizer_options();
  options.algorithm = algorithm;
  Run run;
  const auto note = [&run](const Trial& trial) {
    const bool counts = trial.status.ok() && trial.best_violation == 0.0;
    run.best.push_back(counts ? trial.best_objective : std::numeric_limits<double>::infinity());
    return true;
  };
  try {
    run.result = optimize(problem, options, note);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return run;
}

bool is_feasible(const Run& run) {
  return run.result.status.ok() && !run.best.empty() && std::isfinite(run.best.back());
}

/// "21 of 25, 1e-06": near the best known objective after 21 of 25 evaluations, stationary to
/// 1e-06; or how far above it the search ended.
std::string cell(const std::optional<Run>& run, double known, double size) {
  if (!run) return "";
  const std::string evaluations = std::to_string(run->result.cost.evaluations);
  if (!is_feasible(*run)) return "failed, " + evaluations;
  const std::optional<std::size_t> near = run->first_near(known, size);
  const std::string where =
      near ? std::to_string(*near) + " of " + evaluations
           : "+" + one_digit((run->result.best.objective - known) / size) + " after " + evaluations;
  return where + ", " + one_digit(run->result.optimality.stationarity) +
         (run->result.termination == "stopped_early" ? " early" : "");
}

}  // namespace

void measure_stops(Report* report) {
  Table table{"stops", "Where each algorithm stops", {"study", "best known"}, {}};
  table.columns.insert(table.columns.end(), std::begin(kAlgorithms), std::end(kAlgorithms));
  for (const Subject& subject : subjects()) {
    const std::size_t slash = subject.study.rfind('/') + 1;
    const std::string name = subject.study.substr(slash, subject.study.rfind('.') - slash);
    const Problem problem =
        load_problem(read_source(subject.model), {}, read_source(subject.study));
    std::vector<std::optional<Run>> runs;
    for (const char* algorithm : kAlgorithms) runs.push_back(run(problem, algorithm));
    double known = std::numeric_limits<double>::infinity(), start = 0.0;
    for (const std::optional<Run>& one : runs) {
      if (!one || !is_feasible(*one)) continue;
      known = std::min(known, one->result.best.objective);
      start = one->result.initial.objective;
    }
    // What is a millionth of the objective at the start counts as zero.
    const double size = std::max(std::abs(known), 1e-6 * std::abs(start));
    std::vector<std::string> row{name, three_digits(known)};
    for (const std::optional<Run>& one : runs) row.push_back(cell(one, known, size));
    // A row takes minutes.
    for (const std::string& text : row) std::fprintf(stderr, "| %s ", text.c_str());
    std::fprintf(stderr, "|\n");
    table.rows.push_back(std::move(row));
  }
  report->tables.push_back(std::move(table));
}

}  // namespace codesign
