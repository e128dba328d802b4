// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>

#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/timing.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

// [s]; held by the study, so that every size does the same work per step.
constexpr double kStep = 1e-3;

/// A simulation that takes one step per call.
class Stepper {
 public:
  explicit Stepper(const GeneratedCase& generated)
      : problem_(in_equal_steps(load_problem(generated.urdf, {}, generated.study))),
        simulation_(std::make_unique<Simulation>(problem_, problem_.parameters())) {
    restart();
  }

  int bodies() const { return system_of(problem_)->layout().bodies; }
  void restart() {
    time_ = 0.0;
    require(simulation_->start());
  }
  void step() { require(simulation_->advance(time_ += kStep)); }
  /// Steps and attempts per call, which should be one.
  double steps_per_call() {
    restart();
    for (int k = 0; k < 20; ++k) step();
    return static_cast<double>(simulation_->statistics().steps +
                               simulation_->statistics().rejected_steps) /
           20.0;
  }

 private:
  static Problem in_equal_steps(const Problem& problem) {
    Study study = study_of(problem);
    study.solver.initial_step = study.solver.maximum_step = kStep;
    study.solver.relative_tolerance = study.solver.absolute_tolerance = 0.1;
    return with_study(problem, std::move(study));
  }
  static void require(const Status& status) {
    if (!status.ok()) throw std::runtime_error(status.cause);
  }

  const Problem problem_;
  std::unique_ptr<Simulation> simulation_;
  double time_ = 0.0;
};

double slope(double x0, double y0, double x1, double y1) {
  return std::log(y1 / y0) / std::log(x1 / x0);
}

void add_table(const std::string& name, const std::string& title, GeneratedCase (*generate)(int),
               Report* report) {
  const std::vector<int> sizes = {1, 2, 4, 8, 16, 32, 64};
  std::vector<std::unique_ptr<Stepper>> steppers;
  std::vector<Job> jobs;
  std::vector<double> calls;
  for (int size : sizes) {
    steppers.push_back(std::make_unique<Stepper>(generate(size)));
    Stepper* stepper = steppers.back().get();
    calls.push_back(stepper->steps_per_call());
    jobs.push_back(make_job(
        std::to_string(size), [stepper] { stepper->step(); }, [stepper] { stepper->restart(); }));
  }
  std::vector<double> seconds = median_cpu_seconds(jobs, 5);
  for (std::size_t k = 0; k < sizes.size(); ++k) seconds[k] /= calls[k];
  Table table{
      "scaling_" + name,
      title,
      {"N", "bodies", "us per step", "us per step and body", "log-log slope from the row above"},
      {}};
  for (std::size_t k = 0; k < sizes.size(); ++k)
    table.rows.push_back(
        {std::to_string(sizes[k]), std::to_string(steppers[k]->bodies()),
         three_digits(1e6 * seconds[k]), three_digits(1e6 * seconds[k] / steppers[k]->bodies()),
         k == 0 ? "" : three_digits(slope(sizes[k - 1], seconds[k - 1], sizes[k], seconds[k]))});
  const double total = slope(8, seconds[3], 64, seconds[6]);
  table.rows.push_back({"8 to 64", "", "", "", three_digits(total)});
  report->findings.push_back(
      {"log-log slope of the cost per step, " + name + ", N = 8 to 64", "", total, 1.15, false});
  report->tables.push_back(table);
}

}  // namespace

void measure_scaling(Report* report) {
  add_table("chain", "Cost per step of an open chain of N links", open_chain, report);
  add_table("ladder", "Cost per step of a ladder of N closed loops", ladder, report);
}

}  // namespace codesign
