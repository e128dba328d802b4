// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/given_trajectory.h"

#include <cmath>

#include "excitation/limit_scan.h"
#include "mechanism_codesign/error.h"

namespace codesign {

MeasuredMotion given_motion(const JointRecording& given, const FilterOptions& options,
                            const std::vector<MeasuredJoint>& joints, Warnings* warnings) {
  for (const MeasuredJoint& joint : joints)
    if (const JointSamples* samples = given.find(joint.name);
        samples == nullptr || samples->position.empty())
      throw InputError(
          {given.where, given.element,
           "the compared trajectory has no positions of an excited joint: " + given.file,
           joint.name, "a column " + joint.name + "/position"});
  FilterOptions filter = options;
  filter.residual_cutoff = 0.0;
  filter.decimate = 1;
  return measured_motion(given, filter, warnings);
}

DrivePath path_of(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints) {
  DrivePath path;
  for (Eigen::MatrixXd* rows : {&path.position, &path.velocity, &path.acceleration})
    rows->resize(to_signed(joints.size()), motion.times.count);
  for (std::size_t k = 0; k < joints.size(); ++k)
    for (const JointMotion& joint : motion.joints) {
      if (joint.joint != joints[k].name) continue;
      path.position.row(to_signed(k)) = joint.position;
      path.velocity.row(to_signed(k)) = joint.velocity;
      path.acceleration.row(to_signed(k)) = joint.acceleration;
    }
  return path;
}

std::vector<KeptLimit> reached_limits(const MotionLimits& limits, const DrivePath& path,
                                      const PathResponse& response) {
  std::vector<KeptLimit> reached;
  for (const LimitedSignal& signal : limits.signals) {
    const Eigen::RowVectorXd values = samples_of(signal, path, response);
    reached.push_back({signal, {values.minCoeff(), values.maxCoeff()}});
  }
  return reached;
}

const KeptLimit* ComparedTrajectory::broken() const {
  constexpr double kRounded = 1e-6;  // of the range: tables have rounded numbers
  double worst = 1.0 + kRounded;
  const KeptLimit* found = nullptr;
  for (const KeptLimit& limit : limits)
    for (const double value : {limit.reached.lowest, limit.reached.highest})
      if (const double there = std::abs(limit.limits.relative(value)); there > worst) {
        worst = there;
        found = &limit;
      }
  return found;
}

}  // namespace codesign
