// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/least_squares.h"

#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <new>
#include <numeric>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr Eigen::Index kDense = 256;  // columns up to which dense factorizations are faster

double largest_column(const SparseMatrix& A) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) largest = std::max(largest, A.col(k).norm());
  return largest;
}

/// Copies some columns into `to`, which has their shape.
void copy_columns(const SparseMatrix& A, const std::vector<int>& columns, Eigen::MatrixXd* to) {
  to->setZero();
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (SparseMatrix::InnerIterator entry(A, columns[k]); entry; ++entry)
      (*to)(entry.row(), to_signed(k)) = entry.value();
}

Eigen::Index count(const std::vector<int>& columns) { return to_signed(columns.size()); }

std::vector<int> ascending(std::vector<int> columns) {
  std::sort(columns.begin(), columns.end());
  return columns;
}

std::vector<int> first_independent_columns(const SparseMatrix& A,
                                           const ColumnPreferences& preferences, double tolerance) {
  std::vector<int> order;
  for (const std::vector<int>& candidates : preferences)
    order.insert(order.end(), candidates.begin(), candidates.end());
  SparseQr qr;
  qr.factor(columns_of(A, order), tolerance * largest_column(A), SparseQr::Ordering::kNatural);
  const std::vector<int> dependent = qr.dependent();
  std::vector<int> chosen;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (!std::binary_search(dependent.begin(), dependent.end(), static_cast<int>(k)))
      chosen.push_back(order[k]);
  return ascending(chosen);
}

}  // namespace

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
    view_.nrow = to_index(A.rows());
    view_.ncol = to_index(A.cols());
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
  to.factors = Implementation::require(
      SuiteSparseQR_factorize<double>(order, tolerance, view.get(), &to.common));
}

std::vector<int> SparseQr::dependent() const {
  std::vector<int> columns;
  const Implementation::Factors* const factors = implementation_->factors;
  if (!factors || factors->rank >= implementation_->columns) return columns;
  for (Eigen::Index k = 0; k < implementation_->columns; ++k)
    if (factors->Rmap[k] >= factors->rank)
      columns.push_back(static_cast<int>(factors->Q1fill ? factors->Q1fill[k] : k));
  std::sort(columns.begin(), columns.end());
  return columns;
}

Eigen::MatrixXd SparseQr::solve(const Eigen::MatrixXd& b) const {
  cholmod_common* const common = &implementation_->common;
  Eigen::MatrixXd right = b;
  cholmod_dense view{};
  view.nrow = view.d = to_index(right.rows());
  view.ncol = to_index(right.cols());
  view.nzmax = to_index(right.size());
  view.x = right.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  const auto release = [common](cholmod_dense* matrix) { cholmod_l_free_dense(&matrix, common); };
  using Handle = std::unique_ptr<cholmod_dense, decltype(release)>;
  const Handle rotated(Implementation::require(SuiteSparseQR_qmult<double>(
                           SPQR_QTX, implementation_->factors, &view, common)),
                       release);
  const Handle x(Implementation::require(SuiteSparseQR_solve<double>(
                     SPQR_RETX_EQUALS_B, implementation_->factors, rotated.get(), common)),
                 release);
  return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), to_signed(x->nrow),
                                           b.cols());
}

struct LeastSquares::Implementation {
  bool dense = true;
  Eigen::Index columns = 0;
  LeastNorm dense_factors;
  SparseQr sparse_factors;
};

LeastSquares::LeastSquares() : implementation_(std::make_unique<Implementation>()) {}
LeastSquares::~LeastSquares() = default;
LeastSquares::LeastSquares(LeastSquares&&) noexcept = default;
LeastSquares& LeastSquares::operator=(LeastSquares&&) noexcept = default;

void LeastSquares::factor(const SparseMatrix& A, double tolerance) {
  implementation_->columns = A.cols();
  implementation_->dense = A.cols() <= kDense;
  if (A.rows() == 0 || A.cols() == 0) return;
  if (implementation_->dense) {
    implementation_->dense_factors.matrix(A.rows(), A.cols()) = A;
    implementation_->dense_factors.factor(tolerance);
    return;
  }
  implementation_->sparse_factors.factor(A, tolerance * largest_column(A));
}

void LeastSquares::factor(const SparseMatrix& A, const std::vector<int>& columns,
                          double tolerance) {
  if (count(columns) > kDense) return factor(columns_of(A, columns), tolerance);
  implementation_->columns = count(columns);
  implementation_->dense = true;
  if (A.rows() == 0 || columns.empty()) return;
  copy_columns(A, columns, &implementation_->dense_factors.matrix(A.rows(), count(columns)));
  implementation_->dense_factors.factor(tolerance);
}

Eigen::MatrixXd LeastSquares::solve(const Eigen::MatrixXd& b) const {
  LeastSquaresWorkspace workspace;
  return solve(b, &workspace);
}

Eigen::MatrixXd& LeastSquares::solve(const Eigen::MatrixXd& b,
                                     LeastSquaresWorkspace* workspace) const {
  if (b.rows() > 0 && implementation_->columns > 0 && implementation_->dense)
    return implementation_->dense_factors.solve(b, &workspace->dense);
  if (b.rows() == 0 || implementation_->columns == 0)
    workspace->other.setZero(implementation_->columns, b.cols());
  else
    workspace->other = implementation_->sparse_factors.solve(b);
  return workspace->other;
}

const std::vector<int>& IndependentColumns::choose(const SparseMatrix& A,
                                                   const ColumnPreferences& preferences,
                                                   double tolerance) {
  chosen_.clear();
  if (A.rows() == 0 || A.cols() == 0) return chosen_;
  if (A.cols() <= kDense)
    choose_dense(A, preferences, tolerance);
  else
    chosen_ = first_independent_columns(A, preferences, tolerance);
  std::sort(chosen_.begin(), chosen_.end());
  return chosen_;
}

void IndependentColumns::choose_dense(const SparseMatrix& A, const ColumnPreferences& preferences,
                                      double tolerance) {
  qr_.matrix(A.rows(), A.cols()) = A;
  qr_.factor(tolerance);
  const Eigen::Index rank = qr_.rank();
  for (const std::vector<int>& candidates : preferences) {
    // Choose by the remainder of the candidates after projection onto the columns chosen so far.
    const Eigen::Index missing = rank - count(chosen_);
    if (missing <= 0 || candidates.empty()) continue;
    Eigen::MatrixXd& rest = qr_.matrix(A.rows(), count(candidates));
    copy_columns(A, candidates, &rest);
    if (!chosen_.empty()) {
      Eigen::MatrixXd& taken = taken_.matrix(A.rows(), count(chosen_));
      copy_columns(A, chosen_, &taken);
      taken_.factor(tolerance);
      projection_.noalias() = taken * taken_.solve(rest, &workspace_);
      rest -= projection_;
    }
    qr_.factor(tolerance);
    const Eigen::Index take = std::min(missing, qr_.rank());
    for (Eigen::Index k = 0; k < take; ++k) chosen_.push_back(candidates[to_index(qr_.column(k))]);
  }
}

std::vector<int> independent_columns(const SparseMatrix& A, const ColumnPreferences& preferences,
                                     double tolerance) {
  return IndependentColumns().choose(A, preferences, tolerance);
}

std::vector<int> dependent_columns(const SparseMatrix& A, double tolerance) {
  std::vector<int> dependent;
  if (A.cols() == 0) return dependent;
  if (A.rows() == 0) {
    dependent.resize(to_index(A.cols()));
    std::iota(dependent.begin(), dependent.end(), 0);
  } else if (A.cols() <= 2 * kDense) {
    const PivotedColumns pivots = pivot_columns(Eigen::MatrixXd(A), tolerance);
    const auto zero = std::find_if(pivots.diagonal.begin(), pivots.diagonal.end(),
                                   [tolerance](double pivot) { return !(pivot > tolerance); });
    dependent.assign(pivots.order.begin() + (zero - pivots.diagonal.begin()), pivots.order.end());
  } else {
    SparseQr qr;
    qr.factor(A, tolerance);
    return qr.dependent();
  }
  return ascending(dependent);
}

SparseMatrix columns_of(const SparseMatrix& A, const std::vector<int>& columns) {
  SparseMatrix result(A.rows(), to_signed(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(to_signed(k)) = A.col(columns[k]);
  result.makeCompressed();
  return result;
}

}  // namespace codesign
