// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/result_report.h"

#include <algorithm>
#include <sstream>

#include "description/study.h"
#include "ensemble/scenario.h"
#include "math/arrays.h"
#include "optimization/search_results.h"
#include "problem/load_problem.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign {
namespace {

constexpr double kSmallViolation = 1e-8;  // smaller violations are not shown

int count_failed(const std::vector<StartResult>& starts) {
  return static_cast<int>(std::count_if(
      starts.begin(), starts.end(), [](const StartResult& start) { return start.optimum < 0; }));
}

/// "; the worst is run \"loaded\", sample 3, with 2.5", and how many failed.
std::string describe_worst(const OptimizationResult& result) {
  const int worst = worst_scenario(result);
  if (worst < 0) return "";
  const ScenarioResult& scenario = result.ensemble.scenarios[to_index(worst)];
  const std::string name = scenario_name(scenario.run, scenario.sample),
                    law = scenario.friction_law;
  return "; the worst is " + (name.empty() ? "the nominal run" : name) +
         (law.empty() ? "" : " (" + law + ")") + ", with " + readable(scenario.objective) +
         (result.best.failed.empty()
              ? ""
              : "; " + std::to_string(result.best.failed.size()) + " failed");
}

/// A sentence about the value at risk and its validation on fresh samples.
std::string describe_risk(const RobustOptions& options, const OptimizationResult& result) {
  std::string text = "with a probability of " + readable(options.level) +
                     " the objective is at most " + readable(*result.ensemble.value_at_risk) +
                     " on these samples";
  if (const auto& v = result.ensemble.validation)
    text += ", and at most " + readable(v->value_at_risk) + " on fresh samples, of which " +
            readable(100.0 * v->within, 4) + " % do not exceed the first value";
  return text;
}

void print_design(const Problem& problem, const OptimizationResult& result, std::ostream& out) {
  const std::vector<std::string> names = problem.tuned_names();
  Table table;
  table.add({"parameter", "initial", "tuned", "lower", "upper", "gradient"});
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Parameter& parameter = study_of(problem).parameters[to_index(study_of(problem).tuned[k])];
    const auto i = to_signed(k);
    table.add(
        {names[k], readable(result.initial.rho[i]), readable(result.best.rho[i]),
         readable(parameter.lower), readable(parameter.upper),
         is_evaluated(problem, result) ? readable(result.best.gradient[i]) : "not evaluated"});
  }
  table.print(out);
  for (std::size_t k = 0; k < study_of(problem).constraints.size(); ++k)
    out << study_of(problem).constraints[k].text << ": margin "
        << readable(result.constraints.margins[to_signed(k)]) << '\n';
}

}  // namespace

bool is_evaluated(const Problem& problem, const OptimizationResult& result) {
  return result.best.gradient.size() == to_signed(study_of(problem).tuned.size());
}

bool has_objective(const Problem& problem, const OptimizationResult& result) {
  return is_evaluated(problem, result) || result.multistart.screened > result.multistart.unusable;
}

bool has_design(const Problem& problem, const OptimizationResult& result) {
  const auto size = to_signed(study_of(problem).tuned.size());
  const bool is_complete = result.best.rho.size() == size && result.initial.rho.size() == size;
  return is_complete && (is_evaluated(problem, result) || result.status.is_interrupted());
}

int worst_scenario(const OptimizationResult& result) {
  int worst = -1;
  for (std::size_t k = 0; k < result.ensemble.scenarios.size(); ++k) {
    if (result.ensemble.scenarios[k].failed) continue;
    if (worst < 0 || result.ensemble.scenarios[k].objective >
                         result.ensemble.scenarios[to_index(worst)].objective)
      worst = static_cast<int>(k);
  }
  return worst;
}

std::vector<std::string> watched_sentences(const OptimizationResult& result) {
  std::vector<std::string> sentences;
  for (const WatchedResult& watched : result.constraints.watched)
    sentences.push_back(watched.element + ", " + watched.signal + ": from " +
                        readable(watched.initial_smallest) + " ... " +
                        readable(watched.initial_largest) + " to " + readable(watched.smallest) +
                        " ... " + readable(watched.largest) +
                        (watched.violation > kSmallViolation
                             ? ", beyond its bounds by " + readable(watched.violation, 3)
                             : ""));
  return sentences;
}

std::vector<std::string> ensemble_sentences(const Problem& problem,
                                            const OptimizationResult& result) {
  std::vector<std::string> lines;
  const EnsembleDescription& asked = study_of(problem).ensemble;
  if (!result.ensemble.scenarios.empty()) {
    const RobustOptions options = asked.robust_options();
    lines.push_back(std::string("objective: ") + kRobustMeasureNames[to_index(options.measure)] +
                    " over " + std::to_string(result.ensemble.scenarios.size()) + " scenarios" +
                    describe_worst(result));
  }
  if (result.ensemble.value_at_risk) lines.push_back(describe_risk(asked.robust_options(), result));
  if (const auto& v = result.ensemble.validation)
    lines.push_back("fresh samples: " + readable(v->objective) + " instead of " +
                    readable(v->promised) + ", mean " + readable(v->mean) + ", worst " +
                    readable(v->worst) + ", " + std::to_string(v->failed) + " failed");
  if (result.multistart.starts.empty()) return lines;
  lines.push_back(std::to_string(result.multistart.screened) + " points screened, " +
                  std::to_string(result.multistart.unusable) + " of them unusable; " +
                  std::to_string(result.multistart.starts.size()) + " searches, " +
                  std::to_string(count_failed(result.multistart.starts)) +
                  " of them without an optimum");
  constexpr std::size_t kShown = 10;
  for (std::size_t k = 0; k < std::min(kShown, result.multistart.optima.size()); ++k)
    lines.push_back("optimum " + std::to_string(k + 1) + ": objective " +
                    readable(result.multistart.optima[k].objective) + ", found by " +
                    std::to_string(result.multistart.optima[k].found) + " searches");
  if (result.multistart.optima.size() > kShown)
    lines.push_back(std::to_string(result.multistart.optima.size() - kShown) + " further optima");
  return lines;
}

std::string outcome_text(const Problem& problem, const OptimizationResult& result) {
  std::ostringstream out;
  print_design(problem, result, out);
  if (is_evaluated(problem, result))
    out << "objective " << readable(result.initial.objective) << " -> "
        << readable(result.best.objective) << '\n';
  else if (has_objective(problem, result))
    out << "objective " << readable(result.best.objective) << " at the best point of screening\n";
  for (const auto& [list, row] : result.choice.chosen) out << list << ": " << row << " is chosen\n";
  for (const std::string& sentence : watched_sentences(result)) out << sentence << '\n';
  for (const std::string& sentence : ensemble_sentences(problem, result)) out << sentence << '\n';
  out << result.termination << " after " << result.cost.iterations << " iterations, "
      << result.cost.evaluations << " evaluations (" << result.cost.failed_evaluations
      << " failed), " << result.cost.statistics.steps << " steps, "
      << readable(result.cost.statistics.cpu_seconds) << " s of processor time\n";
  if (const std::string stop = stop_sentence(result); !stop.empty()) out << stop << '\n';
  return out.str();
}

std::string report(const Problem& problem, const OptimizationResult& result) {
  std::string text =
      has_design(problem, result) ? outcome_text(problem, result) : describe(result.status) + '\n';
  Warnings warnings = problem.warnings();
  append(result.warnings, &warnings);
  for (const Warning& warning : warnings)
    text += "warning [" + std::string(warning.code) + "]: " + warning.message + '\n';
  return text;
}

}  // namespace codesign
