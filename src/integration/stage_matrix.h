// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>

#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

namespace codesign {

class CompiledSystem;

/// The matrix E = G_z + c_v G_v + c_q G_q (+ c_s G_s) of a step, doc/theory.md (16), and its
/// solves. For complex numbers, which only derivative checks use, Eigen factors it. factor()
/// returns false for a singular matrix.
template <class T>
class StageMatrix;

template <>
class StageMatrix<double> {
 public:
  explicit StageMatrix(const CompiledSystem& system) : matrix_(system) {}
  bool factor(const Linearization<double>& d, double c_v, double c_q, double c_s) {
    return matrix_.factor(d, c_v, c_q, c_s);
  }
  void reset_pivots() { matrix_.reset_pivots(); }
  void keep_pivots() { matrix_.keep_pivots(); }
  void keep_pivots_of(const StageMatrix& other) { matrix_.keep_pivots_of(other.matrix_); }
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
  void reset_pivots() {}
  void keep_pivots() {}
  void keep_pivots_of(const StageMatrix& /*other*/) {}
  void solve(VectorX<Scalar>* x) const;

 private:
  struct Factors;  // Eigen's template, which takes seconds to compile

  const CompiledSystem& system_;
  std::unique_ptr<Factors> factors_;
};

class LazyStraightLine;

/// The products with G_q (and G_s) and G_v on the right-hand side of every stage of a step and of
/// its tangent; doc/theory.md (16), (18).
class StageProduct {
 public:
  /// @param system must outlive this. @param machine_code whether to compile the products to
  /// machine code where possible; loops otherwise.
  explicit StageProduct(const CompiledSystem& system, bool machine_code = true);
  ~StageProduct();
  StageProduct(StageProduct&&) noexcept;
  StageProduct& operator=(StageProduct&&) noexcept;

  /// y -= G_q x + G_v v over the rows of the equations, for N vectors stored row by row. xv is [x |
  /// v] with x = (q, s). N is 1, 4 or 8.
  template <int N>
  void subtract(const Linearization<double>& derivatives, In<double> xv, Out<double> y) const;

  /// The same for one complex vector, which only derivative checks use.
  void subtract(const Linearization<std::complex<double>>& derivatives, In<std::complex<double>> xv,
                Out<std::complex<double>> y) const;
  void subtract(const Linearization<double>& derivatives, In<double> xv, Out<double> y) const {
    subtract<1>(derivatives, xv, y);
  }

 private:
  template <class T>
  void subtract_rows(const Linearization<T>& derivatives, In<T> xv, Out<T> y) const;

  const ByVariable<Sparsity>* patterns_;
  int rows_;
  std::unique_ptr<LazyStraightLine> code_;
};

/// Projects a state onto the constraints, doc/theory.md (17), with two Newton steps, since the
/// drift may be larger than the drift of one step.
class Projection {
 public:
  explicit Projection(const CompiledSystem& system);

  /// Changes q and v so that Phi = 0 and Phi_q v = 0; z is unchanged. `equations` must hold the
  /// design. False if the augmented matrix is singular or the result is not finite.
  bool apply(Equations<double>* equations, State<double>* state);

 private:
  void correct(const VectorX<double>& error, VectorX<double>* target);

  const Layout& layout_;
  IterationMatrix matrix_;
  Linearization<double> derivatives_;
  VectorX<double> Phi_, Phi_rate_, correction_;
};

}  // namespace codesign
