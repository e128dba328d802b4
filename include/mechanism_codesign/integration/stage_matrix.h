// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_
#define MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_

#include <Eigen/LU>

#include "mechanism_codesign/dynamics/iteration_matrix.h"

namespace codesign {

/// The linear solves of a step, by scalar: sparse for real numbers, dense for complex ones, which only checks of derivatives use.
template <class T>
class StageMatrix;

template <>
class StageMatrix<double> {
 public:
  explicit StageMatrix(const System& system) : matrix_(system) {}
  bool factor(const Linearization<double>& d, double c_v, double c_q, double c_s) { return matrix_.factor(d, c_v, c_q, c_s); }
  void solve(VectorX<double>* x) const { matrix_.lu().solve(x->data()); }
  const SparseLu& lu() const { return matrix_.lu(); }

 private:
  IterationMatrix matrix_;
};

template <>
class StageMatrix<std::complex<double>> {
 public:
  using Scalar = std::complex<double>;
  explicit StageMatrix(const System& system) : system_(system) {}

  bool factor(const Linearization<Scalar>& d, double c_v, double c_q, double c_s) {
    const Sparsity& pattern = system_.sparsity();
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(pattern.columns, pattern.columns);
    for (int column = 0; column < pattern.columns; ++column) {
      const double c = column < system_.layout().state_column(0) ? c_q : c_s;
      for (int k = pattern.column_start[static_cast<std::size_t>(column)]; k < pattern.column_start[static_cast<std::size_t>(column) + 1]; ++k) {
        const auto e = static_cast<std::size_t>(k);
        if (pattern.row_index[e] < pattern.columns) matrix(pattern.row_index[e], column) = d.by_rate[e] + c_v * d.by_velocity[e] + c * d.by_position[e];
      }
    }
    lu_.compute(matrix);
    return matrix.allFinite();
  }
  void solve(VectorX<Scalar>* x) const { *x = lu_.solve(*x).eval(); }

 private:
  const System& system_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_STAGE_MATRIX_H_
