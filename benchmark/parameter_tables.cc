// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>

#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/timing.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/gradient_engine.h"

namespace codesign {
namespace {

constexpr int kLinks = 16;
const std::vector<int> kCounts = {1, 2, 4, 8, 16, 32, 64};

/// The chain with so many tuned parameters, ready to be evaluated by one kind of gradient.
struct Case {
  Case(int count, const std::string& gradient)
      : problem(load(count, gradient)), evaluator(problem), rho(problem.start()) {}

  static Problem load(int count, const std::string& gradient) {
    GeneratedCase chain = parametric_chain(kLinks, count);
    const std::string solver = "solver: {";
    chain.study.text.replace(chain.study.text.find(solver), solver.size(),
                             solver + "gradient: " + gradient + ", ");
    return load_problem(chain.urdf, {}, chain.study);
  }
  Evaluation evaluate(bool with_gradient) {
    Evaluation evaluation = evaluator.evaluate(rho, with_gradient);
    if (!evaluation.status.ok()) throw std::runtime_error(evaluation.status.cause);
    return evaluation;
  }

  Problem problem;
  Evaluator evaluator;
  Eigen::VectorXd rho;
};

}  // namespace

void measure_parameters(Report* report) {
  std::vector<std::unique_ptr<Case>> direct, adjoint;
  std::vector<Job> jobs;
  for (int count : kCounts) {
    direct.push_back(std::make_unique<Case>(count, "direct"));
    adjoint.push_back(std::make_unique<Case>(count, "adjoint"));
  }
  const std::int64_t steps = direct.front()->evaluate(false).statistics.steps;
  jobs.push_back(make_job("simulation", [&] { direct.front()->evaluate(false); }));
  for (std::size_t k = 0; k < kCounts.size(); ++k) {
    jobs.push_back(
        make_job("direct " + std::to_string(kCounts[k]), [&, k] { direct[k]->evaluate(true); }));
    jobs.push_back(
        make_job("adjoint " + std::to_string(kCounts[k]), [&, k] { adjoint[k]->evaluate(true); }));
  }
  const std::vector<double> seconds = median_cpu_seconds(jobs, 3);
  const auto direct_at = [&](std::size_t k) { return seconds[1 + 2 * k] / seconds[0]; };
  const auto adjoint_at = [&](std::size_t k) { return seconds[2 + 2 * k] / seconds[0]; };
  Table table{"parameters",
              "Gradient of a chain of " + std::to_string(kLinks) +
                  " links against the number of parameters (simulation: " +
                  three_digits(1e3 * seconds[0]) + " ms, " + std::to_string(steps) + " steps)",
              {"parameters", "direct, ms", "in simulations", "beyond the simulation, per parameter",
               "adjoint, ms", "in simulations", "auto"},
              {}};
  for (std::size_t k = 0; k < kCounts.size(); ++k) {
    const bool backwards = prefers_adjoint(*system_of(Case::load(kCounts[k], "auto")));
    table.rows.push_back({std::to_string(kCounts[k]), three_digits(1e3 * seconds[1 + 2 * k]),
                          three_digits(direct_at(k)),
                          three_digits((direct_at(k) - 1.0) / kCounts[k]),
                          three_digits(1e3 * seconds[2 + 2 * k]), three_digits(adjoint_at(k)),
                          backwards ? "adjoint" : "direct"});
  }
  const double slope =
      (direct_at(kCounts.size() - 1) - direct_at(3)) / (kCounts.back() - kCounts[3]);
  report->findings.push_back(
      {"gradient: each further parameter from 8 to 64, in simulations", "", slope, 1.0, false});
  report->findings.push_back(
      {"gradient for 64 parameters by the adjoint, in those by direct sensitivities", "",
       adjoint_at(6) / direct_at(6), 1.0, false});
  report->tables.push_back(table);
}

}  // namespace codesign
