// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation_node.h"

#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "jobs/output_error.h"
#include "jobs/sentences.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/version.h"
#include "reading/urdf/stick_figure.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/advance.h"
#include "ros/description.h"
#include "ros/inputs.h"
#include "ros/parameters.h"
#include "ros/trajectory_bag.h"
#include "text/decimal.h"
#include "text/unknown_name.h"

namespace codesign {
namespace {

constexpr std::uint32_t kQueueSize = 100;
/// In the mode as_fast_as_possible, a subscriber that is slow for a second must not lose frames.
constexpr std::uint32_t kLongQueueSize = 1000;

std::vector<std::string> all_parameters() {
  std::vector<std::string> names = simulation_parameters();
  names.insert(names.end(), input_parameters().begin(), input_parameters().end());
  names.emplace_back("diagnostic_period");
  return names;
}

}  // namespace

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
  state_.warn("parameters", unknown_parameters(private_node_, all_parameters()));
  options_ = read_simulation_options(private_node_);
  clock_ = RunClock(options_.time_scale);
  pace_ = Pace(options_.publish_limit);
  const Inputs inputs = read_inputs(node_, private_node_);
  problem_ = codesign::load(inputs, bag_trajectory_loader(study_folder(inputs)));
  check_duration(private_node_, options_, problem_->study().duration);
  state_.show("robot", problem_->robot().name);
  state_.warn("files", problem_->warnings());
  advertise();
  tell_description();
}

void SimulationNode::advertise() {
  const std::uint32_t size = clock_.is_free_running() ? kLongQueueSize : kQueueSize;
  publishers_["joint_states"] = node_.advertise<sensor_msgs::JointState>("joint_states", size);
  publishers_["joint_friction"] = node_.advertise<mechanism_codesign::JointFriction>("joint_friction", size);
  publishers_["controller_states"] = node_.advertise<mechanism_codesign::ControllerStates>("controller_states", size);
  publishers_["loop_errors"] = node_.advertise<mechanism_codesign::LoopErrors>("loop_errors", size);
  publishers_["signals"] = node_.advertise<mechanism_codesign::Signals>("signals", size);
  publishers_["friction_markers"] = node_.advertise<visualization_msgs::MarkerArray>("friction_markers", size);
  if (clock_.is_free_running()) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", size);
  description_publisher_ = node_.advertise<std_msgs::String>("robot_description", 1, true);
  caption_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("caption", size);
  scene_publisher_ = node_.advertise<mechanism_codesign::Scene>("scene", 1, true);
}

void SimulationNode::tell_description() {
  std_msgs::String message;
  const std::string urdf = write_tuned_urdf(problem_->urdf(), problem_->overlays(), problem_->parameters());
  message.data = description_ = with_sticks(urdf);
  description_publisher_.publish(message);
  state_.warn("description", check_description(node_, *problem_, urdf));
}

MessageContext SimulationNode::context(double time) const {
  return {clock_.stamp(time), options_.frame_prefix + problem_->robot().links[static_cast<std::size_t>(problem_->robot().root)].name};
}

void SimulationNode::set_scene() {
  scene_.emplace(*problem_, description_, options_.style, [this] { return stopping(); });
  options_.style = scene_->style();
  scene_publisher_.publish(scene_->message(context(0.0)));
}

void SimulationNode::place_root() {
  const std::string root = options_.frame_prefix + problem_->robot().links[static_cast<std::size_t>(problem_->robot().root)].name;
  if (options_.world_frame.empty() || options_.world_frame == root) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = clock_.stamp(0.0);
  transform.header.frame_id = options_.world_frame;
  transform.child_frame_id = root;
  transform.transform.rotation.w = 1.0;
  static_transforms_.sendTransform(transform);
}

void SimulationNode::run() {
  try {
    run_all();
  } catch (const std::exception& error) {
    state_.set(NodeState::Level::kError, std::string("internal_error: ") + error.what());
  }
}

void SimulationNode::run_all() {
  double previous_duration = 0.0;
  set_scene();
  wait_for_subscribers();
  state_.set(NodeState::Level::kOk, "running " + problem_->robot().name);
  open_bag();
  do {
    if (!clock_.has_room_for(previous_duration + problem_->study().duration))
      return state_.set(NodeState::Level::kWarning, "finished: /clock has reached the end of ROS time");
    clock_.start_run(previous_duration);
    if (previous_duration == 0.0) place_root();
    const Status status = run_once();
    close_bag();
    if (stopping()) return;
    if (!status.ok()) return state_.set(NodeState::Level::kError, std::string(name_of(status.code)) + ": " + reason(status));
    previous_duration = problem_->study().duration + 1.0 / options_.rate;
  } while (options_.loop);
  state_.set(NodeState::Level::kOk, "finished " + problem_->robot().name);
}

Status SimulationNode::run_once() {
  Simulation simulation(problem_->system(), problem_->parameters(), signals_of(problem_->study()));
  Status status = simulation.start();
  const double duration = problem_->study().duration;
  const auto instant = [&](std::int64_t k) { return std::min(static_cast<double>(k) / options_.rate, duration); };
  Frame frame;
  factor_.start(ros::WallTime::now());
  for (std::int64_t k = 0; status.ok(); ++k) {
    const double time = instant(k);
    if (k > 0) status = advance(&simulation, instant(k - 1), time, [this] { return stopping(); });
    if (!status.ok()) break;
    simulation.sample(time, &frame);
    if (!clock_.wait(time, [this] { return stopping(); })) break;
    publish(simulation.names(), frame);
    record(simulation.names(), frame);
    tell_progress(frame, simulation.statistics());
    if (time >= duration) break;
  }
  state_.show("real-time factor of the run", std::to_string(factor_.mean(frame.time, ros::WallTime::now())));
  tell_figures(simulation.statistics());
  state_.warn("run", simulation.warnings());
  return status;
}

void SimulationNode::tell_figures(const Statistics& statistics) {
  state_.show("constraint drift", to_decimal(statistics.constraint_drift));
  state_.show("energy error", to_decimal(statistics.energy_error));
}

void SimulationNode::tell_progress(const Frame& frame, const Statistics& statistics) {
  if (!factor_.note(frame.time, ros::WallTime::now())) return;
  state_.show("time of the run", std::to_string(frame.time));
  state_.show("real-time factor", std::to_string(factor_.value()));
  tell_figures(statistics);
}

void SimulationNode::wait_for_subscribers() {
  if (options_.wait_for_subscribers.empty()) return;
  const auto is_missing = [this](const std::string& topic) { return publishers_.at(topic).getNumSubscribers() == 0; };
  const std::vector<std::string>& topics = options_.wait_for_subscribers;
  state_.set(NodeState::Level::kOk, "waiting for subscribers of " + list_names(topics));
  while (!stopping() && std::any_of(topics.begin(), topics.end(), is_missing)) {
    // Some programs, such as rosbag record, wait for a first message on /clock.
    if (clock_.is_free_running()) publish_clock(0.0);
    ros::WallDuration(0.05).sleep();
  }
}

bool SimulationNode::is_watched() const {
  return std::any_of(publishers_.begin(), publishers_.end(), [](const auto& entry) { return entry.second.getNumSubscribers() > 0; });
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
  FrameMessages(names, frame, context, options_.style).visit([this](const std::string& topic, const auto& message) {
    publishers_.at(topic).publish(message);
  });
  caption_publisher_.publish(scene_->text(frame, context));
  const tf2_msgs::TFMessage poses = options_.frame_prefix.empty() ? free_link_transforms(names, frame, context)
                                                                  : link_transforms(names, frame, context.stamp, options_.frame_prefix);
  if (!poses.transforms.empty()) transforms_.sendTransform(poses.transforms);
}

void SimulationNode::open_bag() {
  if (options_.bag.empty()) return;
  try {
    bag_lock_ = lock_bag();
    bag_ = std::make_unique<BagWriter>(options_.bag);
    bag_->write_text("robot_description", description_);
    bag_->write_text("version", version());
    bag_->write_latched("scene", 0.0, scene_->message({BagWriter::stamp(0.0), context(0.0).root_frame}));
  } catch (const OutputError& error) {
    give_up_bag(error);
  }
}

// Locks the bag. If a killed node left an unlocked lock file, its unfinished bag is removed.
std::optional<LockFile> SimulationNode::lock_bag() {
  const std::string lock = options_.bag + ".job";
  std::optional<LockFile> abandoned = LockFile::take_abandoned(lock);
  if (!abandoned) return LockFile::create(lock);
  std::error_code error;
  if (std::filesystem::remove(options_.bag + ".active", error)) ROS_WARN_STREAM("a node was killed: removed " << options_.bag << ".active");
  return abandoned;
}

void SimulationNode::give_up_bag(const OutputError& error) {
  bag_.reset();
  bag_lock_.reset();
  state_.warn("bag", {{"output_failed", error.what(), {}}});
}

void SimulationNode::record(const FrameNames& names, const Frame& frame) {
  if (!bag_) return;
  try {
    bag_->write_frame("", options_.frame_prefix + names.links[0], names, frame, options_.style);
    bag_->write("caption", frame.time, scene_->text(frame, {BagWriter::stamp(frame.time), context(0.0).root_frame}));
    bag_->write("tf", frame.time, link_transforms(names, frame, BagWriter::stamp(frame.time), options_.frame_prefix));
  } catch (const OutputError& error) {
    give_up_bag(error);
  }
}

void SimulationNode::close_bag() {
  if (!bag_) return;
  try {
    bag_->finish();
    state_.show("bag", options_.bag);
    bag_.reset();
    bag_lock_.reset();
  } catch (const OutputError& error) {
    give_up_bag(error);
  }
}

std::shared_ptr<void> make_simulation_node() { return std::make_shared<SimulationNode>(); }

}  // namespace codesign
