// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/identifiability.h"

#include <algorithm>
#include <cmath>

#include "math/arrays.h"
#include "math/dense.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Entries of C below this number, for columns of length one, are rounding.
constexpr double kNegligible = 1e-6;

Eigen::VectorXd column_lengths(const Eigen::MatrixXd& R) {
  Eigen::VectorXd lengths = R.colwise().norm();
  for (double& length : lengths)
    if (length == 0.0) length = 1.0;
  return lengths;
}

/// The effect of a value of each number as large as it is; of zero, of one.
Eigen::VectorXd effects_of_values(const Eigen::VectorXd& lengths, const Eigen::VectorXd& x) {
  return lengths.cwiseProduct(
      x.unaryExpr([](double value) { return value == 0.0 ? 1.0 : std::abs(value); }));
}

/// Factors that make each of `p` equally long columns shorter than the one before it, by more than
/// rounding and by less than anything that matters.
Eigen::VectorXd in_order(Eigen::Index p) {
  constexpr double kLess = 1e-9;
  return Eigen::VectorXd::LinSpaced(p, 1.0, 1.0 - kLess * static_cast<double>(p - 1));
}

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& A, const std::vector<int>& indices) {
  Eigen::MatrixXd result(A.rows(), to_signed(indices.size()));
  for (std::size_t k = 0; k < indices.size(); ++k) result.col(to_signed(k)) = A.col(indices[k]);
  return result;
}

/// `+ 0.98 mass_3`, `- mass_3`.
std::string term(double factor, const std::string& name) {
  constexpr int kDigits = 3;
  const std::string number = readable(std::abs(factor), kDigits);
  return std::string(factor < 0.0 ? " - " : " + ") + (number == "1" ? "" : number + " ") + name;
}

/// `a`, `a and b`, `a, b and c`.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : " and ") + words[k];
  return text;
}

}  // namespace

void clear_rounding(const Eigen::VectorXd& x, Eigen::MatrixXd* jacobian, double magnitude) {
  constexpr double kLeastEffect = 1e-12;
  if (x.size() == 0) return;
  // By the value itself, which is free of its unit, and by at least one unit, since a value may be
  // near zero by chance. Rounding is negligible by both.
  const Eigen::VectorXd lengths = jacobian->colwise().norm(),
                        by_value = effects_of_values(lengths, x),
                        by_unit = lengths.cwiseProduct(x.cwiseAbs().cwiseMax(1.0));
  const double least_by_value = kLeastEffect * std::max(magnitude, by_value.maxCoeff()),
               least_by_unit = kLeastEffect * std::max(magnitude, by_unit.maxCoeff());
  for (Eigen::Index k = 0; k < x.size(); ++k)
    if (by_value[k] <= least_by_value && by_unit[k] <= least_by_unit) jacobian->col(k).setZero();
}

Identifiability find_identifiable(const Eigen::MatrixXd& R, double threshold) {
  const Eigen::Index p = R.cols();
  Identifiability found;
  found.is_determined.assign(to_index(p), true);
  if (p == 0) return found;
  const Eigen::VectorXd lengths = column_lengths(R);
  const Eigen::MatrixXd scaled = R * lengths.cwiseInverse().asDiagonal();
  found.singular_values = singular_values(scaled).values;
  // Of columns that differ by rounding alone the first one is taken, on every machine.
  const PivotedColumns pivots = pivot_columns(scaled * in_order(p).asDiagonal(), threshold);
  found.rank = scaled.isZero(0.0) ? 0 : static_cast<int>(pivots.rank);
  const std::vector<int> independent(pivots.order.begin(), pivots.order.begin() + found.rank);
  found.dependent.assign(pivots.order.begin() + found.rank, pivots.order.end());
  const auto count = to_signed(found.dependent.size());
  found.null_directions = Eigen::MatrixXd::Zero(p, count);
  if (count == 0) return found;
  const Eigen::MatrixXd C =
      found.rank == 0
          ? Eigen::MatrixXd(0, count)
          : least_norm(columns_of(scaled, independent)).solve(columns_of(scaled, found.dependent));
  for (Eigen::Index k = 0; k < count; ++k) {
    const int d = found.dependent[to_index(k)];
    found.null_directions(d, k) = 1.0;
    for (std::size_t row = 0; row < independent.size(); ++row) {
      const double c = C(to_signed(row), k);
      const int i = independent[row];
      if (std::abs(c) > kNegligible) found.null_directions(i, k) = -c * lengths[d] / lengths[i];
    }
  }
  for (Eigen::Index i = 0; i < p; ++i)
    found.is_determined[to_index(i)] = found.null_directions.row(i).isZero(0.0);
  return found;
}

std::string combination_of(const Identifiability& found, const std::vector<std::string>& names,
                           Eigen::Index i) {
  std::string sum = names[to_index(i)];
  for (Eigen::Index k = 0; k < found.null_directions.cols(); ++k)
    if (const double factor = -found.null_directions(i, k); factor != 0.0)
      sum += term(factor, names[to_index(found.dependent[to_index(k)])]);
  return sum;
}

double combination_value(const Identifiability& found, const Eigen::VectorXd& x, Eigen::Index i) {
  double sum = x[i];
  for (Eigen::Index k = 0; k < found.null_directions.cols(); ++k)
    sum -= found.null_directions(i, k) * x[found.dependent[to_index(k)]];
  return sum;
}

std::vector<std::string> describe_undetermined(const Identifiability& found,
                                               const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  const auto name = [&names](Eigen::Index index) { return names[to_index(index)]; };
  for (Eigen::Index i = 0; i < to_signed(names.size()); ++i) {
    std::vector<std::string> involved = {name(i)};
    if (std::find(found.dependent.begin(), found.dependent.end(), static_cast<int>(i)) !=
        found.dependent.end())
      continue;
    for (Eigen::Index k = 0; k < found.null_directions.cols(); ++k)
      if (found.null_directions(i, k) != 0.0)
        involved.push_back(name(found.dependent[to_index(k)]));
    if (involved.size() > 1)
      sentences.push_back(joined(involved) + " appear only as " + combination_of(found, names, i));
  }
  for (Eigen::Index k = 0; k < found.null_directions.cols(); ++k)
    if ((found.null_directions.col(k).array() != 0.0).count() == 1)
      sentences.push_back(name(found.dependent[to_index(k)]) + " has no effect");
  return sentences;
}

}  // namespace codesign
