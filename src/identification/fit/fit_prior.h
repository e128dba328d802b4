// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "identification/fit/relative_inertia.h"

namespace codesign {

/// What is known of a free inertia before a fit, doc/theory.md (39b), by its matrix E relative to
/// the start:
///   w (tr E - ln det E - 4) + ((E_44 - 1) / s_m)^2 + sum (E_i4 / s_c)^2 + sum ((E_ij - 1_ij) /
///   s_J)^2,
/// the divergence of its pseudo-inertia from the one of the start, of which w is small, and the
/// priors that a study states.
struct InertiaPrior {
  std::array<int, 10> columns{};  ///< of its ten numbers in x, in the order of kLogCholeskyNames
  RelativeInertia relative;
  double weight = 0.0;  ///< w
  /// s_m, s_c, s_J: of mass, centre and moments; infinite: nothing is stated
  double mass = std::numeric_limits<double>::infinity();
  double centre = std::numeric_limits<double>::infinity();
  double moments = std::numeric_limits<double>::infinity();

  RelativeInertia::Ten numbers(const Eigen::VectorXd& x) const { return x(columns); }
  /// One over the deviations of symmetric_numbers(E).
  SymmetricNumbers stated() const;
};

/// What is known before a fit: a sum of squares that is added to its cost.
struct FitPrior {
  /// Normal distributions about `known` with these standard deviations add ((x - known) /
  /// deviation)^2; infinite: nothing. Empty: nothing of any variable.
  Eigen::VectorXd deviations, known;
  std::vector<InertiaPrior> inertias;

  bool empty() const { return deviations.size() == 0 && inertias.empty(); }
  /// Rows whose sum of squares is the term of the prior, and their derivatives.
  Eigen::VectorXd rows(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;
  double cost(const Eigen::VectorXd& x) const { return rows(x).squaredNorm(); }
};

}  // namespace codesign
