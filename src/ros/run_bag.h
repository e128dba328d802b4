// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Commands.h>

#include <memory>
#include <optional>
#include <string>

#include "jobs/files.h"
#include "ros/bag_writer.h"
#include "ros/node_state.h"
#include "ros/simulation_options.h"
#include "ros/simulation_scene.h"

namespace codesign {

/// The bag of the first run of the simulation, if `~bag` requests one: every frame, tf of all links, commands, caption, description, scene
/// and version. A failure to write gives the warning `output_failed` and ends the bag, not the run.
class RunBag {
 public:
  /// @param options, state must outlive this.
  RunBag(const SimulationOptions& options, NodeState* state) : options_(options), state_(state) {}

  /// Begins the bag; the unfinished bag of a killed node is removed. @param description URDF of the mechanism. @param root_frame TF frame
  /// of the root link
  /// @param link_parents as link_parents() finds them.
  void open(const std::string& description, const std::string& root_frame, const std::vector<std::size_t>& link_parents,
            const SimulationScene& scene);
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
