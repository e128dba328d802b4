// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_TREE_CHECK_H_
#define MECHANISM_CODESIGN_READING_URDF_TREE_CHECK_H_

#include "description/robot.h"

namespace codesign {

/// Names must be unique (links; joints with loops; couplings; spring-dampers).
void check_names(const RobotDescription& robot);

/// A link that several joints name as their child hangs on the one by which the root reaches it first; in a vendor's file the others are
/// read as loops, with a warning. Called before `<loop>` elements are added.
void close_with_second_parents(RobotDescription* robot);

/// The tree's root. @throws InputError if a link hangs on two joints, no link or several could be the root, or links hang in a ring.
int find_root(const RobotDescription& robot);

/// `<mimic>` must name another joint with one coordinate or none, and not come back to where it started. In a vendor's file what does not
/// is dropped with a warning. @throws InputError for an overlay's
void check_mimics(RobotDescription* robot);

/// Friction dimensions of the joints that cannot become part of a compound joint: both links have inertia, or are the ground.
void check_friction(const RobotDescription& robot);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_TREE_CHECK_H_
