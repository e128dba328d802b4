// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/coupling_followers.h"
#include "assembly/loop_jacobian.h"
#include "assembly/tree_coordinates.h"
#include "system/tree_kinematics.h"

namespace codesign {

class CompiledSystem;

/// The tree of a mechanism with the loops and couplings that a start has to close. The same for all
/// designs.
struct TreeLoops {
  /// @param compiled must outlive this.
  explicit TreeLoops(const CompiledSystem& compiled);
  TreeLoops(const TreeLoops&) = delete;
  TreeLoops& operator=(const TreeLoops&) = delete;

  const CompiledSystem& system;
  TreeLayout tree;
  LoopJacobian jacobian;
  CouplingFollowers followers;
  GivenStart given;         ///< by the study
  std::vector<bool> drops;  ///< per row of `jacobian`: whether the system does not enforce it
};

}  // namespace codesign
