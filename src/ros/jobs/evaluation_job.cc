// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>

#include "description/study.h"
#include "ensemble/ensemble.h"
#include "ensemble/other_steps.h"
#include "ensemble/parameter_rows.h"
#include "jobs/result_fields.h"
#include "mechanism_codesign/gradient.h"
#include "optimization/smooth_program.h"
#include "problem/load_problem.h"
#include "ros/common/message_fields.h"
#include "ros/jobs/job.h"
#include "ros/jobs/messages.h"
#include "ros/jobs/request.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

CheckMethod method_of(const std::string& check) {
  if (check == "complex_step") return CheckMethod::kComplexStep;
  if (check == "ridders") return CheckMethod::kRidders;
  throw unknown_name({"request", 0}, "check", "gradient check", check, {"complex_step", "ridders"});
}

/// Margins of the constraints on parameters, and the ranges of the watched signals.
void add_constraints(const Problem& problem, const Ensemble& ensemble, const Eigen::VectorXd& rho,
                     const std::vector<Extremes>& extremes,
                     mechanism_codesign::EvaluateResponse* reply) {
  for (const ParameterConstraint& constraint : study_of(problem).constraints)
    reply->constraints.push_back(constraint.text);
  reply->margins = to_array(ParameterRows(study_of(problem), ensemble.scenarios()).margins(rho));
  reply->signals = watched_messages(SmoothProgram(ensemble).describe(extremes, extremes, rho),
                                    study_of(problem).ensemble.is_ensemble());
}

void compute(const Problem& problem, const mechanism_codesign::EvaluateRequest& request,
             Dispatcher* ranks, const std::atomic<bool>& cancel,
             mechanism_codesign::EvaluateResponse* reply) {
  const Eigen::VectorXd rho = design_of(problem, request);
  const Ensemble ensemble(problem, 1, {nullptr, nullptr, ranks});
  GradientCheck check;
  std::vector<Extremes> extremes;
  if (request.check.empty()) {
    EnsembleEvaluation all = ensemble.evaluate(rho, !request.objective_only, &cancel);
    check.evaluation = std::move(all.total);
    check.status = check.evaluation.status;
    extremes = std::move(all.extremes);
  } else {
    check = check_gradient(ensemble, rho, method_of(request.check), &cancel);
    check_other_steps(ensemble, rho, &cancel, &check);
    check_steps(ensemble, rho, &cancel, &check);
    // A check computes many runs, so that one more run per scenario for the signals is cheap.
    if (check.status.ok() && !study_of(problem).watched.empty())
      extremes = ensemble.evaluate(rho, false, &cancel).extremes;
  }
  set_status(check.status, reply);
  add_constraints(problem, ensemble, rho, extremes, reply);
  reply->parameters = problem.tuned_names();
  reply->values = to_array(rho);
  reply->objective = check.evaluation.objective;
  reply->gradient = to_array(check.evaluation.gradient);
  reply->reference = to_array(check.reference);
  reply->reference_error = to_array(check.reference_error);
  reply->largest_relative_difference = check.largest_relative_difference;
  reply->along = check.independent.along;
  reply->derivative = check.independent.derivative;
  reply->derivative_error = check.independent.error;
  if (check.independent.is_known()) reply->derivative_steps = describe_steps(check.independent);
  set_fields(check.evaluation.statistics, reply);
  reply->warnings = warning_messages(problem.warnings(), check.evaluation.warnings);
}

}  // namespace

mechanism_codesign::EvaluateResponse run_evaluation(
    const Problem& problem, const mechanism_codesign::EvaluateRequest& request,
    const std::atomic<bool>& cancel, Dispatcher* ranks) {
  mechanism_codesign::EvaluateResponse reply;
  const auto failure = failure_of([&] { compute(problem, request, ranks, cancel, &reply); });
  if (failure) refuse(failure->code, failure->message, &reply);
  return reply;
}

}  // namespace codesign
