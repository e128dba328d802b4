// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/simulation_options.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "ros/common/parameters.h"
#include "ros/scene/frame_messages.h"
#include "ros/scene/recorded_run.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// [1/s] Stamps have a resolution of nanoseconds.
constexpr double kHighestRate = 1e9;
constexpr double kMostStepFrames = 1e9;

using Node = ros::NodeHandle;

/// Reads a private parameter into the options.
using Read =
    std::function<void(const Node& node, const std::string& name, SimulationOptions* options)>;

/// A private parameter: its name and the function that reads it.
struct Entry {
  const char* name;
  Read read;
};

Read positive(double SimulationOptions::*field) {
  return [field](const Node& node, const std::string& name, SimulationOptions* options) {
    options->*field = read_positive(node, name, options->*field);
  };
}

Read positive(double MarkerStyle::*field) {
  return [field](const Node& node, const std::string& name, SimulationOptions* options) {
    options->style.*field = read_positive(node, name, options->style.*field);
  };
}

/// Zero, which launch files use for "not set", leaves the default.
Read positive_or_none(double SimulationOptions::*field) {
  return [field](const Node& node, const std::string& name, SimulationOptions* options) {
    XmlRpc::XmlRpcValue value;
    double number = 1.0;
    if (find_parameter(node, name, &value) && is_number(value, &number) && number == 0.0) return;
    options->*field = read_positive(node, name, options->*field);
  };
}

void read_rate(const Node& node, const std::string& name, SimulationOptions* options) {
  options->rate = read_positive(node, name, options->rate, kHighestRate);
}

void read_mode(const Node& node, const std::string& name, SimulationOptions* options) {
  const std::string mode = read_text(node, name, "real_time");
  if (mode == "as_fast_as_possible")
    options->time_scale = 0.0;
  else if (mode != "real_time")
    throw unknown_name({node.resolveName(name), 0}, name, "mode", mode,
                       {"real_time", "as_fast_as_possible"});
}

Read flag(bool SimulationOptions::*field) {
  return [field](const Node& node, const std::string& name, SimulationOptions* options) {
    options->*field = read_flag(node, name, options->*field);
  };
}

Read texts(std::vector<std::string> SimulationOptions::*field) {
  return [field](const Node& node, const std::string& name, SimulationOptions* options) {
    options->*field = read_names(node, name);
  };
}

void read_step_frames(const Node& node, const std::string& name, SimulationOptions* options) {
  const double frames = read_positive(node, name, options->step_frames, kMostStepFrames);
  if (frames != std::floor(frames))
    refuse_parameter(node, name, "not a whole number", frames, "1, 2, 3, ...");
  options->step_frames = frames;
}

void read_frame_prefix(const Node& node, const std::string& name, SimulationOptions* options) {
  options->frame_prefix = read_text(node, name, "");
  if (!options->frame_prefix.empty() && options->frame_prefix[0] == '/')
    refuse_parameter(node, name, "TF frames must not begin with a slash", options->frame_prefix,
                     "a text such as left/");
}

void read_topics(const Node& node, const std::string& name, SimulationOptions* options) {
  std::vector<std::string> known;
  FrameMessages({}, {}, {}, {}).visit([&known](const std::string& topic, const auto&) {
    known.push_back(topic);
  });
  options->wait_for_subscribers = read_names(node, name);
  for (const std::string& topic : options->wait_for_subscribers)
    if (std::count(known.begin(), known.end(), topic) == 0)
      throw unknown_name({node.resolveName(name), 0}, name, "topic", topic, known);
}

/// In the order of reading: `mode` comes after `time_scale`, since it overrides `time_scale`.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> kEntries = {
      {"rate", read_rate},
      {"time_scale", positive(&SimulationOptions::time_scale)},
      {"mode", read_mode},
      {"publish_limit", positive(&SimulationOptions::publish_limit)},
      {"loop", flag(&SimulationOptions::loop)},
      {"command_joints", texts(&SimulationOptions::command_joints)},
      {"disconnect", texts(&SimulationOptions::disconnect)},
      {"command_timeout", positive_or_none(&SimulationOptions::command_timeout)},
      {"duration", positive_or_none(&SimulationOptions::duration)},
      {"lock_step", flag(&SimulationOptions::lock_step)},
      {"start_paused", flag(&SimulationOptions::start_paused)},
      {"step_frames", read_step_frames},
      {"float_topics", flag(&SimulationOptions::float_topics)},
      {"world_frame",
       [](const Node& node, const std::string& name, SimulationOptions* options) {
         options->world_frame = read_text(node, name, "");
       }},
      {"frame_prefix", read_frame_prefix},
      {"force_scale", positive(&MarkerStyle::metres_per_newton)},
      {"torque_scale", positive(&MarkerStyle::metres_per_newton_metre)},
      {"arrow_width", positive(&MarkerStyle::shaft_diameter)},
      {"wait_for_subscribers", read_topics},
      {"bag", [](const Node& node, const std::string& name, SimulationOptions* options) {
         options->bag = read_path(node, name, "");
       }}};
  return kEntries;
}

}  // namespace

std::vector<std::string> simulation_parameters() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

SimulationOptions read_simulation_options(const ros::NodeHandle& private_node) {
  SimulationOptions options;
  for (const Entry& entry : entries()) entry.read(private_node, entry.name, &options);
  return options;
}

void check_duration(const ros::NodeHandle& private_node, const SimulationOptions& options,
                    double duration) {
  const bool is_paced = options.time_scale > 0.0;
  if (duration <= kLongestRun && (!is_paced || duration / options.time_scale <= kLongestRun))
    return;
  const char* const of_run = options.duration > 0.0 ? "duration" : "study/duration";
  const std::string key = duration > kLongestRun ? of_run : "time_scale";
  throw InputError({{private_node.resolveName(key), 0},
                    key,
                    "the run is longer than ROS time can represent",
                    to_decimal(is_paced ? duration / options.time_scale : duration) + " s",
                    "at most " + to_decimal(kLongestRun) + " s"});
}

}  // namespace codesign
