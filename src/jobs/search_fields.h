// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <tuple>

#include "jobs/fields.h"
#include "jobs/saved_result.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/status.h"
#include "optimization/tradeoff.h"

namespace codesign {

// The tables of results, in the order of documents: of searches and of checks of gradients.

/// Without the values that run and sample set, whose names differ.
constexpr auto fields_of(const ScenarioResult*) {
  return std::make_tuple(
      field("run", &ScenarioResult::run, "name of the run, empty if the study has none"),
      field(
          "sample", [](const ScenarioResult& one) { return one.sample + 1; },
          "number of the sample from 1; 0 for the nominal values"),
      field("weight", &ScenarioResult::weight, "share in the mean; the sum is 1").finite(),
      field("initial_objective", &ScenarioResult::initial_objective, "at the start of the search"),
      field("objective", &ScenarioResult::objective, "at the result"),
      field("initial_failed", &ScenarioResult::initial_failed,
            "whether it could not be simulated at the start"),
      field("failed", &ScenarioResult::failed, "whether it could not be simulated at the result"),
      field(
          "friction_law", [](const ScenarioResult& one) { return unless_empty(one.friction_law); },
          "the law of all joints, if the study varies it"));
}

constexpr auto fields_of(const Validation*) {
  return std::make_tuple(
      field("samples", &Validation::samples, "number of fresh samples"),
      field("failed", &Validation::failed, "of these could not be simulated"),
      field("promised", &Validation::promised, "the measure on the samples of the search"),
      field("objective", &Validation::objective, "on fresh samples"),
      field("mean", &Validation::mean, "mean of the objective over the fresh samples"),
      field("worst", &Validation::worst, "largest objective of the fresh samples"),
      field(
          "value_at_risk", &Validation::value_at_risk,
          "of the measure cvar: what fresh samples exceed with a probability of at most 1 - level")
          .not_always(),
      field("within", &Validation::within,
            "of the measure cvar: share of fresh samples, 0 to 1, that do not exceed value_at_risk "
            "of the result")
          .not_always());
}

/// Without the design. Of a fit the objective has another name.
constexpr auto fields_of(const Optimum*) {
  return std::make_tuple(
      field("objective", &Optimum::objective, "of a search: the objective there").not_always(),
      field("found", &Optimum::found, "searches that ended there"));
}

/// How the starts of several searches were chosen; without what they have found.
template <class Searches>
constexpr auto rows_of_starts() {
  return std::make_tuple(
      field(
          "starts", [](const Searches& one) { return one.starts.size(); }, "number of searches"),
      field("screened", &Searches::screened, "points that were evaluated to choose the starts"),
      field("unusable", &Searches::unusable, "of these failed"));
}
constexpr auto fields_of(const MultistartResult*) { return rows_of_starts<MultistartResult>(); }

/// Without the designs. No document has it.
constexpr auto fields_of(const StartResult*) {
  return std::make_tuple(
      field("start_objective", &StartResult::start_objective),
      field("objective", &StartResult::objective),
      field("status", [](const StartResult& one) { return name_of(one.status.code); }),
      field("termination", &StartResult::termination),
      field("evaluations", &StartResult::evaluations),
      field("optimum", [](const StartResult& one) { return one.optimum + 1; }));
}

constexpr auto fields_of(const SearchCost*) {
  return std::make_tuple(field("iterations", &SearchCost::iterations,
                               "trial points that were better than all before them"),
                         field("evaluations", &SearchCost::evaluations,
                               "trial points that were simulated, over all searches"),
                         field("failed_evaluations", &SearchCost::failed_evaluations,
                               "of these could not be simulated"));
}

/// Without what was chosen.
constexpr auto fields_of(const ChoiceResult*) {
  return std::make_tuple(
      field("combinations", &ChoiceResult::combinations, "of all lists and whole numbers").finite(),
      field("searched", &ChoiceResult::searched,
            "combinations at which a search of the other parameters has ended"),
      field("unfinished", &ChoiceResult::unfinished,
            "of these: searches that ended before an optimum, or without a point"),
      field(
          "relaxations", &ChoiceResult::relaxations,
          "searches with numbers between the listed ones; 0 where all combinations were searched"),
      field("bounded", &ChoiceResult::bounded,
            "parts of the combinations left out since their relaxation was not better than the "
            "best design"),
      field("infeasible", &ChoiceResult::infeasible,
            "parts left out since their relaxation met no constraints"),
      field("complete", &ChoiceResult::is_complete, "each combination was searched or left out"));
}

constexpr OrNull bound_or_null(double bound) { return {bound, !std::isfinite(bound)}; }

/// Without the scenarios of the smallest and the largest value.
constexpr auto fields_of(const WatchedResult*) {
  return std::make_tuple(
      field("element", &WatchedResult::element, "its place in the study, such as `path[0]`"),
      field("signal", &WatchedResult::signal, "as written"),
      field(
          "lower", [](const WatchedResult& one) { return bound_or_null(one.lower); },
          "bound at the result"),
      field(
          "upper", [](const WatchedResult& one) { return bound_or_null(one.upper); },
          "bound at the result"),
      field("after", &WatchedResult::after, "begin of the interval [s]").finite(),
      field("before", &WatchedResult::before, "its end [s]"),
      field("initial_smallest", &WatchedResult::initial_smallest,
            "smallest value of the signal, less its reference, at the start, in the unit of the "
            "signal"),
      field("initial_largest", &WatchedResult::initial_largest, "largest value at the start"),
      field("smallest", &WatchedResult::smallest, "smallest value at the result"),
      field("largest", &WatchedResult::largest, "largest value at the result"),
      field("smallest_time", &WatchedResult::smallest_time, "when [s]"),
      field("largest_time", &WatchedResult::largest_time, "when [s]"),
      field("violation", &WatchedResult::violation,
            "largest violation of the bounds at the result; 0 if they are met, and for peaks"),
      field("tolerance", &WatchedResult::tolerance,
            "violation up to which the bounds count as met"));
}

constexpr auto fields_of(const ApplyRecord::Change*) {
  return std::make_tuple(
      field("server", &ApplyRecord::Change::server), field("name", &ApplyRecord::Change::name),
      field("before", &ApplyRecord::Change::before), field("after", &ApplyRecord::Change::after),
      field("now", &ApplyRecord::Change::now));
}

/// Without the file and the kind of failure, which bad input has.
constexpr auto fields_of(const Status*) {
  return std::make_tuple(
      field(
          "code", [](const Status& one) { return name_of(one.code); },
          "name of the status, or bad_input, bad_usage, output_failed, failed"),
      field("message", &Status::cause, "the sentence that the terminal shows"),
      field("time", &Status::time, "of a status: the time of the run at which it arose [s]")
          .not_always());
}

/// Without the names of objectives and parameters.
constexpr auto fields_of(const TradeoffPoint*) {
  using P = TradeoffPoint;
  return std::make_tuple(
      field(
          "kind",
          [](const P& one) { return kTradeoffKindNames[static_cast<std::size_t>(one.kind)]; },
          "whether it lies on the curve; dominated: another point is as good in all objectives and "
          "better in one; repeated: the curve has a gap"),
      field("anchor", &P::is_anchor, "the least of one objective alone"),
      field(
          "place",
          [](const P& one) { return std::vector<double>(one.place.begin(), one.place.end()); },
          "weights of the ends of the curve in its reference point")
          .finite(),
      field("status", &P::status, "of its search; `success` with an empty message"),
      field("termination", &P::termination, "why its search ended"),
      field("stationarity", &P::stationarity, "of the end of its search"),
      field("warnings", &P::warnings, "codes of the search's warnings"));
}
constexpr auto fields_of(const TradeoffResult*) {
  return std::make_tuple(field("smallest_gap", &TradeoffResult::smallest_gap,
                               "of two objectives: distance of neighbours on the curve, each "
                               "objective over nadir - ideal"),
                         field("largest_gap", &TradeoffResult::largest_gap, "likewise"));
}

/// A number of differences; absent where they are not known.
template <class T>
std::optional<T> if_known(const IndependentCheck& of, const T& value) {
  return of.is_known() ? std::optional<T>(value) : std::nullopt;
}
/// A number of their steps, which postures do not have.
template <class T>
std::optional<T> if_stepped(const IndependentCheck& of, const T& value) {
  return of.longest_step != 0.0 ? if_known(of, value) : std::nullopt;
}

/// What differences of the objective through other steps say of a gradient, or why that is not
/// known.
constexpr auto fields_of(const IndependentCheck*) {
  using C = IndependentCheck;
  return std::make_tuple(
      field(
          "derivative", [](const C& one) { return if_known(one, one.derivative); },
          "of the objective along the direction, by the differences; of a single tuned parameter "
          "the derivative by it"),
      field(
          "error", [](const C& one) { return if_known(one, one.error); },
          "estimate of its absolute error"),
      field(
          "gradient", [](const C& one) { return if_known(one, one.along); },
          "the same by the gradient"),
      field(
          "allowed", [](const C& one) { return if_known(one, one.allowed); },
          "difference that the tolerances of the study explain, beyond the error"),
      field(
          "size", [](const C& one) { return if_known(one, one.size); },
          "largest term of the sum over the parameters: what differences are relative to"),
      field(
          "disagrees", [](const C& one) { return if_known(one, one.disagrees()); },
          "whether they differ by more than error and allowed: the warning gradient_disagrees"),
      field(
          "objective", [](const C& one) { return if_known(one, one.objective); },
          "at the design itself, with the other steps"),
      field(
          "evaluations", [](const C& one) { return if_known(one, one.evaluations); },
          "of the objective, at most 12"),
      field(
          "cpu_seconds", [](const C& one) { return if_known(one, one.statistics.cpu_seconds); },
          "processor time [s]"),
      field(
          "method", [](const C& one) { return if_stepped(one, one.method); },
          "of the other steps; not for postures, as the two keys below"),
      field(
          "relative_tolerance",
          [](const C& one) { return if_stepped(one, one.relative_tolerance); },
          "of the other steps"),
      field(
          "maximum_step", [](const C& one) { return if_stepped(one, one.longest_step); },
          "of the other steps [s]"),
      field(
          "unknown",
          [](const C& one) {
            return one.is_known() ? std::nullopt : std::optional<std::string>(describe(one.status));
          },
          "why nothing is known; then no other key"));
}

/// As a study and the command line spell it.
constexpr const char* name_of(CheckMethod method) {
  return method == CheckMethod::kComplexStep ? "complex_step" : "ridders";
}

/// Without the reference, whose entries have the names of parameters.
constexpr auto fields_of(const GradientCheck*) {
  using C = GradientCheck;
  return std::make_tuple(
      field(
          "method", [](const C& one) { return name_of(one.method); },
          "that the gradient was compared with"),
      field(
          "directions",
          [](const C& one) {
            return one.directions.size() > 0 ? std::optional<Eigen::Index>(one.directions.cols())
                                             : std::nullopt;
          },
          "random directions that agree"),
      field("largest_relative_difference", &C::largest_relative_difference,
            "largest difference between gradient and reference, relative to the derivative, or to "
            "1e-3 of the largest one if that is more; along a direction relative to the largest "
            "term of the sum"),
      field(
          "largest_change",
          [](const C& one) {
            return one.finer.size() > 0 ? std::optional<double>(one.largest_change) : std::nullopt;
          },
          "by how much the gradient changes with a hundredth of the tolerances, relative in the "
          "same way; only with `complex_step`, without `solver.sensitivity_tolerance`, and if such "
          "a run succeeds"),
      field(
          "differences",
          [](const C& one) {
            return one.independent.evaluations > 0
                       ? std::optional<IndependentCheck>(one.independent)
                       : std::nullopt;
          },
          "of the objective, which rest on nothing that the gradient's own steps share"));
}

}  // namespace codesign
