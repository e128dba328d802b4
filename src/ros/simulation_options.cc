// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/simulation_options.h"

#include <algorithm>

#include "mechanism_codesign/math/decimal.h"
#include "mechanism_codesign/model/unknown_name.h"
#include "mechanism_codesign/ros/parameters.h"
#include "mechanism_codesign/ros/run_clock.h"

namespace codesign {
namespace {

/// Stamps have nanoseconds.
constexpr double kHighestRate = 1e9;

}  // namespace

const std::vector<std::string>& frame_topics() {
  static const std::vector<std::string> kNames = {"joint_states", "joint_friction", "controller_states",
                                                  "loop_errors",  "signals",        "friction_markers"};
  return kNames;
}

const std::vector<std::string>& simulation_parameters() {
  static const std::vector<std::string> kNames = {"rate",         "mode",        "time_scale",           "publish_limit",
                                                  "loop",         "world_frame", "frame_prefix",         "force_scale",
                                                  "torque_scale", "arrow_width", "wait_for_subscribers", "bag"};
  return kNames;
}

SimulationOptions read_simulation_options(const ros::NodeHandle& private_node) {
  SimulationOptions options;
  options.rate = read_positive(private_node, "rate", options.rate, kHighestRate);
  options.time_scale = read_positive(private_node, "time_scale", options.time_scale);
  options.publish_limit = read_positive(private_node, "publish_limit", options.publish_limit);
  options.loop = read_flag(private_node, "loop", options.loop);
  options.world_frame = read_text(private_node, "world_frame", "");
  options.frame_prefix = read_text(private_node, "frame_prefix", "");
  options.style.metres_per_newton = read_positive(private_node, "force_scale", options.style.metres_per_newton);
  options.style.metres_per_newton_metre = read_positive(private_node, "torque_scale", options.style.metres_per_newton_metre);
  options.style.shaft_diameter = read_positive(private_node, "arrow_width", options.style.shaft_diameter);
  options.bag = read_path(private_node, "bag", "");
  options.wait_for_subscribers = read_texts(private_node, "wait_for_subscribers");
  for (const std::string& topic : options.wait_for_subscribers)
    if (std::count(frame_topics().begin(), frame_topics().end(), topic) == 0)
      throw unknown_name({private_node.resolveName("wait_for_subscribers"), 0}, "wait_for_subscribers", "topic", topic, frame_topics());
  const std::string mode = read_text(private_node, "mode", "real_time");
  if (mode == "as_fast_as_possible")
    options.time_scale = 0.0;
  else if (mode != "real_time")
    throw unknown_name({private_node.resolveName("mode"), 0}, "mode", "mode", mode, {"real_time", "as_fast_as_possible"});
  if (!options.frame_prefix.empty() && options.frame_prefix[0] == '/')
    refuse_parameter(private_node, "frame_prefix", "TF frames begin with no slash", options.frame_prefix, "a text such as left/");
  return options;
}

void check_duration(const ros::NodeHandle& private_node, const SimulationOptions& options, double duration) {
  const bool is_paced = options.time_scale > 0.0;
  if (duration <= kLongestRun && (!is_paced || duration / options.time_scale <= kLongestRun)) return;
  const std::string key = duration > kLongestRun ? "study/duration" : "time_scale";
  throw InputError({{private_node.resolveName(key), 0},
                    key,
                    "the run is longer than ROS can count",
                    to_decimal(is_paced ? duration / options.time_scale : duration) + " s",
                    "at most " + to_decimal(kLongestRun) + " s"});
}

}  // namespace codesign
