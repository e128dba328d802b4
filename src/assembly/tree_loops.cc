// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/tree_loops.h"

#include <algorithm>

#include "equations/compiled_system.h"

namespace codesign {

TreeLoops::TreeLoops(const CompiledSystem& compiled)
    : system(compiled),
      tree(compiled.robot()),
      jacobian(compiled, tree),
      followers(compiled, tree),
      given(compiled, &tree) {
  const std::vector<int>& dropped = compiled.dropped_rows();
  for (const int row : jacobian.constraint_rows())
    drops.push_back(std::binary_search(dropped.begin(), dropped.end(), row));
}

}  // namespace codesign
