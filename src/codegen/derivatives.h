// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"
#include "codegen/value_program.h"

namespace codesign {

/// One term of a derivative: the derivative of `node` times `factor`.
struct Partial {
  int node;
  Traced factor;
};

/// The partial derivatives of an operation by its operands; none for leaves, literals and
/// roundings. Nodes for the factors are appended to the recording.
std::vector<Partial> partials_of(Recording* recording, int node);

/// x, as a literal if its node is one, so that products with it are simplified.
Traced folded(Recording* recording, const Traced& x);

/// x * y, with the factors that do not vary multiplied first: such a product is computed once per
/// design.
Traced product(Recording* recording, const Traced& x, const Traced& y);

/// An output of a recording and its weight in the sum that is differentiated.
struct AdjointSeed {
  int node;
  Traced weight;
};

/// The derivatives of the sum of weights times outputs by some nodes of a recording, by reverse
/// accumulation on the linearized graph (Griewank and Walther, Evaluating Derivatives, 2008,
/// section 3.2): the adjoint of a node is its weight plus, for each node that uses it, the partial
/// derivative of the user by the node times the adjoint of the user. The number of operations does
/// not grow with the number of targets.
/// @param recording nodes for the adjoints are appended to it; nodes that it already has are used
/// again.
/// @param is_target per node: whether its adjoint is wanted. The derivative by a target is the one
/// by which the nodes that it is computed from stay fixed: their adjoints get nothing through it.
/// Nodes beyond the end of `is_target` are no targets.
/// @returns one adjoint per entry of `is_target`, a node or a literal; the literal 0 for nodes that
/// are no targets.
std::vector<Traced> derive_adjoints(Recording* recording, const std::vector<AdjointSeed>& seeds,
                                    const std::vector<bool>& is_target);

/// A leaf x_c by which a recording is differentiated. Several leaves may belong to one column: the
/// derivative of an output by column c is the sum over these leaves of (partial derivative by the
/// leaf) * seed, so that functions of time make one column.
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
  kForward,  ///< in the order of computation: forward accumulation
  kReverse,  ///< in the opposite order: reverse accumulation
  /// fewest products first, which is forward or reverse block by block, whichever is shorter
  kMarkowitz
};

/// The derivatives of some nodes of a recording by some of its leaves, by vertex elimination on the
/// linearized graph (Griewank and Walther, Evaluating Derivatives, 2008, chapter 9). An edge c_ji
/// holds the partial derivative of node j by its operand i; eliminating node j adds c_kj c_ji to
/// c_ki for all its users k and operands i. What remains are edges from the leaves to the outputs.
/// @param recording nodes for the derivatives are appended to it; nodes that it already has are
/// used again.
/// @param outputs nodes of the recording. @returns the entries in order of rows, then columns:
/// together they are the pattern of the matrix.
std::vector<JacobianEntry> derive_jacobian(Recording* recording, const std::vector<int>& outputs,
                                           const std::vector<JacobianInput>& inputs,
                                           EliminationOrder order = EliminationOrder::kMarkowitz);

/// Directional derivatives of a recording as sums of products. The rows are derivatives of leaves
/// and of nodes with a sum of their own; the factors are values of nodes. By forward accumulation
/// on the linearized graph (Griewank and Walther 2008, section 10.2): a node whose derivative has
/// one term only, or is used once in a sum, gets no sum of its own; its terms are inserted where it
/// is used.
struct TangentProgram {
  struct Term {
    int row;     ///< the node whose derivative is multiplied: a leaf, or a node with a sum
    int factor;  ///< the node by whose value it is multiplied; -1 for the number 1
    bool added;  ///< false: the product is subtracted
  };
  struct Sum {
    int node;  ///< whose derivative the sum is; -1: it is the derivative of `output`
    ValueTask::Output output;  ///< only if node is -1
    std::vector<Term> terms;
  };

  /// @param recording nodes for the factors are appended to it. @param outputs whose derivatives
  /// are wanted. @param is_leaf per node, whether its derivative is given; all other leaves have
  /// the derivative zero.
  TangentProgram(Recording* recording, const std::vector<ValueTask::Output>& outputs,
                 const std::vector<bool>& is_leaf);

  std::vector<Sum> sums;  ///< in the order of computation
  /// per node: index of the derivative among the `rows` intermediate ones, -1 if it has none
  std::vector<int> row;
  std::vector<int> factors;  ///< nodes whose values are needed, each once
  int rows = 0;              ///< number of intermediate derivatives
};

}  // namespace codesign
