// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_errors.h"

#include <algorithm>
#include <cmath>

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

LoopMiss largest_miss(const LoopJacobian& loops, const VectorX<double>& errors,
                      const Equations<double>& equations) {
  LoopMiss largest;
  for (std::size_t k = 0; k < loops.owners(); ++k)
    if (const LoopMiss miss = loops.miss(k, errors, equations); size_of(miss) > size_of(largest))
      largest = miss;
  return largest;
}

}  // namespace

double size_of(const LoopMiss& miss) { return std::max(miss.length, miss.angle); }

double LoopErrors::find(const TreeLoops& loops, const StartDesign& design, LoopRows heeded,
                        Posture* posture) {
  state.resize(loops.system.layout());
  state.t = posture->time;
  place(loops, design, *posture, &links, &state);
  design.equations->constraint_errors(state, &all, &rates);
  loops.jacobian.take_part(all, &rows);
  for (std::size_t k = 0; k < loops.drops.size(); ++k)
    if (loops.drops[k] && heeded == LoopRows::kEnforced) rows(to_signed(k), 0) = 0.0;
  const double error = rows.size() == 0 ? 0.0 : rows.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (std::isfinite(error)) posture->miss = largest_miss(loops.jacobian, all, *design.equations);
  return error;
}

}  // namespace codesign
