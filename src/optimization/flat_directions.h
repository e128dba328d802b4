// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace codesign {

/// The directions in which the objective is flat at a design: eigenvectors of the Gauss-Newton matrix with eigenvalues below 1e-8 of the
/// largest one, doc/theory.md (24i). Each parameter that gives such a direction its name stands alone in it (entry 1), beside the
/// parameters by which it is balanced.
/// @param root R by the scaled parameters, R^T R the Gauss-Newton matrix. @param active gradients of active constraints by the scaled
/// parameters, one per column: a flat direction does not change them. @param held parameters that do not move, such as those on a bound.
/// @returns one direction per column, by the scaled parameters; no columns without any.
Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& root, const Eigen::MatrixXd& active, const std::vector<bool>& held);

}  // namespace codesign
