// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/work_precision.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {
namespace {

constexpr double kAccuracies[] = {1e-4, 1e-5, 1e-6, 1e-7};

void add_runs(const std::string& name, const std::string& title,
              const std::vector<Contestant>& contestants, const std::vector<Sweep>& sweeps,
              Report* report) {
  Table table{name, title, {"tolerance"}, {}};
  for (const Contestant& contestant : contestants)
    for (const char* what : {": ms", ": steps", ": error"})
      table.columns.push_back(contestant.name + what);
  for (std::size_t k = 0; k < sweeps[0].size(); ++k) {
    std::vector<std::string> row = {one_digit(sweeps[0][k].tolerance)};
    for (const Sweep& sweep : sweeps) {
      row.push_back(three_digits(1e3 * sweep[k].seconds));
      row.push_back(std::to_string(sweep[k].outcome.steps));
      row.push_back(one_digit(sweep[k].outcome.error));
    }
    table.rows.push_back(row);
  }
  report->tables.push_back(table);
}

void add_accuracies(const std::string& name, const std::string& title,
                    const std::vector<Contestant>& contestants, const std::vector<Sweep>& sweeps,
                    Report* report) {
  Table table{name, title, {"solver"}, {}};
  for (double error : kAccuracies) {
    table.columns.push_back("ms at " + one_digit(error));
    table.columns.push_back("ratio");
  }
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    std::vector<std::string> row = {contestants[c].name};
    for (double error : kAccuracies) {
      const double seconds = seconds_to(error, sweeps[c]);
      row.push_back(three_digits(1e3 * seconds));
      row.push_back(three_digits(seconds / seconds_to(error, sweeps[0])));
    }
    table.rows.push_back(row);
  }
  report->tables.push_back(table);
}

}  // namespace

Outcome outcome_of(const ReferenceValues& reference, bool with_gradient, double psi,
                   const Eigen::VectorXd& gradient, long steps) {
  if (!with_gradient) return {std::abs(psi / reference.psi - 1.0), steps};
  return {(gradient.array() / reference.gradient.array() - 1.0).abs().maxCoeff(), steps};
}

Contestant own_solver(const Problem& problem, const std::string& name,
                      const ReferenceValues& reference) {
  return {
      name,
      [problem, name, reference](double tolerance, bool with_gradient) -> std::function<Outcome()> {
        const Problem changed = *with_solver(problem, name, tolerance);
        const auto evaluator = std::make_shared<Evaluator>(changed);
        return [evaluator, reference, rho = changed.start(), with_gradient] {
          const Evaluation e = evaluator->evaluate(rho, with_gradient);
          return e.status.ok() ? outcome_of(reference, with_gradient, e.objective, e.gradient,
                                            static_cast<long>(e.statistics.steps))
                               : Outcome{};
        };
      }};
}

double seconds_to(double error, const Sweep& sweep) {
  double seconds = std::nan("");
  for (auto run = sweep.rbegin(); run != sweep.rend() && run->outcome.error <= error; ++run)
    seconds = run->seconds;
  return seconds;
}

AtError interpolate(double error, const Sweep& sweep) {
  const auto values = [](const Measured& run) {
    return AtError{run.seconds, static_cast<double>(run.outcome.steps), run.tolerance};
  };
  if (!(sweep.back().outcome.error <= error)) return {};
  std::size_t k = sweep.size() - 1;
  while (k > 0 && sweep[k - 1].outcome.error <= error) --k;
  const AtError tight = values(sweep[k]);
  if (k == 0 || !(sweep[k - 1].outcome.error > error)) return tight;
  const AtError loose = values(sweep[k - 1]);
  const double share = std::log(error / sweep[k].outcome.error) /
                       std::log(sweep[k - 1].outcome.error / sweep[k].outcome.error);
  const auto between = [share](double from, double to) {
    return from * std::pow(to / from, share);
  };
  return {between(tight.seconds, loose.seconds), between(tight.steps, loose.steps),
          between(tight.tolerance, loose.tolerance)};
}

std::vector<Sweep> run_sweeps(const std::vector<Contestant>& contestants,
                              const std::vector<double>& tolerances, bool with_gradient) {
  std::vector<Sweep> sweeps(contestants.size());
  std::vector<Job> jobs;
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    for (double tolerance : tolerances) sweeps[c].push_back({tolerance, {}, 0.0});
    for (Measured& slot : sweeps[c]) {
      const std::function<Outcome()> run = contestants[c].prepare(slot.tolerance, with_gradient);
      jobs.push_back(make_job(contestants[c].name + " " + one_digit(slot.tolerance),
                              [run, &slot] { slot.outcome = run(); }));
    }
  }
  const std::vector<double> seconds = median_cpu_seconds(jobs, with_gradient ? 3 : 5, 0.01);
  std::size_t next = 0;
  for (Sweep& sweep : sweeps)
    for (Measured& run : sweep) run.seconds = seconds[next++];
  return sweeps;
}

std::vector<Sweep> race(const std::string& name, const std::string& what, bool with_gradient,
                        const std::vector<Contestant>& contestants,
                        const std::vector<double>& tolerances, Report* report) {
  std::vector<Sweep> sweeps = run_sweeps(contestants, tolerances, with_gradient);
  add_runs(name, what + ": CPU time, steps, relative error", contestants, sweeps, report);
  add_accuracies(name + "_at_accuracy",
                 what + ": CPU time at a given accuracy, and its ratio to the first row",
                 contestants, sweeps, report);
  return sweeps;
}

}  // namespace codesign
