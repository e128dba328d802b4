// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "problem/load_problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// An arm on a vertical axis, which gravity does not move; its moment of inertia about the axis is
/// inertia + 0.5 kg m^2.
inline const std::string kSwingingArm =
    R"(<robot name="arm" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
    <dynamics damping="0.1" friction="0" codesign:damping="${viscous}"/></joint>
</robot>
)";

/// @param more lines of the block `identify`, each indented by two and ended.
inline std::string swinging_study(const std::string& data = "{csv: data.csv}",
                                  const std::string& more = "") {
  return "identify:\n  data: [" + data + "]\n" + more +
         "parameters: {inertia: {}, viscous: {}}\noptimizer: {algorithm: levenberg_marquardt, "
         "relative_tolerance: 1.0e-10}\n";
}

inline Problem swinging_problem(const std::string& data = "{csv: data.csv}",
                                const std::string& more = "") {
  return load_problem({"arm.urdf", kSwingingArm}, {}, {"study.yaml", swinging_study(data, more)});
}

/// The recording of an arm with inertia 0.3 and viscous 0.4 on a rig: for 5 s at 200 Hz; efforts as
/// (tau + offset) / scale.
struct SwingingRig {
  double scale = 1.0, offset = 0.0, start = 0.0;

  double position(double t) const { return std::sin(2.0 * t) + 0.3 * std::sin(5.0 * t); }
  double velocity(double t) const { return 2.0 * std::cos(2.0 * t) + 1.5 * std::cos(5.0 * t); }
  double acceleration(double t) const { return -4.0 * std::sin(2.0 * t) - 7.5 * std::sin(5.0 * t); }
  double torque(double t) const { return 0.8 * acceleration(t) + 0.4 * velocity(t); }

  static constexpr int kSamples = 1001;
  double time(int k) const { return start + 0.005 * k; }

  JointRecording record(const std::string& element) const {
    JointRecording recording;
    recording.file = "data.csv";
    recording.element = element;
    recording.where = {"study.yaml", 2};
    JointSamples hinge{"hinge", {}, {}, {}};
    for (int k = 0; k < kSamples; ++k) {
      recording.times.push_back(time(k));
      recording.places.push_back(static_cast<std::size_t>(k) + 2);
      hinge.position.push_back(position(time(k)));
      hinge.velocity.push_back(velocity(time(k)));
      hinge.effort.push_back((torque(time(k)) + offset) / scale);
    }
    recording.joints = {hinge};
    return recording;
  }

  /// The same as a table with names.
  std::string table() const {
    const JointRecording recording = record("");
    const JointSamples& hinge = recording.joints[0];
    std::string text = "time,hinge/position,hinge/velocity,hinge/effort\n";
    for (std::size_t k = 0; k < recording.times.size(); ++k) {
      for (const double number : {recording.times[k], hinge.position[k], hinge.velocity[k]})
        text += std::to_string(number) + ",";
      text += std::to_string(hinge.effort[k]) + "\n";
    }
    return text;
  }
};

}  // namespace codesign
