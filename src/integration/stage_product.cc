// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stage_product.h"

#include <cassert>

#include "codegen/straight_line.h"
#include "sparse/row_product.h"

namespace codesign {
namespace {

// Indices of the arrays that the compiled code reads and writes.
constexpr int kProduct = 0, kPosition = 1, kVelocity = 2, kVectors = 3;

void append(const Sparsity& pattern, int row, int matrix, int shift, Sum* sum) {
  for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
    sum->products.push_back({{kVectors, shift + pattern.column(e)}, {matrix, e}});
}

std::vector<Sum> sums(const ByVariable<Sparsity>& patterns, int rows) {
  std::vector<Sum> sums;
  for (int row = 0; row < rows; ++row) {
    Sum sum;
    sum.target = sum.start = {kProduct, row};
    append(patterns.position, row, kPosition, 0, &sum);
    append(patterns.velocity, row, kVelocity, patterns.position.columns, &sum);
    sums.push_back(std::move(sum));
  }
  return sums;
}

}  // namespace

StageProduct::StageProduct(const CompiledSystem& system, bool machine_code)
    : patterns_(&system.patterns()), rows_(system.layout().columns()), code_(std::make_unique<LazyStraightLine>(machine_code)) {}

StageProduct::~StageProduct() = default;
StageProduct::StageProduct(StageProduct&&) noexcept = default;
StageProduct& StageProduct::operator=(StageProduct&&) noexcept = default;

template <class T>
void StageProduct::subtract_rows(const Linearization<T>& derivatives, In<T> xv, Out<T> y) const {
  const In<T> x = xv.first(patterns_->position.columns), v = xv.subspan(x.size(), patterns_->velocity.columns);
  for (int row = 0; row < rows_; ++row)
    y[row] -=
        row_product(patterns_->position, derivatives.position, row, x) + row_product(patterns_->velocity, derivatives.velocity, row, v);
}

void StageProduct::subtract(const Linearization<std::complex<double>>& derivatives, In<std::complex<double>> xv,
                            Out<std::complex<double>> y) const {
  subtract_rows(derivatives, xv, y);
}

template <int N>
void StageProduct::subtract(const Linearization<double>& derivatives, In<double> xv, Out<double> y) const {
  const std::ptrdiff_t positions = std::ptrdiff_t{N} * patterns_->position.columns;
  assert(xv.size() == positions + std::ptrdiff_t{N} * patterns_->velocity.columns && y.size() == std::ptrdiff_t{N} * rows_);
  if (const StraightLine* const code = code_->get([this] { return sums(*patterns_, rows_); }, N)) {
    code->run({y.data(), derivatives.position.data(), derivatives.velocity.data(), xv.data(), nullptr});
  } else if constexpr (N == 1) {
    subtract_rows(derivatives, xv, y);
  } else {
    const In<double> x = xv.first(positions), v = xv.subspan(positions, xv.size() - positions);
    double* const result = y.data();
    for (int row = 0; row < rows_; ++row) {
      typename Lanes<N>::Vector sum{};
      add_row_product<N>(patterns_->position, derivatives.position, row, x, &sum);
      add_row_product<N>(patterns_->velocity, derivatives.velocity, row, v, &sum);
      *reinterpret_cast<typename Lanes<N>::Vector*>(result + std::ptrdiff_t{N} * row) -= sum;
    }
  }
}

template void StageProduct::subtract<1>(const Linearization<double>&, In<double>, Out<double>) const;
template void StageProduct::subtract<4>(const Linearization<double>&, In<double>, Out<double>) const;
template void StageProduct::subtract<8>(const Linearization<double>&, In<double>, Out<double>) const;

}  // namespace codesign
