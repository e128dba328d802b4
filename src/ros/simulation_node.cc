// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/simulation_node.h"

#include <rosgraph_msgs/Clock.h>

#include <cmath>

#include "mechanism_codesign/model/error.h"
#include "mechanism_codesign/model/unknown_name.h"
#include "mechanism_codesign/ros/frame_messages.h"
#include "mechanism_codesign/ros/inputs.h"
#include "mechanism_codesign/ros/trajectory_bag.h"

namespace codesign {
namespace {

constexpr std::uint32_t kQueueSize = 100;

std::string at_time(const Status& status) { return status.cause + " (at t = " + std::to_string(status.time) + " s)"; }

}  // namespace

SimulationOptions read_simulation_options(const ros::NodeHandle& private_node) {
  SimulationOptions options;
  options.rate = read_positive(private_node, "rate", options.rate);
  options.time_scale = read_positive(private_node, "time_scale", options.time_scale);
  options.world_frame = private_node.param("world_frame", options.world_frame);
  options.loop = private_node.param("loop", options.loop);
  options.style.metres_per_newton = read_positive(private_node, "force_scale", options.style.metres_per_newton);
  options.style.metres_per_newton_metre = read_positive(private_node, "torque_scale", options.style.metres_per_newton_metre);
  options.style.shaft_diameter = read_positive(private_node, "arrow_width", options.style.shaft_diameter);
  const std::string mode = private_node.param("mode", std::string("real_time"));
  if (mode == "as_fast_as_possible")
    options.time_scale = 0.0;
  else if (mode != "real_time")
    throw unknown_name({private_node.resolveName("mode"), 0}, "mode", "mode", mode, {"real_time", "as_fast_as_possible"});
  return options;
}

SimulationNode::SimulationNode() : state_("simulation") {
  try {
    load();
  } catch (const InputError& error) {
    state_.set(NodeState::Level::kError, std::string("bad input: ") + error.what());
    return;
  }
  thread_ = std::thread([this] { run(); });
}

SimulationNode::~SimulationNode() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void SimulationNode::load() {
  options_ = read_simulation_options(private_node_);
  clock_ = RunClock(options_.time_scale);
  const Inputs inputs = read_inputs(node_, private_node_);
  problem_ = load_problem(inputs.urdf, inputs.overlays, inputs.study, inputs.settings, bag_trajectory_loader(study_folder(inputs)));
  state_.show("robot", problem_.robot.name);
  publishers_["joint_states"] = node_.advertise<sensor_msgs::JointState>("joint_states", kQueueSize);
  publishers_["joint_friction"] = node_.advertise<mechanism_codesign::JointFriction>("joint_friction", kQueueSize);
  publishers_["controller_states"] = node_.advertise<mechanism_codesign::ControllerStates>("controller_states", kQueueSize);
  publishers_["loop_errors"] = node_.advertise<mechanism_codesign::LoopErrors>("loop_errors", kQueueSize);
  publishers_["friction_markers"] = node_.advertise<visualization_msgs::MarkerArray>("friction_markers", kQueueSize);
  if (clock_.is_free_running()) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", kQueueSize);
}

void SimulationNode::place_root() {
  const std::string& root = problem_.robot.links[static_cast<std::size_t>(problem_.robot.root)].name;
  if (options_.world_frame.empty() || options_.world_frame == root) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = clock_.stamp(0.0);
  transform.header.frame_id = options_.world_frame;
  transform.child_frame_id = root;
  transform.transform.rotation.w = 1.0;
  static_transforms_.sendTransform(transform);
}

void SimulationNode::run() {
  double previous_duration = 0.0;
  state_.set(NodeState::Level::kOk, "running " + problem_.robot.name);
  do {
    clock_.start_run(previous_duration);
    if (previous_duration == 0.0) place_root();
    const Status status = run_once();
    if (stopping()) return;
    if (!status.ok()) return state_.set(NodeState::Level::kError, std::string(name_of(status.code)) + ": " + at_time(status));
    previous_duration = problem_.study.duration + 1.0 / options_.rate;
  } while (options_.loop);
  state_.set(NodeState::Level::kOk, "finished " + problem_.robot.name);
}

Status SimulationNode::run_once() {
  Simulation simulation(problem_.system, problem_.parameters());
  Status status = simulation.start();
  const double duration = problem_.study.duration;
  Frame frame;
  for (long k = 0; status.ok(); ++k) {
    const double time = std::min(static_cast<double>(k) / options_.rate, duration);
    if (k > 0) status = simulation.advance(time);
    if (!status.ok()) break;
    simulation.sample(time, &frame);
    if (!clock_.wait(time, [this] { return stopping(); })) break;
    publish(simulation.names(), frame);
    if (time >= duration) break;
  }
  return status;
}

void SimulationNode::publish(const FrameNames& names, const Frame& frame) {
  const MessageContext context{clock_.stamp(frame.time), names.links[0]};
  if (clock_.is_free_running()) {
    rosgraph_msgs::Clock message;
    message.clock = context.stamp;
    clock_publisher_.publish(message);
  }
  FrameMessages(names, frame, context, options_.style).visit([this](const std::string& topic, const auto& message) {
    publishers_.at(topic).publish(message);
  });
  const tf2_msgs::TFMessage poses = free_link_transforms(names, frame, context);
  if (!poses.transforms.empty()) transforms_.sendTransform(poses.transforms);
}

}  // namespace codesign
