// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion_rig.h"

#include <random>
#include <string>
#include <vector>

namespace codesign {

JointRecording MotionRig::record(const Problem& problem, const std::string& joint,
                                 const std::vector<double>& parameters) const {
  Simulation simulation(problem, parameters,
                        {joint + "/position", joint + "/velocity", joint + "/effort"});
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 2};
  JointSamples samples{joint, {}, {}, {}};
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Status status = simulate(
      &simulation, duration, static_cast<int>(duration * rate) + 1, [&](const Frame& frame) {
        recording.times.push_back(frame.time + begin);
        recording.places.push_back(recording.times.size());
        samples.position.push_back(frame.signals[0] + noise * normal(random));
        if (with_velocity)
          samples.velocity.push_back(frame.signals[1] + 5.0 * noise * normal(random));
        if (with_effort) samples.effort.push_back(frame.signals[2]);
        return true;
      });
  EXPECT_TRUE(status.ok()) << status.cause;
  recording.joints = {samples};
  return recording;
}

std::string motion_pendulum() {
  return R"(<robot name="pendulum" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="10"/>
  <codesign:parameter name="dry" value="0.2" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
    <dynamics damping="0.1" friction="0.2" codesign:damping="${viscous}" codesign:friction="${dry}"/></joint>
</robot>)";
}

std::string motion_servo() {
  return "initial_state: {hinge: {position: 0.3, velocity: 0.5}}\n"
         "controllers: {servo: {type: pid, input: hinge/position, setpoint: {type: sine, "
         "amplitude: 1.2, frequency: 0.6}, output: hinge, "
         "gains: {p: 20.0, i: 4.0, d: 2.0}}}\n";
}

Problem motion_problem(const std::string& blocks, const std::string& identify,
                       const std::string& parameters) {
  return load_problem(
      {"pendulum.urdf", motion_pendulum()}, {},
      {"study.yaml",
       blocks + "identify:\n  data: [{csv: data.csv}]\n  residual: motion\n" + identify +
           "parameters: {" + parameters +
           "}\noptimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}\n"});
}

JointRecording record_pendulum(const MotionRig& rig) {
  const Problem truth = load_problem(
      {"pendulum.urdf", motion_pendulum()}, {},
      {"truth.yaml", "duration: 6.0\n" + motion_servo() +
                         "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n"});
  return rig.record(truth, "hinge", {0.2, 0.3, 0.5});
}

}  // namespace codesign
