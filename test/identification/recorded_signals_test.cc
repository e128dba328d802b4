// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Signals that sensors beside those of joints record: forces and torques of a wrist or a plate,
// IMUs, markers.
#include <gtest/gtest.h>

#include <cmath>

#include "identification/effort/effort_residuals.h"
#include "identification/identify.h"
#include "identification/motion_rig.h"
#include "identification/regressor.h"
#include "identification/simulated_recording.h"
#include "identification/swinging_arm.h"

namespace codesign {
namespace {

SignalSamples signal_samples(const std::string& signal, std::vector<double> values) {
  return {parse_signal(signal, {"study.yaml", 2}, "identify.data[0].signals"), std::move(values)};
}

/// The arm of SwingingRig with its mass and the distance of its centre as parameters.
constexpr const char* kSensedArm =
    R"(<robot name="arm" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mass" value="1.5"/><codesign:parameter name="reach" value="0.4"/>
  <codesign:parameter name="inertia" value="0.1"/><codesign:parameter name="bias" value="0"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0.4 0 0" codesign:xyz="${reach} 0 0"/>
    <mass value="1.5" codesign:value="${mass}"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/></joint>
</robot>)";

Problem sensed_arm(const std::string& more = "") {
  return load_problem(
      {"arm.urdf", kSensedArm}, {},
      {"study.yaml", "identify:\n  data: [{csv: data.csv}]\n  filter: {cutoff: 0" + more +
                         "}\nparameters: {mass: {}, reach: {}, inertia: {}, bias: "
                         "{}}\noptimizer: {relative_tolerance: 1.0e-12}\n"});
}

/// What a sensor in the hinge shows, by Newton's law of a mass of 2 kg at 0.5 m: towards the axis,
/// along the motion and upwards. @param has_effort whether the torque of the hinge was recorded
JointRecording on_a_plate(bool has_effort) {
  const SwingingRig rig;
  JointRecording recording = rig.record("identify.data[0]");
  std::vector<double> inward, along, torque;
  for (const double t : recording.times) {
    inward.push_back(-2.0 * 0.5 * rig.velocity(t) * rig.velocity(t));
    along.push_back(2.0 * 0.5 * rig.acceleration(t));
    torque.push_back(0.8 * rig.acceleration(t));
  }
  std::vector<double> upward(recording.times.size(), 2.0 * 9.81 + 0.7);
  recording.signals = {signal_samples("hinge/reaction_force/x", inward),
                       signal_samples("hinge/reaction_force/y", along),
                       signal_samples("${hinge/reaction_force/z + bias}", upward)};
  recording.joints[0].effort = has_effort ? torque : std::vector<double>();
  return recording;
}

void expect_sensed(const IdentificationResult& result, bool has_effort) {
  ASSERT_EQ(result.data.size(), has_effort ? 4U : 3U);
  EXPECT_EQ(result.data.back().joint, "${hinge/reaction_force/z + bias}");
  EXPECT_TRUE(result.data.back().is_signal);
  EXPECT_EQ(result.data.front().is_signal, !has_effort);
  if (!has_effort) return;
  const double mass = result.numbers[0].value, reach = result.numbers[1].value;
  EXPECT_NEAR(result.numbers[2].value + mass * reach * reach, 0.8, 1e-3);
}

/// The products mass times reach and mass plus bias over g are all that these sensors tell.
TEST(RecordedSignals, ForcesOfAHingeTellTheFirstMoment) {
  StudyRecordings recordings;
  recordings.data = {on_a_plate(false)};
  const IdentificationResult result = identify(sensed_arm(), recordings, {}, nullptr);
  expect_sensed(result, false);
  EXPECT_NEAR(result.numbers[0].value * result.numbers[1].value, 1.0, 1e-4);
  EXPECT_NEAR(9.81 * result.numbers[0].value + result.numbers[3].value, 2.0 * 9.81 + 0.7, 1e-3);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
}

TEST(RecordedSignals, StandBesideEfforts) {
  StudyRecordings recordings;
  recordings.data = {on_a_plate(true)};
  const IdentificationResult result =
      identify(sensed_arm(", residual_cutoff: 20"), recordings, {}, nullptr);
  expect_sensed(result, true);
  for (const OutputFit& fit : result.data) EXPECT_LT(fit.rms, 2e-3 * fit.recorded) << fit.joint;
}

TEST(RecordedSignals, OthersInOneRecordingAreRefused) {
  StudyRecordings recordings;
  recordings.data = {on_a_plate(true), on_a_plate(true)};
  recordings.data[1].signals.pop_back();
  EXPECT_THROW(identify(sensed_arm(), recordings, {}, nullptr), InputError);
}

/// Recordings with values of their own have a model of their own, and so has a holdout.
TEST(RecordedSignals, OthersInAHoldoutOrWithOtherValuesAreRefused) {
  const Problem problem = load_problem(
      {"arm.urdf", kSensedArm}, {},
      {"study.yaml",
       "identify: {data: [{csv: data.csv}], filter: {cutoff: 0}}\nparameters: {mass: {}}\n"});
  StudyRecordings held;
  held.data = {on_a_plate(true)};
  held.holdout = {on_a_plate(true)};
  held.holdout[0].signals.pop_back();
  StudyRecordings set;
  set.data = {on_a_plate(true), on_a_plate(true)};
  set.data[0].signals.pop_back();
  set.data[1].settings = {{3, 0.1}};
  StudyRecordings none = set;
  none.data[1].signals.clear();
  for (const StudyRecordings& recordings : {held, set, none}) {
    EXPECT_THROW(identify(problem, recordings, {}, nullptr), InputError);
    EXPECT_THROW(evaluate_model(problem, recordings, nullptr), InputError);
  }
  EXPECT_THROW(find_regressor(problem, {}, set.data, nullptr), InputError);
  EXPECT_NO_THROW(find_regressor(problem, {}, held.data, nullptr));
}

/// Exact derivatives, also of a mechanism with loops whose dimensions are tuned.
void expect_signal_slopes(const Problem& problem, const JointRecording& recording, double largest) {
  const FitVariables variables(study_of(problem), &robot_of(problem));
  Warnings warnings;
  const std::vector<JointRecording> recordings = {recording};
  EffortResiduals residuals(*system_of(problem), variables, require_same_joints(recordings),
                            {measured_motion(recording, {}, &warnings)}, {}, 1,
                            require_same_signals(recordings));
  const Eigen::VectorXd x = variables.start();
  Eigen::MatrixXd values, slopes, above, below;
  ASSERT_TRUE(residuals.begin(x).ok());
  ASSERT_TRUE(residuals.evaluate(x, &values, &slopes).ok());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double step = 1e-5 * std::max(1e-2, std::abs(x[k]));
    Eigen::VectorXd shifted = x;
    shifted[k] = x[k] + step;
    ASSERT_TRUE(residuals.evaluate(shifted, &above, nullptr).ok());
    shifted[k] = x[k] - step;
    ASSERT_TRUE(residuals.evaluate(shifted, &below, nullptr).ok());
    const Eigen::VectorXd difference = (above - below).reshaped() / (2.0 * step);
    EXPECT_LT((difference - slopes.col(k)).cwiseAbs().maxCoeff(),
              largest * (1.0 + slopes.col(k).cwiseAbs().maxCoeff()))
        << variables.names()[static_cast<std::size_t>(k)];
  }
}

TEST(RecordedSignals, SlopesAreThoseOfDifferences) {
  JointRecording recording = on_a_plate(true);
  std::vector<double> none(recording.times.size(), 0.0);
  for (const char* signal : {"bar/imu_acceleration/y", "bar/angular_acceleration/z",
                             "mechanism/kinetic_energy", "hinge/reaction_torque/y@ground"})
    recording.signals.push_back(signal_samples(signal, none));
  expect_signal_slopes(sensed_arm(), part_of(recording, 0, 60), 1e-6);
}

/// A four-bar linkage whose crank is driven: positions of its other links follow its lengths.
constexpr const char* kSensedBars =
    R"(<robot name="bars" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="length" value="0.8" lower="0.5" upper="1.5"/>
  <codesign:parameter name="mass" value="1" lower="0.1" upper="5"/>
  <link name="base"/>
  <link name="crank"><inertial><origin xyz="0.15 0 0"/><mass value="1" codesign:value="${mass}"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="coupler"><inertial><origin xyz="0.4 0 0" codesign:xyz="${length/2} 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="rocker"><inertial><origin xyz="0.25 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="drive" type="continuous"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="pivot" type="continuous"><parent link="base"/><child link="rocker"/><origin xyz="0.7 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="pin" type="revolute"><predecessor link="coupler"><origin xyz="0.8 0 0" codesign:xyz="${length} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0.5 0 0"/></successor><axis xyz="0 0 1"/></loop>
</robot>)";

TEST(RecordedSignals, SlopesOfALoopWhoseLengthIsTuned) {
  const Problem problem = load_problem(
      {"bars.urdf", kSensedBars}, {},
      {"study.yaml",
       "initial_state: {drive: {position: 0.3}, elbow: {guess: 0.6}, pivot: {guess: 1.9}}\n"
       "identify: {data: [{csv: data.csv}]}\nparameters: {length: {}, mass: {}}\n"});
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  JointSamples drive{"drive", {}, {}, {}};
  for (int k = 0; k < 60; ++k) {
    recording.times.push_back(0.01 * k);
    recording.places.push_back(static_cast<std::size_t>(k) + 2);
    drive.position.push_back(0.3 + 0.5 * std::sin(3.0 * recording.times.back()));
    drive.effort.push_back(1.0);
  }
  recording.joints = {drive};
  const std::vector<double> none(recording.times.size(), 0.0);
  for (const char* signal :
       {"coupler/position/y", "rocker/angular_velocity/z", "coupler/imu_acceleration/x",
        "pin/reaction_force/x", "pivot/reaction_force/y", "mechanism/shaking_force/x"})
    recording.signals.push_back(signal_samples(signal, none));
  expect_signal_slopes(problem, recording, 2e-6);
}

/// A pendulum whose IMU alone was recorded beside its position, in motion.
TEST(RecordedSignals, AnImuInMotion) {
  const std::string servo = motion_servo();
  const Problem truth = load_problem(
      {"pendulum.urdf", motion_pendulum()}, {},
      {"truth.yaml", "duration: 4.0\n" + servo +
                         "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n"});
  const std::vector<std::string> names = {"hinge/position", "bar/imu_acceleration/x",
                                          "bar/imu_angular_velocity/y"};
  Simulation simulation(truth, {0.2, 0.3, 0.5}, names);
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  JointSamples hinge{"hinge", {}, {}, {}};
  std::vector<double> values[2];
  ASSERT_TRUE(simulate(&simulation, 4.0, 401, [&](const Frame& frame) {
                recording.times.push_back(frame.time);
                recording.places.push_back(recording.times.size());
                hinge.position.push_back(frame.signals[0]);
                for (std::size_t k = 0; k < 2; ++k) values[k].push_back(frame.signals[k + 1]);
                return true;
              }).ok());
  recording.joints = {hinge};
  for (std::size_t k = 0; k < 2; ++k)
    recording.signals.push_back(signal_samples(names[k + 1], values[k]));
  StudyRecordings recordings;
  recordings.data = {recording};
  const IdentificationResult result = identify(
      motion_problem(servo, "  filter: {cutoff: 20.0}\n", "inertia: {}, viscous: {}, dry: {}"),
      recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.data.size(), 3U);
  EXPECT_EQ(result.data[1].joint, "bar/imu_acceleration/x");
  const double expected[] = {0.2, 0.3, 0.5};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(result.numbers[k].value, expected[k], 1e-4);
  for (const OutputFit& fit : result.data) EXPECT_GT(fit.explained, 0.9999) << fit.joint;
}

}  // namespace
}  // namespace codesign
