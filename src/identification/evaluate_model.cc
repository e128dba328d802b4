// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>
#include <vector>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/fit/given_motion.h"
#include "identification/fit_doubts.h"
#include "identification/identify.h"
#include "identification/judgement.h"
#include "identification/residuals_of_recordings.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The residuals at x, with the spreads that they have themselves. Unknown states of segments are
/// the best ones for these spreads, which are found in two passes.
Status evaluate_at(const Eigen::VectorXd& x, const LossOptions& loss, RecordingResiduals* source,
                   Eigen::MatrixXd* residuals, Eigen::VectorXd* spreads) {
  Status status = source->begin(x);
  *spreads = Eigen::VectorXd::Ones(source->recorded().cols());
  const int passes = source->own_unknowns() > 0 ? 2 : 1;
  for (int pass = 0; pass < passes && status.ok(); ++pass) {
    source->count_by(*spreads, loss);
    status = source->evaluate(x, residuals, nullptr);
    if (status.ok())
      *spreads = spreads_of(*residuals, loss, source->counted()).unaryExpr([](double spread) {
        return spread > 0.0 ? spread : 1.0;
      });
  }
  return status;
}

/// Outputs and series of one set of recordings; empty for none.
struct JudgedSet {
  std::vector<OutputFit> outputs;
  FittedSeries series;
  Eigen::Index samples = 0;
};

Status judge(const Problem& problem, const FitVariables& variables,
             const std::vector<MeasuredJoint>& joints,
             const std::vector<JointRecording>& recordings, const std::atomic<bool>* cancel,
             Warnings* warnings, JudgedSet* set) {
  if (recordings.empty()) return {};
  const auto source = make_residuals(problem, variables, joints, recordings, cancel, warnings);
  if (!source) return {StatusCode::kCancelled, 0.0, "cancelled"};
  source->obey(cancel);
  const LossOptions& loss = study_of(problem).identification->loss;
  Eigen::MatrixXd residuals;
  Eigen::VectorXd spreads;
  Status status = evaluate_at(variables.start(), loss, source.get(), &residuals, &spreads);
  if (!status.ok()) return status;
  set->outputs = judge_outputs(*source, residuals, residuals, spreads, loss);
  set->series = series_of(*source, residuals);
  set->samples = source->rows();
  return status;
}

}  // namespace

IdentificationResult evaluate_model(const Problem& problem, const StudyRecordings& given,
                                    const std::atomic<bool>* cancel) {
  const CpuTimer timer(CpuTimer::Of::kProcess);
  IdentificationResult result;
  result.termination = kEvaluated;
  const std::optional<StudyRecordings> completed = with_given_motions(problem, given);
  const StudyRecordings& recordings = completed ? *completed : given;
  std::vector<JointRecording> all = recordings.data;
  all.insert(all.end(), recordings.holdout.begin(), recordings.holdout.end());
  if (all.empty())
    throw InputError({study_of(problem).identification->where, "identify.data",
                      "the study has no recordings by which to judge the model", "",
                      "at least one recording under identify.data or identify.holdout"});
  const std::vector<MeasuredJoint> joints = require_same_joints(all);
  require_same_signals(all);
  const FitVariables variables(study_of(problem), &robot_of(problem));
  result.x = variables.start();
  result.parameters = variables.parameters(result.x);
  JudgedSet data, holdout;
  result.status =
      judge(problem, variables, joints, recordings.data, cancel, &result.warnings, &data);
  if (result.status.ok())
    result.status =
        judge(problem, variables, joints, recordings.holdout, cancel, &result.warnings, &holdout);
  if (result.status.code == StatusCode::kCancelled) result.termination = "cancelled";
  if (!result.status.ok()) return result;
  result.data = std::move(data.outputs);
  result.data_series = std::move(data.series);
  result.samples = data.samples;
  result.holdout = std::move(holdout.outputs);
  result.holdout_series = std::move(holdout.series);
  result.holdout_samples = holdout.samples;
  Status unused;  // an evaluation that finds a model wrong has not failed
  Warnings doubts =
      doubts_about(problem, recordings.data.empty() ? recordings.holdout : recordings.data, result,
                   cancel, &unused);
  append(result.warnings, &doubts);
  result.warnings = std::move(doubts);
  result.evaluations = 1;
  result.cpu_seconds = timer.seconds();
  return result;
}

}  // namespace codesign
