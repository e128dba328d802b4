// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/reference.h"
#include "description/study.h"
#include "equations/compiled_system.h"

namespace codesign {

/// The commanded joints and controllers of a mechanism.
struct CommandOptions {
  /// joints that take efforts; nullopt: drivable_joints()
  std::optional<std::vector<std::string>> joints;
  /// controllers whose output is not applied; inverse dynamics then give only the feedback part
  std::vector<std::string> disconnected;
  std::optional<double> duration;  ///< duration of the run [s] in place of the study's
  /// instants at which commands may take effect, per second: each one ends a step
  double rate = 0.0;
};

/// Every joint of the tree that moves mass, has a coordinate of its own and follows neither another
/// joint nor a given motion, in the order of the description.
std::vector<std::string> drivable_joints(const CompiledSystem& system);

/// @param from topic or option that names the joint. @param known joints that take efforts
/// @throws InputError if the study gives the motion of the joint.
void refuse_given_motion(const MotionStudy& study, const std::string& joint,
                         const std::string& from, const std::vector<std::string>& known);

/// Makes `reference` a function that commands set during a run, in place of what it was, which
/// holds until the first command.
/// @returns the function, empty until it is commanded.
std::shared_ptr<LiveFunction> make_live(ReferenceDescription* reference);

/// A study extended by inputs for commands during a run, doc/theory.md (55). Before the study's
/// controllers it has a controller u = f(t) for each joint that takes efforts, and each set-point
/// is a function that a command can replace.
struct CommandInputs {
  Study study;
  std::vector<std::string> joints;       ///< joints that take efforts
  std::vector<std::string> controllers;  ///< controllers that have a set-point and are connected
  std::vector<std::size_t> indices;      ///< indices of these controllers in the original study
  std::vector<std::shared_ptr<LiveFunction>> efforts;  ///< one per entry of `joints` [N m or N]
  std::vector<std::shared_ptr<LiveFunction>> setpoints;

  /// @throws InputError for an unknown joint or controller, and for a joint named twice, without a
  /// coordinate of its own or with a given motion.
  CommandInputs(const CompiledSystem& of, const CommandOptions& options);
};

/// A controller that a trajectory of a joint commands.
struct TrajectoryFollower {
  std::size_t controller = 0;  ///< index in CommandInputs::controllers
  /// true: the input is the velocity of the joint, and the set-point is the rate of the trajectory
  bool by_rate = false;
};

/// The controller that a trajectory of a joint commands: the first whose input is the position of
/// the joint, else the first whose input is its velocity. A controller that drives another joint
/// does not count. None if there is no such controller.
std::optional<TrajectoryFollower> follower_of(const CommandInputs& inputs,
                                              const std::string& joint);

}  // namespace codesign
