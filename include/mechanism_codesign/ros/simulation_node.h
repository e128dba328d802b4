// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_
#define MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_

#include <ros/node_handle.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <map>
#include <string>
#include <thread>

#include "mechanism_codesign/optimization/problem.h"
#include "mechanism_codesign/ros/friction_markers.h"
#include "mechanism_codesign/ros/node_state.h"
#include "mechanism_codesign/ros/run_clock.h"

namespace codesign {

struct SimulationOptions {
  double rate = 50.0;       ///< frames per second of the run
  double time_scale = 1.0;  ///< seconds of the run per second; 0: as fast as possible, with /clock
  std::string world_frame;  ///< a TF frame at the root link, for viewers that do not know its name; empty: none
  bool loop = false;        ///< start again when the study's duration is over
  MarkerStyle style;
};

/// Reads `~rate`, `~mode`, `~time_scale`, `~loop`, `~world_frame`, `~force_scale`, `~torque_scale` and `~arrow_width`. @throws InputError
SimulationOptions read_simulation_options(const ros::NodeHandle& private_node);

/// The node `simulation`: runs the loaded study and publishes it. See doc/ros_api.md.
///
/// It computes in a thread of its own. With bad input, or after a numerical failure, the node stays up and says so on /diagnostics.
class SimulationNode {
 public:
  SimulationNode();
  ~SimulationNode();

 private:
  void load();
  void run();
  /// One run from 0 to the study's duration; the status tells why it ended before.
  Status run_once();
  void place_root();
  void publish(const FrameNames& names, const Frame& frame);
  bool stopping() const { return stopping_ || !ros::ok(); }

  ros::NodeHandle node_, private_node_{"~"};
  NodeState state_;
  SimulationOptions options_;
  Problem problem_;
  RunClock clock_{1.0};
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher clock_publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_
