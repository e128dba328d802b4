// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "ros/common/node_state.h"
#include "ros/simulation/commands.h"
#include "ros/simulation/run_clock.h"

namespace codesign {

/// Subscribes to the command topics of the simulation, doc/ros_api.md, and keeps the commands until
/// the run takes them. Thread-safe.
class CommandInbox {
 public:
  /// @param inputs, state, bell must outlive this. @param bell rung for each message
  CommandInbox(ros::NodeHandle node, ros::NodeHandle private_node, const CommandInputs& inputs,
               NodeState* state, Bell* bell);

  /// The commands since the last call, in the order of their arrival.
  std::vector<Command> take();
  /// Discards commands and refusals, for a new run.
  void clear();

  /// To be called before a frame with this stamp is published: commands that answer earlier frames
  /// no longer count as an answer.
  void await_answer(const ros::Time& stamp);
  /// Whether a message has arrived since that answers the frame. A message with a header answers it
  /// if its stamp is zero or not before the stamp of the frame.
  bool is_answered() const;

  /// Handles a message as if it had arrived: `read` returns the command or throws InputError.
  /// @param stamp of its header, or zero
  template <class Read>
  void receive(const std::string& topic, const ros::Time& stamp, const Read& read);

 private:
  template <class Message, class Read>
  void listen(ros::NodeHandle& node, const std::string& name, const Read& read);
  void add(Command command, const ros::Time& stamp);
  void refuse(const std::string& topic, const ros::Time& stamp, const std::string& sentence);
  void note_answer(const ros::Time& stamp);

  const CommandInputs& inputs_;
  NodeState* state_;
  Bell* bell_;
  mutable std::mutex mutex_;
  std::vector<Command> commands_;
  ros::Time awaited_;
  bool answered_ = false;
  /// per topic: time of the last warning of a refused message, at most one per second
  std::map<std::string, ros::WallTime> warned_;
  std::size_t refused_ = 0;
  std::vector<ros::Subscriber> subscribers_;
};

template <class Read>
void CommandInbox::receive(const std::string& topic, const ros::Time& stamp, const Read& read) {
  try {
    add(read(), stamp);
  } catch (const InputError& error) {
    refuse(topic, stamp, error.what());
  }
  bell_->ring();
}

/// `text` with an underscore for each letter that a name of ROS must not have; slashes stay. A name
/// that is in `taken` gets a number behind it: `a_b_2`. The result is added to `taken`.
std::string legal_name(const std::string& text, std::set<std::string>* taken);

/// The topic of each controller's set-point, `CONTROLLER/command`, legal and all different:
/// `controller_1c/command` for a name that does not begin with a letter, as names of ROS must. The
/// panel has the same rule.
/// @param controllers all of a study, in its order
std::vector<std::string> setpoint_topics(const std::vector<std::string>& controllers);

}  // namespace codesign
