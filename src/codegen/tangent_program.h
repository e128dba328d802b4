// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CODEGEN_TANGENT_PROGRAM_H_
#define MECHANISM_CODESIGN_CODEGEN_TANGENT_PROGRAM_H_

#include <vector>

#include "codegen/traced.h"
#include "codegen/value_program.h"

namespace codesign {

/// Directional derivatives of a recording as sums of products: of directions of leaves and of other sums (rows) with numbers that are nodes
/// themselves (factors). Forward accumulation on the linearized graph (Griewank and Walther 2008, section 10.2): what is proportional to
/// one other derivative, or is only added to another, has no sum of its own.
struct TangentProgram {
  struct Term {
    int row;     ///< the node whose derivative it is: a leaf, or one that has a sum
    int factor;  ///< node; -1 for one
    bool added;  ///< rather than subtracted
  };
  struct Sum {
    int node;  ///< -1: of an output
    ValueTask::Output output;
    std::vector<Term> terms;
  };

  /// @param recording gets nodes for the factors. @param outputs whose derivatives are wanted. @param is_leaf per node, whether its
  /// derivative is given; nodes that do not vary and are not among them have none.
  TangentProgram(Recording* recording, const std::vector<ValueTask::Output>& outputs, const std::vector<bool>& is_leaf);

  std::vector<Sum> sums;     ///< in order
  std::vector<int> row;      ///< per node: its place among the sums' own rows, -1 if it has none
  std::vector<int> factors;  ///< nodes whose values are needed, each once
  int rows = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CODEGEN_TANGENT_PROGRAM_H_
