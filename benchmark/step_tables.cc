// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "benchmark/core_access.h"
#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kInstant = 0.3, kStepSize = 1e-3, kTolerance = 1e-6;

void add_pieces(const Problem& problem, Report* report) {
  StepProbe probe(system_of(problem), kInstant, kStepSize);
  if (!probe.status().ok()) throw std::runtime_error(probe.status().cause);
  const auto rewind = [&probe] { probe.rewind(); };
  const std::vector<double> seconds =
      median_cpu_seconds({make_job("residual", [&probe] { probe.residual(); }),
                          make_job("linearize", [&probe] { probe.linearize(); }),
                          make_job("factor", [&probe] { probe.factor(); }),
                          make_job("solve", [&probe] { probe.solve(); }),
                          make_job(
                              "attempt", [&probe] { probe.attempt(); }, rewind),
                          make_job(
                              "step", [&probe] { probe.step(); }, rewind)});
  const double residual = seconds[0], linearize = seconds[1], factor = seconds[2],
               solve = seconds[3], attempt = seconds[4], step = seconds[5];
  const int stages = probe.stages();
  const std::string size = std::to_string(probe.matrix_size());
  Table table{
      "step",
      "Cost of one step of rodas4 on the slider-crank (matrix of " + size + " by " + size + ")",
      {"piece", "us each", "per step", "us per step", "share of a step"},
      {}};
  const auto add = [&](const std::string& name, double each, int count) {
    table.rows.push_back({name, three_digits(1e6 * each), std::to_string(count),
                          three_digits(1e6 * each * count),
                          three_digits(100.0 * each * count / step) + " %"});
  };
  add("residual G, g", residual, stages);
  add("linearize: G_q, G_v, G_z, g_y", linearize, 1);
  add("factor", factor, 2);
  add("solve", solve, stages + 2);
  add("rest of the stages: products, sums", (attempt - factor - stages * (residual + solve)), 1);
  add("rest of the projection", (step - attempt - linearize - factor - 2 * solve), 1);
  add("one whole step", step, 1);
  report->tables.push_back(table);
}

/// What the equations cost where there is no machine code.
void add_interpreter(const Problem& problem, Report* report) {
  StepProbe probe(system_of(problem), kInstant, kStepSize);
  if (!probe.status().ok()) throw std::runtime_error(probe.status().cause);
  const std::vector<double> seconds = median_cpu_seconds(
      {make_job("residual", [&probe] { probe.residual(); }),
       make_job("interpreted residual", [&probe] { probe.interpret_residual(); }),
       make_job("linearize", [&probe] { probe.linearize(); }),
       make_job("interpreted linearize", [&probe] { probe.interpret_linearize(); })});
  Table table{"interpreter",
              "The equations of the slider-crank, interpreted",
              {"function", "machine code, us", "interpreted, us", "ratio"},
              {}};
  const auto add = [&](const char* name, double compiled, double interpreted) {
    table.rows.push_back({name, three_digits(1e6 * compiled), three_digits(1e6 * interpreted),
                          three_digits(interpreted / compiled)});
    report->findings.push_back({std::string("interpreter: ") + name + ", in times of machine code",
                                "", interpreted / compiled, 15.0, false});
  };
  add("residual G, g", seconds[0], seconds[1]);
  add("linearize: G_q, G_v, G_z, g_y", seconds[2], seconds[3]);
  report->tables.push_back(table);
}

/// From the public interface: what a gradient costs beyond its simulation, per step.
void add_tangents(const Problem& problem, Report* report) {
  std::vector<std::unique_ptr<Evaluator>> evaluators;
  std::vector<Problem> problems;
  std::vector<Job> jobs;
  const std::vector<int> counts = {1, 4, 5, 8};
  for (int count : counts) {
    problems.push_back(with_tuned(problem, count));
    evaluators.push_back(std::make_unique<Evaluator>(problems.back()));
  }
  Evaluation evaluation = evaluators[0]->evaluate(problems[0].start(), false);
  if (!evaluation.status.ok()) throw std::runtime_error(evaluation.status.cause);
  jobs.push_back(
      make_job("simulation", [&] { evaluators[0]->evaluate(problems[0].start(), false); }));
  for (std::size_t k = 0; k < counts.size(); ++k)
    jobs.push_back(make_job("gradient " + std::to_string(counts[k]),
                            [&, k] { evaluators[k]->evaluate(problems[k].start(), true); }));
  const std::vector<double> seconds = median_cpu_seconds(jobs, 5);
  const auto steps = static_cast<double>(evaluation.statistics.steps);
  Table table{"tangent",
              "Cost of the tangent of a step of rodas4 on the slider-crank",
              {"parameters", "us per step", "in steps", "per parameter, in steps"},
              {}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double tangent = seconds[k + 1] - seconds[0];
    table.rows.push_back({std::to_string(counts[k]), three_digits(1e6 * tangent / steps),
                          three_digits(tangent / seconds[0]),
                          three_digits(tangent / seconds[0] / counts[k])});
  }
  report->tables.push_back(table);
}

}  // namespace

void measure_steps(Report* report) {
  const std::optional<Problem> problem = with_solver(load_slider_crank(), "rodas4", kTolerance);
  add_pieces(*problem, report);
  add_interpreter(*problem, report);
  add_tangents(*problem, report);
}

}  // namespace codesign
