// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "control/course.h"
#include "integration/command_inputs.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// A run whose inputs and parameters can change during the run, as on a robot: set_effort(),
/// set_course(), then apply() at an instant. Without commands it takes the same steps as a
/// Simulation; after the first command or change, steps end at the times given to advance(). It has
/// a system of its own. Not thread-safe.
class InteractiveSimulation {
 public:
  /// @throws InputError as CommandInputs and Simulation.
  InteractiveSimulation(const CompiledSystem& of, const CommandOptions& options,
                        const std::vector<SignalDescription>& signals);

  const CommandInputs& inputs() const { return inputs_; }
  /// Of the longest run [s].
  double duration() const { return inputs_.study.duration; }
  /// As Simulation::end(), after start().
  double end() const { return simulation_->end(); }
  /// Whether the last advance() has reached the end of a run that ends by itself. A step may have
  /// found it before; a command until then can still move it.
  bool has_ended() const { return simulation_->has_ended() && now_ >= simulation_->time(); }
  /// The names of frames; controllers have the names of the study.
  const FrameNames& names() const { return names_; }
  const std::vector<double>& parameters() const { return parameters_; }

  /// Begins at t = 0 without commands. @param parameters all named parameters. @returns as
  /// Simulation::start(); after a failure the run must be started again.
  Status start(const std::vector<double>& parameters);
  /// As Simulation::advance(); steps end at the instants at which pieces of courses begin.
  Status advance(double time);
  void sample(double time, Frame* frame);

  /// Sets an effort, which takes effect with apply(). @param joint, controller indices in inputs().
  /// @param effort [N or N m], held until the next effort.
  void set_effort(std::size_t joint, double effort);
  /// @param course of a set-point, in the unit of the controller's input; from its first piece on,
  /// it replaces the previous course.
  void set_course(std::size_t controller, const Course& course);
  /// Applies the new commands, if there are any, at `time`, at which the last advance() ended.
  Status apply(double time);
  /// Changes the parameters at `time`, as Simulation::go_on().
  Status change(double time, const std::vector<double>& parameters);

  double effort(std::size_t joint) const { return inputs_.efforts[joint]->c[0]; }
  /// The set-point of a controller and its rates at `time` [s], now or later, if no other course is
  /// set.
  ReferenceMotion<double> setpoint(std::size_t controller, double time) const;
  /// Whether a command has replaced the set-point of the study.
  bool is_commanded(std::size_t controller) const {
    return inputs_.setpoints[controller]->commanded;
  }

  /// As Simulation::obey(), also for later runs.
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
  std::vector<Course> courses_;  ///< per set-point: the pieces that have not begun yet
  const std::atomic<bool>* cancel_ = nullptr;
  double now_ = 0.0;  ///< time of the last advance() [s]
  bool was_commanded_ = false, has_news_ = false;
};

}  // namespace codesign
