// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "benchmark/sundials_peer.h"
#include "benchmark/work_precision.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const std::vector<double> kTolerances = {1e-4, 6e-5, 3e-5, 2e-5, 1e-5, 6e-6, 3e-6,
                                         2e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9};
constexpr double kDefaultTolerance = 1e-6;  // a study's

/// The cost of a tolerance [s].
double seconds_at(double tolerance, const Sweep& sweep) {
  const auto found = std::find_if(sweep.begin(), sweep.end(), [tolerance](const Measured& point) {
    return point.tolerance == tolerance;
  });
  if (found == sweep.end()) throw std::logic_error("a tolerance that was not measured");
  return found->seconds;
}

Contestant sundials(const Problem& problem, const std::string& name, SundialsMatrix matrix,
                    const ReferenceValues& reference) {
  return {name,
          [problem, matrix, reference](double tolerance,
                                       bool with_gradient) -> std::function<Outcome()> {
            const auto peer = std::make_shared<SundialsPeer>(system_of(problem), matrix);
            return [peer, reference, tolerance, with_gradient] {
              const SundialsResult r = peer->run(tolerance, with_gradient);
              return r.ok ? outcome_of(reference, with_gradient, r.psi, r.gradient, r.steps)
                          : Outcome{};
            };
          }};
}

/// The cost of an accuracy by the fastest of the contestants from `first` on.
double fastest(double error, const std::vector<Sweep>& sweeps, std::size_t first) {
  double seconds = std::nan("");
  for (std::size_t c = first; c < sweeps.size(); ++c)
    seconds = std::fmin(seconds, seconds_to(error, sweeps[c]));
  return seconds;
}

}  // namespace

void measure_work_precision(Report* report) {
  const Problem problem = load_slider_crank();
  const ReferenceValues reference{kReferencePsi,
                                  Eigen::Map<const Eigen::VectorXd>(kReferenceGradient, 5)};
  std::vector<Contestant> contestants;
  for (const char* name : {"rodas4", "rodas4p2", "rodas5p"})
    contestants.push_back(own_solver(problem, name, reference));
  std::size_t ida = contestants.size();
  if (with_solver(problem, "idas", 1e-6))
    contestants.push_back(own_solver(problem, "idas", reference));
  contestants.push_back(
      sundials(problem, "SUNDIALS, KLU", SundialsMatrix::kSparseExact, reference));
  contestants.push_back(
      sundials(problem, "SUNDIALS, dense", SundialsMatrix::kDenseDifferences, reference));
  const std::vector<Sweep> simulation =
      race("simulation", "Simulation of the slider-crank over 2 s", false, contestants, kTolerances,
           report);
  const double own_simulation = seconds_to(1e-6, simulation[0]),
               peer_simulation = fastest(1e-6, simulation, ida);

  contestants.insert(contestants.begin(), own_solver(problem, kControlled, reference));
  ++ida;
  const std::vector<Sweep> gradient = race("gradient", "psi and its gradient by 5 parameters", true,
                                           contestants, kTolerances, report);

  const double own_gradient = seconds_to(1e-5, gradient[0]);
  const double ratio =
      seconds_at(kDefaultTolerance, gradient[1]) / seconds_at(kDefaultTolerance, simulation[0]);
  report->findings.push_back(
      {"simulation by rodas4, psi to 1e-6", "ms", 1e3 * own_simulation, 5.0, false});
  report->findings.push_back({"the same by the fastest IDAS, in times of rodas4", "",
                              peer_simulation / own_simulation, 4.0, true});
  report->findings.push_back(
      {"gradient by 5 parameters by rodas5p with controlled sensitivities, to 1e-5", "ms",
       1e3 * own_gradient, 25.0, false});
  report->findings.push_back({"the same by the fastest IDAS, in times of it", "",
                              fastest(1e-5, gradient, ida) / own_gradient, 6.0, true});
  report->findings.push_back(
      {"gradient by 5 parameters, in simulations, both by rodas4 at tolerance 1e-6", "", ratio, 4.0,
       false});
}

}  // namespace codesign
