// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"
#include "codegen/value_program.h"

namespace codesign {

/// Directional derivatives of a recording as sums of products. The rows are derivatives of leaves and of nodes with a sum of their own; the
/// factors are values of nodes. By forward accumulation on the linearized graph (Griewank and Walther 2008, section 10.2): a node whose
/// derivative has one term only, or is used once in a sum, gets no sum of its own; its terms are inserted where it is used.
struct TangentProgram {
  struct Term {
    int row;     ///< the node whose derivative is multiplied: a leaf, or a node with a sum
    int factor;  ///< the node by whose value it is multiplied; -1 for the number 1
    bool added;  ///< false: the product is subtracted
  };
  struct Sum {
    int node;                  ///< whose derivative the sum is; -1: it is the derivative of `output`
    ValueTask::Output output;  ///< only if node is -1
    std::vector<Term> terms;
  };

  /// @param recording nodes for the factors are appended to it. @param outputs whose derivatives are wanted. @param is_leaf per node,
  /// whether its derivative is given; all other leaves have the derivative zero.
  TangentProgram(Recording* recording, const std::vector<ValueTask::Output>& outputs, const std::vector<bool>& is_leaf);

  std::vector<Sum> sums;     ///< in the order of computation
  std::vector<int> row;      ///< per node: index of the derivative among the `rows` intermediate ones, -1 if it has none
  std::vector<int> factors;  ///< nodes whose values are needed, each once
  int rows = 0;              ///< number of intermediate derivatives
};

}  // namespace codesign
