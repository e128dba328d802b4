// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/robot.h"
#include "reading/urdf/overlay_lines.h"

namespace codesign {

/// What is known of the drive of a joint with one coordinate.
struct DriveFacts {
  const JointDescription& joint;
  double gear_ratio = 0.0;  ///< of the file's transmission; 0: it has none
  std::string missing;      ///< what the joint waits for before it can have a rotor; empty: nothing
};

/// The rotor that `<dynamics armature>` of other tools is, theory (9a): gear_ratio^2 rotor_inertia
/// is `armature` [kg m^2 or kg]. An element, or a line to fill in where something is missing.
void write_armature(const DriveFacts& drive, double armature, OverlayLines* lines);

/// A line for gear and rotor, with numbers of a usual size.
void write_gear(const DriveFacts& drive, OverlayLines* lines);

/// A line for the friction of a joint, likewise.
void write_friction(const JointDescription& joint, OverlayLines* lines);

}  // namespace codesign
