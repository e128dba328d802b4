// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_GIVEN_START_H_
#define MECHANISM_CODESIGN_ASSEMBLY_GIVEN_START_H_

#include <vector>

#include "assembly/tree_kinematics.h"
#include "system/start_rotations.h"
#include "system/system.h"

namespace codesign {

/// Which of the tree's coordinates, and of their rates, the study gives.
struct GivenStart {
  std::vector<bool> position, guess, velocity;

  GivenStart(const System& system, const TreeLayout& tree);
};

/// Sets the coordinates and rates that the study gives to their values at `parameters`; the others stay. The turning coordinates of a
/// floating joint with a given rotation are zero: JointDescription::start_rotation holds it.
template <class T>
void set_given_start(const System& system, const TreeLayout& tree, const std::vector<T>& parameters, VectorX<T>* theta, VectorX<T>* rate);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_GIVEN_START_H_
