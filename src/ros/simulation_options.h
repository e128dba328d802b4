// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_SIMULATION_OPTIONS_H_
#define MECHANISM_CODESIGN_ROS_SIMULATION_OPTIONS_H_

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/friction_markers.h"

namespace codesign {

struct SimulationOptions {
  double rate = 50.0;                             ///< frames per second of the run
  double time_scale = 1.0;                        ///< seconds of the run per second; 0: as fast as possible, with /clock
  double publish_limit = 500.0;                   ///< frames per second, as fast as possible and while somebody listens
  bool loop = false;                              ///< start again when the study's duration is over
  std::string world_frame;                        ///< a TF frame at the root link, for viewers that do not know its name; empty: none
  std::string frame_prefix;                       ///< before the name of each link's TF frame; not empty: the node publishes all of them
  std::vector<std::string> wait_for_subscribers;  ///< topics that must have one before the run begins
  std::string bag;                                ///< path of a bag of the first run; empty: none
  MarkerStyle style;
};

/// Topics of a frame, which may have to wait for subscribers.
const std::vector<std::string>& frame_topics();

/// The names of the parameters that read_simulation_options() knows.
std::vector<std::string> simulation_parameters();

/// Reads the private parameters of those names. @throws InputError
SimulationOptions read_simulation_options(const ros::NodeHandle& private_node);

/// Makes sure that ROS can count the time of a run. @param duration of the study [s]. @throws InputError
void check_duration(const ros::NodeHandle& private_node, const SimulationOptions& options, double duration);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_SIMULATION_OPTIONS_H_
