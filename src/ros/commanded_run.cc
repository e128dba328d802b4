// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/commanded_run.h"

#include <algorithm>

namespace codesign {

void CommandedRun::clear() {
  last_effort_.reset();
  timed_out_ = false;
}

void CommandedRun::take(const EffortCommand& command, double time) {
  for (const auto& [joint, effort] : command.efforts) run_->set_effort(joint, effort);
  last_effort_ = time;
  timed_out_ = false;
}

void CommandedRun::take(const SetpointCommand& command, double time) { run_->set_course(command.controller, held(command.value, time)); }

void CommandedRun::take(const TrajectoryCommand& command, const Frame& frame, const RunClock& clock) {
  const double begin = command.begin.isZero() ? frame.time : clock.time_of(command.begin);
  for (const JointCourse& course : command.joints) follow(course, begin, frame);
}

// If the set-point is a velocity, the trajectory begins at the measured position.
void CommandedRun::follow(const JointCourse& course, double begin, const Frame& frame) {
  const std::vector<std::string>& joints = run_->names().joints;
  const auto found = std::find(joints.begin(), joints.end(), course.joint);
  const double position = found == joints.end() ? 0.0 : frame.joints[static_cast<std::size_t>(found - joints.begin())].position;
  const auto [controller, by_rate] = course.follower;
  if (course.points.empty()) return run_->set_course(controller, held(by_rate ? 0.0 : position, frame.time));
  const double now = std::max(begin, frame.time);
  const ReferenceMotion<double> in_effect = run_->setpoint(controller, now);
  const Knot<double> from = by_rate ? Knot<double>{position, in_effect.value, in_effect.rate}
                                    : Knot<double>{in_effect.value, in_effect.rate, in_effect.acceleration};
  std::vector<CoursePoint> points = course.points;
  for (CoursePoint& point : points) point.time += begin;
  const Course pieces = trajectory_course(points, now, from);
  run_->set_course(controller, by_rate ? rate_of(pieces) : pieces);
}

bool CommandedRun::end_efforts(double time) {
  if (!(timeout_ > 0.0) || timed_out_ || !last_effort_ || time - *last_effort_ < timeout_ * (1.0 - 1e-9)) return false;
  for (std::size_t joint = 0; joint < run_->inputs().joints.size(); ++joint) run_->set_effort(joint, 0.0);
  timed_out_ = true;
  return true;
}

CommandedRun::Outcome CommandedRun::apply(const std::vector<Command>& commands, const Frame& frame, const RunClock& clock) {
  struct Take {
    CommandedRun* run;
    const Frame& frame;
    const RunClock& clock;
    void operator()(const EffortCommand& command) const { run->take(command, frame.time); }
    void operator()(const SetpointCommand& command) const { run->take(command, frame.time); }
    void operator()(const TrajectoryCommand& command) const { run->take(command, frame, clock); }
  };
  for (const Command& command : commands) std::visit(Take{this, frame, clock}, command);
  const bool ended = end_efforts(frame.time);
  return {run_->apply(frame.time), ended || !commands.empty()};
}

mechanism_codesign::Commands CommandedRun::message(double time) const {
  mechanism_codesign::Commands message;
  const CommandInputs& inputs = run_->inputs();
  message.joints = inputs.joints;
  for (std::size_t k = 0; k < inputs.joints.size(); ++k) message.efforts.push_back(run_->effort(k));
  for (std::size_t k = 0; k < inputs.controllers.size(); ++k) {
    if (!run_->is_commanded(k)) continue;
    const ReferenceMotion<double> setpoint = run_->setpoint(k, time);
    message.controllers.push_back(inputs.controllers[k]);
    message.setpoints.push_back(setpoint.value);
    message.setpoint_rates.push_back(setpoint.rate);
  }
  return message;
}

}  // namespace codesign
