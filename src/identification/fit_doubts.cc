// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit_doubts.h"

#include <algorithm>
#include <utility>

#include "description/study.h"
#include "problem/load_problem.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// A holdout is not explained if its residuals are larger than those of the fitted data times this.
constexpr double kHoldoutFactor = 1.5;
// Share of signal in the slope of a recorded effort below which a warning is given.
constexpr double kSlopeSignal = 0.8;
constexpr double kExplainsNothing = 0.1;  // share of an output below which a fit has failed
constexpr double kWhiteBelow = 0.01;      // probability below which residuals do not count as white

/// A motion is driven by the recorded efforts of its joint; its output is `JOINT/position`. Signals
/// may have names that begin alike and belong to no joint: empty.
std::string joint_of(const IdentificationDescription& options, const OutputFit& fit) {
  if (fit.is_signal) return "";
  return options.residual == ResidualKind::kMotion ? fit.joint.substr(0, fit.joint.rfind('/'))
                                                   : fit.joint;
}

/// Doubts about joints that the fit explains. Numbers without bounds near them follow an effort in
/// another unit, so that the fit is no answer to such a doubt.
std::vector<EffortDoubt> doubts_despite_fit(const IdentificationDescription& options,
                                            const IdentificationResult& result,
                                            const std::vector<EffortDoubt>& doubts) {
  std::vector<EffortDoubt> left;
  for (const EffortDoubt& doubt : doubts) {
    double explained = 1.0;
    for (const OutputFit& fit : result.outputs())
      if (joint_of(options, fit) == doubt.joint) explained = std::min(explained, fit.explained);
    if (explained < kExplainedHalf) continue;  // told with what the fit does not explain
    if (doubt.is_unit || doubt.mended >= explained + kClearly) left.push_back(doubt);
  }
  return left;
}

/// Whether most points of a fit could not be evaluated.
bool is_fit_hindered(const IdentificationResult& result) {
  return 2 * result.failed_evaluations > result.evaluations;
}

std::string unexplained_sentence(const std::string& who, const std::string& output,
                                 const std::string& mistake) {
  return who + " does not explain " + output + ": " + mistake;
}

/// @param joint whose recorded effort drives the motion; empty: efforts are compared
std::string explained_sentence(const std::string& who, const OutputFit& fit,
                               const std::string& joint, const std::string& mistake) {
  return who + " explains " + readable(100.0 * std::max(0.0, fit.explained), 2) + " % of " +
         fit.joint + ": sign, unit, order?" +
         (!joint.empty() && !mistake.empty() ? " the recorded effort of " + joint + ":" : "") +
         (mistake.empty() ? "" : " " + mistake);
}

}  // namespace

Warnings doubts_about(const Problem& problem, const std::vector<JointRecording>& recordings,
                      const IdentificationResult& result, const std::atomic<bool>* cancel,
                      Status* failure) {
  double explained = 1.0;
  for (const OutputFit& fit : result.outputs()) explained = std::min(explained, fit.explained);
  std::vector<EffortDoubt> doubts;
  if (!is_set(cancel)) doubts = find_effort_doubts(problem, recordings, explained);
  return unexplained_outputs(*study_of(problem).identification, result, doubts, failure);
}

Warnings unexplained_outputs(const IdentificationDescription& options,
                             const IdentificationResult& result,
                             const std::vector<EffortDoubt>& doubts, Status* failure) {
  Warnings warnings;
  const bool is_motion = options.residual == ResidualKind::kMotion;
  const std::string who = result.termination == kEvaluated ? "the model" : "the fit";
  for (const OutputFit& fit : result.outputs()) {
    if (!(fit.explained < kExplainedHalf)) continue;
    const std::string joint = joint_of(options, fit);
    const auto doubt = std::find_if(doubts.begin(), doubts.end(),
                                    [&joint](const EffortDoubt& of) { return of.joint == joint; });
    const std::string mistake = doubt == doubts.end() ? "" : sentence_of(*doubt);
    const bool is_filter = doubt != doubts.end() && doubt->cutoff > 0.0,
               is_hindered = !is_filter && mistake.empty() && is_fit_hindered(result);
    std::string sentence = explained_sentence(who, fit, is_motion ? joint : "", mistake);
    if (is_filter) sentence = unexplained_sentence(who, fit.joint, mistake);
    if (is_hindered)
      sentence =
          "most points of the fit could not be evaluated, and the best of the others explains less "
          "than half of " +
          fit.joint;
    const std::string allowed =
        is_filter ? "at least half; a cutoff above the frequencies of the motion"
        : is_hindered
            ? "at least half; bounds or twins that leave such points out, or another start"
        : fit.is_signal ? "at least half; the signal in SI units, along the axes that its name says"
        : is_motion
            ? "at least half; positions in rad or m along the axis of the joint, efforts on the "
              "child in N m or N along the same axis, "
              "and the controllers and loads that drove the recording"
            : "at least half; a recording in N m or N on the child, along the axis of its joint";
    warnings.push_back(warn(is_motion ? "motion_not_explained" : "effort_not_explained",
                            {options.where, "identify.data", sentence, "", allowed}));
    if (failure->ok() && (fit.explained < kExplainsNothing || !mistake.empty()))
      *failure = {StatusCode::kNotIdentifiable, 0.0, sentence};
  }
  append(warnings_of(options, doubts_despite_fit(options, result, doubts)), &warnings);
  return warnings;
}

Warnings warnings_of(const IdentificationDescription& options, const IdentificationResult& result) {
  Warnings warnings;
  for (std::size_t k = 0; k < result.holdout.size(); ++k) {
    const double here = result.holdout[k].rms, there = result.data[k].rms;
    if (!(here > kHoldoutFactor * there)) continue;
    warnings.push_back(warn(
        "holdout_failed",
        {options.where, "identify.holdout",
         "the fitted model does not explain the holdout: root mean square of the residuals of " +
             result.holdout[k].joint + ", " + readable(there) + " on the fitted data",
         readable(here), "at most " + readable(kHoldoutFactor * there)}));
  }
  if (result.termination == "max_evaluations_reached")
    warnings.push_back(warn(
        "max_evaluations_reached",
        {options.where, "optimizer.max_evaluations",
         "the fit ended before it reached an optimum; its numbers are those of the best point",
         std::to_string(result.evaluations), "more evaluations, or a larger relative_tolerance"}));
  if (is_fit_hindered(result))
    warnings.push_back(warn(
        "fit_hindered",
        {options.where, "identify",
         std::to_string(result.failed_evaluations) + " of " + std::to_string(result.evaluations) +
             " points could not be evaluated, the last one for: " + result.last_failure.cause,
         "", "bounds or twins that leave such points out, or another start"}));
  for (const IdentifiedNumber& number : result.numbers)
    if (number.is_on_bound)
      warnings.push_back(warn("identified_on_bound",
                              {options.where, number.name,
                               "the fit ends on a bound, so that this number has no interval",
                               readable(number.value), "wider bounds, or other data"}));
  for (const IdentifiedNumber& number : result.numbers)
    if (number.slope_signal < kSlopeSignal)
      warnings.push_back(
          warn("delay_in_noise",
               {options.where, number.name,
                "noise makes up for " + readable(100.0 * (1.0 - number.slope_signal), 2) +
                    " % of the slope of the recorded effort, by which this delay is found; its "
                    "interval counts that, but "
                    "not that the delay is drawn to where samples are interpolated most smoothly",
                readable(number.value),
                "a lower identify.filter.residual_cutoff, where the noise begins"}));
  for (const OutputFit& fit : result.outputs())
    if (options.intervals.noise == NoiseModel::kWhite && fit.whiteness.probability < kWhiteBelow)
      warnings.push_back(
          warn("correlated_residuals",
               {options.where, "identify.intervals.noise",
                "the residuals of " + fit.joint + " are correlated (correlation of neighbours " +
                    readable(fit.whiteness.first_correlation) +
                    "), so that these intervals are too narrow",
                "white", "correlated"}));
  return warnings;
}

}  // namespace codesign
