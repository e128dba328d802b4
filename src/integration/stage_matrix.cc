// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stage_matrix.h"

#include <Eigen/SparseLU>
#include <cassert>
#include <cmath>
#include <vector>

#include "codegen/straight_line.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

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

constexpr int kRounds = 2;

}  // namespace

struct StageMatrix<std::complex<double>>::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Scalar>> lu;
  bool analyzed = false;  ///< whether `lu` knows the pattern, which does not change
};

StageMatrix<std::complex<double>>::StageMatrix(const CompiledSystem& system)
    : system_(system), factors_(std::make_unique<Factors>()) {}
StageMatrix<std::complex<double>>::~StageMatrix() = default;
StageMatrix<std::complex<double>>::StageMatrix(StageMatrix&&) noexcept = default;

bool StageMatrix<std::complex<double>>::factor(const Linearization<Scalar>& d, double c_v,
                                               double c_q, double c_s) {
  const Layout& layout = system_.layout();
  std::vector<Eigen::Triplet<Scalar>> entries;
  const auto add = [&](const Sparsity& pattern, const std::vector<Scalar>& values,
                       const auto& coefficient, const auto& column_of) {
    for (int row = 0; row < layout.columns(); ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
        entries.emplace_back(row, column_of(pattern.column(e)),
                             coefficient(pattern.column(e)) * values[to_index(e)]);
  };
  const auto same = [](int column) { return column; };
  add(
      system_.patterns().rate, d.rate, [](int) { return 1.0; }, same);
  add(
      system_.patterns().velocity, d.velocity, [c_v](int) { return c_v; }, same);
  add(
      system_.patterns().position, d.position,
      [&](int column) { return column < layout.n ? c_q : c_s; },
      [&](int column) { return layout.rate_column(column); });
  Eigen::SparseMatrix<Scalar> matrix(layout.columns(), layout.columns());
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!matrix.coeffs().allFinite()) return false;
  if (!factors_->analyzed) factors_->lu.analyzePattern(matrix);
  factors_->analyzed = true;
  factors_->lu.factorize(matrix);
  return factors_->lu.info() == Eigen::Success;
}

void StageMatrix<std::complex<double>>::solve(VectorX<Scalar>* x) const {
  *x = factors_->lu.solve(*x).eval();
}

StageProduct::StageProduct(const CompiledSystem& system, bool machine_code)
    : patterns_(&system.patterns()),
      rows_(system.layout().columns()),
      code_(std::make_unique<LazyStraightLine>(machine_code)) {}

StageProduct::~StageProduct() = default;
StageProduct::StageProduct(StageProduct&&) noexcept = default;
StageProduct& StageProduct::operator=(StageProduct&&) noexcept = default;

template <class T>
void StageProduct::subtract_rows(const Linearization<T>& derivatives, In<T> xv, Out<T> y) const {
  const In<T> x = xv.first(patterns_->position.columns),
              v = xv.subspan(x.size(), patterns_->velocity.columns);
  for (int row = 0; row < rows_; ++row)
    y[row] -= row_product(patterns_->position, derivatives.position, row, x) +
              row_product(patterns_->velocity, derivatives.velocity, row, v);
}

void StageProduct::subtract(const Linearization<std::complex<double>>& derivatives,
                            In<std::complex<double>> xv, Out<std::complex<double>> y) const {
  subtract_rows(derivatives, xv, y);
}

template <int N>
void StageProduct::subtract(const Linearization<double>& derivatives, In<double> xv,
                            Out<double> y) const {
  const std::ptrdiff_t positions = std::ptrdiff_t{N} * patterns_->position.columns;
  assert(xv.size() == positions + std::ptrdiff_t{N} * patterns_->velocity.columns &&
         y.size() == std::ptrdiff_t{N} * rows_);
  if (const StraightLine* const code = code_->get([this] { return sums(*patterns_, rows_); }, N)) {
    code->run(
        {y.data(), derivatives.position.data(), derivatives.velocity.data(), xv.data(), nullptr});
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

template void StageProduct::subtract<1>(const Linearization<double>&, In<double>,
                                        Out<double>) const;
template void StageProduct::subtract<4>(const Linearization<double>&, In<double>,
                                        Out<double>) const;
template void StageProduct::subtract<8>(const Linearization<double>&, In<double>,
                                        Out<double>) const;

Projection::Projection(const CompiledSystem& system) : layout_(system.layout()), matrix_(system) {
  derivatives_.resize(system.patterns());
}

void Projection::correct(const VectorX<double>& error, VectorX<double>* target) {
  correction_.setZero(layout_.columns());
  correction_.segment(layout_.n, layout_.m) = -error;
  matrix_.lu().solve(correction_);
  *target += correction_.head(layout_.n);
}

bool Projection::apply(Equations<double>* equations, State<double>* state) {
  if (layout_.m == 0) return std::isfinite(state->q.sum() + state->v.sum());
  matrix_.reset_pivots();
  for (int round = 0; round < kRounds; ++round) {
    equations->linearize_rates(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return false;
    equations->constraint_errors(*state, &Phi_, &Phi_rate_);
    correct(Phi_, &state->q);
    equations->constraint_errors(*state, &Phi_, &Phi_rate_);
    correct(Phi_rate_, &state->v);
  }
  return std::isfinite(state->q.sum() + state->v.sum());
}

}  // namespace codesign
