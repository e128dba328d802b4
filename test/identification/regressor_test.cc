// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/regressor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/swinging_arm.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The arm as it stands needs 0.6 a + 0.1 v; accelerations are differences of samples.
void expect_efforts(const Regressor& found, double offset) {
  const SwingingRig rig;
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  ASSERT_EQ(found.outputs, std::vector<std::string>{"hinge"});
  for (Eigen::Index k = 0; k < found.computed.rows(); ++k) {
    const double t = found.times[static_cast<std::size_t>(k)];
    EXPECT_NEAR(found.computed(k, 0), 0.6 * rig.acceleration(t) + 0.1 * rig.velocity(t) + offset,
                2e-3);
    // The arm's other 0.5 kg m^2 are no number.
    EXPECT_NEAR(found.matrix.row(k).head(2).sum() * 0.1 + 0.5 * rig.acceleration(t),
                found.computed(k, 0) - offset, 2e-3);
  }
}

Regressor of_arm(const std::string& joints, const JointRecording& recording) {
  return find_regressor(swinging_problem("{csv: data.csv}", "  filter: {cutoff: 0}\n" + joints), {},
                        {recording}, nullptr);
}

TEST(Regressor, HasTheEffortsWhateverTheSensorDoes) {
  const JointRecording recording = SwingingRig().record("recordings[0]");
  JointRecording alone = recording;
  alone.joints[0].effort.clear();
  for (const JointRecording& of : {recording, alone}) {
    expect_efforts(of_arm("", of), 0.0);
    expect_efforts(of_arm("  joints: {hinge: {effort_scale: 3, delay: 0.05, offset: 0.7}}\n", of),
                   0.0);
  }
}

/// An offset that is to be found is one of the numbers.
TEST(Regressor, AFittedOffsetIsANumber) {
  const Regressor found = of_arm("  joints: {hinge: {offset: {initial: 0.7}, delay: {}}}\n",
                                 SwingingRig().record("recordings[0]"));
  expect_efforts(found, 0.7);
  ASSERT_EQ(found.names.size(), 4U);
  EXPECT_EQ(found.names[3], "hinge/offset");
  EXPECT_EQ(found.values[3], 0.7);
  EXPECT_TRUE(found.matrix.col(3).isConstant(1.0, 1e-12));
  EXPECT_TRUE(found.matrix.col(2).isZero(1e-12)) << "a constant has no delay";
}

/// A parallelogram: crank and rocker turn alike, the coupler does not turn.
constexpr const char* kParallelogram =
    R"(<robot name="bars" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="5"/>
  <link name="base"/>
  <link name="crank"><inertial><origin xyz="0.15 0 0"/><mass value="1" codesign:value="${mass}"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="coupler"><inertial><origin xyz="0.4 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="rocker"><inertial><origin xyz="0.15 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="drive" type="continuous"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="pivot" type="continuous"><parent link="base"/><child link="rocker"/><origin xyz="0.8 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="pin" type="revolute"><predecessor link="coupler"><origin xyz="0.8 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0.3 0 0"/></successor><axis xyz="0 0 1"/></loop>
</robot>)";

/// @param passive whether encoders of the other joints were recorded, too
JointRecording of_bars(bool passive, bool with_effort) {
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "recordings[0]";
  JointSamples drive{"drive", {}, {}, {}}, elbow{"elbow", {}, {}, {}}, pivot{"pivot", {}, {}, {}};
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k, angle = 1.0 + 0.4 * std::sin(3.0 * t);
    recording.times.push_back(t);
    recording.places.push_back(static_cast<std::size_t>(k) + 1);
    drive.position.push_back(angle);
    elbow.position.push_back(-angle);
    pivot.position.push_back(angle);
    if (with_effort) drive.effort.push_back(0.3);
  }
  recording.joints = {drive};
  if (passive) recording.joints = {pivot, drive, elbow};
  return recording;
}

/// About the axes of crank and rocker (0.01 + 0.15^2) each, and the coupler moves as a point at
/// 0.3 m.
TEST(Regressor, OfALoopWithEncodersOnAllJoints) {
  const Problem problem = load_problem(
      {"bars.urdf", kParallelogram}, {},
      {"study.yaml",
       "initial_state: {drive: {position: 1.0}, elbow: {guess: -1.0}, pivot: {guess: 1.0}}\n"
       "gravity: [0, 0, -9.81]\nidentify: {filter: {cutoff: 0}}\nparameters: {mass: {}}\n"});
  for (const bool passive : {false, true})
    for (const bool with_effort : {false, true}) {
      const Regressor found = find_regressor(problem, {}, {of_bars(passive, with_effort)}, nullptr);
      ASSERT_TRUE(found.status.ok()) << found.status.cause;
      ASSERT_EQ(found.outputs.size(), 1U);
      if (!passive || with_effort) {
        EXPECT_EQ(found.outputs[0], "drive");
      }
      const double sign =
          found.outputs[0] == "elbow" ? -1.0 : 1.0;  // that turns against the others
      for (Eigen::Index k = 0; k < found.computed.rows(); ++k) {
        const double a =
            sign * -0.4 * 9.0 * std::sin(3.0 * found.times[static_cast<std::size_t>(k)]);
        EXPECT_NEAR(found.computed(k, 0), (2.0 * (0.01 + 0.0225) + 0.09) * a, 2e-3);
        EXPECT_NEAR(found.matrix(k, 0), 0.0225 * a, 1e-3);
      }
    }
}

}  // namespace
}  // namespace codesign
