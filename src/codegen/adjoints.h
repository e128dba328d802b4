// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"

namespace codesign {

/// An output of a recording and its weight in the sum that is differentiated.
struct AdjointSeed {
  int node;
  Traced weight;
};

/// The derivatives of the sum of weights times outputs by some nodes of a recording, by reverse accumulation on the linearized graph
/// (Griewank and Walther, Evaluating Derivatives, 2008, section 3.2): the adjoint of a node is its weight plus, for each node that uses it,
/// the partial derivative of the user by the node times the adjoint of the user. The number of operations does not grow with the number of
/// targets.
/// @param recording nodes for the adjoints are appended to it; nodes that it already has are used again.
/// @param is_target per node: whether its adjoint is wanted. The derivative by a target is the one by which the nodes that it is computed
/// from stay fixed: their adjoints get nothing through it. Nodes beyond the end of `is_target` are no targets.
/// @returns one adjoint per entry of `is_target`, a node or a literal; the literal 0 for nodes that are no targets.
std::vector<Traced> derive_adjoints(Recording* recording, const std::vector<AdjointSeed>& seeds, const std::vector<bool>& is_target);

}  // namespace codesign
