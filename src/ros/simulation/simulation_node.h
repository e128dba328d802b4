// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "integration/interactive_simulation.h"
#include "jobs/run_recorder.h"
#include "problem/load_problem.h"
#include "ros/common/node_state.h"
#include "ros/simulation/command_inbox.h"
#include "ros/simulation/commands.h"
#include "ros/simulation/live_parameters.h"
#include "ros/simulation/run_clock.h"
#include "ros/simulation/run_control.h"
#include "ros/simulation/run_output.h"
#include "ros/simulation/simulation_options.h"

namespace codesign {

/// The node `simulation`: runs the loaded study, publishes it, and takes commands as a robot does.
/// See doc/ros_api.md.
///
/// The computation has its own thread. Services that wait for it are served by threads of their
/// own, so that commands arrive meanwhile. After bad input or a numerical failure the node stays up
/// and reports it on /diagnostics.
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
  void place_root();
  void wait_for_subscribers();
  bool is_watched() const;
  /// The number of subscribers of all topics.
  std::uint32_t subscriptions() const;

  // The thread of the run, simulation_run.cc.
  void run();
  void run_all();
  /// Runs the study once, from 0 to its duration. The status is ok unless the run failed or was
  /// stopped.
  Status run_once();
  Status run_frames();
  /// Applies commands and parameters at the instant of the last frame, and waits there while the
  /// run is paused or a command is awaited.
  Status serve();
  /// Between runs: tries parameters for the next run.
  void serve_idle();
  void wait_for_restart(const std::string& why);
  /// No further run is possible.
  void end_for_good(const std::string& why);
  void show_frame(bool record);
  /// Looks for joints beyond their limits at the present parameters; forgets those found before.
  void watch_limits();
  void note_limits();
  void tell_commands();
  void publish(const FrameNames& names, const Frame& frame);
  void publish_clock(double time);
  void tell_progress(const Statistics& statistics);
  void tell_figures(const Statistics& statistics);
  bool stopping() const { return stopping_ || !ros::ok(); }
  bool leaving_run() const { return stopping() || control_.wants_restart(); }

  ros::CallbackQueue waiting_services_;
  ros::NodeHandle node_, private_node_{"~"}, service_node_{"~"};
  NodeState state_;
  Bell bell_;
  RunControl control_;
  SimulationOptions options_;
  std::optional<Problem> problem_;  ///< empty after bad input
  std::unique_ptr<InteractiveSimulation> simulation_;
  std::optional<CommandedRun> commanded_;
  std::unique_ptr<CommandInbox> inbox_;
  std::unique_ptr<LiveParameters> live_;
  std::unique_ptr<FloatTopics> floats_;
  std::string description_;  ///< URDF of the simulated mechanism, with sticks
  std::optional<SimulationScene> scene_;
  RunClock clock_{1.0};
  Pace pace_;
  RealTimeFactor factor_;
  Frame frame_;  ///< the last frame
  std::optional<LimitWatch> limits_;
  std::size_t limits_told_ = 0;            ///< number of its crossings that are warned of
  std::vector<std::size_t> link_parents_;  ///< as link_parents() finds them
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher clock_publisher_, description_publisher_, commands_publisher_, factor_publisher_,
      caption_publisher_, scene_publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  RunBag bag_{options_, &state_};
  std::atomic<bool> stopping_{false};
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace codesign
