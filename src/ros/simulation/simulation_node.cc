// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/simulation_node.h"

#include <ros/master.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "description/study.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "observation/observer.h"
#include "problem/load_problem.h"
#include "reading/urdf/pictures.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/bags/bag_files.h"
#include "ros/common/inputs.h"
#include "ros/common/latched.h"
#include "ros/common/parameters.h"
#include "ros/common/run_node.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

constexpr std::uint32_t kQueueSize = 100;
/// In the mode as_fast_as_possible, a subscriber that is slow for a second must not lose frames.
constexpr std::uint32_t kLongQueueSize = 1000;
/// [s] A recorder subscribes to its topics one after the other; the run begins when no connection
/// has been made for so long.
constexpr double kSettling = 0.5;
/// Threads for services that wait for the run: one for ~step, one for a change of parameters, and
/// one for a request that interrupts them.
constexpr std::uint32_t kServiceThreads = 3;

std::vector<std::string> all_parameters() {
  std::vector<std::string> names = simulation_parameters();
  names.insert(names.end(), input_parameters().begin(), input_parameters().end());
  names.emplace_back("diagnostic_period");
  return names;
}

/// The nodes below a topic in an answer of the master: a list of pairs of a topic and its nodes.
std::set<std::string> nodes_of(XmlRpc::XmlRpcValue& topics, const std::vector<std::string>& names) {
  std::set<std::string> nodes;
  for (int i = 0; i < topics.size(); ++i)
    if (std::count(names.begin(), names.end(), text_of(topics[i][0])) > 0)
      for (int k = 0; k < topics[i][1].size(); ++k) nodes.insert(text_of(topics[i][1][k]));
  return nodes;
}

/// The number of nodes that subscribe to a topic and publish TF, as robot_state_publisher does:
/// they show the run, and do not record it.
std::uint32_t transformers_of(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) return 0;
  const std::set<std::string> transformers = nodes_of(state[0], {"/tf", "/tf_static"});
  const std::set<std::string> subscribers = nodes_of(state[1], {topic});
  return static_cast<std::uint32_t>(
      std::count_if(subscribers.begin(), subscribers.end(),
                    [&](const std::string& node) { return transformers.count(node) > 0; }));
}

ros::NodeHandle with_queue(ros::NodeHandle node, ros::CallbackQueue* queue) {
  node.setCallbackQueue(queue);
  return node;
}

CommandOptions command_options(const SimulationOptions& options) {
  CommandOptions of_run;
  if (!options.command_joints.empty()) of_run.joints = options.command_joints;
  of_run.disconnected = options.disconnect;
  if (options.duration > 0.0) of_run.duration = options.duration;
  of_run.rate = options.rate;
  return of_run;
}

}  // namespace

SimulationNode::SimulationNode()
    : service_node_(with_queue(ros::NodeHandle("~"), &waiting_services_)),
      state_("simulation"),
      control_(&bell_) {
  control_.advertise(service_node_);
  spinner_ = std::make_unique<ros::AsyncSpinner>(kServiceThreads, &waiting_services_);
  spinner_->start();
  try {
    load();
  } catch (const InputError& error) {
    const std::string fault = std::string("bad input: ") + error.what();
    state_.set(NodeState::Level::kError, fault);
    control_.end_run(fault);
    return;
  }
  thread_ = std::thread([this] { run(); });
}

SimulationNode::~SimulationNode() {
  stopping_ = true;
  control_.stop();
  if (live_) live_->stop();
  bell_.ring();
  if (thread_.joinable()) thread_.join();
  spinner_->stop();
}

void SimulationNode::load() {
  state_.warn("parameters", unknown_parameters(private_node_, all_parameters()));
  options_ = read_simulation_options(private_node_);
  clock_ = RunClock(options_.time_scale);
  pace_ = Pace(options_.publish_limit);
  const Inputs inputs = read_inputs(node_, private_node_);
  problem_ = codesign::load(inputs, bag_trajectory_loader(study_folder(inputs)));
  simulation_ = std::make_unique<InteractiveSimulation>(
      *system_of(*problem_), command_options(options_), signals_of(study_of(*problem_)));
  check_duration(private_node_, options_, simulation_->duration());
  link_parents_ = link_parents(robot_of(*problem_));
  commanded_.emplace(simulation_.get(), options_.command_timeout);
  state_.show("robot", robot_of(*problem_).name);
  state_.show("joints of ~command/efforts", list_names(simulation_->inputs().joints));
  state_.warn("files", problem_->warnings());
  control_.configure(options_.start_paused, static_cast<std::int64_t>(options_.step_frames));
  advertise();
  tell_description();
}

void SimulationNode::advertise() {
  const std::uint32_t size = clock_.is_free_running() ? kLongQueueSize : kQueueSize;
  FrameMessages({}, {}, {}, {}).visit([&](const std::string& topic, const auto& message) {
    publishers_[topic] = node_.advertise<std::decay_t<decltype(message)>>(topic, size);
  });
  if (clock_.is_free_running())
    clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", size);
  description_publisher_ = node_.advertise<std_msgs::String>("robot_description", 1, true);
  commands_publisher_ = node_.advertise<mechanism_codesign::Commands>("commands", size, true);
  factor_publisher_ = private_node_.advertise<std_msgs::Float64>("real_time_factor", size);
  if (options_.float_topics)
    floats_ = std::make_unique<FloatTopics>(node_, simulation_->names(), size);
  inbox_ =
      std::make_unique<CommandInbox>(node_, private_node_, simulation_->inputs(), &state_, &bell_);
  live_ = std::make_unique<LiveParameters>(service_node_, problem_->all_parameters(),
                                           simulation_->parameters(), &state_, &bell_);
  caption_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("caption", size);
  scene_publisher_ = node_.advertise<mechanism_codesign::Scene>("scene", 1, true);
}

void SimulationNode::tell_description() {
  std_msgs::String message;
  const std::string urdf =
      write_tuned_urdf(problem_->urdf(), problem_->overlays(), simulation_->parameters(),
                       std::nullopt, robot_of(*problem_).laws);
  message.data = with_sticks(urdf);
  if (message.data == description_) return;
  description_ = message.data;
  publish_latched(description_publisher_, message);
  state_.warn("description", check_description(node_, *problem_, urdf, description_));
}

MessageContext SimulationNode::context(double time) const {
  return {
      clock_.stamp(time),
      options_.frame_prefix + robot_of(*problem_).links[to_index(robot_of(*problem_).root)].name};
}

void SimulationNode::set_scene() {
  scene_.emplace(*problem_, description_, options_.style, [this] { return stopping(); });
  options_.style = scene_->style();
  publish_latched(scene_publisher_, scene_->message(context(0.0)));
}

void SimulationNode::place_root() {
  const std::string root = context(0.0).root_frame;
  if (options_.world_frame.empty() || options_.world_frame == root) return;
  geometry_msgs::TransformStamped transform;
  transform.header = header_of({clock_.stamp(0.0), options_.world_frame});
  transform.child_frame_id = root;
  transform.transform.rotation.w = 1.0;
  static_transforms_.sendTransform(transform);
}

void SimulationNode::wait_for_subscribers() {
  if (options_.wait_for_subscribers.empty()) return;
  const auto is_heard = [this](const std::string& topic) {
    const ros::Publisher& publisher = publishers_.at(topic);
    return publisher.getNumSubscribers() > 0 &&
           publisher.getNumSubscribers() > transformers_of(publisher.getTopic());
  };
  const std::vector<std::string>& topics = options_.wait_for_subscribers;
  const std::string sentence =
      "waiting for subscribers of " + list_names(topics) + ", robot_state_publisher not counted";
  state_.set(NodeState::Level::kOk, sentence);
  control_.end_run("the run has not begun: " + sentence);
  std::uint32_t connections = 0;
  ros::WallTime since;
  while (!stopping()) {
    const bool all_heard = std::all_of(topics.begin(), topics.end(), is_heard);
    const std::uint32_t now = subscriptions();
    if (!all_heard || now != connections) since = ros::WallTime::now();
    connections = now;
    if (all_heard && ros::WallTime::now() - since > ros::WallDuration(kSettling)) return;
    // Some programs, such as rosbag record, wait for a first message on /clock.
    if (clock_.is_free_running()) publish_clock(0.0);
    serve_idle();
    bell_.wait(0.05);
  }
}

std::uint32_t SimulationNode::subscriptions() const {
  std::uint32_t count =
      caption_publisher_.getNumSubscribers() + commands_publisher_.getNumSubscribers();
  if (clock_.is_free_running()) count += clock_publisher_.getNumSubscribers();
  for (const auto& [topic, publisher] : publishers_) count += publisher.getNumSubscribers();
  return count;
}

bool SimulationNode::is_watched() const {
  return std::any_of(publishers_.begin(), publishers_.end(),
                     [](const auto& entry) { return entry.second.getNumSubscribers() > 0; });
}

void SimulationNode::publish_clock(double time) {
  rosgraph_msgs::Clock message;
  message.clock = clock_.stamp(time);
  clock_publisher_.publish(message);
}

void SimulationNode::publish(const FrameNames& names, const Frame& frame) {
  const MessageContext context{clock_.stamp(frame.time), options_.frame_prefix + names.links[0]};
  if (clock_.is_free_running()) {
    if (is_watched()) pace_.wait(ros::WallTime::now()).sleep();
    publish_clock(frame.time);
  }
  FrameMessages(names, frame, context, options_.style)
      .visit([this](const std::string& topic, const auto& message) {
        publishers_.at(topic).publish(message);
      });
  if (floats_) floats_->publish(frame);
  caption_publisher_.publish(scene_->text(frame, context));
  const tf2_msgs::TFMessage poses =
      options_.frame_prefix.empty()
          ? free_link_transforms(names, frame, context)
          : link_transforms(names, link_parents_, frame, context.stamp, options_.frame_prefix);
  if (!poses.transforms.empty()) transforms_.sendTransform(poses.transforms);
}

RunningNode make_simulation_node() { return {std::make_shared<SimulationNode>(), {}}; }

}  // namespace codesign
