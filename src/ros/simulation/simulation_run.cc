// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The thread of SimulationNode that runs the study.
#include <std_msgs/Float64.h>

#include <algorithm>

#include "problem/load_problem.h"
#include "ros/common/latched.h"
#include "ros/simulation/simulation_node.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kLook = 0.1;  // [s] between two checks whether a wait must end

/// How a study enforces a limit of the URDF; that of a velocity it cannot enforce.
std::string remedy(const std::string& limit) {
  if (limit == "velocity") return "";
  return "; the study enforces it with limits: {" +
         std::string(limit == "effort" ? "effort" : "position") + ": true}";
}

}  // namespace

void SimulationNode::run() {
  try {
    run_all();
  } catch (const std::exception& error) {
    const std::string fault = std::string("internal_error: ") + error.what();
    state_.set(NodeState::Level::kError, fault);
    bag_.close();
    end_for_good(fault);
  }
}

void SimulationNode::end_for_good(const std::string& why) {
  control_.stop(why);
  live_->stop();
}

void SimulationNode::run_all() {
  double previous_duration = 0.0;
  set_scene();
  wait_for_subscribers();
  bag_.open(description_, context(0.0).root_frame, link_parents_, *scene_);
  while (!stopping()) {
    if (!clock_.has_room_for(previous_duration + simulation_->duration())) {
      const std::string why = "finished: /clock has reached the end of ROS time";
      state_.set(NodeState::Level::kWarning, why);
      return end_for_good(why);
    }
    state_.set(NodeState::Level::kOk, "running " + robot_of(*problem_).name);
    clock_.start_run(previous_duration);
    if (previous_duration == 0.0) place_root();
    const Status status = run_once();
    bag_.close();
    previous_duration = frame_.time + 1.0 / options_.rate;
    if (stopping()) return;
    if (control_.wants_restart() || (status.ok() && options_.loop)) continue;
    const std::string why = status.ok() ? "finished " + robot_of(*problem_).name
                                        : std::string(name_of(status.code)) + ": " + reason(status);
    state_.set(status.ok() ? NodeState::Level::kOk : NodeState::Level::kError, why);
    wait_for_restart(why);
  }
}

void SimulationNode::wait_for_restart(const std::string& why) {
  control_.end_run(why);
  while (!leaving_run()) {
    serve_idle();
    bell_.wait(kLook);
  }
}

// Refuses parameters whose start cannot be assembled, so that ~restart begins with a valid start.
void SimulationNode::serve_idle() {
  inbox_->take();  // commands to a run that has ended
  const std::vector<double> before = simulation_->parameters();
  simulation_->obey(nullptr);
  const bool changed = live_->serve([&](const std::vector<double>& values) {
    Status status = simulation_->start(values);
    if (!status.ok()) simulation_->start(before);
    return status;
  });
  if (changed) tell_description();
}

Status SimulationNode::run_once() {
  frame_.time = 0.0;
  inbox_->clear();
  commanded_->clear();
  state_.warn("command timeout", {});
  watch_limits();
  control_.begin_run();
  Status status = run_frames();
  state_.show("time of the run", std::to_string(frame_.time));
  state_.show("real-time factor of the run",
              std::to_string(factor_.mean(frame_.time, ros::WallTime::now())));
  tell_figures(simulation_->statistics());
  state_.warn("run", simulation_->warnings());
  return status;
}

Status SimulationNode::run_frames() {
  simulation_->obey(control_.leaving());
  Status status = simulation_->start(simulation_->parameters());
  const auto instant = [&](std::int64_t k) {
    return std::min(static_cast<double>(k) / options_.rate, simulation_->end());
  };
  if (status.ok()) {
    simulation_->sample(0.0, &frame_);
    tell_commands();
  }
  factor_.start(ros::WallTime::now());
  for (std::int64_t k = 0; status.ok(); ++k) {
    double time = instant(k);
    if (k > 0) status = simulation_->advance(time);
    if (!status.ok()) break;
    simulation_->sample(time, &frame_);
    // A run that ends by itself has its last frame at its end.
    time = frame_.time;
    if (!clock_.wait(time, [this] { return leaving_run(); })) break;
    inbox_->await_answer(clock_.stamp(time));
    show_frame(true);
    note_limits();
    control_.note_frame(time);
    tell_progress(simulation_->statistics());
    if (time >= simulation_->end() || simulation_->has_ended()) break;
    status = serve();
    if (leaving_run()) break;
  }
  return status.code == StatusCode::kCancelled ? Status() : status;
}

Status SimulationNode::serve() {
  const ros::WallTime begun = ros::WallTime::now();
  bool has_waited = false;
  for (;;) {
    // Read before commands are taken: a command that arrives in between is taken in the next round.
    const bool goes_on =
        !control_.stand_if_paused() && (!options_.lock_step || inbox_->is_answered());
    const CommandedRun::Outcome outcome = commanded_->apply(inbox_->take(), frame_, clock_);
    if (!outcome.status.ok()) return outcome.status;
    const bool other_values = live_->serve([this](const std::vector<double>& values) {
      return simulation_->change(frame_.time, values);
    });
    if (outcome.changed) tell_commands();
    if (other_values) tell_description();
    if (other_values) watch_limits();
    if (leaving_run()) return {};
    if (goes_on) break;
    if (control_.is_paused() && (outcome.changed || other_values)) {
      simulation_->sample(frame_.time, &frame_);
      show_frame(false);
    }
    if (!has_waited) state_.show("time of the run", std::to_string(frame_.time));
    has_waited = true;
    const bool is_paused = control_.is_paused();
    state_.show("waits for", is_paused ? "~step or ~resume" : "a command");
    const ros::WallTime before = ros::WallTime::now();
    bell_.wait(kLook);
    if (is_paused) factor_.leave_out(ros::WallTime::now() - before);
  }
  if (!has_waited) return {};
  state_.show("waits for", "nothing");
  // After a shorter wait, such as for the answer of a fast controller, the due time of the next
  // frame does not change.
  if (ros::WallTime::now() - begun > ros::WallDuration(1.0 / options_.rate))
    clock_.go_on_from(frame_.time);
  return {};
}

void SimulationNode::show_frame(bool record) {
  publish(simulation_->names(), frame_);
  if (record) bag_.record(simulation_->names(), frame_, *scene_);
}

void SimulationNode::watch_limits() {
  limits_.emplace(*problem_, simulation_->parameters(), simulation_->names());
  limits_told_ = 0;
  state_.warn("limits", {});
}

// Without time and worst value, with which the log would have another sentence in each run.
void SimulationNode::note_limits() {
  limits_->observe(frame_);
  const std::vector<LimitCrossing>& crossings = limits_->crossings();
  for (const LimitCrossing& crossing : crossings)
    state_.show(crossing.joint + " beyond its " + crossing.limit + " limit", describe(crossing));
  if (crossings.size() == limits_told_) return;
  limits_told_ = crossings.size();
  Warnings warnings;
  for (const LimitCrossing& crossing : crossings)
    warnings.push_back({"limits_exceeded",
                        "joint '" + crossing.joint + "' exceeds its " + crossing.limit + " limit " +
                            to_decimal(crossing.bound) +
                            "; /diagnostics shows since when and how far" + remedy(crossing.limit),
                        {}});
  state_.warn("limits", warnings);
}

void SimulationNode::tell_commands() {
  mechanism_codesign::Commands commands = commanded_->message(frame_.time);
  bag_.record(commands, frame_.time);
  commands.header.stamp = clock_.stamp(frame_.time);
  publish_latched(commands_publisher_, commands);
  if (!commanded_->is_timed_out()) return state_.warn("command timeout", {});
  state_.warn("command timeout",
              {{"command_timeout",
                "no effort was commanded for " + to_decimal(options_.command_timeout) +
                    " s (~command_timeout): all commanded efforts are zero until the next one",
                {}}});
}

void SimulationNode::tell_figures(const Statistics& statistics) {
  state_.show("constraint drift", to_decimal(statistics.constraint_drift));
  state_.show("energy error", to_decimal(statistics.energy_error));
}

void SimulationNode::tell_progress(const Statistics& statistics) {
  if (!factor_.note(frame_.time, ros::WallTime::now())) return;
  std_msgs::Float64 message;
  message.data = factor_.value();
  factor_publisher_.publish(message);
  state_.show("time of the run", std::to_string(frame_.time));
  state_.show("real-time factor", std::to_string(factor_.value()));
  tell_figures(statistics);
}

}  // namespace codesign
