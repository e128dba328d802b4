// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/command_inbox.h"

#include <cctype>

namespace codesign {
namespace {

/// Queue size: one second of messages from a controller that runs at 1 kHz.
constexpr std::uint32_t kWaitingCommands = 1000;
/// Largest number of commands that wait for the run, so that a controller that sends to a run that
/// has ended does not fill the memory.
constexpr std::size_t kMostCommands = 10 * kWaitingCommands;

/// The stamp of the frame that a message answers; zero: any. The stamp of a trajectory is the time
/// at which it begins.
ros::Time answered_stamp(const sensor_msgs::JointState& message) { return message.header.stamp; }
template <class Message>
ros::Time answered_stamp(const Message&) {
  return {};
}

}  // namespace

std::string legal_name(const std::string& text, std::set<std::string>* taken) {
  std::string legal = text;
  for (char& letter : legal)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '/') letter = '_';
  std::string name = legal;
  for (int suffix = 2; !taken->insert(name).second; ++suffix)
    name = legal + "_" + std::to_string(suffix);
  return name;
}

std::vector<std::string> setpoint_topics(const std::vector<std::string>& controllers) {
  std::set<std::string> taken;
  std::vector<std::string> topics;
  for (const std::string& controller : controllers) {
    const unsigned char first =
        controller.empty() ? '_' : static_cast<unsigned char>(controller[0]);
    const char* const before = std::isalpha(first) != 0 || first == '/' ? "" : "controller_";
    topics.push_back(legal_name(before + controller, &taken) + "/command");
  }
  return topics;
}

CommandInbox::CommandInbox(ros::NodeHandle node, ros::NodeHandle private_node,
                           const CommandInputs& inputs, NodeState* state, Bell* bell)
    : inputs_(inputs), state_(state), bell_(bell) {
  listen<sensor_msgs::JointState>(private_node, "command/effort",
                                  [this](const auto& topic, const auto& message) {
                                    return read_efforts(inputs_, topic, message);
                                  });
  listen<std_msgs::Float64MultiArray>(private_node, "command/efforts",
                                      [this](const auto& topic, const auto& message) {
                                        return read_efforts(inputs_, topic, message);
                                      });
  listen<trajectory_msgs::JointTrajectory>(private_node, "command/trajectory",
                                           [this](const auto& topic, const auto& message) {
                                             return read_trajectory(inputs_, topic, message);
                                           });
  // Counted among all controllers of the study, which are those of controller_states: the topic of
  // one does not depend on whether others are connected.
  std::vector<std::string> names;
  for (std::size_t c = inputs.joints.size(); c < inputs.study.controllers.size(); ++c)
    names.push_back(inputs.study.controllers[c].name);
  const std::vector<std::string> topics = setpoint_topics(names);
  for (std::size_t k = 0; k < inputs.controllers.size(); ++k)
    listen<std_msgs::Float64>(node, topics[inputs.indices[k]],
                              [this, k](const auto& topic, const auto& message) {
                                return read_setpoint(inputs_, topic, k, message);
                              });
}

template <class Message, class Read>
void CommandInbox::listen(ros::NodeHandle& node, const std::string& name, const Read& read) {
  const std::string topic = node.resolveName(name);
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [this, topic, read](const boost::shared_ptr<const Message>& message) {
        receive(topic, answered_stamp(*message), [&] { return read(topic, *message); });
      };
  subscribers_.push_back(node.subscribe<Message>(name, kWaitingCommands, callback, {},
                                                 ros::TransportHints().tcpNoDelay()));
}

void CommandInbox::note_answer(const ros::Time& stamp) {
  answered_ = answered_ || stamp.isZero() || stamp >= awaited_;
}

void CommandInbox::add(Command command, const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (commands_.size() == kMostCommands)
    commands_.erase(commands_.begin(), commands_.begin() + kMostCommands / 2);
  commands_.push_back(std::move(command));
  note_answer(stamp);
}

void CommandInbox::refuse(const std::string& topic, const ros::Time& stamp,
                          const std::string& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  note_answer(stamp);
  state_->show("refused commands", std::to_string(++refused_));
  const ros::WallTime now = ros::WallTime::now();
  if (const auto warned = warned_.find(topic);
      warned != warned_.end() && now - warned->second < ros::WallDuration(1.0))
    return;
  warned_[topic] = now;
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
  for (const auto& [topic, time] : warned_) state_->warn("command " + topic, {});
  warned_.clear();
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
