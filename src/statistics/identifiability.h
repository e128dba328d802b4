// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace codesign {

/// Which of p parameters the residuals of a fit determine, to first order, by the rank of their
/// Jacobian J; doc/theory.md (32).
struct Identifiability {
  int rank = 0;
  /// of J with columns scaled to length one (columns of zeros stay), descending; p entries
  Eigen::VectorXd singular_values;
  /// p - rank parameters whose effect the other parameters can reproduce: for each other parameter
  /// i, the data determine only the sum x_i + sum_d C_id x_d.
  std::vector<int> dependent;
  /// p x (p - rank): directions that change no residual. Column k has a one at dependent[k], zeros
  /// at the other dependent parameters, and -C_ik elsewhere: as many zeros as the choice of
  /// `dependent` allows.
  Eigen::MatrixXd null_directions;
  /// p entries: whether no null direction moves the parameter, so that the data determine it.
  std::vector<bool> is_determined;
};

/// Sets columns of a Jacobian to zero that hold only rounding errors. A variable has such a column
/// if a change by its magnitude, or by 1 if that is more, changes the residuals by less than 1e-12
/// of the change by the most influential variable. find_identifiable() scales columns to length one
/// and would take such a variable for known.
/// @param x the variables at the Jacobian, one per column. @param magnitude of the compared
/// quantities, if it is known: counts as the influence of a variable, too.
void clear_rounding(const Eigen::VectorXd& x, Eigen::MatrixXd* jacobian, double magnitude = 0.0);

/// Columns count as dependent below this ratio of pivots. Derivatives are exact to about 1e-13, so
/// that columns that are dependent by construction lie far below this ratio, and columns that a
/// poor excitation makes nearly dependent lie far above it.
constexpr double kRankThreshold = 1e-9;

/// @param R with R^T R = J^T J, at least as many rows as columns, such as upper_factor(J), or J
/// itself
/// @param threshold of a pivot, relative to the largest pivot; a larger threshold than the default
/// also finds parameters that the data hardly determine
Identifiability find_identifiable(const Eigen::MatrixXd& R, double threshold = kRankThreshold);

/// `mass_2 + 0.98 mass_3`: what the data determine of independent parameter `i` and the dependent
/// ones, (32); the name alone if it is determined.
std::string combination_of(const Identifiability& found, const std::vector<std::string>& names,
                           Eigen::Index i);
/// Its value at x.
double combination_value(const Identifiability& found, const Eigen::VectorXd& x, Eigen::Index i);

/// Sentences about parameters that the data do not determine: `mass_2 and mass_3 appear only as
/// mass_2 + 0.98 mass_3`, `preload has no effect`. Empty at full rank. @param names of the
/// parameters
std::vector<std::string> describe_undetermined(const Identifiability& found,
                                               const std::vector<std::string>& names);

}  // namespace codesign
