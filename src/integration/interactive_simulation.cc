// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/interactive_simulation.h"
#include "integration/simulation_of.h"

#include <algorithm>
#include <limits>

#include "math/arrays.h"

namespace codesign {

InteractiveSimulation::InteractiveSimulation(const CompiledSystem& of,
                                             const CommandOptions& options,
                                             const std::vector<SignalDescription>& signals)
    : inputs_(of, options),
      signals_(signals),
      system_(std::make_shared<const CompiledSystem>(of.robot(), inputs_.study, of.sharing())),
      parameters_(of.parameters()),
      simulation_(std::make_unique<Simulation>(simulation_of(system_, parameters_, signals_))),
      names_(simulation_->names()),
      courses_(inputs_.setpoints.size()) {
  names_.controllers.erase(names_.controllers.begin(),
                           names_.controllers.begin() + to_signed(inputs_.joints.size()));
}

Status InteractiveSimulation::start(const std::vector<double>& parameters) {
  for (const auto* functions : {&inputs_.efforts, &inputs_.setpoints})
    for (const std::shared_ptr<LiveFunction>& function : *functions) *function = {};
  for (Course& course : courses_) course.clear();
  was_commanded_ = has_news_ = false;
  now_ = 0.0;
  if (parameters != parameters_) {
    parameters_ = parameters;
    simulation_ = std::make_unique<Simulation>(simulation_of(system_, parameters_, signals_));
    simulation_->obey(cancel_);
  }
  return simulation_->start();
}

void InteractiveSimulation::obey(const std::atomic<bool>* cancel) {
  cancel_ = cancel;
  simulation_->obey(cancel);
}

double InteractiveSimulation::next_piece() const {
  double next = std::numeric_limits<double>::infinity();
  for (const Course& course : courses_)
    if (!course.empty()) next = std::min(next, course.front().start);
  return next;
}

// Of several pieces that have begun the last one is in effect.
bool InteractiveSimulation::take_pieces(double time) {
  bool taken = false;
  for (std::size_t k = 0; k < courses_.size(); ++k) {
    Course& course = courses_[k];
    const auto later =
        std::find_if(course.begin(), course.end(),
                     [time](const LiveFunction& piece) { return piece.start > time; });
    if (later == course.begin()) continue;
    *inputs_.setpoints[k] = *std::prev(later);
    course.erase(course.begin(), later);
    taken = true;
  }
  return taken;
}

Status InteractiveSimulation::advance(double time) {
  for (double next = next_piece(); next < time; next = next_piece()) {
    now_ = std::max(next, now_);
    if (Status status = simulation_->advance_to(now_); !status.ok()) return status;
    was_commanded_ = true;
    take_pieces(now_);
    if (Status status = simulation_->go_on(now_, parameters_); !status.ok()) return status;
  }
  now_ = time;
  return was_commanded_ ? simulation_->advance_to(time) : simulation_->advance(time);
}

void InteractiveSimulation::sample(double time, Frame* frame) {
  simulation_->sample(time, frame);
  frame->controllers.erase(frame->controllers.begin(),
                           frame->controllers.begin() + to_signed(inputs_.joints.size()));
}

void InteractiveSimulation::set_effort(std::size_t joint, double effort) {
  *inputs_.efforts[joint] = held(effort, 0.0).front();
  has_news_ = true;
}

void InteractiveSimulation::set_course(std::size_t controller, const Course& course) {
  Course& pieces = courses_[controller];
  const auto replaced = std::find_if(pieces.begin(), pieces.end(), [&](const LiveFunction& piece) {
    return piece.start >= course.front().start;
  });
  pieces.erase(replaced, pieces.end());
  pieces.insert(pieces.end(), course.begin(), course.end());
  has_news_ = true;
}

Status InteractiveSimulation::apply(double time) {
  const bool begins = take_pieces(time);
  if (!begins && !has_news_) return {};
  has_news_ = false;
  was_commanded_ = true;
  return simulation_->go_on(time, parameters_);
}

Status InteractiveSimulation::change(double time, const std::vector<double>& parameters) {
  const Status status = simulation_->go_on(time, parameters);
  if (!status.ok()) return status;
  parameters_ = parameters;
  was_commanded_ = true;
  return status;
}

ReferenceMotion<double> InteractiveSimulation::setpoint(std::size_t controller, double time) const {
  const std::size_t index = inputs_.joints.size() + inputs_.indices[controller];
  ReferenceDescription description = system_->study().controllers[index].setpoint;
  for (const LiveFunction& piece : courses_[controller])
    if (piece.start <= time)
      description.live.function = std::make_shared<const LiveFunction>(piece);
  return Reference<double>(description, parameters_).at(time);
}

}  // namespace codesign
