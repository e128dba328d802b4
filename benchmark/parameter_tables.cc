// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/timing.h"
#include "mechanism_codesign/optimization/problem.h"
#include "mechanism_codesign/sensitivity/evaluation.h"

namespace codesign {
namespace {

constexpr int kLinks = 16;

}  // namespace

void measure_parameters(Report* report) {
  const std::vector<int> counts = {1, 2, 4, 8, 16, 32, 64};
  std::vector<Problem> problems;
  std::vector<Evaluator> evaluators;
  std::vector<Job> jobs;
  for (int count : counts) {
    const GeneratedCase chain = parametric_chain(kLinks, count);
    problems.push_back(load_problem(chain.urdf, {}, chain.study));
    evaluators.emplace_back(problems.back().system);
  }
  const Evaluation evaluation = evaluators.front().evaluate(problems.front().start(), false);
  if (!evaluation.status.ok()) throw std::runtime_error(evaluation.status.cause);
  jobs.push_back(make_job("simulation", [&] { evaluators[0].evaluate(problems[0].start(), false); }));
  for (std::size_t k = 0; k < counts.size(); ++k)
    jobs.push_back(make_job("direct " + std::to_string(counts[k]), [&, k] { evaluators[k].evaluate(problems[k].start(), true); }));
  const std::vector<double> seconds = median_cpu_seconds(jobs, 3);
  Table table{"parameters",
              "Gradient of a chain of " + std::to_string(kLinks) + " links against the number of parameters (simulation: " +
                  three_digits(1e3 * seconds[0]) + " ms, " + std::to_string(evaluation.statistics.steps) + " steps)",
              {"parameters", "direct, ms", "in simulations", "beyond the simulation, per parameter, in simulations"},
              {}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double direct = seconds[k + 1] / seconds[0];
    table.rows.push_back(
        {std::to_string(counts[k]), three_digits(1e3 * seconds[k + 1]), three_digits(direct), three_digits((direct - 1.0) / counts[k])});
  }
  const double slope = (seconds.back() - seconds[4]) / (counts.back() - counts[3]) / seconds[0];
  report->findings.push_back({"gradient: each further parameter from 8 to 64, in simulations", "", slope, 1.0, false});
  report->tables.push_back(table);
}

}  // namespace codesign
