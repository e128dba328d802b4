// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/session.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "optimization/algorithm.h"
#include "problem/load_problem.h"
#include "sensitivity/gradient_engine.h"
#include "statics/linearize.h"
#include "text/number_text.h"

namespace codesign::python {
namespace {

constexpr const char* kCall = "arguments";

/// Residuals stand for an objective that is a sum of squares and nothing else.
void require_squares(const Study& study) {
  const bool has_term = std::any_of(study.watched.begin(), study.watched.end(), is_term);
  if (!has_term && is_sum_of_squares(study) &&
      study.ensemble.robust_options().measure == RobustMeasure::kMean)
    return;
  throw InputError(
      {{study.file, 1},
       "objective",
       "residuals belong to a sum of squares, which this objective is not",
       "",
       "integral, terminal and sum terms with weights of at least 0 and the loss square, "
       "above or below, no peaks and measures, robust.measure mean, and an end of runs that no "
       "parameter moves"});
}

void use_adjoint(MotionStudy* study) { study->solver.gradient = GradientMethod::kAdjoint; }

Study with_adjoint(Study study) {
  use_adjoint(&study);
  for (RunDescription& run : study.ensemble.runs) {
    if (!run.study) continue;
    Study changed = *run.study;
    use_adjoint(&changed);
    run.study = std::make_shared<const Study>(std::move(changed));
  }
  return study;
}

void require_adjoint(const Problem& problem) {
  for (const auto& system : distinct_systems(problem))
    if (!prefers_adjoint(*system))
      throw InputError({{study_of(problem).file, 1},
                        "adjoint",
                        "this study has no adjoint",
                        "",
                        "the integrator rosenbrock, without path, final, peaks, measures and "
                        "positions"});
}

}  // namespace

Squares squares_of(const Evaluation& evaluation) {
  if (!evaluation.status.ok()) return {};
  const Eigen::MatrixXd& R = evaluation.jacobian_root;
  const Eigen::Index p = R.cols();
  Squares squares{Eigen::VectorXd(p + 1), Eigen::MatrixXd::Zero(p + 1, p)};
  // R is singular if parameters have no effect, or the same: the least norm then.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> root(R.transpose());
  squares.residuals.head(p) = root.solve(0.5 * evaluation.gradient);
  squares.residuals[p] =
      std::sqrt(std::max(0.0, evaluation.objective - squares.residuals.head(p).squaredNorm()));
  squares.jacobian.topRows(p) = R;
  return squares;
}

Session::Session(Problem problem)
    : problem_(std::move(problem)),
      start_(problem_.parameters()),
      scenarios_(make_scenarios(problem_)),
      default_signals_(
          checked(codesign::default_signals(robot_of(problem_), study_of(problem_).controllers))) {}

std::vector<SignalDescription> Session::checked(const std::vector<std::string>& signals) const {
  std::vector<SignalDescription> parsed;
  for (const std::string& text : signals) {
    parsed.push_back(parse_signal(text, {kCall, 0}, "signals"));
    check_signal(parsed.back(), robot_of(problem_), study_of(problem_).controllers, "signals");
  }
  return parsed;
}

std::vector<double> Session::design(const std::optional<std::vector<double>>& rho,
                                    const ParameterSettings& settings) const {
  std::vector<double> values = start_;
  if (rho) {
    const std::vector<int>& tuned = study_of(problem_).tuned;
    if (rho->size() != tuned.size())
      throw InputError({{kCall, 0},
                        "rho",
                        "one number for each tuned parameter is needed",
                        std::to_string(rho->size()),
                        std::to_string(tuned.size())});
    for (std::size_t k = 0; k < tuned.size(); ++k) {
      if (!std::isfinite((*rho)[k]))
        throw InputError({{kCall, 0},
                          "rho[" + std::to_string(k) + "]",
                          "the number is not finite",
                          to_decimal((*rho)[k]),
                          ""});
      values[to_index(tuned[k])] = (*rho)[k];
    }
  }
  if (settings.empty()) return values;
  const std::vector<double> set = problem_.parameters(settings);
  const std::vector<Parameter>& parameters = problem_.all_parameters();
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const auto& setting : settings)
      if (setting.first == parameters[k].name) values[k] = set[k];
  return values;
}

std::vector<Scenario> Session::scenarios_at(const std::vector<double>& parameters) const {
  std::vector<Scenario> scenarios = scenarios_;
  const std::vector<int>& tuned = study_of(problem_).tuned;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const int index = static_cast<int>(k);
    if (parameters[k] == start_[k] || std::find(tuned.begin(), tuned.end(), index) != tuned.end())
      continue;
    // In front, so that the values of a run or a sample replace it.
    for (Scenario& scenario : scenarios)
      scenario.values.emplace(scenario.values.begin(), index, parameters[k]);
  }
  return scenarios;
}

std::shared_ptr<EvaluationEngine> Session::take_engine() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (engines_.empty())
    engines_.emplace_back(make_engine(problem_, to_signed(scenarios_.size()), nullptr));
  std::shared_ptr<EvaluationEngine> engine = engines_.back();
  if (is_serial()) engines_.pop_back();
  return engine;
}

void Session::give_back(const std::shared_ptr<EvaluationEngine>& engine) {
  if (!is_serial()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  engines_.push_back(engine);
}

Evaluation Session::evaluate(const std::vector<double>& parameters, Derivatives derivatives,
                             const std::atomic<bool>* cancel) {
  const Study& study = study_of(problem_);
  require_objective(problem_);
  if (derivatives != Derivatives::kNone) require_tuned(study);
  if (derivatives == Derivatives::kGaussNewton) require_squares(study);
  Eigen::VectorXd rho(to_signed(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[to_signed(k)] = parameters[to_index(study.tuned[k])];
  const std::shared_ptr<EvaluationEngine> engine = take_engine();
  const Ensemble ensemble(scenarios_at(parameters), study.ensemble.robust_options(), engine);
  Evaluation evaluation = ensemble.evaluate(rho, derivatives, cancel).total;
  give_back(engine);
  return evaluation;
}

Session& Session::adjoint() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!adjoint_) {
    auto session =
        std::make_unique<Session>(with_study(problem_, with_adjoint(study_of(problem_))));
    require_adjoint(session->problem());
    adjoint_ = std::move(session);
  }
  return *adjoint_;
}

RunTable Session::run(const std::vector<double>& parameters,
                      const std::vector<std::string>& signals, int samples,
                      const std::atomic<bool>* cancel) const {
  if (samples < 2)
    throw InputError({{kCall, 0},
                      "samples",
                      "a run needs samples at its start and at its end",
                      std::to_string(samples),
                      "at least 2"});
  const std::vector<SignalDescription> recorded =
      signals.empty() ? default_signals_ : checked(signals);
  RunTable table;
  table.names = column_names(recorded);
  const int postures = study_of(problem_).postures;
  table.room = to_index(postures > 0 ? postures : samples);
  table.values.resize(table.names.size() * table.room);
  const auto sink = [&table](const std::vector<double>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) table.values[k * table.room + table.rows] = row[k];
    ++table.rows;
  };
  table.summary = record_run(problem_, parameters, recorded, samples, sink, cancel);
  RunSummary& summary = table.summary;
  // Peaks and measures need a run of its own that follows them.
  if (summary.status.ok() && has_objective(study_of(problem_)) && !summary.objective) {
    const Evaluation evaluation =
        Evaluator(problem_).evaluate_design(parameters, Derivatives::kNone, cancel);
    summary.status = evaluation.status;
    if (evaluation.status.ok()) summary.objective = evaluation.objective;
  }
  return table;
}

LinearModel Session::linearize(const std::vector<double>& parameters,
                               const std::vector<std::string>& outputs, const std::string& friction,
                               std::optional<double> at, const std::atomic<bool>* cancel) const {
  const auto known = std::find(kLinearFrictionNames.begin(), kLinearFrictionNames.end(), friction);
  if (known == kLinearFrictionNames.end())
    throw InputError({{kCall, 0},
                      "friction",
                      "this is no way to count friction about rest",
                      friction,
                      "off, regularised or given_speed"});
  if (at && !(*at >= 0.0 && std::isfinite(*at)))
    throw InputError({{kCall, 0}, "at", "not a time of the run", to_decimal(*at), "0 s or more"});
  const LinearQuestion question{
      checked(outputs), static_cast<LinearFriction>(known - kLinearFrictionNames.begin()), true};
  const CompiledSystem& system = *system_of(problem_);
  return at ? linearize_in_motion(system, parameters, question, *at, cancel)
            : linearize_at_rest(system, parameters, question, cancel);
}

}  // namespace codesign::python
