// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "excitation/excitation_result.h"
#include "identification/comparison/model_comparison.h"
#include "identification/fit/identification_result.h"
#include "jobs/fields.h"
#include "jobs/recording_records.h"
#include "jobs/search_fields.h"

namespace codesign {

// The tables of results, in the order of documents: of recordings, fits and excitations.

constexpr auto fields_of(const RecordingSummary*) {
  using R = RecordingSummary;
  return std::make_tuple(
      field("recording", &R::element, "its place in the study"),
      field("file", &R::file, "that was read"),
      field("samples", &R::samples, "number of samples between `from` and `to`"),
      field("rate", &R::rate, "[Hz]").finite(), field("from", &R::from, "[s]").finite(),
      field("to", &R::to, "[s]").finite(), field("fitted", &R::fitted, "samples that the fit uses"),
      field("measured", &R::measured, "signals it holds"));
}

/// A number of the interval, which a number on a bound does not have.
inline OrNull interval_number(const IdentifiedNumber& of, double value) {
  return {of.is_on_bound ? std::numeric_limits<double>::quiet_NaN() : value, of.is_on_bound};
}

/// In the order of ProfileEnd.
constexpr std::array<const char*, 4> kProfileEndNames{"found", "bound", "unbounded", "failed"};
constexpr auto fields_of(const ProfileInterval*) {
  using P = ProfileInterval;
  return std::make_tuple(
      field(
          "interval",
          [](const P& one) {
            return std::array<double, 2>{one.lower, one.upper};
          },
          "lower and upper end, in the unit of the number"),
      field(
          "ends",
          [](const P& one) {
            return std::array<std::string, 2>{
                kProfileEndNames[static_cast<std::size_t>(one.lower_end)],
                kProfileEndNames[static_cast<std::size_t>(one.upper_end)]};
          },
          "of each end: found, bound (that of the parameter comes first), unbounded (the "
          "recordings do not bound it), failed (a fit failed before)"),
      field("found_better", &P::found_better,
            "a fit on the way was better than the result, which is not the best point"));
}

/// Without bounds and the interval, which is null on a bound.
constexpr auto fields_of(const IdentifiedNumber*) {
  using N = IdentifiedNumber;
  return std::make_tuple(
      field("value", &N::value, "at the best fit, in `unit`"),
      field("start", &N::start, "at which the fit began, in `unit`"),
      field("unit", &N::unit, "as the model or the kind of number says; empty without one"),
      field("determined", &N::is_determined, "whether the recordings determine it"),
      field("on_bound", &N::is_on_bound, "whether it ended on its bound, where it has no interval"),
      field(
          "deviation", [](const N& one) { return interval_number(one, one.deviation); },
          "standard deviation"),
      field("profile", &N::profile, "with `intervals.profiles`: the interval by repeated fits"));
}

constexpr auto fields_of(const BaseParameter*) {
  return std::make_tuple(field("expression", &BaseParameter::expression,
                               "the combination, in the names of the numbers"),
                         field("value", &BaseParameter::value, "at the result"),
                         field("deviation", &BaseParameter::deviation, "standard deviation"),
                         field(
                             "interval",
                             [](const BaseParameter& one) {
                               return std::array<double, 2>{one.low, one.high};
                             },
                             "lower and upper end, with the probability `level`"));
}

constexpr auto fields_of(const Whiteness*) {
  return std::make_tuple(
      field("ljung_box", &Whiteness::statistic, "the statistic of Ljung and Box"),
      field("lags", &Whiteness::lags, "number of correlations in it"),
      field("probability", &Whiteness::probability, "of such a statistic for white residuals"),
      field("first_correlation", &Whiteness::first_correlation,
            "of neighbouring residuals, -1 to 1"));
}

/// Without joint and whiteness, of which a message has the probability alone.
constexpr auto fields_of(const OutputFit*) {
  return std::make_tuple(
      field("recorded_rms", &OutputFit::recorded,
            "root mean square of the recorded values [N m or N; of a motion the unit of the "
            "quantity]"),
      field("start_rms", &OutputFit::start, "root mean square of the residuals at the start"),
      field("rms", &OutputFit::rms, "at the result"),
      field("worst", &OutputFit::worst, "largest magnitude of the residuals at the result"),
      field("explained", &OutputFit::explained, "1 - (rms / recorded_rms)^2"),
      field("counted", &OutputFit::counted,
            "share of the samples that count, above the speed of a mask")
          .finite());
}

constexpr auto fields_of(const IdentificationResult*) {
  using R = IdentificationResult;
  return std::make_tuple(
      field("termination", &R::termination, "why the fit ended"),
      field("evaluations", &R::evaluations, "trial points of the fit"),
      field("failed_evaluations", &R::failed_evaluations, "of these could not be evaluated"),
      field("iterations", &R::iterations, "steps of the fit"),
      field("cpu_seconds", &R::cpu_seconds, "processor time [s]").finite());
}

/// Of a fit from several starts, without its optima.
constexpr auto fields_of(const FitSearches*) { return rows_of_starts<FitSearches>(); }

/// A number of a criterion; absent where there is none.
template <class T>
std::optional<T> if_judged(const ModelComparison& of, const T& value) {
  return of.refusal.empty() ? std::optional<T>(value) : std::nullopt;
}
/// A number of nested models.
template <class T>
std::optional<T> if_nested(const ModelComparison& of, const T& value) {
  return of.is_nested ? if_judged(of, value) : std::nullopt;
}
constexpr auto fields_of(const ModelComparison*) {
  using C = ModelComparison;
  return std::make_tuple(
      field(
          "refusal", [](const C& one) { return unless_empty(one.refusal); },
          "why there is no criterion"),
      field(
          "inflation", [](const C& one) { return if_judged(one, one.inflation); },
          "by which likelihoods are divided: that of the model with more numbers")
          .finite(),
      field(
          "criterion", [](const C& one) { return if_judged(one, one.criterion); },
          "Akaike's, here minus there; negative: this model is expected to predict better")
          .finite(),
      field(
          "nested", [](const C& one) { return if_judged(one, one.is_nested); },
          "whether the numbers of one are among those of the other"),
      field(
          "larger",
          [](const C& one) {
            return if_nested(one, std::string(one.is_here_larger ? "here" : "other"));
          },
          "which of nested models has more numbers"),
      field(
          "statistic", [](const C& one) { return if_nested(one, one.statistic); },
          "likelihood ratio of nested models; negative: the larger one has not been fitted to its "
          "optimum")
          .finite(),
      field(
          "degrees", [](const C& one) { return if_nested(one, one.degrees); },
          "further numbers of the larger one"),
      field(
          "probability", [](const C& one) { return if_nested(one, one.probability); },
          "of a ratio as large if these are not needed")
          .finite());
}

/// What the other model and this one leave of an output, and explain.
struct JudgedPair {
  std::array<double, 2> rms, explained;
};
constexpr auto fields_of(const JudgedPair*) {
  return std::make_tuple(
      field("rms", &JudgedPair::rms, "root mean squares of the residuals, there and here").finite(),
      field("explained", &JudgedPair::explained, "shares that are explained, there and here")
          .finite());
}

/// With the plain trajectory, and with that found.
struct BeforeAfter {
  double before, after;
};
constexpr auto fields_of(const BeforeAfter*) {
  return std::make_tuple(field("before", &BeforeAfter::before, "with the plain trajectory"),
                         field("after", &BeforeAfter::after, "with the trajectory found"));
}

/// How well a number is known.
struct Uncertainty {
  double deviation, half_interval;
};
constexpr auto fields_of(const Uncertainty*) {
  return std::make_tuple(
      field("deviation", &Uncertainty::deviation,
            "standard deviation, in the unit of the number; null if it is not determined"),
      field("half_interval", &Uncertainty::half_interval,
            "half the width of the interval, in the unit of the number"));
}

constexpr auto fields_of(const PredictedNumber*) {
  using N = PredictedNumber;
  return std::make_tuple(
      field("nominal", &N::nominal, "value at which the prediction is made, in `unit`"),
      field("unit", &N::unit, "as the model or the kind of number says; empty without one"),
      field("determined", &N::is_determined, "whether any trajectory determines it"),
      field(
          "before",
          [](const N& one) {
            return Uncertainty{one.deviation_before, one.half_before};
          },
          "with the plain trajectory"),
      field(
          "after",
          [](const N& one) {
            return Uncertainty{one.deviation, one.half};
          },
          "with the trajectory found"));
}

constexpr auto fields_of(const KeptLimit*) {
  return std::make_tuple(field(
                             "lower", [](const KeptLimit& one) { return one.limits.lower; },
                             "limit, in the unit of the signal; null without one"),
                         field(
                             "upper", [](const KeptLimit& one) { return one.limits.upper; },
                             "limit; null without one"),
                         field(
                             "lowest", [](const KeptLimit& one) { return one.reached.lowest; },
                             "smallest value along the trajectory"),
                         field(
                             "highest", [](const KeptLimit& one) { return one.reached.highest; },
                             "largest value along the trajectory"));
}

/// The factor by which one interval shrinks on average: the root of that of the volume, of as many
/// as are counted.
inline double mean_factor(const ExcitationResult& of) {
  return of.counted == 0 ? 1.0 : std::pow(of.volume_factor(), 1.0 / of.counted);
}

/// A prediction; absent where no trajectory was found.
template <class T>
std::optional<T> if_predicted(const ExcitationResult& of, const T& value) {
  return of.numbers.empty() ? std::nullopt : std::optional<T>(value);
}
/// A prediction for a trajectory that the mechanism follows.
template <class T>
std::optional<T> if_followed(const ComparedTrajectory& of, const T& value) {
  return of.status.ok() ? std::optional<T>(value) : std::nullopt;
}

constexpr auto fields_of(const ExcitationResult*) {
  using R = ExcitationResult;
  return std::make_tuple(
      field("termination", &R::termination, "why the best search ended"),
      field("evaluations", &R::evaluations, "trajectories that were tried, over all searches"),
      field("cpu_seconds", &R::cpu_seconds, "processor time [s]").finite(),
      field(
          "volume_factor", [](const R& one) { return if_predicted(one, one.volume_factor()); },
          "by which the volume of the intervals falls"),
      field(
          "mean_factor", [](const R& one) { return if_predicted(one, mean_factor(one)); },
          "by which one interval shrinks on average"),
      field(
          "undetermined", [](const R& one) { return if_predicted(one, one.undetermined); },
          "sentences on numbers that no trajectory determines"),
      field(
          "condition",
          [](const R& one) {
            return if_predicted(one, BeforeAfter{one.condition_before, one.condition});
          },
          "number of the Jacobian by the base parameters, residuals over the noise, numbers in SI "
          "units; null if not all are determined"));
}

/// Without what is relative to the plain trajectory, and what has the names of numbers, base
/// parameters and limits.
constexpr auto fields_of(const ComparedTrajectory*) {
  using C = ComparedTrajectory;
  return std::make_tuple(
      field("samples", &C::samples, "of the trajectory of `--compare`"),
      field("rate", &C::rate, "its samples per second [Hz]").finite(),
      field(
          "condition", [](const C& one) { return if_followed(one, one.condition); }, "as above"));
}

constexpr auto fields_of(const ExcitationStart*) {
  using S = ExcitationStart;
  return std::make_tuple(field("initial_criterion", &S::initial_criterion,
                               "at its start: the criterion (46a) of doc/theory.md, smaller where "
                               "the recording tells more"),
                         field("criterion", &S::criterion, "the same at its end"),
                         field("evaluations", &S::evaluations, "trajectories that it tried"),
                         field("termination", &S::termination, "why it ended"));
}

}  // namespace codesign
