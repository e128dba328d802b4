// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace codesign {

int joint_index(const RobotDescription& robot, const std::string& name) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].name == name) return static_cast<int>(k);
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

RecordedMotion record_motion(const CompiledSystem& system, const std::vector<std::string>& joints,
                             int samples, double largest_step) {
  RosenbrockIntegrator integrator(system);
  EXPECT_TRUE(integrator.start(system.parameters()).ok());
  RecordedMotion recorded;
  for (Eigen::MatrixXd* part : {&recorded.motion.position, &recorded.motion.velocity,
                                &recorded.motion.acceleration, &recorded.efforts})
    part->resize(static_cast<Eigen::Index>(joints.size()), samples);
  Assembly assembly(system);
  for (int sample = 0; sample < samples; ++sample) {
    State<double> state = integrator.state();
    EXPECT_TRUE(assembly.rates().solve(&integrator.equations(), &state).ok());
    Formulas<double>& formulas = integrator.equations().formulas();
    formulas.load(state);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const CouplingTerm at =
          drive_of(system.robot(), system.topology(), joint_index(system.robot(), joints[k]))
              .terms.front();
      const CoordinateMotion<double>& motion = formulas.coordinate(at.pair, at.element);
      const auto row = static_cast<Eigen::Index>(k);
      recorded.motion.position(row, sample) = motion.position;
      recorded.motion.velocity(row, sample) = motion.rate;
      recorded.motion.acceleration(row, sample) = motion.acceleration;
      recorded.efforts(row, sample) = formulas.effort(at.pair, at.element);
    }
    EXPECT_TRUE(integrator.advance(state.t + largest_step).ok());
  }
  return recorded;
}

std::shared_ptr<const CompiledSystem> compiled(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study}, robot), nullptr);
}

std::vector<MeasuredJoint> measured(const std::vector<std::string>& with_effort,
                                    const std::vector<std::string>& without) {
  std::vector<MeasuredJoint> joints;
  for (const std::string& name : with_effort)
    joints.push_back({name, true, 1.0, {"study.yaml", 3}});
  for (const std::string& name : without) joints.push_back({name, false, 1.0, {"study.yaml", 4}});
  return joints;
}

MotionSamples swing(int samples, double amplitude, double offset, int joints) {
  MotionSamples motion;
  for (Eigen::MatrixXd* part : {&motion.position, &motion.velocity, &motion.acceleration})
    part->resize(joints, samples);
  for (int joint = 0; joint < joints; ++joint) {
    for (int k = 0; k < samples; ++k) {
      const double w = 3.0 + 0.7 * joint, phase = w * 0.01 * k + joint;
      motion.position(joint, k) = offset + amplitude * std::sin(phase);
      motion.velocity(joint, k) = amplitude * w * std::cos(phase);
      motion.acceleration(joint, k) = -amplitude * w * w * std::sin(phase);
    }
  }
  return motion;
}

}  // namespace codesign
