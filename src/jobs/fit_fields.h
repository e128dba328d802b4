// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <tuple>

#include "excitation/excitation_result.h"
#include "identification/fit/identification_result.h"
#include "jobs/fields.h"
#include "jobs/recording_records.h"

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

/// Without bounds and intervals.
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
          "standard deviation"));
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

/// Without joint and whiteness.
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

constexpr auto fields_of(const Whiteness*) {
  return std::make_tuple(
      field("ljung_box", &Whiteness::statistic, "the statistic of Ljung and Box"),
      field("lags", &Whiteness::lags, "number of correlations in it"),
      field("probability", &Whiteness::probability, "of such a statistic for white residuals"),
      field("first_correlation", &Whiteness::first_correlation,
            "of neighbouring residuals, -1 to 1"));
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

constexpr auto fields_of(const ExcitationResult*) {
  using R = ExcitationResult;
  return std::make_tuple(
      field("termination", &R::termination, "why the best search ended"),
      field("evaluations", &R::evaluations, "trajectories that were tried, over all searches"),
      field("cpu_seconds", &R::cpu_seconds, "processor time [s]").finite());
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
