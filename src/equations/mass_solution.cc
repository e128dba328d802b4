// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/mass_solution.h"

#include <algorithm>
#include <cmath>

#include "codegen/interpreter.h"
#include "description/expression.h"
#include "equations/equation_variant.h"
#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

using TracedMatrix = Eigen::Matrix<Traced, Eigen::Dynamic, Eigen::Dynamic>;

/// The values of all nodes at a state without any pattern.
std::vector<double> values_of(const System& system, const Recording& recording) {
  std::vector<double> values(to_index(recording.size()));
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    double& value = values[to_index(n)];
    if (node.operation == Operation::kLiteral)
      value = node.literal;
    else if (node.operation != Operation::kLeaf)
      value = operate<double>(node.operation, values[to_index(node.a)],
                              node.b < 0 ? 0.0 : values[to_index(node.b)]);
    else if (node.a != Recording::kSupplied)
      value = std::sin(1.0 + 7.0 * node.b + 3.0 * node.a);
    else if (node.b >= 0)
      value = value_at(*recording.supplied_sources()[to_index(node.b)].as<Expression>(),
                       system.parameters());
  }
  return values;
}

}  // namespace

bool is_mass_matrix(const System& system, const Recording& recording, const Sparsity& pattern,
                    const std::vector<Traced>& entries) {
  constexpr double kRounding = 1e-11;
  const std::vector<double> values = values_of(system, recording);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(pattern.columns, pattern.columns);
  for (int row = 0; row < pattern.columns; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
      const Traced& entry = entries[to_index(e)];
      A(row, pattern.column(e)) =
          entry.is_literal() ? entry.value() : values[to_index(entry.node())];
    }
  const Eigen::VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
  A = scale.asDiagonal() * A * scale.asDiagonal();
  return A.allFinite() && (A - A.transpose()).cwiseAbs().maxCoeff() < kRounding &&
         is_positive_definite(A);
}

MassSolution record_mass_solution(const Sparsity& pattern, const std::vector<Traced>& entries,
                                  const VectorX<Traced>& b) {
  const Eigen::Index size = pattern.columns;
  TracedMatrix A = TracedMatrix::Constant(size, size, Traced(0.0));
  for (int row = 0; row < size; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      A(row, pattern.column(e)) = entries[to_index(e)];
  VectorX<Traced> x = b, inverse(size);
  for (Eigen::Index k = size - 1; k >= 0; --k) {
    inverse[k] = Traced(1.0) / A(k, k);
    for (Eigen::Index i = 0; i < k; ++i) {
      if (A(k, i).is(0.0)) continue;
      const Traced factor = A(k, i) * inverse[k];
      for (Eigen::Index j = 0; j <= i; ++j)
        if (!A(k, j).is(0.0)) A(i, j) -= factor * A(k, j);
      x[i] -= factor * x[k];
    }
  }
  MassSolution result;
  result.factor.starts = {0};
  for (Eigen::Index k = 0; k < size; ++k) {
    for (Eigen::Index j = 0; j < k; ++j) {
      if (A(k, j).is(0.0)) continue;
      x[k] -= A(k, j) * x[j];
      result.factor.columns.push_back(static_cast<int>(j));
      result.values.push_back(A(k, j));
    }
    x[k] *= inverse[k];
    result.values.push_back(inverse[k]);
    result.factor.starts.push_back(static_cast<int>(result.factor.columns.size()));
  }
  result.x = x;
  return result;
}

template <int N>
void MassFactor::solve(In<double> values, Out<double> x) const {
  using Row = Eigen::Map<Eigen::Array<double, N, 1>>;
  const auto row = [&x](int k) { return Row(x.data() + std::ptrdiff_t{N} * k); };
  const int rows = static_cast<int>(starts.size()) - 1;
  // Before row k there are k inverses.
  for (int k = rows; k-- > 0;) {
    const double* const entries = values.data() + k;
    const Eigen::Array<double, N, 1> scaled = entries[starts[to_index(k) + 1]] * row(k);
    for (int e = starts[to_index(k)]; e < starts[to_index(k) + 1]; ++e)
      row(columns[to_index(e)]) -= entries[e] * scaled;
  }
  for (int k = 0; k < rows; ++k) {
    const double* const entries = values.data() + k;
    for (int e = starts[to_index(k)]; e < starts[to_index(k) + 1]; ++e)
      row(k) -= entries[e] * row(columns[to_index(e)]);
    row(k) *= entries[starts[to_index(k) + 1]];
  }
}

template void MassFactor::solve<1>(In<double>, Out<double>) const;
template void MassFactor::solve<4>(In<double>, Out<double>) const;
template void MassFactor::solve<8>(In<double>, Out<double>) const;

bool is_affine(const Recording& recording, const std::vector<Recording::Guard>& guards,
               const std::vector<Traced>& G_z, const Traced& g) {
  std::vector<bool> depends(to_index(recording.size()));
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (node.operation == Operation::kLeaf)
      depends[to_index(n)] = node.a == EquationArrays::kZ;
    else if (node.operation != Operation::kLiteral)
      depends[to_index(n)] =
          depends[to_index(node.a)] || (node.b >= 0 && depends[to_index(node.b)]);
  }
  const auto is_free = [&](int n) { return n < 0 || !depends[to_index(n)]; };
  return is_free(g.node()) &&
         std::all_of(G_z.begin(), G_z.end(),
                     [&](const Traced& entry) { return is_free(entry.node()); }) &&
         std::all_of(guards.begin(), guards.end(), [&](const Recording::Guard& guard) {
           return is_free(guard.a) && is_free(guard.b);
         });
}

}  // namespace codesign
