// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>

#include "equations/iteration_matrix.h"

namespace codesign {

/// The matrix E = G_z + c_v G_v + c_q G_q (+ c_s G_s) of a step, doc/theory.md (16), and its solves. For complex numbers, which only
/// derivative checks use, Eigen factors it. factor() returns false for a singular matrix.
template <class T>
class StageMatrix;

template <>
class StageMatrix<double> {
 public:
  explicit StageMatrix(const CompiledSystem& system) : matrix_(system) {}
  bool factor(const Linearization<double>& d, double c_v, double c_q, double c_s) { return matrix_.factor(d, c_v, c_q, c_s); }
  void forget() { matrix_.forget(); }
  void settle() { matrix_.settle(); }
  void settle_as(const StageMatrix& other) { matrix_.settle_as(other.matrix_); }
  void solve(VectorX<double>* x) const { matrix_.lu().solve(*x); }
  const SparseLu& lu() const { return matrix_.lu(); }

 private:
  IterationMatrix matrix_;
};

template <>
class StageMatrix<std::complex<double>> {
 public:
  using Scalar = std::complex<double>;
  explicit StageMatrix(const CompiledSystem& system);
  ~StageMatrix();
  StageMatrix(StageMatrix&&) noexcept;

  bool factor(const Linearization<Scalar>& d, double c_v, double c_q, double c_s);
  void forget() {}
  void settle() {}
  void settle_as(const StageMatrix& /*other*/) {}
  void solve(VectorX<Scalar>* x) const;

 private:
  struct Factors;  // Eigen's template, which takes seconds to compile

  const CompiledSystem& system_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace codesign
