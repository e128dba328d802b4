// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparse_qr.h"

#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <new>

namespace codesign {

struct SparseQr::Implementation {
  using Factors = SuiteSparseQR_factorization<double>;

  Implementation() {
    cholmod_l_start(&common);
    common.print = 0;
  }
  ~Implementation() {
    SuiteSparseQR_free<double>(&factors, &common);
    cholmod_l_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  /// SPQR and CHOLMOD return null if they run out of memory.
  template <class X>
  static X* require(X* x) {
    if (!x) throw std::bad_alloc();
    return x;
  }

  mutable cholmod_common common{};
  Factors* factors = nullptr;
  Eigen::Index columns = 0;
};

namespace {

/// CHOLMOD's view of a matrix whose indices are copied into 64 bits.
class SparseView {
 public:
  explicit SparseView(const SparseMatrix& A) {
    for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
      starts_.push_back(static_cast<SuiteSparse_long>(values_.size()));
      for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
        rows_.push_back(entry.row());
        values_.push_back(entry.value());
      }
    }
    starts_.push_back(static_cast<SuiteSparse_long>(values_.size()));
    view_.nrow = static_cast<std::size_t>(A.rows());
    view_.ncol = static_cast<std::size_t>(A.cols());
    view_.nzmax = values_.size();
    view_.p = starts_.data();
    view_.i = rows_.data();
    view_.x = values_.data();
    view_.stype = 0;
    view_.itype = CHOLMOD_LONG;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = 1;
    view_.packed = 1;
  }
  SparseView(const SparseView&) = delete;
  SparseView& operator=(const SparseView&) = delete;

  cholmod_sparse* get() { return &view_; }

 private:
  std::vector<SuiteSparse_long> starts_, rows_;
  std::vector<double> values_;
  cholmod_sparse view_{};
};

}  // namespace

SparseQr::SparseQr() : implementation_(std::make_unique<Implementation>()) {}
SparseQr::~SparseQr() = default;
SparseQr::SparseQr(SparseQr&&) noexcept = default;
SparseQr& SparseQr::operator=(SparseQr&&) noexcept = default;

void SparseQr::factor(const SparseMatrix& A, double tolerance, Ordering ordering) {
  Implementation& to = *implementation_;
  SuiteSparseQR_free<double>(&to.factors, &to.common);
  to.columns = A.cols();
  SparseView view(A);
  const int order = ordering == Ordering::kNatural ? SPQR_ORDERING_FIXED : SPQR_ORDERING_COLAMD;
  to.factors = Implementation::require(SuiteSparseQR_factorize<double>(order, tolerance, view.get(), &to.common));
}

std::vector<int> SparseQr::dependent() const {
  std::vector<int> columns;
  const Implementation::Factors* const factors = implementation_->factors;
  if (!factors || factors->rank >= implementation_->columns) return columns;
  for (Eigen::Index k = 0; k < implementation_->columns; ++k)
    if (factors->Rmap[k] >= factors->rank) columns.push_back(static_cast<int>(factors->Q1fill ? factors->Q1fill[k] : k));
  std::sort(columns.begin(), columns.end());
  return columns;
}

Eigen::MatrixXd SparseQr::solve(const Eigen::MatrixXd& b) const {
  cholmod_common* const common = &implementation_->common;
  Eigen::MatrixXd right = b;
  cholmod_dense view{};
  view.nrow = view.d = static_cast<std::size_t>(right.rows());
  view.ncol = static_cast<std::size_t>(right.cols());
  view.nzmax = static_cast<std::size_t>(right.size());
  view.x = right.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  const auto release = [common](cholmod_dense* matrix) { cholmod_l_free_dense(&matrix, common); };
  using Handle = std::unique_ptr<cholmod_dense, decltype(release)>;
  const Handle rotated(Implementation::require(SuiteSparseQR_qmult<double>(SPQR_QTX, implementation_->factors, &view, common)), release);
  const Handle x(Implementation::require(SuiteSparseQR_solve<double>(SPQR_RETX_EQUALS_B, implementation_->factors, rotated.get(), common)),
                 release);
  return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), static_cast<Eigen::Index>(x->nrow), b.cols());
}

}  // namespace codesign
