// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"

namespace codesign {

/// Checks that names are unique: among links, among joints and loops, among couplings, among spring-dampers. @throws InputError
void check_names(const RobotDescription& robot);

/// For a link that is the child of several joints: keeps as tree joint the joint by which a walk from the root reaches the link first. In a
/// vendor's file the other joints become loops, with a warning (`second_parent`). Called before `<loop>` elements are added.
void close_with_second_parents(RobotDescription* robot);

/// Index of the tree's root link.
/// @throws InputError if a link is the child of two joints, if there is no root or more than one, or if joints form a ring.
int find_root(const RobotDescription& robot);

/// Checks that every `<mimic>` names another joint with one coordinate or none, and that joints do not mimic each other in a ring. In a
/// vendor's file a wrong `<mimic>` is dropped with a warning (`mimic_ignored`). @throws InputError for a wrong `<mimic>` of an overlay
void check_mimics(RobotDescription* robot);

/// Checks the friction dimensions of joints that cannot be folded with others, since both links have mass or are the ground.
/// @throws InputError as check_friction_geometry().
void check_friction(const RobotDescription& robot);

}  // namespace codesign
