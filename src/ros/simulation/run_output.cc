// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_output.h"

#include <std_msgs/Float64.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "description/study.h"
#include "mechanism_codesign/version.h"
#include "problem/load_problem.h"
#include "ros/scene/recorded_run.h"
#include "ros/simulation/command_inbox.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Names of numbers and their places in a sample.
template <class Sample>
using Quantities = std::vector<std::pair<const char*, double Sample::*>>;

constexpr double kInstants = 100.0;
/// [s] of wall time.
constexpr double kPatience = 2.0;

void replace_if_given(double given, double* value) {
  if (given > 0.0) *value = given;
}

}  // namespace

FrameNumbers::FrameNumbers(const FrameNames& names) {
  std::set<std::string> texts, taken;
  const auto add = [&](const std::string& text, const std::function<double(const Frame&)>& number) {
    texts.insert(text);
    topics.push_back(legal_name(text, &taken));
    read.push_back(number);
  };
  const auto add_all = [&add](const std::vector<std::string>& objects, std::size_t count,
                              auto samples, const auto& quantities) {
    for (std::size_t k = 0; k < count; ++k)
      for (const auto& [quantity, member] : quantities)
        add(objects[k] + "/" + quantity, [k, samples, member = member](const Frame& frame) {
          return (frame.*samples)[k].*member;
        });
  };
  add_all(names.joints, names.tree_joints, &Frame::joints,
          Quantities<JointSample>{{"position", &JointSample::position},
                                  {"velocity", &JointSample::velocity},
                                  {"effort", &JointSample::effort}});
  add_all(names.frictions, names.frictions.size(), &Frame::frictions,
          Quantities<FrictionSample>{{"friction", &FrictionSample::friction},
                                     {"normal_force", &FrictionSample::normal_force},
                                     {"sliding_velocity", &FrictionSample::sliding_velocity}});
  add_all(names.controllers, names.controllers.size(), &Frame::controllers,
          Quantities<ControllerSample>{{"setpoint", &ControllerSample::setpoint},
                                       {"input", &ControllerSample::input},
                                       {"error", &ControllerSample::error},
                                       {"integral", &ControllerSample::integral},
                                       {"output", &ControllerSample::output}});
  for (std::size_t k = 0; k < names.signals.size(); ++k)
    if (texts.count(names.signals[k]) == 0)
      add(names.signals[k], [k](const Frame& frame) { return frame.signals[k]; });
}

FloatTopics::FloatTopics(ros::NodeHandle node, const FrameNames& names, std::uint32_t queue)
    : numbers_(names) {
  for (const std::string& topic : numbers_.topics)
    publishers_.push_back(node.advertise<std_msgs::Float64>("signals/" + topic, queue));
}

void FloatTopics::publish(const Frame& frame) const {
  std_msgs::Float64 message;
  for (std::size_t k = 0; k < publishers_.size(); ++k) {
    message.data = numbers_.read[k](frame);
    publishers_[k].publish(message);
  }
}

SimulationScene::SimulationScene(const Problem& problem, const std::string& urdf,
                                 const MarkerStyle& given, const std::function<bool()>& stop)
    : has_objective_(!study_of(problem).integral.empty()) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  const RecordedRun run =
      record_run(system_of(problem), problem.parameters(), kInstants / study_of(problem).duration,
                 [&] { return stop() || ros::WallTime::now() > end; });
  const auto solids = std::make_shared<LinkBoxes>(link_boxes(urdf, run.names.links));
  layout_ = lay_out({{run.names, run.frames, solids}});
  layout_.style.solids = solids;
  // With a scale of the user's own, lengths are what the user has chosen.
  if (given.metres_per_newton > 0.0 || given.metres_per_newton_metre > 0.0)
    layout_.style.longest = MarkerStyle().longest;
  replace_if_given(given.metres_per_newton, &layout_.style.metres_per_newton);
  replace_if_given(given.metres_per_newton_metre, &layout_.style.metres_per_newton_metre);
  replace_if_given(given.shaft_diameter, &layout_.style.shaft_diameter);
  legend_ = arrow_legend(layout_);
  stage_ = stage_of(layout_, {Eigen::Vector3d::Zero()}, 1 + static_cast<int>(legend_.size()));
}

mechanism_codesign::Scene SimulationScene::message(const MessageContext& context) const {
  mechanism_codesign::Scene scene = stage_.scene;
  scene.header = header_of(context);
  return scene;
}

visualization_msgs::MarkerArray SimulationScene::text(const Frame& frame,
                                                      const MessageContext& context) const {
  std::string first = "t = " + readable(frame.time, 4) + " s";
  if (has_objective_) first += ", objective so far " + readable(frame.objective, 4);
  std::vector<CaptionLine> lines{plain_line(first)};
  lines.insert(lines.end(), legend_.begin(), legend_.end());
  return caption(lines, layout_, stage_.caption, context);
}

template <class Write>
void RunBag::guard(const Write& write) {
  try {
    write();
  } catch (const OutputError& error) {
    bag_.reset();
    lock_.reset();
    state_->warn("bag", {{"output_failed", error.what(), {}}});
  }
}

void RunBag::open(const std::string& description, const std::string& root_frame,
                  const std::vector<std::size_t>& link_parents, const SimulationScene& scene) {
  if (options_.bag.empty()) return;
  link_parents_ = link_parents;
  guard([&] {
    lock_ = lock();
    bag_ = std::make_unique<BagWriter>(options_.bag);
    bag_->write_text("robot_description", description);
    bag_->write_text("version", version());
    bag_->write_latched("scene", 0.0, scene.message({BagWriter::stamp(0.0), root_frame}));
  });
}

// If a killed node left an unlocked lock file, its unfinished bag is removed.
std::optional<LockFile> RunBag::lock() const {
  const std::string path = options_.bag + ".job";
  std::optional<LockFile> abandoned = LockFile::take_abandoned(path);
  if (!abandoned) return LockFile::create(path);
  std::error_code error;
  if (std::filesystem::remove(options_.bag + ".active", error))
    ROS_WARN_STREAM("a node was killed: removed " << options_.bag << ".active");
  return abandoned;
}

void RunBag::record(const FrameNames& names, const Frame& frame, const SimulationScene& scene) {
  if (!bag_) return;
  guard([&] {
    bag_->write_frame("", options_.frame_prefix + names.links[0], names, frame, options_.style);
    bag_->write(
        "caption", frame.time,
        scene.text(frame, {BagWriter::stamp(frame.time), options_.frame_prefix + names.links[0]}));
    bag_->write("tf", frame.time,
                link_transforms(names, link_parents_, frame, BagWriter::stamp(frame.time),
                                options_.frame_prefix));
  });
}

void RunBag::record(const mechanism_codesign::Commands& commands, double time) {
  if (!bag_) return;
  mechanism_codesign::Commands stamped = commands;
  stamped.header.stamp = BagWriter::stamp(time);
  guard([&] { bag_->write("commands", time, stamped); });
}

void RunBag::close() {
  if (!bag_) return;
  guard([&] {
    bag_->finish();
    state_->show("bag", options_.bag);
    bag_.reset();
    lock_.reset();
  });
}

}  // namespace codesign
