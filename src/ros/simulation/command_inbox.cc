// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/command_inbox.h"

#include <cctype>

namespace codesign {
namespace {

/// Queue size: one second of messages from a controller that runs at 1 kHz.
constexpr std::uint32_t kWaitingCommands = 1000;
/// Largest number of commands that wait for the run, so that a controller that sends to a run that has ended does not fill the memory.
constexpr std::size_t kMostCommands = 10 * kWaitingCommands;

}  // namespace

std::string legal_name(const std::string& text) {
  std::string name = text;
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '/') letter = '_';
  return name;
}

CommandInbox::CommandInbox(ros::NodeHandle node, ros::NodeHandle private_node, const CommandInputs& inputs, NodeState* state, Bell* bell)
    : inputs_(inputs), state_(state), bell_(bell) {
  const auto listen = [&](ros::NodeHandle& of, const std::string& name, auto read) {
    using Message = std::decay_t<typename decltype(read)::Message>;
    const std::string topic = of.resolveName(name);
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, topic, read](const boost::shared_ptr<const Message>& message) {
          receive(topic, read.stamp(*message), [&] { return read(topic, *message); });
        };
    subscribers_.push_back(of.subscribe<Message>(name, kWaitingCommands, callback, {}, ros::TransportHints().tcpNoDelay()));
  };
  struct Efforts {
    using Message = sensor_msgs::JointState;
    const CommandInputs& inputs;
    ros::Time stamp(const Message& message) const { return message.header.stamp; }
    Command operator()(const std::string& topic, const Message& message) const { return read_efforts(inputs, topic, message); }
  };
  struct EffortArray {
    using Message = std_msgs::Float64MultiArray;
    const CommandInputs& inputs;
    ros::Time stamp(const Message&) const { return {}; }
    Command operator()(const std::string& topic, const Message& message) const { return read_efforts(inputs, topic, message); }
  };
  struct Setpoint {
    using Message = std_msgs::Float64;
    const CommandInputs& inputs;
    std::size_t controller;
    ros::Time stamp(const Message&) const { return {}; }
    Command operator()(const std::string& topic, const Message& message) const { return read_setpoint(inputs, topic, controller, message); }
  };
  struct Trajectory {
    using Message = trajectory_msgs::JointTrajectory;
    const CommandInputs& inputs;
    ros::Time stamp(const Message&) const { return {}; }  // the stamp in the header is the time at which the trajectory begins
    Command operator()(const std::string& topic, const Message& message) const { return read_trajectory(inputs, topic, message); }
  };
  listen(private_node, "command/effort", Efforts{inputs});
  listen(private_node, "command/efforts", EffortArray{inputs});
  listen(private_node, "command/trajectory", Trajectory{inputs});
  for (std::size_t k = 0; k < inputs.controllers.size(); ++k)
    listen(node, legal_name(inputs.controllers[k]) + "/command", Setpoint{inputs, k});
}

void CommandInbox::note_answer(const ros::Time& stamp) { answered_ = answered_ || stamp.isZero() || stamp >= awaited_; }

void CommandInbox::add(Command command, const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (commands_.size() == kMostCommands) commands_.erase(commands_.begin(), commands_.begin() + kMostCommands / 2);
  commands_.push_back(std::move(command));
  note_answer(stamp);
}

void CommandInbox::refuse(const std::string& topic, const ros::Time& stamp, const std::string& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  note_answer(stamp);
  state_->show("refused commands", std::to_string(++refused_));
  const ros::WallTime now = ros::WallTime::now();
  if (const auto told = told_.find(topic); told != told_.end() && now - told->second < ros::WallDuration(1.0)) return;
  told_[topic] = now;
  state_->warn("command " + topic, {{"command_refused", sentence, {}}});
}

std::vector<Command> CommandInbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Command> taken;
  taken.swap(commands_);
  return taken;
}

void CommandInbox::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  commands_.clear();
  for (const auto& [topic, time] : told_) state_->warn("command " + topic, {});
  told_.clear();
}

void CommandInbox::await_answer(const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  awaited_ = stamp;
  answered_ = false;
}

bool CommandInbox::is_answered() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return answered_;
}

}  // namespace codesign
