// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_
#define MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_

#include <Eigen/LU>

#include "equations/iteration_matrix.h"

namespace codesign {

/// The matrix E = G_z + c_v G_v + c_q G_q (+ c_s G_s) of a step, doc/theory.md (16), and its solves. Sparse for double; dense for complex
/// numbers, which only derivative checks use. factor() returns false for a singular matrix.
template <class T>
class StageMatrix;

template <>
class StageMatrix<double> {
 public:
  explicit StageMatrix(const CompiledSystem& system) : matrix_(system) {}
  bool factor(const Linearization<double>& d, double c_v, double c_q, double c_s) { return matrix_.factor(d, c_v, c_q, c_s); }
  void forget() { matrix_.forget(); }
  void settle() { matrix_.settle(); }
  void solve(VectorX<double>* x) const { matrix_.lu().solve(*x); }
  const SparseLu& lu() const { return matrix_.lu(); }

 private:
  IterationMatrix matrix_;
};

template <>
class StageMatrix<std::complex<double>> {
 public:
  using Scalar = std::complex<double>;
  explicit StageMatrix(const CompiledSystem& system) : system_(system) {}

  bool factor(const Linearization<Scalar>& d, double c_v, double c_q, double c_s) {
    const Layout& layout = system_.layout();
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(layout.columns(), layout.columns());
    const auto add = [&](const Sparsity& pattern, const std::vector<Scalar>& values, const auto& coefficient, const auto& column_of) {
      for (int row = 0; row < layout.columns(); ++row)
        for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
          matrix(row, column_of(pattern.column(e))) += coefficient(pattern.column(e)) * values[static_cast<std::size_t>(e)];
    };
    const auto same = [](int column) { return column; };
    add(
        system_.patterns().rate, d.rate, [](int) { return 1.0; }, same);
    add(
        system_.patterns().velocity, d.velocity, [c_v](int) { return c_v; }, same);
    add(
        system_.patterns().position, d.position, [&](int column) { return column < layout.n ? c_q : c_s; },
        [&](int column) { return layout.rate_column(column); });
    lu_.compute(matrix);
    return matrix.allFinite();
  }
  void forget() {}
  void settle() {}
  void solve(VectorX<Scalar>* x) const { *x = lu_.solve(*x).eval(); }

 private:
  const CompiledSystem& system_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_
