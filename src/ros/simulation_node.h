// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_
#define MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_

#include <ros/node_handle.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "jobs/lock_file.h"
#include "jobs/output_error.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "ros/bag_writer.h"
#include "ros/node_state.h"
#include "ros/pace.h"
#include "ros/run_clock.h"
#include "ros/simulation_options.h"
#include "ros/simulation_scene.h"

namespace codesign {

/// The node `simulation`: runs the loaded study and publishes it. See doc/ros_api.md.
///
/// The computation has its own thread. After bad input or a numerical failure the node stays up and reports it on /diagnostics.
class SimulationNode {
 public:
  SimulationNode();
  ~SimulationNode();

 private:
  void load();
  void advertise();
  void tell_description();
  void set_scene();
  /// @param time of the run.
  MessageContext context(double time) const;
  void run();
  void run_all();
  /// Runs the study once, from 0 to its duration. The status is ok unless the run failed or was stopped.
  Status run_once();
  void place_root();
  void wait_for_subscribers();
  bool is_watched() const;
  void publish(const FrameNames& names, const Frame& frame);
  void publish_clock(double time);
  void open_bag();
  std::optional<LockFile> lock_bag();
  void give_up_bag(const OutputError& error);
  void record(const FrameNames& names, const Frame& frame);
  void close_bag();
  void tell_progress(const Frame& frame, const Statistics& statistics);
  void tell_figures(const Statistics& statistics);
  bool stopping() const { return stopping_ || !ros::ok(); }

  ros::NodeHandle node_, private_node_{"~"};
  NodeState state_;
  SimulationOptions options_;
  std::optional<Problem> problem_;  ///< empty after bad input
  std::string description_;         ///< URDF of the mechanism that runs, with sticks
  std::optional<SimulationScene> scene_;
  RunClock clock_{1.0};
  Pace pace_;
  RealTimeFactor factor_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher clock_publisher_, description_publisher_, caption_publisher_, scene_publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::optional<LockFile> bag_lock_;
  std::unique_ptr<BagWriter> bag_;  ///< while it is being written
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_SIMULATION_NODE_H_
