// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/filter_doubt.h"

#include <algorithm>

#include "math/dense.h"
#include "recordings/measured_motion.h"

namespace codesign {
namespace {

/// Positions, or velocities where no positions were recorded, at the samples to fit.
Eigen::VectorXd recorded_motion(const MeasuredMotion& motion, const std::string& joint) {
  for (const JointMotion& each : motion.joints)
    if (each.joint == joint) {
      const Eigen::VectorXd& of = each.position_measured ? each.position : each.velocity;
      return of.segment(motion.first, std::max<Eigen::Index>(0, motion.end - motion.first));
    }
  return {};
}

}  // namespace

std::optional<EffortDoubt> doubt_filter(const std::vector<JointRecording>& recordings,
                                        FilterOptions filter, const std::string& joint) {
  constexpr double kLeastLeft = 0.5;
  if (filter.residual_cutoff > 0.0)
    filter.cutoff = filter.cutoff > 0.0 ? std::min(filter.cutoff, filter.residual_cutoff)
                                        : filter.residual_cutoff;
  if (!(filter.cutoff > 0.0)) return std::nullopt;
  filter.residual_cutoff = 0.0;
  double all = 0.0, removed = 0.0;
  for (const JointRecording& recording : recordings) {
    Warnings known_warnings;
    FilterOptions none = filter;
    none.cutoff = 0.0;
    // The same samples of both.
    const Eigen::VectorXd smooth = recorded_motion(
                              measured_motion(recording, filter, &known_warnings), joint),
                          raw = recorded_motion(measured_motion(recording, none, &known_warnings),
                                                joint);
    const Eigen::Index cut = (raw.size() - smooth.size()) / 2;
    const Eigen::VectorXd same = raw.segment(cut, smooth.size());
    all += about_mean_of(same).squaredNorm();
    removed += about_mean_of(same - smooth).squaredNorm();
  }
  if (!(removed > kLeastLeft * all)) return std::nullopt;
  EffortDoubt doubt{joint, 0.0, "", 0.0};
  doubt.cutoff = filter.cutoff;
  doubt.motion_left = std::max(0.0, 1.0 - removed / all);
  return doubt;
}

}  // namespace codesign
