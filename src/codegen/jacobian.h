// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"

namespace codesign {

/// A leaf x_c by which a recording is differentiated. Several leaves may belong to one column: the derivative of an output by column c is
/// the sum over these leaves of (partial derivative by the leaf) * seed, so that functions of time make one column.
struct JacobianInput {
  int leaf;          ///< a node
  int column;        ///< c
  Traced seed{1.0};  ///< derivative of the leaf by the column's variable
};

/// One nonzero entry of a Jacobian matrix.
struct JacobianEntry {
  int row;       ///< index among the outputs
  int column;    ///< c
  Traced value;  ///< a node or a literal, never the literal 0
};

/// In which order the intermediate nodes of the linearized graph are eliminated.
enum class EliminationOrder {
  kForward,   ///< in the order of computation: forward accumulation
  kReverse,   ///< in the opposite order: reverse accumulation
  kMarkowitz  ///< fewest products first, which is forward or reverse block by block, whichever is shorter
};

/// The derivatives of some nodes of a recording by some of its leaves, by vertex elimination on the linearized graph (Griewank and Walther,
/// Evaluating Derivatives, 2008, chapter 9). An edge c_ji holds the partial derivative of node j by its operand i; eliminating node j adds
/// c_kj c_ji to c_ki for all its users k and operands i. What remains are edges from the leaves to the outputs.
/// @param recording nodes for the derivatives are appended to it; nodes that it already has are used again.
/// @param outputs nodes of the recording. @returns the entries in order of rows, then columns: together they are the pattern of the matrix.
std::vector<JacobianEntry> derive_jacobian(Recording* recording, const std::vector<int>& outputs, const std::vector<JacobianInput>& inputs,
                                           EliminationOrder order = EliminationOrder::kMarkowitz);

}  // namespace codesign
