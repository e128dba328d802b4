// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/float_topics.h"

#include <std_msgs/Float64.h>

#include <algorithm>
#include <set>

#include "ros/command_inbox.h"

namespace codesign {
namespace {

using ReadNumber = double (*)(const Frame&, std::size_t);

struct NamedNumber {
  const char* quantity;
  ReadNumber read;
};

constexpr NamedNumber kOfJoints[] = {{"position", [](const Frame& frame, std::size_t k) { return frame.joints[k].position; }},
                                     {"velocity", [](const Frame& frame, std::size_t k) { return frame.joints[k].velocity; }},
                                     {"effort", [](const Frame& frame, std::size_t k) { return frame.joints[k].effort; }}};
constexpr NamedNumber kOfFrictions[] = {
    {"friction", [](const Frame& frame, std::size_t k) { return frame.frictions[k].friction; }},
    {"normal_force", [](const Frame& frame, std::size_t k) { return frame.frictions[k].normal_force; }},
    {"sliding_velocity", [](const Frame& frame, std::size_t k) { return frame.frictions[k].sliding_velocity; }}};
constexpr NamedNumber kOfControllers[] = {{"setpoint", [](const Frame& frame, std::size_t k) { return frame.controllers[k].setpoint; }},
                                          {"input", [](const Frame& frame, std::size_t k) { return frame.controllers[k].input; }},
                                          {"error", [](const Frame& frame, std::size_t k) { return frame.controllers[k].error; }},
                                          {"integral", [](const Frame& frame, std::size_t k) { return frame.controllers[k].integral; }},
                                          {"output", [](const Frame& frame, std::size_t k) { return frame.controllers[k].output; }}};

}  // namespace

FrameNumbers::FrameNumbers(const FrameNames& names) {
  std::set<std::string> texts, taken;
  const auto add = [&](const std::string& text, ReadNumber reader, std::size_t k) {
    texts.insert(text);
    const std::string legal = legal_name(text);
    std::string topic = legal;
    for (int number = 2; !taken.insert(topic).second; ++number) topic = legal + "_" + std::to_string(number);
    topics.push_back(topic);
    read.push_back(reader);
    index.push_back(k);
  };
  const auto add_all = [&add](const std::vector<std::string>& objects, std::size_t count, const auto& numbers) {
    for (std::size_t k = 0; k < count; ++k)
      for (const NamedNumber& number : numbers) add(objects[k] + "/" + number.quantity, number.read, k);
  };
  add_all(names.joints, names.tree_joints, kOfJoints);
  add_all(names.frictions, names.frictions.size(), kOfFrictions);
  add_all(names.controllers, names.controllers.size(), kOfControllers);
  for (std::size_t k = 0; k < names.signals.size(); ++k) {
    if (texts.count(names.signals[k]) > 0) continue;
    add(
        names.signals[k], [](const Frame& frame, std::size_t at) { return frame.signals[at]; }, k);
  }
}

FloatTopics::FloatTopics(ros::NodeHandle node, const FrameNames& names, std::uint32_t queue) : numbers_(names) {
  for (const std::string& topic : numbers_.topics) publishers_.push_back(node.advertise<std_msgs::Float64>("signals/" + topic, queue));
}

void FloatTopics::publish(const Frame& frame) const {
  std_msgs::Float64 message;
  for (std::size_t k = 0; k < publishers_.size(); ++k) {
    message.data = numbers_.value(frame, k);
    publishers_[k].publish(message);
  }
}

}  // namespace codesign
