// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/violated_bounds.h"

#include <algorithm>
#include <cmath>

#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"
#include "problem/margins.h"
#include "text/decimal.h"

namespace codesign {

double tolerance_of_range(const WatchedResult& watched) {
  double range = 0.0;
  for (const double value :
       {watched.initial_smallest, watched.initial_largest, watched.smallest, watched.largest, watched.lower, watched.upper})
    if (std::isfinite(value)) range = std::max(range, std::abs(value));
  return std::max(kMostViolation, kShareOfRange * range);
}

void count_range_of_run(const Scenario& scenario, const Eigen::VectorXd& rho, const std::atomic<bool>* cancel,
                        std::vector<WatchedResult>* watched) {
  constexpr int kInstants = 201;
  const std::vector<WatchedSignal>& bounds = scenario.system->study().watched;
  std::vector<SignalDescription> signals;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < watched->size(); ++k) {
    if (bounds[k].role != WatchedSignal::Role::kFinal || bounds[k].tolerance) continue;
    signals.push_back(bounds[k].signal);
    places.push_back(k);
  }
  if (places.empty()) return;
  Simulation simulation(scenario.system, scenario.parameters(rho), signals);
  // The status does not matter: a run that fails was long enough for what it has shown.
  const auto widen = [&](const Frame& frame) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      double* tolerance = &(*watched)[places[k]].tolerance;
      *tolerance = std::max(*tolerance, kShareOfRange * std::abs(frame.signals[k]));
    }
    return true;
  };
  simulate(&simulation, scenario.system->study().duration, kInstants, widen, cancel);
}

bool meets_constraints(const OptimizationResult& result) {
  return all_met(result.margins) && std::all_of(result.watched.begin(), result.watched.end(),
                                                [](const WatchedResult& watched) { return watched.violation <= watched.tolerance; });
}

std::string describe_violated(const std::vector<WatchedResult>& watched) {
  std::string list;
  for (const WatchedResult& result : watched) {
    if (!(result.violation > result.tolerance)) continue;
    list += (list.empty() ? "" : "; ") + result.element + " (" + result.signal + ") goes from " + to_decimal(result.smallest) + " to " +
            to_decimal(result.largest) + ", beyond its bounds by " + to_decimal(result.violation) +
            " (tolerance: " + to_decimal(result.tolerance) + ")";
  }
  return "no point was found that keeps the bounds of all signals: " + list;
}

}  // namespace codesign
