// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/compared_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "identification/driven_replay.h"
#include "identification/effort_residuals.h"
#include "problem/load_problem.h"
#include "recordings/measured_motion.h"

namespace codesign {
namespace {

/// Limit for the frames of all recordings [bytes].
constexpr double kMostMemory = 256e6;

double bytes_of_both(const FrameNames& names) {
  return 2.0 * static_cast<double>(sizeof(Frame) + names.joints.size() * sizeof(JointSample) + names.links.size() * sizeof(LinkSample) +
                                   names.frictions.size() * sizeof(FrictionSample) + names.loops.size() * sizeof(double));
}

/// A measured joint in one recording.
struct ShownJoint {
  const JointMotion* motion;
  std::size_t place;                     ///< index in FrameNames::joints
  std::optional<RecordedEffort> effort;  ///< empty: not recorded
  EffortSensor sensor;                   ///< the identified one

  /// What the sensor says of the effort on the child, theory (28c) solved for tau.
  double recorded(double time) const {
    if (!effort) return std::numeric_limits<double>::quiet_NaN();
    return sensor.scale * effort->at(time + sensor.delay).value - sensor.offset;
  }
};

std::vector<ShownJoint> shown_joints(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints, const FitVariables& variables,
                                     const IdentificationResult& result, const FrameNames& names) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(motion.times.count));
  for (Eigen::Index k = 0; k < motion.times.count; ++k) times.push_back(motion.times.at(k));
  std::vector<ShownJoint> shown;
  for (const MeasuredJoint& joint : joints) {
    const auto of =
        std::find_if(motion.joints.begin(), motion.joints.end(), [&](const JointMotion& each) { return each.joint == joint.name; });
    const auto place = std::find(names.joints.begin(), names.joints.end(), joint.name) - names.joints.begin();
    shown.push_back({&*of, static_cast<std::size_t>(place), std::nullopt, variables.sensor(joint.name, result.x)});
    if (joint.with_effort) shown.back().effort.emplace(times, std::vector<double>(of->effort.begin(), of->effort.end()));
  }
  return shown;
}

Eigen::VectorXd positions_at(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints, Eigen::Index sample) {
  Eigen::VectorXd positions(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t k = 0; k < joints.size(); ++k)
    for (const JointMotion& each : motion.joints)
      if (each.joint == joints[k].name) positions[static_cast<Eigen::Index>(k)] = each.position[sample];
  return positions;
}

/// Positions at a few instants, from which the drives are chosen.
Eigen::MatrixXd some_positions(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints) {
  constexpr int kInstants = 4;
  Eigen::MatrixXd some(static_cast<Eigen::Index>(joints.size()), kInstants);
  for (int k = 0; k < kInstants; ++k)
    some.col(k) = positions_at(motion, joints, motion.first + k * (motion.end - motion.first - 1) / kInstants);
  return some;
}

/// The measured side of a frame: as `model`, but with what was measured, and without efforts and frictions that nobody measured.
Frame measured_frame(const Frame& model, const std::vector<ShownJoint>& joints, Eigen::Index sample, double time) {
  Frame frame = model;
  frame.frictions.clear();
  for (JointSample& joint : frame.joints) joint.effort = std::numeric_limits<double>::quiet_NaN();
  for (const ShownJoint& joint : joints)
    frame.joints[joint.place] = {joint.motion->position[sample], joint.motion->velocity[sample], joint.motion->acceleration[sample],
                                 joint.recorded(time)};
  return frame;
}

std::vector<ComparedJoint> compared_joints(const RobotDescription& robot, const std::vector<MeasuredJoint>& measured,
                                           const std::vector<double>& parameters, const FrameNames& names) {
  std::vector<ComparedJoint> joints;
  for (const JointDescription& joint : robot.joints) {
    const auto is_compared = [&](const MeasuredJoint& each) { return each.name == joint.name && each.with_effort; };
    if (joint.is_loop || std::none_of(measured.begin(), measured.end(), is_compared)) continue;
    const auto place = std::find(names.joints.begin(), names.joints.end(), joint.name) - names.joints.begin();
    const Eigen::Vector3d axis(joint.axis[0].at(parameters), joint.axis[1].at(parameters), joint.axis[2].at(parameters));
    joints.push_back({static_cast<std::size_t>(place), static_cast<std::size_t>(joint.child), axis.normalized(),
                      joint.type != JointType::kPrismatic});
  }
  return joints;
}

/// What the instants of all recordings have in common.
struct Comparison {
  double rate;
  const std::function<bool()>& stop;
  DrivenReplay* replay;
};

void compare(const MeasuredMotion& motion, const std::vector<ShownJoint>& joints, const Comparison& with, ComparedRecording* compared) {
  const auto every = std::max<Eigen::Index>(1, std::llround(motion.times.rate() / with.rate));
  Eigen::VectorXd measured[3];
  for (Eigen::VectorXd& column : measured) column.resize(static_cast<Eigen::Index>(joints.size()));
  for (Eigen::Index k = motion.first; k < motion.end; k += every) {
    if (with.stop && with.stop()) {
      compared->status = {StatusCode::kCancelled, motion.times.at(k), "cancelled"};
      return;
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      measured[0][row] = joints[j].motion->position[k];
      measured[1][row] = joints[j].motion->velocity[k];
      measured[2][row] = joints[j].motion->acceleration[k];
    }
    Frame model;
    if (k == motion.first) compared->status = with.replay->begin(measured[0]);
    if (compared->status.ok()) compared->status = with.replay->show(measured, &model);
    if (!compared->status.ok()) {
      compared->status.time = motion.times.at(k);
      return;
    }
    model.time = motion.times.at(k);
    compared->measured.push_back(measured_frame(model, joints, k, model.time));
    compared->model.push_back(std::move(model));
  }
}

}  // namespace

ComparedMotion compare_motion(const Problem& problem, const StudyRecordings& recordings, const IdentificationResult& result, double rate,
                              const std::function<bool()>& stop) {
  std::vector<JointRecording> all = recordings.data;
  all.insert(all.end(), recordings.holdout.begin(), recordings.holdout.end());
  const std::vector<MeasuredJoint> joints = require_same_joints(all);
  std::vector<MeasuredMotion> motions;
  Warnings told_before;
  double seconds = 0.0;
  for (const JointRecording& recording : all) {
    motions.push_back(measured_motion(recording, problem.study().identification->filter, &told_before));
    seconds += static_cast<double>(motions.back().end - motions.back().first) * motions.back().times.step;
  }
  const FitVariables variables(problem.study());
  DrivenReplay replay(*problem.system(), joints, some_positions(motions.front(), joints), result.parameters);
  ComparedMotion compared;
  compared.names = replay.names();
  compared.joints = compared_joints(problem.robot(), joints, result.parameters, compared.names);
  const double most = kMostMemory / (bytes_of_both(compared.names) * std::max(seconds, 1e-3));
  for (std::size_t k = 0; k < all.size(); ++k) {
    compared.recordings.push_back({all[k].element, {}, {}, {}});
    compare(motions[k], shown_joints(motions[k], joints, variables, result, compared.names), {std::min(rate, most), stop, &replay},
            &compared.recordings.back());
  }
  return compared;
}

}  // namespace codesign
