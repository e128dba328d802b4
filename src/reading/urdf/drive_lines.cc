// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/drive_lines.h"

#include "text/number_text.h"

namespace codesign {
namespace {

// Numbers of a usual size; decision 131 says where they come from.
constexpr double kUsualRatio = 100.0;       // of strain wave and planetary gears
constexpr double kScrewRatio = 628.0;       // of a screw of 10 mm per turn [rad/m]
constexpr double kReflectedInertia = 1e-3;  // [kg m^2] per N m of the largest effort
constexpr double kScrewRotor = 1e-5;        // rotor of a small servo motor [kg m^2]
constexpr double kFriction = 0.03;          // of the largest effort
constexpr double kEffort = 10.0;            // of a joint without a limit [N m or N]

double ratio_of(const DriveFacts& drive) {
  if (drive.gear_ratio != 0.0) return drive.gear_ratio;
  return drive.joint.is_turn() ? kUsualRatio : kScrewRatio;
}

/// @param inertia of the rotor [kg m^2] @param more attributes
std::string actuator_line(const DriveFacts& drive, const std::string& inertia, const char* more) {
  return element_named(
      "joint", drive.joint.name,
      "<codesign:actuator gear_ratio=" + attribute_text(to_decimal(ratio_of(drive))) +
          " rotor_inertia=" + attribute_text(inertia) + more + "/>");
}

double largest_effort(const JointDescription& joint) {
  return joint.limit && joint.limit->bounds_effort() ? joint.limit->effort.nominal() : kEffort;
}

std::string of_largest_effort(const JointDescription& joint) {
  const bool bounded = joint.limit && joint.limit->bounds_effort();
  return std::string(bounded ? "of its limit, " : "without a limit, for ") +
         readable(largest_effort(joint), 4) + (joint.is_turn() ? " N m" : " N");
}

}  // namespace

void write_armature(const DriveFacts& drive, double armature, OverlayLines* lines) {
  lines->say("Rotor of " + drive.joint.name + ": <dynamics armature=\"" + readable(armature) +
             "\"> of other tools is what the joint feels of it, gear_ratio^2 rotor_inertia" +
             (drive.gear_ratio != 0.0
                  ? ""
                  : "; another gear_ratio, here the usual one, changes only what the motor does to "
                    "the link that carries it") +
             (drive.missing.empty() ? "." : "; " + drive.missing + "."));
  const double ratio = ratio_of(drive);
  const std::string line = actuator_line(drive, to_decimal(armature / (ratio * ratio)), "");
  if (drive.missing.empty())
    lines->add(line);
  else
    lines->to_fill_in(line);
}

void write_gear(const DriveFacts& drive, OverlayLines* lines) {
  const bool turns = drive.joint.is_turn();
  const double ratio = ratio_of(drive);
  const double inertia =
      turns ? kReflectedInertia * largest_effort(drive.joint) / (ratio * ratio) : kScrewRotor;
  lines->say(
      "Drive of " + drive.joint.name + ", from its data sheet" +
      (drive.missing.empty() ? "" : ", " + drive.missing) + ". Usual: " +
      (drive.gear_ratio != 0.0 ? "the reduction of the file's transmission"
       : turns                 ? "100 : 1"
                               : "a screw of 10 mm per turn") +
      (turns ? ", a rotor that is felt as 0.001 kg m^2 per N m " + of_largest_effort(drive.joint)
             : ", a rotor of 1e-5 kg m^2") +
      ", 85 % efficiency. Without a gear: gear_ratio 1, no efficiency.");
  lines->to_fill_in(actuator_line(drive, readable(inertia, 3), " efficiency=\"0.85\""));
}

void write_friction(const JointDescription& joint, OverlayLines* lines) {
  const bool bounded = joint.limit && joint.limit->bounds_velocity();
  const double friction = kFriction * largest_effort(joint);
  const double damping = friction / (bounded ? joint.limit->velocity.nominal() : 1.0);
  lines->say("Friction of " + joint.name + ". Usual: 3 % " + of_largest_effort(joint) +
             ", dry, and as much viscous " +
             (bounded ? "at its largest velocity" : "at a velocity of 1") +
             "; codesign identify finds it from a recording.");
  lines->to_fill_in(element_named("joint", joint.name,
                                  "<dynamics damping=" + attribute_text(readable(damping, 3)) +
                                      " friction=" + attribute_text(readable(friction, 3)) + "/>"));
}

}  // namespace codesign
