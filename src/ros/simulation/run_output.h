// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Commands.h>
#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/files.h"
#include "mechanism_codesign/frame.h"
#include "problem/load_problem.h"
#include "ros/bags/bag_writer.h"
#include "ros/common/node_state.h"
#include "ros/scene/scene_layout.h"
#include "ros/simulation/simulation_options.h"

namespace codesign {

/// The numbers of a frame that have topics of their own.
struct FrameNumbers {
  std::vector<std::string> topics;  ///< without `signals/`, legal and all different
  std::vector<std::function<double(const Frame&)>> read;  ///< per topic

  explicit FrameNumbers(const FrameNames& names);
};

/// Publishes each number of a frame on a topic of its own: `signals/hinge/position`,
/// std_msgs/Float64; doc/ros_api.md.
class FloatTopics {
 public:
  /// @param queue messages kept for each slow subscriber.
  FloatTopics(ros::NodeHandle node, const FrameNames& names, std::uint32_t queue);
  void publish(const Frame& frame) const;

 private:
  FrameNumbers numbers_;
  std::vector<ros::Publisher> publishers_;
};

/// The picture of the mechanism of the node `simulation`. Runs the study once and samples it at 100
/// instants to determine the range of the motion and the magnitude of the friction. If the run
/// takes longer than 2 s, is stopped or fails, the part until then counts.
class SimulationScene {
 public:
  /// @param urdf with sticks, as viewers get it. @param given scales that the user has set; zero:
  /// the scale follows from the run.
  /// @param stop called repeatedly; true ends the run.
  SimulationScene(const Problem& problem, const std::string& urdf, const MarkerStyle& given,
                  const std::function<bool()>& stop);

  /// Scales and solids for friction_markers().
  const MarkerStyle& style() const { return layout_.style; }
  mechanism_codesign::Scene message(const MessageContext& context) const;
  /// Time, objective so far if the study has integral terms, and the legend of the arrows.
  visualization_msgs::MarkerArray text(const Frame& frame, const MessageContext& context) const;

 private:
  SceneLayout layout_;
  Stage stage_;
  std::vector<CaptionLine> legend_;
  bool has_objective_;
};

/// The bag of the first run of the simulation, if `~bag` requests one: every frame, tf of all
/// links, commands, caption, description, scene and version. A failure to write gives the warning
/// `output_failed` and ends the bag, not the run.
class RunBag {
 public:
  /// @param options, state must outlive this.
  RunBag(const SimulationOptions& options, NodeState* state) : options_(options), state_(state) {}

  /// Begins the bag; the unfinished bag of a killed node is removed. @param description URDF of the
  /// mechanism. @param root_frame TF frame of the root link
  /// @param link_parents as link_parents() finds them.
  void open(const std::string& description, const std::string& root_frame,
            const std::vector<std::size_t>& link_parents, const SimulationScene& scene);
  void record(const FrameNames& names, const Frame& frame, const SimulationScene& scene);
  /// @param time [s] of the run from which the commands are in effect
  void record(const mechanism_codesign::Commands& commands, double time);
  /// Completes the bag.
  void close();

 private:
  std::optional<LockFile> lock() const;
  template <class Write>
  void guard(const Write& write);

  const SimulationOptions& options_;
  NodeState* state_;
  std::optional<LockFile> lock_;
  std::vector<std::size_t> link_parents_;
  std::unique_ptr<BagWriter> bag_;  ///< null unless the bag is being written
};

}  // namespace codesign
