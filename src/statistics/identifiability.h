// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_STATISTICS_IDENTIFIABILITY_H_
#define MECHANISM_CODESIGN_STATISTICS_IDENTIFIABILITY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

namespace codesign {

/// Which of p parameters the residuals of a fit tell, to first order: what the columns of their Jacobian J span; doc/theory.md (32).
struct Identifiability {
  int rank = 0;
  Eigen::VectorXd singular_values;  ///< of J with columns scaled to length one (columns of zeros stay), descending; p entries
  /// p - rank parameters of which the others do the work: the data tell x_i + sum_d C_id x_d for each other parameter i.
  std::vector<int> dependent;
  /// p x (p - rank): directions that change no residual. Column k has a one at dependent[k], zeros at the other dependent parameters, and
  /// -C_ik elsewhere: as many zeros as the choice of `dependent` allows.
  Eigen::MatrixXd null_directions;
  /// p entries: whether no null direction moves the parameter, so that the data tell it.
  std::vector<bool> is_determined;
};

/// Sets columns of a Jacobian that are rounding to zero: those of variables whose change by their magnitude, or by 1 if that is more,
/// changes the residuals by less than 1e-12 of what the most influential one does. Scaled to length one, as below, they would count as
/// known.
/// @param x the variables at the Jacobian, one per column. @param magnitude of what is compared, if it is known: counts as an influence,
/// too.
void clear_rounding(const Eigen::VectorXd& x, Eigen::MatrixXd* jacobian, double magnitude = 0.0);

/// Columns depend on each other below this ratio of pivots. Derivatives are exact to about 1e-13, so that what depends by construction is
/// far below, and what depends by a poor excitation alone far above.
constexpr double kRankThreshold = 1e-9;

/// @param R with R^T R = J^T J, at least as many rows as columns, such as upper_factor(J), or J itself
/// @param threshold of a pivot, relative to the largest one; a larger one than the default finds what the data hardly tell
Identifiability find_identifiable(const Eigen::MatrixXd& R, double threshold = kRankThreshold);

/// Sentences about what the data do not tell: `mass_2 and mass_3 appear only as mass_2 + 0.98 mass_3`, `preload has no effect`. Empty at
/// full rank. @param names of the parameters
std::vector<std::string> describe_undetermined(const Identifiability& found, const std::vector<std::string>& names);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_STATISTICS_IDENTIFIABILITY_H_
