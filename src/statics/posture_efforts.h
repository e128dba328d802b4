// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "description/posture_grid.h"
#include "identification/effort/motion_projection.h"

namespace codesign {

/// The efforts of one drive at rest [N m or N], along its coordinate; doc/theory.md (65).
struct PostureEffort {
  double rest = 0.0;  ///< without friction
  /// Beyond `upper` the joint begins to move along its coordinate, below `lower` against it, while
  /// all other drives rest. Infinite where no effort moves it: the mechanism locks.
  double lower = 0.0, upper = 0.0;

  /// The least magnitude that holds the joint: zero if friction alone does.
  double holding() const { return lower > 0.0 ? lower : upper < 0.0 ? upper : 0.0; }
};

/// The joints of a grid, all with an effort.
std::vector<MeasuredJoint> driven_joints(const PostureGrid& grid);
/// The positions of posture `index`, one per joint of the grid.
Eigen::VectorXd posture(const PostureGrid& grid, std::size_t index);

/// Statics of a mechanism whose grid joints are held: efforts at rest, and those at which friction
/// begins to slip, with its static coefficient everywhere; doc/theory.md (65). Not thread-safe.
class PostureStatics {
 public:
  /// @param system as make_system() compiled it. @param parameters all named parameters. @param
  /// signals of the frames.
  /// @throws InputError if the grid's joints do not determine the posture, or are more than the
  /// degrees of freedom, and for a signal that does not exist.
  PostureStatics(const CompiledSystem& system, const PostureGrid& grid,
                 const std::vector<double>& parameters,
                 const std::vector<SignalDescription>& signals);

  const FrameNames& names() const { return replay_.names(); }
  /// The index in FrameNames::joints of each drive.
  const std::vector<std::size_t>& drives() const { return replay_.drives(); }

  /// Assembles the mechanism near a posture. Call it before the first posture.
  Status begin(const Eigen::VectorXd& positions) { return replay_.begin(positions); }
  /// Whether the grid's joints do not determine how the mechanism moves on from the posture that
  /// show() has shown last: a dead centre, or a posture where several motions meet. No effort moves
  /// it from there.
  bool is_singular() const { return is_singular_; }
  /// @param frame at rest, without friction. @param efforts one per drive.
  Status show(const Eigen::VectorXd& positions, Frame* frame, std::vector<PostureEffort>* efforts);

 private:
  double slipping(const Eigen::VectorXd& positions, std::size_t drive, double direction);

  const CompiledSystem sliding_;  ///< the mechanism with static friction at any speed
  DrivenReplay replay_;
  Frame frame_;
  bool is_singular_ = false;
};

}  // namespace codesign
