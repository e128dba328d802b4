// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_INTERACTIVE_SIMULATION_H_
#define MECHANISM_CODESIGN_INTEGRATION_INTERACTIVE_SIMULATION_H_

#include <atomic>
#include <memory>
#include <vector>

#include "control/reference.h"
#include "integration/command_inputs.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// A run whose inputs and parameters change while it goes on, as a robot's do: set_effort(), set_course(), then apply() at an instant.
/// Without commands it takes the steps of a Simulation; once there was one, steps end at the times that advance() is given. It has a system
/// of its own. Not thread-safe.
class InteractiveSimulation {
 public:
  /// @throws InputError as CommandInputs and Simulation.
  InteractiveSimulation(const CompiledSystem& of, const CommandOptions& options, const std::vector<SignalDescription>& signals);

  const CommandInputs& inputs() const { return inputs_; }
  double duration() const { return inputs_.study.duration; }
  /// The names of frames; controllers have the names of the study.
  const FrameNames& names() const { return names_; }
  const std::vector<double>& parameters() const { return parameters_; }

  /// Begins at t = 0 without commands. @param parameters all named ones. @returns as Simulation::start(); after a failure the run must be
  /// started again.
  Status start(const std::vector<double>& parameters);
  /// Simulation::advance(), over the instants at which pieces of courses begin.
  Status advance(double time);
  void sample(double time, Frame* frame);

  /// Sets what apply() brings into effect. @param joint, controller indices in inputs(). @param effort [N or N m], held until the next one.
  void set_effort(std::size_t joint, double effort);
  /// @param course of a set-point, in the unit of the controller's input; replaces the one before, from its first piece on.
  void set_course(std::size_t controller, const Course& course);
  /// Brings commands into effect at `time`, at which the last advance() ended; without new ones nothing happens.
  Status apply(double time);
  /// Changes the parameters at `time`, as Simulation::go_on().
  Status change(double time, const std::vector<double>& parameters);

  double effort(std::size_t joint) const { return inputs_.efforts[joint]->c[0]; }
  /// The set-point of a controller and its rates at `time` [s], now or later, if no other course is set.
  ReferenceMotion<double> setpoint(std::size_t controller, double time) const;
  /// Whether a set-point is commanded, not the study's.
  bool is_commanded(std::size_t controller) const { return inputs_.setpoints[controller]->commanded; }

  /// As Simulation::obey(), for later runs too.
  void obey(const std::atomic<bool>* cancel);
  const Statistics& statistics() const { return simulation_->statistics(); }
  const Warnings& warnings() const { return simulation_->warnings(); }

 private:
  double next_piece() const;
  bool take_pieces(double time);

  CommandInputs inputs_;
  std::vector<SignalDescription> signals_;
  std::shared_ptr<const CompiledSystem> system_;
  std::vector<double> parameters_;
  std::unique_ptr<Simulation> simulation_;
  FrameNames names_;
  std::vector<Course> courses_;  ///< per set-point: the pieces that are yet to begin
  const std::atomic<bool>* cancel_ = nullptr;
  double now_ = 0.0;  ///< [s] of the last advance()
  bool was_commanded_ = false, has_news_ = false;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_INTERACTIVE_SIMULATION_H_
