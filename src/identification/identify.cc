// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/identify.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "description/study.h"
#include "identification/fit/given_motion.h"
#include "identification/fit/residual_source.h"
#include "identification/fit_doubts.h"
#include "identification/judgement.h"
#include "identification/residuals_of_recordings.h"
#include "math/cpu_timer.h"
#include "problem/load_problem.h"
#include "problem/margins.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The residuals to fit and, if there is a holdout, its residuals; null once `cancel` is set.
struct Sources {
  std::unique_ptr<RecordingResiduals> data, holdout;
};

Sources make_sources(const Problem& problem, const FitVariables& variables,
                     const StudyRecordings& recordings, const std::atomic<bool>* cancel,
                     Warnings* warnings) {
  std::vector<JointRecording> all = recordings.data;
  all.insert(all.end(), recordings.holdout.begin(), recordings.holdout.end());
  const std::vector<MeasuredJoint> joints = require_same_joints(all);
  require_same_signals(all);
  Sources sources;
  sources.data = make_residuals(problem, variables, joints, recordings.data, cancel, warnings);
  if (!recordings.holdout.empty())
    sources.holdout =
        make_residuals(problem, variables, joints, recordings.holdout, cancel, warnings);
  return sources;
}

IdentificationResult cancelled() {
  IdentificationResult result;
  result.status = {StatusCode::kCancelled, 0.0, "cancelled"};
  result.termination = "cancelled";
  return result;
}

FitProblem fit_problem(const Problem& problem, const FitVariables& variables) {
  FitProblem fit;
  fit.start = variables.start();
  fit.lower = variables.lower();
  fit.upper = variables.upper();
  fit.prior = variables.prior();
  fit.loss = study_of(problem).identification->loss;
  fit.max_evaluations = problem.optimizer_options().max_evaluations;
  fit.relative_tolerance = problem.optimizer_options().relative_tolerance;
  return fit;
}

/// Computes the residuals of recordings that were not fitted, at x.
Status judge_holdout(const FitVariables& variables, const ResidualFit& fit, const LossOptions& loss,
                     RecordingResiduals* residuals, IdentificationResult* result) {
  Eigen::MatrixXd at_start, at_end;
  residuals->count_by(fit.spreads, loss);
  Status status = residuals->begin(variables.start());
  if (status.ok()) status = residuals->evaluate(variables.start(), &at_start, nullptr);
  if (status.ok()) status = residuals->evaluate(result->x, &at_end, nullptr);
  if (!status.ok()) return status;
  result->holdout = judge_outputs(*residuals, at_start, at_end, fit.spreads, loss);
  result->holdout_series = series_of(*residuals, at_end);
  result->holdout_samples = residuals->rows();
  return status;
}

/// The fit knows bounds alone, so that constraints among parameters are looked at behind it.
Warnings unmet_constraints(const Study& study, const std::vector<double>& parameters) {
  Warnings warnings;
  for (const ParameterConstraint& constraint : study.constraints)
    if (const double margin = margin_left(constraint, parameters);
        !(margin >= least_margin(study, constraint)))
      warnings.push_back(
          warn("identified_outside_constraint",
               {constraint.where, constraint.element,
                "the fit keeps bounds alone, and the identified values do not meet this constraint "
                "(margin " +
                    to_decimal(margin) + ")",
                constraint.text,
                "bounds or twins that leave such values out, other data, or no such constraint"}));
  return warnings;
}

void require_data(const IdentificationDescription& options, const StudyRecordings& recordings) {
  if (recordings.data.empty())
    throw InputError({options.where, "identify.data",
                      "the study has no recordings to identify from", "",
                      "at least one recording"});
}

/// Adds the warnings of a finished fit, and the status of one that explains nothing, or of which
/// neither data nor prior determine all numbers.
void add_doubts(const Problem& problem, const std::vector<JointRecording>& data,
                bool is_rest_decided, const std::atomic<bool>* cancel,
                IdentificationResult* result) {
  Status unexplained;
  Warnings found = doubts_about(problem, data, *result, cancel, &unexplained);
  append(warnings_of(*study_of(problem).identification, *result), &found);
  append(unmet_constraints(study_of(problem), result->parameters), &found);
  append(result->warnings, &found);
  result->warnings = std::move(found);
  if (result->status.ok()) result->status = unexplained;
  if (result->status.ok() && !result->undetermined.empty() && !is_rest_decided)
    result->status =
        not_identifiable("the data do not determine all numbers", result->undetermined);
}

}  // namespace

void require_recordings_named(const Problem& problem) {
  if (!study_of(problem).identification)
    throw InputError({{study_of(problem).file, 1},
                      "identify",
                      "the study has no recordings to identify from",
                      "",
                      "a block identify"});
}

void require_identification(const Problem& problem) {
  require_recordings_named(problem);
  if (FitVariables(study_of(problem), &robot_of(problem)).size() == 0)
    throw InputError({study_of(problem).identification->where, "identify",
                      "there is nothing to identify", "",
                      "at least one parameter under parameters, or a map under "
                      "identify.joints.JOINT; codesign identify --evaluate judges the model as it "
                      "stands"});
}

IdentificationResult identify(const Problem& problem, const StudyRecordings& given,
                              const FitObserver& observer, const std::atomic<bool>* cancel) {
  const CpuTimer timer(CpuTimer::Of::kProcess);
  const IdentificationDescription& options = *study_of(problem).identification;
  if (is_set(cancel)) return cancelled();  // perhaps already in load_recordings()
  require_data(options, given);
  const std::optional<StudyRecordings> completed = with_given_motions(problem, given);
  const StudyRecordings& recordings = completed ? *completed : given;
  const FitVariables variables(study_of(problem), &robot_of(problem));
  IdentificationResult result;
  const auto [data, holdout] =
      make_sources(problem, variables, recordings, cancel, &result.warnings);
  if (is_set(cancel)) return cancelled();
  RecordingResiduals& residuals = *data;
  // The holdout does not: it is judged after a cancel, too, which takes two evaluations.
  residuals.obey(cancel);

  const FitProblem limits = fit_problem(problem, variables);
  result.status = residuals.begin(limits.start);
  if (!result.status.ok()) {
    result.termination =
        result.status.code == StatusCode::kCancelled ? "cancelled" : "start_failed";
    return result;
  }
  const ResidualFit fit = fit_from_starts(limits, study_of(problem).ensemble.multistart, &residuals,
                                          observer, &result.searches);
  result.status = fit.status;
  result.termination = fit.termination;
  result.evaluations = fit.evaluations;
  result.failed_evaluations = fit.failed_evaluations;
  result.iterations = fit.iterations;
  result.last_failure = fit.last_failure;
  if (fit.residuals.size() == 0) return result;

  // The uncertainties at the best point are computed even after a cancel; they need no further
  // evaluation.
  result.x = fit.x;
  result.parameters = variables.parameters(fit.x);
  result.samples = residuals.rows();
  result.data =
      judge_outputs(residuals, fit.start_residuals, fit.residuals, fit.spreads, options.loss);
  result.data_series = series_of(residuals, fit.residuals);
  judge_numbers(variables, options, residuals, residuals.delay_signals(fit.x), fit, &result);
  if (options.intervals.profiles && !is_set(cancel))
    add_profiles(limits, options, fit, &residuals, observer, cancel, &result);
  if (options.intervals.profiles && is_set(cancel) && result.status.ok())
    result.status = {StatusCode::kCancelled, 0.0, "cancelled"};
  if (holdout) {
    const Status status = judge_holdout(variables, fit, options.loss, holdout.get(), &result);
    if (result.status.ok()) result.status = status;
  }
  add_doubts(problem, recordings.data, decides_the_rest(limits.prior, fit, options.loss, result),
             cancel, &result);
  result.cpu_seconds = timer.seconds();
  return result;
}

}  // namespace codesign
