// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "ensemble/scenario.h"
#include "integration/rosenbrock_integrator.h"
#include "jobs/job_files.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr std::size_t kLanes = 4;

/// Ends of the steps of one scenario's run, from 0 on [s].
std::vector<double> step_ends(const Scenario& scenario, const Eigen::VectorXd& rho) {
  RosenbrockIntegrator integrator(*scenario.system);
  const double end = scenario.system->study().duration;
  std::vector<double> times = {0.0};
  Status status = integrator.start(scenario.parameters(rho));
  while (status.ok() && times.back() < end) {
    status = integrator.advance(end);
    times.push_back(integrator.state().t);
  }
  if (!status.ok()) throw std::runtime_error(status.cause);
  return times;
}

/// Steps of runs that step together: at each time the smallest of the steps that they take there
/// alone.
std::size_t shared_steps(const std::vector<double>* first) {
  std::size_t at[kLanes] = {}, steps = 0;
  const double end = first->back() * (1.0 - 1e-12);
  for (double time = 0.0; time < end; ++steps) {
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::vector<double>& times = first[lane];
      while (at[lane] + 2 < times.size() && times[at[lane] + 1] <= time) ++at[lane];
      step = std::min(step, times[at[lane] + 1] - times[at[lane]]);
    }
    time += step;
  }
  return steps;
}

/// Least processor time of a few evaluations [s].
double evaluation_seconds(const Scenario& scenario, const Eigen::VectorXd& rho,
                          Derivatives derivatives) {
  Evaluator evaluator = evaluator_of(scenario.system);
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 5; ++repetition) {
    const CpuTimer timer;
    const Evaluation evaluation =
        evaluator.evaluate_design(scenario.parameters(rho), derivatives, nullptr);
    if (!evaluation.status.ok()) throw std::runtime_error(evaluation.status.cause);
    least = std::min(least, timer.seconds());
  }
  return least;
}

void add_row(const std::string& name, const Problem& problem, Table* table) {
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  const Eigen::VectorXd rho = problem.start();
  std::vector<std::vector<double>> runs;
  std::size_t alone = 0, shared = 0;
  for (const Scenario& scenario : scenarios) {
    runs.push_back(step_ends(scenario, rho));
    alone += runs.back().size() - 1;
  }
  // Neighbours in the number of steps are the most alike.
  std::sort(runs.begin(), runs.end(),
            [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (std::size_t k = 0; k + kLanes <= runs.size(); k += kLanes)
    shared += kLanes * shared_steps(&runs[k]);
  const double ratio = static_cast<double>(shared) / static_cast<double>(alone), lanes = kLanes;
  const double run = evaluation_seconds(scenarios.front(), rho, Derivatives::kNone);
  const double gradient = evaluation_seconds(scenarios.front(), rho, Derivatives::kGradient);
  table->rows.push_back(
      {name, three_digits(static_cast<double>(alone) / static_cast<double>(runs.size())),
       three_digits(ratio), three_digits(1e3 * run), three_digits(1e3 * gradient),
       three_digits(lanes / ratio),
       three_digits(gradient / (gradient - run + run * ratio / lanes))});
}

}  // namespace

void measure_lanes(Report* report) {
  Table table{"ensemble_lanes",
              "Steps of 32 samples alone, and of four samples that step together; what four lanes "
              "could gain at most, if a pass over four "
              "samples took no longer than over one",
              {"case", "steps alone", "shared / alone", "run, ms", "gradient, ms",
               "gain of runs at most", "of gradients at most"},
              {}};
  add_row("slider-crank, two masses",
          with_uncertain_masses(load_slider_crank(), 32, "{type: serial}"), &table);
  add_row("pendulum_robust, friction and its law",
          load_problem(read_source("urdf/pendulum_robust.urdf"), {},
                       read_source("config/pendulum_robust.yaml")),
          &table);
  report->tables.push_back(table);
}

}  // namespace codesign
