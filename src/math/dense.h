// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MATH_DENSE_H_
#define MECHANISM_CODESIGN_MATH_DENSE_H_

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

// Eigen's decompositions of dense matrices take seconds to compile. dense.cc compiles them once; files that include this header in place of
// Eigen's do not compile them again.
extern template class Eigen::BDCSVD<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

#endif  // MECHANISM_CODESIGN_MATH_DENSE_H_
