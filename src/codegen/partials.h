// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"

namespace codesign {

/// One term of a derivative: the derivative of `node` times `factor`.
struct Partial {
  int node;
  Traced factor;
};

/// The partial derivatives of an operation by its operands; none for leaves, literals and roundings. Nodes for the factors are appended to
/// the recording.
std::vector<Partial> partials_of(Recording* recording, int node);

/// x, as a literal if its node is one, so that products with it are simplified.
Traced folded(Recording* recording, const Traced& x);

/// x * y, with the factors that do not vary multiplied first: such a product is computed once per design.
Traced product(Recording* recording, const Traced& x, const Traced& y);

}  // namespace codesign
