// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/algorithm.h"

#include <algorithm>
#include <map>
#include <optional>

#include "description/objective_part.h"
#include "description/study.h"
#include "text/number_text.h"

namespace codesign {
namespace {

struct Algorithm {
  /// std::nullopt: Levenberg-Marquardt, which NLopt does not have, and `auto`
  std::optional<nlopt::algorithm> id;
  /// The most that it takes beside bounds of parameters.
  enum class Takes { kBounds, kInequalities, kEqualities } takes;

  bool takes_constraints() const { return takes != Takes::kBounds; }
  bool takes_equalities() const { return takes == Takes::kEqualities; }
};

constexpr const char* kLeastSquares = "levenberg_marquardt";
constexpr const char* kAuto = "auto";

const std::map<std::string, Algorithm>& algorithms() {
  using Takes = Algorithm::Takes;
  static const std::map<std::string, Algorithm> table{
      {"lbfgs", {nlopt::LD_LBFGS, Takes::kBounds}},
      {"var1", {nlopt::LD_VAR1, Takes::kBounds}},
      {"var2", {nlopt::LD_VAR2, Takes::kBounds}},
      {"tnewton", {nlopt::LD_TNEWTON_PRECOND_RESTART, Takes::kBounds}},
      {"mma", {nlopt::LD_MMA, Takes::kInequalities}},
      {"ccsaq", {nlopt::LD_CCSAQ, Takes::kInequalities}},
      {"slsqp", {nlopt::LD_SLSQP, Takes::kEqualities}},
      {"cobyla", {nlopt::LN_COBYLA, Takes::kEqualities}},
      {"bobyqa", {nlopt::LN_BOBYQA, Takes::kBounds}},
      {"auglag_lbfgs", {nlopt::LD_AUGLAG, Takes::kEqualities}},
      {kLeastSquares, {std::nullopt, Takes::kBounds}},
      {kAuto, {std::nullopt, Takes::kEqualities}}};
  return table;
}

template <class Predicate>
std::string names(const Predicate& is_listed) {
  std::string list;
  for (const auto& [name, algorithm] : algorithms())
    if (is_listed(algorithm)) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Whether a constraint among parameters is an equality.
bool has_equality(const Study& study) {
  return std::any_of(study.constraints.begin(), study.constraints.end(),
                     [](const ParameterConstraint& one) { return one.is_equality; });
}

/// Checks that the algorithm takes the constraints of the study. @param with_slack whether the
/// robust measure adds constraints.
void check_constraints(const Study& study, const Algorithm& algorithm, bool with_slack,
                       InputFault fault) {
  const auto refuse = [&fault](const char* message, bool equalities) {
    fault.message = message;
    fault.allowed = names([equalities](const Algorithm& other) {
      return equalities ? other.takes_equalities() : other.takes_constraints();
    });
    throw InputError(fault);
  };
  if (!algorithm.takes_constraints()) {
    if (!study.constraints.empty())
      refuse("this algorithm takes no constraints on parameters", false);
    if (!study.watched.empty())
      refuse(
          "this algorithm takes no constraints, which path, final, objective.peak and peaks in "
          "constraints need",
          false);
    if (with_slack)
      refuse(
          "this algorithm takes no constraints, which robust.measure worst and cvar are solved by",
          false);
  }
  if (!algorithm.takes_equalities() &&
      (has_equality(study) || std::any_of(study.watched.begin(), study.watched.end(), is_equality)))
    refuse(
        "this algorithm takes no equality constraints, such as == among parameters and final with "
        "equal bounds",
        true);
}

bool has_negative_weight(const ObjectiveTerm& term) {
  return term.weight.is_constant() && term.weight.nominal() < 0.0;
}

/// @param element the term. @param others the algorithms that take any term.
void check_square(const ObjectiveTerm& term, const std::string& element,
                  const std::string& others) {
  if (has_negative_weight(term))
    throw InputError({term.where, "objective",
                      "optimizer.algorithm levenberg_marquardt takes sums of squares, without "
                      "negative weights",
                      to_decimal(term.weight.nominal()),
                      "0 or more, or one of the algorithms " + others});
  if (!term.loss->is_square())
    throw InputError({term.where, element + ".loss",
                      "optimizer.algorithm levenberg_marquardt takes sums of squares, which this "
                      "loss does not make",
                      term.loss->name,
                      "loss: square, above or below, or one of the algorithms " + others});
}

}  // namespace

SourceLocation where_of(const OptimizerOptions& options, const Study& study) {
  return options.where.file.empty() ? SourceLocation{study.file, 1} : options.where;
}

bool is_least_squares(const std::string& algorithm) { return algorithm == kLeastSquares; }

void check_algorithm(const Study& study, const OptimizerOptions& options, bool with_slack) {
  const auto found = algorithms().find(options.algorithm);
  const SourceLocation where = where_of(options, study);
  const InputFault fault{where, "optimizer.algorithm", "", options.algorithm, ""};
  if (found == algorithms().end())
    throw InputError({fault.where, fault.element, "no such algorithm", fault.value,
                      names([](const Algorithm&) { return true; })});
  check_constraints(study, found->second, with_slack, fault);
  // Checked here because the tolerance may also come from a request of a ROS client. Smaller ones
  // are below rounding.
  constexpr double kLeast = 1e-15;
  if (!(options.relative_tolerance >= kLeast && options.relative_tolerance < 1.0))
    throw InputError({where, "optimizer.relative_tolerance", "tolerance out of range",
                      to_decimal(options.relative_tolerance), "from 1e-15 to less than 1"});
}

void check_squares(const Study& study, const OptimizerOptions& options, RobustMeasure measure) {
  InputFault fault{where_of(options, study), "optimizer.algorithm", "", options.algorithm,
                   names([](const Algorithm& other) { return other.id.has_value(); })};
  if (measure == RobustMeasure::kMeanPlusDeviation) {
    fault.message =
        "this algorithm takes sums of squares, which robust.measure mean_plus_deviation is not";
    throw InputError(fault);
  }
  if (study.solver.gradient == GradientMethod::kAdjoint) {
    fault.message =
        "this algorithm needs the sensitivities of all residuals, which solver.gradient: adjoint "
        "does not compute";
    fault.allowed += ", or solver.gradient auto or direct";
    throw InputError(fault);
  }
  if (has_moving_end(study)) {
    fault.message =
        "this algorithm takes sums of squares over one time for all designs, and the end of a run "
        "depends on the design";
    throw InputError(fault);
  }
  const auto check = [&](const std::vector<ObjectiveTerm>& terms, ObjectivePart part) {
    for (std::size_t k = 0; k < terms.size(); ++k)
      check_square(terms[k], term_name(study, part, k), fault.allowed);
  };
  check(study.integral, ObjectivePart::kIntegral);
  check(study.terminal, ObjectivePart::kTerminal);
}

std::vector<std::string> algorithms_for(const Study& study, const OptimizerOptions& options,
                                        RobustMeasure measure, bool with_slack) {
  if (options.algorithm != kAuto) return {options.algorithm};
  // Constraints among parameters are often inactive at the optimum. Where one is active, least
  // squares without it do not end at a stationary point, and the next algorithm goes on. An
  // equality is always active.
  Study without_constraints = study;
  without_constraints.constraints.clear();
  std::vector<std::string> list;
  for (const char* name : {kLeastSquares, "slsqp", "lbfgs", "mma"}) {
    OptimizerOptions candidate = options;
    candidate.algorithm = name;
    if (is_least_squares(name) && has_equality(study)) continue;
    try {
      check_algorithm(is_least_squares(name) ? without_constraints : study, candidate, with_slack);
      if (is_least_squares(name)) check_squares(study, candidate, measure);
      list.push_back(name);
    } catch (const InputError&) {  // this one does not take the problem
    }
  }
  return list;
}

bool uses_gradients(const std::string& algorithm) {
  return algorithm != "cobyla" && algorithm != "bobyqa";
}

bool is_sum_of_squares(const Study& study) {
  const auto is_no_square = [](const ObjectiveTerm& term) {
    return has_negative_weight(term) || !term.loss->is_square();
  };
  const auto is_own_term = [](const WatchedSignal& watched) {
    return is_term(watched) && !is_largest_of_many(watched);
  };
  return !has_moving_end(study) &&
         std::none_of(study.integral.begin(), study.integral.end(), is_no_square) &&
         std::none_of(study.terminal.begin(), study.terminal.end(), is_no_square) &&
         std::none_of(study.watched.begin(), study.watched.end(), is_own_term);
}

nlopt::opt make_optimizer(const OptimizerOptions& options, unsigned dimension) {
  const nlopt::algorithm id = algorithms().at(options.algorithm).id.value();
  nlopt::opt optimizer(id, dimension);
  if (id == nlopt::LD_AUGLAG) {
    nlopt::opt local(nlopt::LD_LBFGS, dimension);
    local.set_ftol_rel(options.relative_tolerance);
    // NLopt 2.7.1 reads the absolute tolerances of the sub-optimizer even if they were never set.
    local.set_xtol_abs(0.0);
    optimizer.set_local_optimizer(local);
    optimizer.set_xtol_abs(0.0);
  }
  return optimizer;
}

bool is_success(const std::string& termination) {
  return termination == "success" || termination == "objective_tolerance_reached" ||
         termination == "parameter_tolerance_reached" || termination == "roundoff_limited";
}

std::string termination_name(nlopt::result result) {
  switch (result) {
    case nlopt::SUCCESS:
      return "success";
    case nlopt::STOPVAL_REACHED:
      return "objective_value_reached";
    case nlopt::FTOL_REACHED:
      return "objective_tolerance_reached";
    case nlopt::XTOL_REACHED:
      return "parameter_tolerance_reached";
    case nlopt::MAXEVAL_REACHED:
      return "max_evaluations_reached";
    case nlopt::MAXTIME_REACHED:
      return "max_time_reached";
    case nlopt::FORCED_STOP:
      return "cancelled";
    case nlopt::ROUNDOFF_LIMITED:
      return "roundoff_limited";
    default:
      return "algorithm_failed";
  }
}

}  // namespace codesign
