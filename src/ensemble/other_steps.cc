// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/other_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "sensitivity/independent_check.h"
#include "sensitivity/run_steps.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Steps that the check may take over those of the study's runs: where the explicit pair needs more,
// the motion is stiff.
constexpr double kMostOfPair = 8.0, kMostOfImplicit = 5.0;
constexpr double kFewestOfPair = 4000.0, kFewestOfImplicit = 20000.0, kMostSteps = 1e8;
// The share of the allowed difference at which the differences are good enough.
constexpr double kGoodEnough = 0.1;
// The effect of the second set of steps bounds that of the first one, twice where the longest step
// limits both.
constexpr double kOfSteps = 2.0;
constexpr double kSameObjective = 1e-3;

/// One check: the objective along a line with other steps.
class OtherSteps {
 public:
  OtherSteps(const Ensemble& ensemble, const Eigen::VectorXd& rho, const ClaimedGradient& claim,
             const std::atomic<bool>* cancel)
      : ensemble_(ensemble),
        study_(ensemble.scenarios().front().system->whole_study()),
        rho_(rho),
        claim_(claim),
        cancel_(cancel),
        line_(checked_line(study_, rho, claim.gradient)) {}

  IndependentCheck run(bool is_thorough) {
    const double at_zero = begin();
    if (!check_.status.ok()) return std::move(check_);
    LineDifferences differences(at_zero, line_.is_two_sided);
    check_.objective = at_zero;
    check_.along = claim_.gradient.dot(line_.direction);
    extrapolate(&differences);
    if (!check_.status.ok()) return std::move(check_);
    check_.direction = line_.direction;
    if (is_thorough || check_.disagrees()) add_error_of_steps(differences);
    if (check_.status.is_interrupted()) check_.direction.resize(0);
    return std::move(check_);
  }

 private:
  /// Chooses the method. @returns the objective at the design
  double begin() {
    const CompiledSystem& system = *ensemble_.scenarios().front().system;
    if (study_.postures == 0) use(other_method(system, claim_.statistics));
    double at_zero = values({0.0}, false)[0];
    if (std::isfinite(at_zero) || check_.status.is_interrupted() || study_.postures > 0)
      return at_zero;
    use(fallback_method(system, steps_.method));
    check_.status = {};
    at_zero = values({0.0}, false)[0];
    return at_zero;
  }

  void use(RunSteps::Method method) {
    const bool is_pair = method == RunSteps::Method::kDopri5;
    const double own = static_cast<double>(claim_.statistics.steps) / std::max(1.0, claim_.runs);
    steps_.method = method;
    steps_.most = static_cast<std::int32_t>(
        std::min(kMostSteps, std::max(is_pair ? kFewestOfPair : kFewestOfImplicit,
                                      own * (is_pair ? kMostOfPair : kMostOfImplicit))));
    const SolverOptions& solver = with_steps(study_, steps_).solver;
    check_.method = name_of(method);
    check_.relative_tolerance = solver.relative_tolerance;
    check_.longest_step = solver.maximum_step;
  }

  void extrapolate(LineDifferences* differences) {
    const int each = line_.is_two_sided ? 2 : 1;
    double h = line_.first_step;
    Status failure;
    while (check_.evaluations + each + 2 <= kMostEvaluations) {
      const std::vector<double> at =
          values(line_.is_two_sided ? std::vector<double>{h, -h} : std::vector<double>{h}, false);
      if (check_.status.is_interrupted()) return;
      if (!check_.status.ok()) failure = std::exchange(check_.status, Status{});
      if (std::isfinite(at.front()) && std::isfinite(at.back()))
        differences->add(h, at[0], at.back());
      h /= LineDifferences::kShrink;
      if (differences->levels() > 0) judge(*differences);
      if (differences->levels() > 1 && check_.error <= kGoodEnough * check_.allowed) break;
    }
    const bool diverges = differences->diverges() && !(check_.error <= check_.allowed);
    if (differences->levels() > 1 && !diverges) return;
    check_.status = failure;
    if (differences->levels() > 1)
      check_.status = {StatusCode::kNonFiniteGradient, 0.0,
                       "its slope along the checked direction grows as the steps shrink, to " +
                           readable(differences->quotient()) + " over " +
                           readable(differences->step(), 2) +
                           " of the direction: differences cannot tell the derivative beside a "
                           "design where there is none"};
    else if (failure.ok())
      check_.status = {StatusCode::kNonFinite, 0.0,
                       "the objective beside the design is not finite"};
  }

  void judge(const LineDifferences& differences) {
    check_.derivative = differences.value();
    check_.error = differences.error();
    check_.size = std::max(line_.direction.cwiseProduct(claim_.gradient).cwiseAbs().maxCoeff(),
                           std::abs(check_.derivative));
    check_.allowed =
        std::max(claim_.allowed_per_range * line_.per_range,
                 allowed_difference(check_, line_, claim_.objective, differences.curvature()));
  }

  void add_error_of_steps(const LineDifferences& differences) {
    const double h = differences.step();
    if (study_.postures > 0) return;
    const std::vector<double> at =
        values(line_.is_two_sided ? std::vector<double>{h, -h} : std::vector<double>{h, 0.0}, true);
    if (check_.status.is_interrupted()) return;
    const double other = differences.quotient(h, at[1], at[0], at[1]);
    // The second set is no part of the differences: its failure leaves them with the error so far.
    check_.status = {};
    if (std::isfinite(other)) check_.error += kOfSteps * std::abs(other - differences.quotient());
  }

  /// The objective at rho + h d for each h; not a number where a scenario fails.
  std::vector<double> values(const std::vector<double>& at, bool is_second) {
    std::vector<EvaluationTask> tasks;
    for (const double h : at)
      for (std::size_t k = 0; k < ensemble_.scenarios().size(); ++k) {
        if (claim_.by_value[to_signed(k)] == 0.0) continue;
        const Scenario& scenario = ensemble_.scenarios()[k];
        EvaluationTask task{scenario.system, scenario.parameters(rho_ + h * line_.direction)};
        if (steps_.method != RunSteps::Method::kOwn) {
          task.steps = steps_;
          task.steps.is_second = is_second;
          task.stepped = stepped(scenario.system, task.steps);
        }
        tasks.push_back(std::move(task));
      }
    const std::vector<Evaluation> runs = ensemble_.engine().evaluate(tasks, cancel_);
    check_.evaluations += static_cast<int>(at.size());
    std::vector<double> sums(at.size(), 0.0);
    std::size_t run = 0;
    for (double& sum : sums)
      for (std::size_t k = 0; k < ensemble_.scenarios().size(); ++k) {
        if (claim_.by_value[to_signed(k)] == 0.0) continue;
        const Evaluation& one = runs[run++];
        check_.statistics += one.statistics;
        if (!one.status.ok() && !check_.status.is_interrupted()) check_.status = one.status;
        sum += one.status.ok() ? claim_.by_value[to_signed(k)] * one.objective
                               : std::numeric_limits<double>::quiet_NaN();
      }
    return sums;
  }

  std::shared_ptr<const CompiledSystem> stepped(const std::shared_ptr<const CompiledSystem>& system,
                                                const RunSteps& steps) {
    std::shared_ptr<const CompiledSystem>& result = stepped_[{system.get(), steps}];
    if (!result) result = with_steps(*system, steps);
    return result;
  }

  const Ensemble& ensemble_;
  const Study& study_;
  const Eigen::VectorXd& rho_;
  const ClaimedGradient& claim_;
  const std::atomic<bool>* cancel_;
  const CheckedLine line_;
  RunSteps steps_;
  std::map<std::pair<const CompiledSystem*, RunSteps>, std::shared_ptr<const CompiledSystem>>
      stepped_;
  IndependentCheck check_;
};

}  // namespace

IndependentCheck check_other_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                                   const ClaimedGradient& claim, bool is_thorough,
                                   const std::atomic<bool>* cancel) {
  return OtherSteps(ensemble, rho, claim, cancel).run(is_thorough);
}

void check_other_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                       const std::atomic<bool>* cancel, GradientCheck* check) {
  if (!check->status.ok()) return;
  ClaimedGradient claim{check->evaluation.gradient, Eigen::VectorXd::Ones(1),
                        check->evaluation.objective, check->evaluation.statistics,
                        static_cast<double>(ensemble.scenarios().size())};
  if (ensemble.scenarios().size() > 1) {
    const EnsembleEvaluation all = ensemble.evaluate(rho, false, cancel);
    check->status = all.total.status;
    if (!check->status.ok()) return;
    claim.by_value = all.by_value;
    count_worst_for_failed(all.failed, all.values, &claim.by_value);
    claim.objective = claim.by_value.dot(all.values);
  }
  check->independent = check_other_steps(ensemble, rho, claim, true, cancel);
  if (check->independent.status.is_interrupted()) check->status = check->independent.status;
  if (check->independent.disagrees())
    check->evaluation.warnings.push_back(
        disagreement(ensemble, check->independent, claim.objective));
}

void count_worst_for_failed(const std::vector<int>& failed, const Eigen::VectorXd& values,
                            Eigen::VectorXd* by_value) {
  const auto has_failed = [&failed](Eigen::Index k) {
    return std::count(failed.begin(), failed.end(), static_cast<int>(k)) > 0;
  };
  Eigen::Index worst = -1;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    if (!has_failed(k) && (worst < 0 || values[k] > values[worst])) worst = k;
  for (int k : failed) {
    if (worst >= 0) (*by_value)[worst] += (*by_value)[k];
    (*by_value)[k] = 0.0;
  }
}

std::string describe_steps(const IndependentCheck& check) {
  if (check.longest_step == 0.0) return "postures";
  return check.method + ", tolerance " + readable(check.relative_tolerance, 2) +
         ", steps of at most " + readable(check.longest_step, 3) + " s";
}

Warning disagreement(const Ensemble& ensemble, const IndependentCheck& check, double objective) {
  const Study& study = ensemble.scenarios().front().system->whole_study();
  const std::string where = study.tuned.size() == 1
                                ? "by \"" + tuned_names(study).front() + "\""
                                : "along a direction in which every parameter has its part";
  std::string text =
      "the gradient is wrong, or the objective has no derivative: differences of "
      "the objective through other steps (" +
      describe_steps(check) + ") are " + readable(check.derivative) + " " + where +
      ", with an error of " + readable(check.error, 2);
  if (!(std::abs(check.objective - objective) <= kSameObjective * std::abs(objective)))
    text += "; the objective itself is " + readable(check.objective) + " there and " +
            readable(objective) + " with the study's steps";
  return warn("gradient_disagrees",
              {{study.file, 1},
               "solver",
               text,
               readable(check.along),
               "a difference of at most " + readable(check.error + check.allowed, 2)});
}

}  // namespace codesign
