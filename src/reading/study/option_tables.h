// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "description/excitation.h"
#include "description/identification.h"
#include "description/loss_law.h"
#include "description/study.h"

namespace codesign {

/// The allowed values of a number.
struct OptionRange {
  double least, most;
  bool has_least = true, has_most = true;  ///< whether the ends are allowed themselves
  const char* fault = nullptr;    ///< the message for another value; null: "KEY out of range"
  const char* allowed = nullptr;  ///< the allowed values in words; null: in_words() says them

  /// The same without its ends.
  constexpr OptionRange without_ends() const { return {least, most, false, false, fault, allowed}; }
  /// The same with its own words for a value outside it.
  constexpr OptionRange saying(const char* own_fault, const char* own_allowed = nullptr) const {
    return {least, most, has_least, has_most, own_fault, own_allowed ? own_allowed : allowed};
  }

  bool is_bounded() const { return most < std::numeric_limits<double>::infinity(); }
  bool holds(double value) const {
    return (has_least ? value >= least : value > least) &&
           (has_most ? value <= most : value < most);
  }
  /// "0 or more", "more than 0 and less than 1", "a whole number from 1 to 4".
  std::string in_words() const;
};

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr OptionRange kZeroOrMore{0.0, kUnbounded},
    kAboveZero = kZeroOrMore.without_ends(), kProperFraction = OptionRange{0.0, 1.0}.without_ends();
constexpr OptionRange kCount = OptionRange{1.0, kUnbounded}.saying("count out of range");
constexpr OptionRange kPositive = kAboveZero.saying("not above zero");
constexpr OptionRange kTime =
    kZeroOrMore.saying("number out of range", "a positive number of seconds, or 0 for none");
constexpr OptionRange kSeed{0.0, std::numeric_limits<int>::max()};
constexpr OptionRange tolerance_from(double least) {
  return {least, 1.0, true, false, "tolerance out of range"};
}
// Smallest tolerances that double precision (rounding 1.1e-16) can meet: a relative error test
// needs some hundred roundings, an absolute one the rounding of a position of 1 m.
constexpr OptionRange kRelativeTolerance = tolerance_from(1e-13),
                      kAbsoluteTolerance = tolerance_from(1e-16);

constexpr std::array<const char*, 12> kAlgorithmNames{
    "auto",  "lbfgs", "var1",   "var2",   "tnewton",      "mma",
    "ccsaq", "slsqp", "cobyla", "bobyqa", "auglag_lbfgs", "levenberg_marquardt"};

/// The losses of an identification by their names in studies: those with a weight, where a sum of
/// squares is named `none`.
std::vector<std::pair<std::string, LossKind>> fit_losses();

// The keys of each block of options: visit(key, range or names of the choices, option) for each, in
// the order of messages. Defaults are in the structures. From these rows come the reader, the list
// of known keys and the test of the tables of keys in doc/study.md.

template <class Visit>
void visit_options(const Visit& visit, LimitOptions* of) {
  visit("effort", of->effort);
  visit("position", of->position);
  visit("stiffness", kAboveZero, of->stiffness);
  visit("dissipation", kZeroOrMore, of->dissipation);
  visit("width", kAboveZero, of->width);
}

template <class Visit>
void visit_options(const Visit& visit, SolverOptions* of) {
  visit("integrator", kIntegratorNames, of->integrator);
  visit("method", kRosenbrockMethodNames, of->method);
  visit("gradient", kGradientMethodNames, of->gradient);
  visit("relative_tolerance", kRelativeTolerance, of->relative_tolerance);
  visit("absolute_tolerance", kAbsoluteTolerance, of->absolute_tolerance);
  visit("sensitivity_tolerance", kRelativeTolerance, of->sensitivity_tolerance);
  visit("initial_step", kTime, of->initial_step);
  visit("maximum_step", kTime, of->maximum_step);
  visit("maximum_steps", kCount, of->maximum_steps);
  visit("maximum_speed",
        kTime.saying(kTime.fault, "a positive speed in m/s and rad/s, or 0: chosen"),
        of->maximum_speed);
  visit("closure_tolerance", kZeroOrMore, of->closure_tolerance);
  visit("coordinates", kCoordinatesNames, of->coordinates);
}

template <class Visit>
void visit_options(const Visit& visit, OptimizerOptions* of) {
  visit("algorithm", kAlgorithmNames, of->algorithm);
  visit("max_evaluations", kCount, of->max_evaluations);
  visit("relative_tolerance", tolerance_from(1e-15), of->relative_tolerance);
}

template <class Visit>
void visit_options(const Visit& visit, RobustOptions* of) {
  visit("measure", kRobustMeasureNames, of->measure);
  visit("level", kProperFraction, of->level);
  visit("factor", kZeroOrMore, of->factor);
  visit("samples", OptionRange{1, 100000}, of->samples);
  visit("sampler", kSamplerNames, of->sampler);
  visit("seed", kSeed, of->seed);
  visit("validate", OptionRange{0, 1000000}, of->validate);
  visit("failed", kFailedSamplesNames, of->failed);
}

template <class Visit>
void visit_options(const Visit& visit, MultistartOptions* of) {
  visit("starts", OptionRange{1, 100000}, of->starts);
  visit("sampler", kSamplerNames, of->sampler);
  visit("seed", kSeed, of->seed);
  visit("screen", OptionRange{static_cast<double>(of->starts), 10000000}, of->screen);
  visit("cluster", kProperFraction, of->cluster);
}

template <class Visit>
void visit_options(const Visit& visit, EngineOptions* of) {
  visit("type", kEngineNames, of->kind);
  visit("workers", OptionRange{1, 4096}, of->workers);
}

template <class Visit>
void visit_options(const Visit& visit, FilterOptions* of) {
  constexpr OptionRange kCutoff =
      kZeroOrMore.saying("a cutoff is a frequency", "more than 0 Hz, or 0 for no filter");
  visit("cutoff", kCutoff, of->cutoff);
  visit("residual_cutoff", kCutoff, of->residual_cutoff);
  visit("order", OptionRange{1, 8}, of->order);
  visit("decimate", OptionRange{1, 1000}, of->decimate);
}

template <class Visit>
void visit_options(const Visit& visit, LossOptions* of) {
  visit("type", of->kind);
  visit("scale",
        kPositive.saying(kPositive.fault, "more than 0, in units of the residuals' spread"),
        of->scale);
}

template <class Visit>
void visit_options(const Visit& visit, IntervalOptions* of) {
  visit("level",
        kProperFraction.saying("the level is a probability", "between 0 and 1, such as 0.95"),
        of->level);
  visit("noise", kNoiseNames, of->noise);
  visit("lag", OptionRange{1, std::numeric_limits<int>::max()}, of->lag);
  visit("profiles", of->profiles);
}

template <class Visit>
void visit_options(const Visit& visit, ExcitationDescription* of) {
  visit("trajectory", kTrajectoryNames, of->trajectory);
  visit("period", kPositive, of->period);
  visit("harmonics", OptionRange{2, 50}, of->harmonics);
  visit("knots", OptionRange{5, 500}, of->knots);
  visit("periods", OptionRange{1, 1000}, of->periods);
  visit("sample_rate", kPositive, of->sample_rate);
  visit("starts", OptionRange{1, 1000}, of->starts);
  visit("seed", OptionRange{0, 1000000000}, of->seed);
  visit("search", kTrajectorySearchNames, of->search);
  visit("max_evaluations", OptionRange{1, 1000000}, of->max_evaluations);
}

}  // namespace codesign
