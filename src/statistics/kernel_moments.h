// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "statistics/time_series.h"

namespace codesign {

/// The variances that a kernel estimates from contributions of parts of recordings, if the noise is
/// white and of variance one: p entries each, doc/theory.md (35).
struct KernelMoments {
  Eigen::VectorXd means;    ///< zero of parameters to which white noise contributes nothing
  Eigen::VectorXd degrees;  ///< 2 mean^2 / variance, at least 1, for Student's t
};

/// Residuals of a fit are r = (I - Q Q^T) e, the contribution of part i to the error of parameter k
/// is psi_i = a_i^T r_i with a_i = Q_i m_k.
/// @param Q orthonormal columns that span those of the Jacobian, N m x rank: rows as in
/// parameter_covariance()
/// @param outputs m. @param parts rows of each part, sum N. @param lengths parts of each recording
/// @param lag of the Bartlett kernel in parts; 0: parts are taken as independent
/// @param maps m, rank x p, of each part, or one for all
KernelMoments kernel_moments(const Eigen::MatrixXd& Q, Eigen::Index outputs,
                             const SeriesLengths& parts, const SeriesLengths& lengths, int lag,
                             const std::vector<Eigen::MatrixXd>& maps);

}  // namespace codesign
