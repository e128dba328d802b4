// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "ros/simulation/run_clock.h"

namespace codesign {

/// The services ~pause, ~resume, ~step and ~restart of the simulation, doc/ros_api.md. They wait
/// for the run, so that their callbacks need another thread than the callbacks of topics.
/// Thread-safe.
class RunControl {
 public:
  /// @param bell rung for each request
  explicit RunControl(Bell* bell) : bell_(bell) {}

  /// Offers the services below `node`, whose callback queue serves them.
  void advertise(ros::NodeHandle node);

  /// @param paused whether runs pause after their first frame. @param step_frames number of frames
  /// of a ~step
  void configure(bool paused, std::int64_t step_frames);

  // The thread of the run calls these.

  /// To be called when a run begins; answers a waiting ~restart.
  void begin_run();
  /// To be called when a frame was published, at `time` [s] of the run.
  void note_frame(double time);
  /// To be called when the run has ended, or waits for something before it begins; requests other
  /// than ~restart are then refused with this sentence.
  void end_run(const std::string& why);
  /// To be called when no run will follow: ends all waits, and refuses each request with this
  /// sentence.
  void stop(const std::string& why = "the node ends");

  /// Whether the run is paused after the last frame.
  bool is_paused() const;
  /// As is_paused(), to be called by the thread of the run, which then does not go on: answers a
  /// waiting ~pause.
  bool stand_if_paused();
  /// Whether ~restart waits for a new run.
  bool wants_restart() const;
  /// Set while the run is to end early, for Simulation::obey().
  const std::atomic<bool>* leaving() const { return &leaving_; }

  // The services. A request that comes while the node starts waits for the first run, or for the
  // reason why there is none.
  std_srvs::TriggerResponse pause();
  std_srvs::TriggerResponse resume();
  std_srvs::TriggerResponse step();
  std_srvs::TriggerResponse restart();

 private:
  using Service = std_srvs::TriggerResponse (RunControl::*)();
  void serve(ros::NodeHandle* node, const std::string& name, Service service);
  std_srvs::TriggerResponse refusal() const;
  std::unique_lock<std::mutex> lock_when_known();

  Bell* bell_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> leaving_{false};
  bool begun_ = false, running_ = false, paused_ = false, stopped_ = false, restart_ = false;
  bool stands_ = false;  ///< whether the thread of the run has seen that it is paused
  std::int64_t step_frames_ = 1, steps_left_ = 0;
  std::uint64_t runs_ = 0;
  double time_ = 0.0;  ///< [s] of the last frame
  std::string why_;    ///< why no run is there; empty while the node starts
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace codesign
