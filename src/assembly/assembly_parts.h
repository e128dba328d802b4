// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What Assembly consists of, for the files of its functions.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "assembly/assembly.h"
#include "assembly/design_branch.h"
#include "assembly/first_posture.h"
#include "assembly/loop_closure.h"
#include "assembly/posture.h"
#include "assembly/posture_list.h"
#include "assembly/rate_solution.h"
#include "assembly/singular_start.h"
#include "assembly/start_design.h"
#include "assembly/start_positions.h"
#include "assembly/start_velocities.h"
#include "assembly/stuck_joints.h"
#include "assembly/tree_loops.h"

namespace codesign {

struct Assembly::Parts {
  explicit Parts(const CompiledSystem& compiled);

  StartDesign design(const std::vector<double>& parameters, Equations<double>* equations) const {
    return {parameters, equations, cancel};
  }
  void forget_messages();
  Status close_from(const TreeCoordinates& from, const StartDesign& design, Posture* sought);

  TreeLoops loops;
  FirstPosture first;
  LoopClosure closure;
  StartPositions positions;
  DesignBranch branch;
  StartVelocities velocities;
  SingularStart singular;
  StuckJoints stuck;
  PostureList list;
  RateSolution rates;
  const std::atomic<bool>* cancel = nullptr;

  // The last solution.
  Posture posture;
  StartDependents dependents;
  Warnings warnings;
  std::vector<std::size_t> contradicting;
  std::vector<LinkMotion<double>> links;  ///< memory of place()
};

}  // namespace codesign
