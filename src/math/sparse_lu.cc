// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/math/sparse_lu.h"

#include <suitesparse/klu.h>

#include <cmath>

namespace codesign {
namespace {

// Below this the old pivots are distrusted: an entry has grown by eight digits.
constexpr double kPoorGrowth = 1e-8;
// Below this the matrix is singular to working precision.
constexpr double kSingular = 1e-17;

}  // namespace

struct SparseLu::Implementation {
  int n = 0;
  // KLU takes non-const pointers although it only reads the pattern.
  int* column_start = nullptr;
  int* row_index = nullptr;
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  long full_factorizations = 0;

  ~Implementation() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  bool regular() {
    klu_rcond(symbolic, numeric, &common);
    return std::isfinite(common.rcond) && common.rcond > kSingular;
  }

  bool refactor(double* values) {
    if (!numeric || !klu_refactor(column_start, row_index, values, symbolic, numeric, &common) || common.status != KLU_OK) return false;
    klu_rgrowth(column_start, row_index, values, symbolic, numeric, &common);
    return common.rgrowth > kPoorGrowth && regular();
  }

  bool factor(double* values) {
    ++full_factorizations;
    klu_free_numeric(&numeric, &common);
    numeric = klu_factor(column_start, row_index, values, symbolic, &common);
    return numeric && common.status == KLU_OK && regular();
  }
};

SparseLu::SparseLu(int n, const std::vector<int>& column_start, const std::vector<int>& row_index) : implementation_(std::make_unique<Implementation>()) {
  implementation_->n = n;
  implementation_->column_start = const_cast<int*>(column_start.data());
  implementation_->row_index = const_cast<int*>(row_index.data());
  klu_defaults(&implementation_->common);
  implementation_->symbolic = klu_analyze(n, implementation_->column_start, implementation_->row_index, &implementation_->common);
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factor(const double* values) {
  // A structurally singular pattern has no analysis.
  if (!implementation_->symbolic) return false;
  auto* entries = const_cast<double*>(values);
  return implementation_->refactor(entries) || implementation_->factor(entries);
}

void SparseLu::solve(double* right_hand_side, int count) const {
  klu_solve(implementation_->symbolic, implementation_->numeric, implementation_->n, count, right_hand_side, &implementation_->common);
}

void SparseLu::solve_transposed(double* right_hand_side, int count) const {
  klu_tsolve(implementation_->symbolic, implementation_->numeric, implementation_->n, count, right_hand_side, &implementation_->common);
}

long SparseLu::full_factorizations() const { return implementation_->full_factorizations; }

}  // namespace codesign
