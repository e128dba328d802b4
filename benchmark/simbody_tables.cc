// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>

#include "benchmark/report.h"
#include "benchmark/simbody_peer.h"
#include "benchmark/slider_crank.h"
#include "benchmark/work_precision.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

const std::vector<double> kTolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};

/// Central differences, with the step that balances their error against the integration's.
Eigen::VectorXd simbody_gradient(const Eigen::VectorXd& rho, double accuracy, long* steps) {
  Eigen::VectorXd gradient(rho.size());
  const double relative_step = 0.2 * std::cbrt(accuracy);
  for (Eigen::Index k = 0; k < rho.size(); ++k) {
    double difference = 0.0;
    const double h = relative_step * rho[k];
    for (const double sign : {1.0, -1.0}) {
      Eigen::VectorXd moved = rho;
      moved[k] += sign * h;
      const SimbodyResult result = run_simbody(moved[0], moved[1], moved[2], accuracy);
      difference += sign * result.psi;
      *steps += result.steps;
    }
    gradient[k] = difference / (2.0 * h);
  }
  return gradient;
}

Contestant simbody(const Eigen::VectorXd& rho, const ReferenceValues& reference) {
  return {"Simbody",
          [rho, reference](double accuracy, bool with_gradient) -> std::function<Outcome()> {
            return [rho, reference, accuracy, with_gradient] {
              const SimbodyResult run = run_simbody(rho[0], rho[1], rho[2], accuracy);
              long steps = run.steps;
              const Eigen::VectorXd gradient =
                  with_gradient ? simbody_gradient(rho, accuracy, &steps) : Eigen::VectorXd();
              return outcome_of(reference, with_gradient, run.psi, gradient, steps);
            };
          }};
}

}  // namespace

void measure_simbody(Report* report) {
  const Problem problem = with_dry_friction(load_slider_crank());
  const Problem tight = *with_solver(problem, "rodas5p", 1e-10);
  const Evaluation evaluation = Evaluator(tight).evaluate(tight.start(), true);
  if (!evaluation.status.ok()) throw std::runtime_error(evaluation.status.cause);
  const ReferenceValues reference{evaluation.objective, evaluation.gradient};
  const Eigen::VectorXd rho = problem.start();
  if (!(std::abs(run_simbody(rho[0], rho[1], rho[2], 1e-9).psi / reference.psi - 1.0) < 1e-7))
    throw std::runtime_error("Simbody's slider-crank is not the same as ours");
  const std::vector<Contestant> contestants = {own_solver(problem, "rodas4", reference),
                                               simbody(rho, reference)};
  const std::vector<Sweep> simulation =
      race("simbody_simulation", "Simulation with friction that does not depend on reactions",
           false, contestants, kTolerances, report);
  const std::vector<Sweep> gradient = race(
      "simbody_gradient", "psi and its gradient by 3 parameters, Simbody's by central differences",
      true, contestants, kTolerances, report);
  report->findings.push_back({"Simbody, psi to 1e-6, in times of ours", "",
                              seconds_to(1e-6, simulation[1]) / seconds_to(1e-6, simulation[0]),
                              1.0, true});
  report->findings.push_back({"Simbody with differences, gradient to 1e-4, in times of ours", "",
                              seconds_to(1e-4, gradient[1]) / seconds_to(1e-4, gradient[0]), 1.0,
                              true});
}

}  // namespace codesign
