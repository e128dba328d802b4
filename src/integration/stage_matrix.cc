// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stage_matrix.h"

#include <Eigen/SparseLU>
#include <vector>

namespace codesign {

struct StageMatrix<std::complex<double>>::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Scalar>> lu;
  bool analyzed = false;  ///< whether `lu` knows the pattern, which does not change
};

StageMatrix<std::complex<double>>::StageMatrix(const CompiledSystem& system) : system_(system), factors_(std::make_unique<Factors>()) {}
StageMatrix<std::complex<double>>::~StageMatrix() = default;
StageMatrix<std::complex<double>>::StageMatrix(StageMatrix&&) noexcept = default;

bool StageMatrix<std::complex<double>>::factor(const Linearization<Scalar>& d, double c_v, double c_q, double c_s) {
  const Layout& layout = system_.layout();
  std::vector<Eigen::Triplet<Scalar>> entries;
  const auto add = [&](const Sparsity& pattern, const std::vector<Scalar>& values, const auto& coefficient, const auto& column_of) {
    for (int row = 0; row < layout.columns(); ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
        entries.emplace_back(row, column_of(pattern.column(e)), coefficient(pattern.column(e)) * values[static_cast<std::size_t>(e)]);
  };
  const auto same = [](int column) { return column; };
  add(
      system_.patterns().rate, d.rate, [](int) { return 1.0; }, same);
  add(
      system_.patterns().velocity, d.velocity, [c_v](int) { return c_v; }, same);
  add(
      system_.patterns().position, d.position, [&](int column) { return column < layout.n ? c_q : c_s; },
      [&](int column) { return layout.rate_column(column); });
  Eigen::SparseMatrix<Scalar> matrix(layout.columns(), layout.columns());
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!matrix.coeffs().allFinite()) return false;
  if (!factors_->analyzed) factors_->lu.analyzePattern(matrix);
  factors_->analyzed = true;
  factors_->lu.factorize(matrix);
  return factors_->lu.info() == Eigen::Success;
}

void StageMatrix<std::complex<double>>::solve(VectorX<Scalar>* x) const { *x = factors_->lu.solve(*x).eval(); }

}  // namespace codesign
