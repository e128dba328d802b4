// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/ensemble.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "problem/load_problem.h"
#include "sampling/measure.h"
#include "sensitivity/gradient_check.h"
#include "text/number_text.h"

namespace codesign {
namespace {

Scenario own_run(std::shared_ptr<const CompiledSystem> system) {
  Scenario scenario;
  scenario.system = std::move(system);
  return scenario;
}

/// Adds the warnings whose code is new at their place: scenarios differ in the numbers of their
/// messages.
void add_new_codes(const Warnings& warnings, Warnings* all) {
  const auto same = [](const Warning& a, const Warning& b) {
    return a.code == b.code && a.where.file == b.where.file && a.where.line == b.where.line;
  };
  for (const Warning& warning : warnings)
    if (std::none_of(all->begin(), all->end(),
                     [&](const Warning& known) { return same(known, warning); }))
      all->push_back(warning);
}

/// The index of the largest objective among the evaluations that did not fail.
std::size_t worst_of(const std::vector<Evaluation>& members) {
  std::size_t worst = members.size();
  for (std::size_t k = 0; k < members.size(); ++k)
    if (members[k].status.ok() &&
        (worst == members.size() || members[k].objective > members[worst].objective))
      worst = k;
  return worst;
}

Status named(const Status& status, const Scenario& scenario) {
  return {status.code, status.time, scenario.name() + ": " + status.cause};
}

}  // namespace

Ensemble::Ensemble(std::vector<Scenario> scenarios, const RobustOptions& options,
                   std::shared_ptr<EvaluationEngine> engine)
    : scenarios_(std::move(scenarios)),
      options_(options),
      weights_(to_signed(scenarios_.size())),
      engine_(std::move(engine)) {
  for (std::size_t k = 0; k < scenarios_.size(); ++k) weights_[to_signed(k)] = scenarios_[k].weight;
}

Ensemble::Ensemble(const Problem& problem, int designs, EngineRecords records)
    : Ensemble(make_scenarios(problem), study_of(problem).ensemble.robust_options(), nullptr) {
  const auto most_useful = designs * static_cast<std::int64_t>(scenarios_.size());
  std::unique_ptr<EvaluationEngine> engine = make_engine(problem, most_useful, records.ranks);
  engine_ = with_records(std::move(engine), std::move(records));
}

Ensemble::Ensemble(std::shared_ptr<const CompiledSystem> system)
    : Ensemble({own_run(std::move(system))}, RobustOptions{},
               make_engine({EngineKind::kSerial, 0}, 1)) {}

Ensemble Ensemble::with(Scenario scenario) const {
  std::vector<Scenario> all = scenarios_;
  const double sum = 1.0 + scenario.weight;
  scenario.sample = all.back().sample + 1;
  all.push_back(std::move(scenario));
  for (Scenario& one : all) one.weight /= sum;
  return Ensemble(std::move(all), options_, engine_);
}

std::vector<EvaluationTask> tasks_at(const std::vector<Scenario>& scenarios,
                                     const Eigen::VectorXd& rho, Derivatives derivatives) {
  std::vector<EvaluationTask> tasks;
  tasks.reserve(scenarios.size());
  for (const Scenario& scenario : scenarios)
    tasks.push_back({scenario.system, scenario.parameters(rho), derivatives});
  return tasks;
}

EnsembleEvaluation Ensemble::evaluate(const Eigen::VectorXd& rho, Derivatives derivatives,
                                      const std::atomic<bool>* cancel) const {
  const bool with_gradient = derivatives != Derivatives::kNone;
  std::vector<Evaluation> members =
      engine_->evaluate(tasks_at(scenarios_, rho, derivatives), cancel);
  EnsembleEvaluation result;
  if (scenarios_.size() == 1) {
    result.total = std::move(members.front());
    add_new_codes(engine_->warnings(), &result.total.warnings);
    if (!result.total.status.ok()) return result;
    result.values = Eigen::VectorXd::Constant(1, result.total.objective);
    result.by_value = Eigen::VectorXd::Ones(1);
    if (with_gradient) result.gradients = result.total.gradient;
    if (result.total.extremes.values.size() > 0) result.extremes = {result.total.extremes};
    return result;
  }
  for (std::size_t k = 0; k < members.size(); ++k) {
    members[k].objective = (members[k].objective - scenarios_[k].offset) / scenarios_[k].scale;
    members[k].gradient /= scenarios_[k].scale;
  }
  for (const Evaluation& member : members) {
    result.total.statistics += member.statistics;
    add_new_codes(member.warnings, &result.total.warnings);
    result.total.events.count += member.events.count;
  }
  result.total.events.list = std::move(members.front().events.list);
  add_new_codes(engine_->warnings(), &result.total.warnings);
  if (!collect(members, with_gradient, &result)) return result;
  const bool is_watched = std::any_of(members.begin(), members.end(), [](const Evaluation& member) {
    return member.extremes.values.size() > 0;
  });
  for (std::size_t k = 0; is_watched && k < members.size(); ++k)
    result.extremes.push_back(std::move(members[k].extremes));
  const Measured measured = measure(options_, result.values, weights_);
  result.total.objective = measured.value;
  result.by_value = measured.by_value;
  result.threshold = measured.threshold;
  if (with_gradient) result.total.gradient = result.gradients * measured.by_value;
  if (derivatives == Derivatives::kGaussNewton) combine_roots(members, &result);
  check_finite(scenarios_.front().system->whole_study().duration, &result);
  return result;
}

/// The objective of each scenario is finite; sums and squares of them may overflow.
void Ensemble::check_finite(double time, EnsembleEvaluation* result) const {
  Evaluation& total = result->total;
  const std::string measure_name =
      std::string("the measure ") + kRobustMeasureNames[to_index(options_.measure)];
  if (!std::isfinite(total.objective))
    total.status = {
        StatusCode::kNonFinite, time,
        measure_name + " of the scenarios' objectives is not finite, though each of them is"};
  else if (!total.gradient.allFinite() || !total.jacobian_root.allFinite())
    total.status = {StatusCode::kNonFiniteGradient, time,
                    "the gradient of " + measure_name + " is not finite, though the measure is"};
  if (!total.status.ok()) result->values.resize(0);
}

/// The residuals of the mean are the residuals of all scenarios, each times the square root of the
/// scenario's weight.
void Ensemble::combine_roots(const std::vector<Evaluation>& members,
                             EnsembleEvaluation* result) const {
  const Eigen::Index columns = result->gradients.rows();
  RowRoot root;
  root.start(columns);
  for (std::size_t k = 0; k < members.size(); ++k) {
    // A failed scenario counts with the worst evaluation of the others.
    const Evaluation& member = members[k].status.ok() ? members[k] : members[worst_of(members)];
    const Eigen::MatrixXd weighted =
        std::sqrt(scenarios_[k].weight) * member.jacobian_root.transpose();
    for (Eigen::Index row = 0; row < columns; ++row) root.add(weighted.col(row));
  }
  result->total.jacobian_root = root.root();
}

/// Collects values and gradients. Returns false, with the status of the failure, if a scenario
/// failed that must not fail.
bool Ensemble::collect(const std::vector<Evaluation>& members, bool with_gradient,
                       EnsembleEvaluation* result) const {
  std::vector<std::size_t> failed;
  const auto count = to_signed(scenarios_.size());
  result->values.resize(count);
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Evaluation& member = members[k];
    const auto column = to_signed(k);
    if (!member.status.ok()) {
      const bool interrupted = member.status.is_interrupted();
      // Constraints need the extreme values of every sample, and a failed sample has none.
      const bool is_constrained = !scenarios_[k].system->whole_study().watched.empty();
      if (options_.failed == FailedSamples::kRefuse || interrupted || is_constrained) {
        result->total.status = interrupted ? member.status : named(member.status, scenarios_[k]);
        result->values.resize(0);
        return false;
      }
      failed.push_back(k);
      continue;
    }
    result->values[column] = member.objective;
    if (!with_gradient) continue;
    if (result->gradients.size() == 0) result->gradients.setZero(member.gradient.size(), count);
    result->gradients.col(column) = member.gradient;
  }
  return failed.empty() || fill_tail(failed, members, result);
}

/// Gives each failed scenario the value and gradient of the worst scenario that did not fail. False
/// if more scenarios failed than the tail holds.
bool Ensemble::fill_tail(const std::vector<std::size_t>& failed,
                         const std::vector<Evaluation>& members, EnsembleEvaluation* result) const {
  double weight = 0.0;
  for (std::size_t k : failed) weight += scenarios_[k].weight;
  if (weight > 1.0 - options_.level) {
    result->total.status = named(members[failed.front()].status, scenarios_[failed.front()]);
    result->total.status.cause += "; " + std::to_string(failed.size()) + " of " +
                                  std::to_string(scenarios_.size()) +
                                  " scenarios failed, more than the tail holds";
    result->values.resize(0);
    return false;
  }
  const auto worst = to_signed(worst_of(members));
  for (std::size_t k : failed) {
    const auto column = to_signed(k);
    result->values[column] = result->values[worst];
    if (result->gradients.size() > 0) result->gradients.col(column) = result->gradients.col(worst);
  }
  result->failed.assign(failed.begin(), failed.end());
  result->total.warnings.push_back(
      warn("scenarios_failed",
           {options_.where, "robust.failed",
            std::to_string(failed.size()) + " of " + std::to_string(scenarios_.size()) +
                " scenarios could not be integrated at this design and count as the worst of the "
                "others, the first is " +
                named(members[failed.front()].status, scenarios_[failed.front()]).cause +
                "; narrow what is uncertain, or write failed: refuse",
            kFailedSamplesNames[to_index(options_.failed)], ""}));
  return true;
}

namespace {

constexpr double kCoarse = 0.01;  // share of a gradient that its steps may change

/// Whether the gradient through finer steps differs by more than what moves no optimum, as
/// differences of the objective tell it: beside an optimum, where the gradient is what the
/// tolerances leave, a change by its whole size means nothing. True if they tell nothing.
bool change_counts(const GradientCheck& check) {
  const IndependentCheck& known = check.independent;
  const Eigen::VectorXd& gradient = check.evaluation.gradient;
  if (!known.is_known()) return true;
  const double bound = known.allowed + known.error;
  const auto size = [&](const Eigen::VectorXd& direction) {
    return direction.cwiseProduct(gradient).cwiseAbs().maxCoeff();
  };
  if (check.directions.size() == 0)
    return (check.finer - gradient).cwiseProduct(known.direction).cwiseAbs().maxCoeff() > bound;
  for (Eigen::Index k = 0; k < check.directions.cols(); ++k) {
    const Eigen::VectorXd direction = check.directions.col(k);
    const double change = std::abs(direction.dot(gradient) - check.finer[k]), of = size(direction);
    if (of > 0.0 ? change * size(known.direction) / of > bound : change > 0.0) return true;
  }
  return false;
}

/// @param directions how many; 0: by each parameter.
GradientCheck checked(const Ensemble& ensemble, const Eigen::VectorXd& rho, CheckMethod method,
                      int directions, const std::atomic<bool>* cancel) {
  EnsembleEvaluation all = ensemble.evaluate(rho, true, cancel);
  GradientCheck check;
  check.evaluation = std::move(all.total);
  check.status = check.evaluation.status;
  if (!check.status.ok()) return check;
  if (directions > 0) check.directions = check_directions(check.evaluation.gradient, directions);
  check.reference.setZero(directions > 0 ? directions : rho.size());
  check.reference_error.setZero(check.reference.size());
  double worst_of_one = 0.0;
  for (std::size_t k = 0; k < ensemble.scenarios().size(); ++k) {
    const double factor = all.by_value[to_signed(k)];
    const Scenario& scenario = ensemble.scenarios()[k];
    if (factor == 0.0) continue;
    const GradientCheck one =
        check_design(scenario.system, scenario.parameters(rho), method, cancel, check.directions);
    check.method = one.method;
    check.status = one.status;
    if (!check.status.ok()) return check;
    check.reference += factor * one.reference;
    check.reference_error += std::abs(factor) * one.reference_error;
    worst_of_one = std::max(worst_of_one, one.largest_relative_difference);
  }
  compare(&check);
  // The check of each scenario has compared the extremes with their references.
  check.largest_relative_difference = std::max(check.largest_relative_difference, worst_of_one);
  return check;
}

}  // namespace

GradientCheck check_gradient(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                             CheckMethod method, const std::atomic<bool>* cancel) {
  return checked(ensemble, rho, method, 0, cancel);
}

GradientCheck check_along(const Ensemble& ensemble, const Eigen::VectorXd& rho, CheckMethod method,
                          const std::atomic<bool>* cancel) {
  return checked(ensemble, rho, method, rho.size() > kCheckedDirections ? kCheckedDirections : 0,
                 cancel);
}

namespace {

/// The gradient of the measure through finer steps, by each parameter or along the check's
/// directions. False if a run cannot be repeated so. @param factors derivatives of the measure by
/// the value of each scenario.
bool differentiate_finer(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                         const Eigen::VectorXd& factors, const std::atomic<bool>* cancel,
                         GradientCheck* check) {
  const Eigen::MatrixXd& directions = check->directions;
  Eigen::VectorXd sum =
      Eigen::VectorXd::Zero(directions.size() > 0 ? directions.cols() : rho.size());
  for (std::size_t k = 0; k < ensemble.scenarios().size(); ++k) {
    const double factor = factors[to_signed(k)];
    const Scenario& scenario = ensemble.scenarios()[k];
    if (factor == 0.0) continue;
    const bool tests_errors = scenario.system->study().solver.sensitivity_tolerance > 0.0;
    if (tests_errors || !can_replay(scenario.system->study())) return false;
    Eigen::VectorXd one;
    const Status status = differentiate_finer_steps(*scenario.system, scenario.parameters(rho),
                                                    directions, cancel, &one);
    if (status.code == StatusCode::kCancelled) check->status = status;
    if (!status.ok() || !one.allFinite()) return false;
    sum += factor * one;
  }
  check->finer = std::move(sum);
  return true;
}

}  // namespace

void check_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                 const std::atomic<bool>* cancel, GradientCheck* check) {
  if (!check->status.ok() || check->method != CheckMethod::kComplexStep) return;
  const EnsembleEvaluation all = ensemble.evaluate(rho, false, cancel);
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(to_signed(ensemble.scenarios().size()));
  if (all.total.status.ok()) factors = all.by_value;
  if (!differentiate_finer(ensemble, rho, factors, cancel, check)) return;
  compare(check);
  if (!(check->largest_change > kCoarse && change_counts(*check))) return;
  // One direction cannot tell whose derivative changes: perhaps one that is zero but for rounding.
  GradientCheck each = *check;
  each.directions.resize(0, 0);
  const bool is_known =
      check->directions.size() > 0 && differentiate_finer(ensemble, rho, factors, cancel, &each);
  check->status = each.status;
  if (check->status.ok() && (!is_known || change_counts(each)))
    check->evaluation.warnings.push_back(
        warn("coarse_gradient",
             {{ensemble.scenarios().front().system->whole_study().file, 1},
              "solver",
              "the steps are too long for the gradient: with a hundredth of the tolerances it "
              "changes by this share",
              readable(check->largest_change, 2),
              "at most " + readable(kCoarse, 2) +
                  "; sensitivity_tolerance: 1e-6, or smaller tolerances"}));
}

bool disagrees(const GradientCheck& check) {
  return check.largest_relative_difference >
         (check.method == CheckMethod::kComplexStep ? 1e-6 : 1e-4);
}

}  // namespace codesign
