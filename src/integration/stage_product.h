// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>

#include "equations/compiled_system.h"
#include "math/span.h"
#include "sparse/sparsity.h"

namespace codesign {

class LazyStraightLine;

/// The products with G_q (and G_s) and G_v on the right-hand side of every stage of a step and of its tangent; doc/theory.md (16), (18).
class StageProduct {
 public:
  /// @param system must outlive this. @param machine_code whether to compile the products to machine code where possible; loops otherwise.
  explicit StageProduct(const CompiledSystem& system, bool machine_code = true);
  ~StageProduct();
  StageProduct(StageProduct&&) noexcept;
  StageProduct& operator=(StageProduct&&) noexcept;

  /// y -= G_q x + G_v v over the rows of the equations, for N vectors stored row by row. xv is [x | v] with x = (q, s). N is 1, 4 or 8.
  template <int N>
  void subtract(const Linearization<double>& derivatives, In<double> xv, Out<double> y) const;

  /// The same for one complex vector, which only derivative checks use.
  void subtract(const Linearization<std::complex<double>>& derivatives, In<std::complex<double>> xv, Out<std::complex<double>> y) const;
  void subtract(const Linearization<double>& derivatives, In<double> xv, Out<double> y) const { subtract<1>(derivatives, xv, y); }

 private:
  template <class T>
  void subtract_rows(const Linearization<T>& derivatives, In<T> xv, Out<T> y) const;

  const ByVariable<Sparsity>* patterns_;
  int rows_;
  std::unique_ptr<LazyStraightLine> code_;
};

}  // namespace codesign
