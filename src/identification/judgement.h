// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identification/effort/effort_residuals.h"
#include "identification/fit/identification_result.h"
#include "identification/fit/residual_fit.h"
#include "statistics/identifiability.h"

namespace codesign {

/// One OutputFit per output. @param start, residuals rows x outputs. @param spreads, loss of the
/// fit, by which outliers count less in the share that it explains
std::vector<OutputFit> judge_outputs(const RecordingResiduals& source, const Eigen::MatrixXd& start,
                                     const Eigen::MatrixXd& residuals,
                                     const Eigen::VectorXd& spreads, const LossOptions& loss);

/// Sets numbers, covariance, rank, lag and the sentences about numbers that the data do not
/// determine, from a fit with a best point.
/// @param source of the fit. @param delays their columns count without the noise of recorded
/// efforts, doc/theory.md (33a)
void judge_numbers(const FitVariables& variables, const IdentificationDescription& options,
                   const ResidualSource& source, const std::vector<DelaySignal>& delays,
                   const ResidualFit& fit, IdentificationResult* result);

/// Whether a prior decides all that the data leave open: every direction that changes no residual
/// changes the prior. @param result with numbers judged by judge_numbers()
bool decides_the_rest(const FitPrior& prior, const ResidualFit& fit, const LossOptions& loss,
                      const IdentificationResult& result);

/// The same of directions that were found. @param columns of x to which they belong
bool decides(const FitPrior& prior, const Eigen::VectorXd& x, const std::vector<int>& columns,
             const Identifiability& found);

/// kNotIdentifiable: `what`, and the first of the sentences; all stand in the result.
Status not_identifiable(const std::string& what, const std::vector<std::string>& sentences);

/// Computes intervals of the profile likelihood of all numbers that the data determine: each number
/// is fixed in turn, and all others are fitted again.
/// @param problem, source as in the fit. @param cancel once set, ends the profiles early. @param
/// observer called after each evaluation, with FitTrial::profile set; may be empty.
void add_profiles(const FitProblem& problem, const IdentificationDescription& options,
                  const ResidualFit& fit, ResidualSource* source, const FitObserver& observer,
                  const std::atomic<bool>* cancel, IdentificationResult* result);

}  // namespace codesign
