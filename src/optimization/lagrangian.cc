// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/lagrangian.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "integration/simulation_of.h"
#include "math/arrays.h"
#include "mechanism_codesign/simulation.h"
#include "optimization/near_multipliers.h"
#include "problem/margins.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kAtBound = 1e-9;  // a variable nearer to its bound, in its unit, is on it

void add_bound(Index variable, double sign, double distance, std::vector<Holder>* holders) {
  if (!std::isfinite(distance)) return;
  Holder holder;
  holder.others.emplace_back(variable, sign);
  holder.is_bound = true;
  holder.distance = distance <= kAtBound ? 0.0 : distance;
  holders->push_back(std::move(holder));
}

/// The holder of a row c <= 0 or c = 0 with the value and derivatives of c.
void add_row(const SmoothProgram::Value& value, bool any_sign, const Scaling& scaling,
             std::vector<Holder>* holders) {
  Holder row;
  const std::vector<double> by_x = scaling.scale_gradient(value.by_rho);
  row.leading = -Eigen::Map<const Eigen::VectorXd>(by_x.data(), static_cast<Index>(by_x.size()));
  for (Index k = 0; k < value.by_slack.size(); ++k)
    if (value.by_slack[k] != 0.0)
      row.others.emplace_back(row.leading.size() + k, -value.by_slack[k]);
  row.distance = any_sign ? 0.0 : std::abs(value.value);
  row.any_sign = any_sign;
  if (row.leading.allFinite() && value.by_slack.allFinite() && std::isfinite(row.distance))
    holders->push_back(std::move(row));
}

/// The rows c <= 0 and c = 0 of the smooth program, and the parameter constraints -margin <= 0.
std::vector<Holder> rows_at(const Eigen::VectorXd& rho, const Eigen::VectorXd& y,
                            const Scaling& scaling, const ParameterRows& parameters,
                            const SmoothProgram& program, const std::atomic<bool>* cancel) {
  std::vector<Holder> rows;
  for (int i = 0; i < program.equalities(); ++i) add_row(program.equality(i), true, scaling, &rows);
  for (int i = 0; i < program.inequalities() && !(cancel && *cancel); ++i)
    add_row(program.inequality(i, y), false, scaling, &rows);
  for (const ParameterRows::Row& row : parameters.rows()) {
    SmoothProgram::Value value;
    value.value = -parameters.margin(row, rho, &value.by_rho);
    value.by_rho = -value.by_rho;
    value.by_slack.setZero(y.size());
    add_row(value, parameters.is_equality(row), scaling, &rows);
  }
  return rows;
}

}  // namespace

void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x) {
  const std::vector<double> scaled = scaling.scale_gradient(value.by_rho);
  std::copy(value.by_slack.begin(), value.by_slack.end(),
            std::copy(scaled.begin(), scaled.end(), by_x));
}

Optimality optimality(const EnsembleEvaluation& at, const Eigen::VectorXd& rho,
                      const Scaling& scaling, const ParameterRows& parameters,
                      SmoothProgram* program, const std::atomic<bool>* cancel) {
  // In the unit of the objective itself, so that its slack variables are of the magnitude of the
  // scaled parameters.
  const double unit = at.total.objective != 0.0 ? std::abs(at.total.objective) : 1.0;
  program->take(at, rho);
  const Eigen::VectorXd y = program->start(at, unit);
  const std::vector<double> x = scaling.to_scaled(rho), lower = scaling.lower(),
                            upper = scaling.upper();
  const auto tuned = static_cast<Index>(x.size()), size = tuned + y.size();
  Eigen::VectorXd gradient(size);
  if (program->slacks() > 0) {
    spread(program->objective(y), scaling, gradient.data());
  } else {
    const std::vector<double> scaled = scaling.scale_gradient(at.total.gradient);
    for (Index k = 0; k < tuned; ++k) gradient[k] = scaled[to_index(k)] / unit;
  }
  std::vector<Holder> holders = rows_at(rho, y, scaling, parameters, *program, cancel);
  const std::size_t rows = holders.size();
  for (Index k = 0; k < tuned; ++k) {
    const auto i = to_index(k);
    add_bound(k, 1.0, x[i] - lower[i], &holders);
    add_bound(k, -1.0, upper[i] - x[i], &holders);
  }
  for (Index k = 0; k < y.size(); ++k)
    add_bound(tuned + k, 1.0, y[k] - program->lower(static_cast<int>(k)), &holders);
  const Multipliers multipliers = least_multipliers(gradient, holders, cancel);
  Optimality result;
  result.slope = multipliers.residual * unit;
  result.factorizations = multipliers.factorizations;
  result.bounds.setZero(tuned);
  std::vector<Eigen::VectorXd> active;
  for (std::size_t k = 0; k < holders.size(); ++k) {
    const double c = multipliers.values[static_cast<Index>(k)];
    // An equality holds whatever it is worth.
    if (k < rows && (c != 0.0 || holders[k].any_sign)) active.push_back(holders[k].leading);
    if (holders[k].is_on_bound() && holders[k].others[0].first < tuned)
      result.bounds[holders[k].others[0].first] += c * holders[k].others[0].second * unit;
  }
  result.active.resize(tuned, static_cast<Index>(active.size()));
  for (std::size_t k = 0; k < active.size(); ++k)
    result.active.col(static_cast<Index>(k)) = active[k];
  return result;
}

double tolerance_of_range(const WatchedResult& watched) {
  double range = 0.0;
  for (const double value : {watched.smallest, watched.largest, watched.lower, watched.upper})
    if (std::isfinite(value)) range = std::max(range, std::abs(value));
  return std::max(kMostViolation, kShareOfRange * range);
}

void count_range_of_run(const Scenario& scenario, const Eigen::VectorXd& rho,
                        const std::atomic<bool>* cancel, std::vector<WatchedResult>* watched) {
  constexpr int kInstants = 201;
  const std::vector<WatchedSignal>& bounds = scenario.system->whole_study().watched;
  std::vector<SignalDescription> signals;
  std::vector<std::size_t> places;
  // Behind those of the scenario are terms of others, which have no bounds.
  for (std::size_t k = 0; k < std::min(bounds.size(), watched->size()); ++k) {
    if (bounds[k].role != WatchedSignal::Role::kFinal || bounds[k].tolerance) continue;
    signals.push_back(bounds[k].signal);
    places.push_back(k);
  }
  if (places.empty()) return;
  Simulation simulation = simulation_of(scenario.system, scenario.parameters(rho), signals);
  // The status does not matter: a run that fails was long enough for what it has shown.
  const auto widen = [&](const Frame& frame) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      double* tolerance = &(*watched)[places[k]].tolerance;
      *tolerance = std::max(*tolerance, kShareOfRange * std::abs(frame.signals[k]));
    }
    return true;
  };
  simulate(&simulation, scenario.system->whole_study().duration, kInstants, widen, cancel);
}

bool meets_constraints(const Study& study, const OptimizationResult& result) {
  return all_met(study, result.constraints.margins) &&
         std::all_of(
             result.constraints.watched.begin(), result.constraints.watched.end(),
             [](const WatchedResult& watched) { return watched.violation <= watched.tolerance; });
}

std::string describe_violated(const std::vector<WatchedResult>& watched) {
  std::string list;
  for (const WatchedResult& result : watched) {
    if (!(result.violation > result.tolerance)) continue;
    list += (list.empty() ? "" : "; ") + result.element + " (" + result.signal + ") goes from " +
            to_decimal(result.smallest) + " to " + to_decimal(result.largest) +
            ", beyond its bounds by " + to_decimal(result.violation) +
            " (tolerance: " + to_decimal(result.tolerance) + ")";
  }
  return "no point was found that keeps the bounds of all signals: " + list;
}

}  // namespace codesign
