// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

/// From the files to the answer.
OptimizationResult whole_optimization(const std::string& solver, double tolerance) {
  const std::optional<Problem> problem = with_solver(load_slider_crank(), solver, tolerance);
  return optimize(*problem);
}

struct Way {
  std::string solver;
  double tolerance;
};

}  // namespace

void measure_optimization(Report* report) {
  std::vector<Way> ways = {{kControlled, 1e-4}, {"rodas4", 1e-6}, {"rodas5p", 1e-8}};
  if (with_solver(load_slider_crank(), "idas", 1e-6)) ways.push_back({"idas", 1e-6});
  std::vector<OptimizationResult> results(ways.size());
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < ways.size(); ++k)
    jobs.push_back(make_job(ways[k].solver + " " + one_digit(ways[k].tolerance),
                            [way = ways[k], result = &results[k]] {
                              *result = whole_optimization(way.solver, way.tolerance);
                            }));
  jobs.push_back(make_job("reading", [] { load_slider_crank(); }));
  const std::vector<double> seconds = median_cpu_seconds(jobs, 3);
  for (const OptimizationResult& result : results)
    if (!result.status.ok()) throw std::runtime_error(result.status.cause);
  Table table{"optimization",
              "Whole optimization of the slider-crank with its parameter constraint, from the "
              "files to the answer",
              {"solver", "tolerance", "ms", "ratio", "psi", "psi / reference - 1", "evaluations",
               "failed trials"},
              {}};
  for (std::size_t k = 0; k < ways.size(); ++k)
    table.rows.push_back({ways[k].solver, one_digit(ways[k].tolerance),
                          three_digits(1e3 * seconds[k]), three_digits(seconds[k] / seconds[0]),
                          three_digits(results[k].best.objective),
                          one_digit(results[k].best.objective / kReferenceOptimum - 1.0),
                          std::to_string(results[k].cost.evaluations),
                          std::to_string(results[k].cost.failed_evaluations)});
  table.rows.push_back({"reading and compiling alone", "", three_digits(1e3 * seconds.back()),
                        three_digits(seconds.back() / seconds[0]), "", "", "", ""});
  report->findings.push_back({"whole optimization", "ms", 1e3 * seconds[0], 500.0, false});
  report->tables.push_back(table);
}

}  // namespace codesign
