// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace codesign {

// Decompositions of dense matrices, by Eigen. Eigen's templates take seconds to compile in each
// file that uses them; dense.cc compiles the needed ones once. None of these functions belongs into
// a loop over steps: they allocate. The classes PivotedQr and LeastNorm allocate only for matrices
// of a shape that they have not had before.

/// Columns without their means: x - mean(x).
Eigen::MatrixXd about_mean_of(Eigen::MatrixXd columns);

/// A = U diag(values) V^T, values in descending order; U and V are square and orthogonal.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd U, V;  ///< empty unless requested
};
enum class SingularVectors { kNone, kLeft, kRight, kBoth };
SingularValues singular_values(const Eigen::MatrixXd& A,
                               SingularVectors vectors = SingularVectors::kNone);

/// Householder QR decomposition with column pivoting, A P = Q R.
struct PivotedColumns {
  Eigen::Index rank;         ///< number of pivots above the threshold
  std::vector<int> order;    ///< column of A that is column k of A P
  Eigen::VectorXd diagonal;  ///< |R_kk|, min(rows, columns) entries
};
/// @param threshold a pivot counts as zero below this fraction of the largest one.
PivotedColumns pivot_columns(const Eigen::MatrixXd& A, double threshold);

/// The same decomposition, with a workspace for each shape of A.
class PivotedQr {
 public:
  PivotedQr();
  ~PivotedQr();
  PivotedQr(PivotedQr&&) noexcept;
  PivotedQr& operator=(PivotedQr&&) noexcept;

  /// The matrix that factor() decomposes: rows x columns, to be filled by the caller; what it holds
  /// is undefined.
  Eigen::MatrixXd& matrix(Eigen::Index rows, Eigen::Index columns);
  /// Decomposes matrix(). @param threshold as pivot_columns().
  void factor(double threshold);

  Eigen::Index rank() const;
  /// PivotedColumns::order[k].
  int column(Eigen::Index k) const;
  /// orthogonal_complement() of the matrix.
  void complement(Eigen::MatrixXd* basis);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Least squares A x = b by the same decomposition, with Eigen's default threshold.
class PivotedLeastSquares {
 public:
  /// @param A may have no columns.
  explicit PivotedLeastSquares(const Eigen::MatrixXd& A);
  ~PivotedLeastSquares();
  PivotedLeastSquares(PivotedLeastSquares&&) noexcept;

  /// @param b one right-hand side per column. @returns one solution per column; columns beyond the
  /// rank have zeros.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// By how much the best x decreases |b|^2.
  double explained(const Eigen::VectorXd& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Whether the Cholesky decomposition of a symmetric matrix, whose lower triangle is read, exists.
bool is_positive_definite(const Eigen::MatrixXd& A);
/// A^-1 b by this decomposition.
Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// R of the QR decomposition A = Q R, square and upper triangular with diagonal entries of 0 or
/// more; rows of zeros where A has fewer rows than columns. R^T R = A^T A.
Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& A);

/// An orthonormal basis (one vector per column) of the vectors orthogonal to all columns of A.
/// @param threshold as pivot_columns().
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& A, double threshold);

/// The memory for solutions of LeastNorm, one for each shape of A and b.
class LeastNormWorkspace {
 public:
  LeastNormWorkspace();
  ~LeastNormWorkspace();
  LeastNormWorkspace(LeastNormWorkspace&&) noexcept;
  LeastNormWorkspace& operator=(LeastNormWorkspace&&) noexcept;

 private:
  friend class LeastNorm;
  struct Solution;
  std::vector<std::unique_ptr<Solution>> solutions_;
};

/// Least-squares solutions of least norm, A x = b, by the complete orthogonal decomposition.
class LeastNorm {
 public:
  LeastNorm();
  /// @param threshold as pivot_columns().
  LeastNorm(const Eigen::MatrixXd& A, double threshold);
  ~LeastNorm();
  LeastNorm(LeastNorm&&) noexcept;
  LeastNorm& operator=(LeastNorm&&) noexcept;

  /// The matrix that factor() decomposes: rows x columns, to be filled by the caller; what it holds
  /// is undefined.
  Eigen::MatrixXd& matrix(Eigen::Index rows, Eigen::Index columns);
  /// Decomposes matrix(). @param threshold as pivot_columns().
  void factor(double threshold);

  Eigen::Index rank() const;
  /// @param b one right-hand side per column, as many rows as A. @returns one solution per column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// The same, in the workspace, valid until it is used again.
  Eigen::MatrixXd& solve(const Eigen::MatrixXd& b, LeastNormWorkspace* workspace) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};
/// The same with Eigen's default threshold: the rounding of one number times the smaller dimension.
LeastNorm least_norm(const Eigen::MatrixXd& A);
double least_norm_threshold(Eigen::Index rows, Eigen::Index columns);

/// Eigenvalues, ascending, and orthonormal eigenvectors (columns) of a symmetric matrix, whose
/// lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

/// Eigenvalues and eigenvectors (columns of unit length) of a square matrix.
struct GeneralEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
GeneralEigen general_eigen(const Eigen::MatrixXd& A);

/// A B and A^T B. An expression with such a product compiles Eigen's kernels again in its file;
/// where speed does not depend on it, it calls these.
Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Principal moments, ascending, of an inertia tensor [kg m^2].
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& J);

/// The upper triangular R with R^T R = A^T A and a diagonal that is not negative, by Householder
/// reflections; square, of the size of A's columns. A^T A itself, whose condition number is the
/// square of A's condition number, is not formed.
Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& A);

/// The same for a matrix whose rows arrive one after another and are too many to keep. It holds two
/// times as many rows as columns, at least 32 rows more than columns. No allocation in add().
class RowRoot {
 public:
  /// Begins again, without rows.
  void start(Eigen::Index columns);
  /// Adds a row, given as a column vector.
  void add(const Eigen::Ref<const Eigen::VectorXd>& row);
  /// R of all rows so far; resized and filled. Allocates nothing but this result once warm.
  void root(Eigen::MatrixXd* root);
  Eigen::MatrixXd root() {
    Eigen::MatrixXd R;
    root(&R);
    return R;
  }

 private:
  Eigen::MatrixXd rows_;     ///< R of the rows before, then rows that wait
  Eigen::VectorXd reduced_;  ///< memory for the root of all rows
  Eigen::VectorXd workspace_;
  Eigen::Index used_ = 0;  ///< rows in use
};

}  // namespace codesign
