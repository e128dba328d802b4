// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/scene/markers.h"

namespace codesign {

/// The private parameters of the simulation node; doc/ros_api.md.
struct SimulationOptions {
  double rate = 50.0;  ///< frames per second of the run
  /// seconds of the run per second; 0: mode as_fast_as_possible, with /clock
  double time_scale = 1.0;
  /// frames per second of wall time, in that mode and while there are subscribers
  double publish_limit = 500.0;
  bool loop = false;        ///< start again at the end of the study
  std::string world_frame;  ///< TF frame to publish as the parent of the root link; empty: none
  /// before the name of each link's TF frame; if not empty, the node publishes all frames
  std::string frame_prefix;
  /// topics that must have a subscriber before the run begins
  std::vector<std::string> wait_for_subscribers;
  std::string bag;  ///< path of a bag of the first run; empty: none
  /// joints that take efforts, in order; empty: all that can be driven
  std::vector<std::string> command_joints;
  std::vector<std::string> disconnect;  ///< controllers whose output is not applied
  double command_timeout = 0.0;  ///< [s] of the run after which commanded efforts end; 0: never
  double duration = 0.0;         ///< [s] of a run; 0: the study's
  bool lock_step = false;        ///< wait for a command after each frame
  bool start_paused = false;     ///< pause after the first frame
  double step_frames = 1.0;      ///< frames of a ~step, a whole number
  bool float_topics = false;     ///< publish each number on a topic of its own, too
  /// scales that the user has set; 0: the scale follows from the run
  MarkerStyle style{0.0, 0.0, 0.0};
};

/// The names of the parameters that read_simulation_options() knows.
std::vector<std::string> simulation_parameters();

/// Reads these private parameters. @throws InputError for a value of the wrong type or out of
/// range.
SimulationOptions read_simulation_options(const ros::NodeHandle& private_node);

/// Checks that ROS time can represent the duration of a run. @param duration of the study [s].
/// @throws InputError if it cannot.
void check_duration(const ros::NodeHandle& private_node, const SimulationOptions& options,
                    double duration);

}  // namespace codesign
