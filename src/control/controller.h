// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "control/joint_observer.h"
#include "control/reference.h"
#include "control/shaped_input.h"
#include "control/signal.h"
#include "control/signal_filter.h"
#include "description/motion_study.h"
#include "forces/control_law.h"
#include "mechanism/coupling.h"

namespace codesign {

struct RobotDescription;
struct Topology;

/// The numbers of one controller at one design.
template <class T>
struct ControllerConstants {
  Reference<T> setpoint, feedforward;
  Pid<T> pid;
  std::vector<T> gains;                  ///< kStateFeedback: one per term
  std::vector<Reference<T>> references;  ///< kStateFeedback: one per term
  ShapedInput<T> shape;                  ///< kBasis
  JointObserver<T> observer;             ///< kObserver
  /// Numbers of ControlRealization; zero if absent.
  Bounds<T> i_clamp, output_limit, rate_limit;
  T derivative_filter{0.0}, time_constant{0.0};
  T tracking{0.0};  ///< AntiWindup::kBackCalculation: tracking time times gain i, by default p
  /// As Controller::filters: the sections of each of its inputs.
  std::vector<std::vector<FilterSection<T>>> filters;
};

/// Bounds at one design.
template <class T>
Bounds<T> bounds_at(const ControlBounds& bounds, const std::vector<T>& parameters) {
  const T upper = bounds.upper.at(parameters);
  return {bounds.lower ? bounds.lower->at(parameters) : static_cast<T>(-upper), upper,
          !bounds.lower};
}

/// How many inputs of a controller may have filters: its input, or the signals of its feedback.
std::size_t filtered_inputs(const ControllerDescription& description);
/// The filters of the k-th of these inputs.
const std::vector<FilterDescription>& filters_of(const ControllerDescription& description,
                                                 std::size_t k);

/// ControllerConstants::tracking at `parameters`.
template <class T>
T tracking_at(const ControllerDescription& of, const std::vector<T>& parameters) {
  const std::optional<Quantity>& time = of.realization.tracking_time;
  return time ? static_cast<T>(time->at(parameters) * of.i.at(parameters))
              : static_cast<T>(of.p.at(parameters));
}

/// Evaluates a description at `parameters`, all named parameters. The description must outlive the
/// result.
/// @param result new, or of the same description at other parameters; overwritten, its memory is
/// used again.
template <class T>
void controller_constants(const ControllerDescription& description,
                          const std::vector<T>& parameters, ControllerConstants<T>* result) {
  ControllerConstants<T>& c = *result;
  c.setpoint.set(description.setpoint, parameters);
  c.feedforward.set(description.feedforward, parameters);
  c.pid.p = description.p.at(parameters);
  c.pid.i = description.i.at(parameters);
  c.pid.d = description.d.at(parameters);
  c.gains.resize(description.feedback.size());
  c.references.resize(description.feedback.size());
  for (std::size_t k = 0; k < description.feedback.size(); ++k) {
    c.gains[k] = description.feedback[k].gain.at(parameters);
    c.references[k].set(description.feedback[k].reference, parameters);
  }
  const ControlRealization& realization = description.realization;
  if (realization.i_clamp) c.i_clamp = bounds_at(*realization.i_clamp, parameters);
  if (realization.derivative_filter)
    c.derivative_filter = realization.derivative_filter->at(parameters);
  if (realization.output_limit) c.output_limit = bounds_at(*realization.output_limit, parameters);
  if (realization.rate_limit) c.rate_limit = bounds_at(*realization.rate_limit, parameters);
  if (realization.time_constant) c.time_constant = realization.time_constant->at(parameters);
  c.tracking = tracking_at(description, parameters);
  c.filters.resize(filtered_inputs(description));
  for (std::size_t k = 0; k < c.filters.size(); ++k) {
    c.filters[k].clear();
    for (const FilterDescription& filter : filters_of(description, k))
      c.filters[k].push_back(section_of(filter, realization.sample_time, parameters));
  }
  if (description.kind->input == ControlInput::kShape) c.shape.set(description.basis, parameters);
  if (description.kind->input == ControlInput::kObserved)
    c.observer = joint_observer(description.observer, realization.sample_time, parameters);
}
template <class T>
ControllerConstants<T> controller_constants(const ControllerDescription& description,
                                            const std::vector<T>& parameters) {
  ControllerConstants<T> constants;
  controller_constants(description, parameters, &constants);
  return constants;
}

/// A sentence about a number of a controller that is impossible at this design; empty if there is
/// none. Gains may be anything.
std::string find_impossible(const ControllerDescription& description,
                            const ControllerConstants<double>& constants);
/// The same of the numbers of an observer.
std::string find_impossible_observer(const ControllerDescription& description,
                                     const std::vector<double>& parameters);
/// The same of the numbers of its filters, at these values of all named parameters.
std::string find_impossible_filter(const ControllerDescription& description,
                                   const std::vector<double>& parameters);

/// A filter of a controller: index of its first state, and how many it has.
struct FilterPlace {
  int state = -1, order = 0;
};

/// Indices of the extra states of a controller as a robot runs it, theory (49)-(53), or -1.
struct ControllerStates {
  std::vector<std::vector<FilterPlace>> inputs;  ///< the filters of each of its inputs
  int filter = -1;  ///< the filtered error; for a sampled controller the filtered rate of the error
  int last = -1;    ///< sampled: the error at the last sample
  int held = -1;    ///< sampled: the output in effect
  int computed = -1;  ///< sampled with a rate_limit: the output of the last sample
  /// sampled: the first of the waiting outputs, whose number is ControlRealization::queued()
  int queue = -1;
  int lag = -1;       ///< the effort after the lag of the drive
  int estimate = -1;  ///< kObserver: the first of its estimates
  int estimates = 0;  ///< and their number
};

/// Some of the extra states of a controller.
struct StatePlace {
  int first, count;  ///< first is -1 for none
  const char* name;
};

/// A controller with its names resolved to indices; ControlLaw describes the laws.
struct Controller {
  ControllerKind kind = ControllerKind::kPid;
  /// only if kind->has_error(), `input` also of kObserver; input_rate is empty if it is not needed
  Signal input, input_rate;
  std::vector<int> efforts;      ///< kObserver: the controllers whose outputs it counts
  bool has_error_rate = false;   ///< whether the rate of the error is needed
  std::vector<Signal> feedback;  ///< kStateFeedback: one signal per term
  /// the driven coordinate: index in Topology::pairs and in the pair's chain
  int pair = -1, element = -1;
  int state = -1;           ///< index of its integral among the extra states, or -1
  ControllerStates states;  ///< the other states
  /// The rates of signals that the rate of the output needs, theory (54): the rates of `input` and
  /// of `input_rate`, or of `feedback`.
  std::vector<Signal> output_rate;
  bool has_output_rate = false;
  DrivenTree tree;  ///< only of laws with a ControlLoad

  /// Whether its states at the start depend on its input.
  bool has_start() const;
  /// All its states: those of the same study have the same names in the same order.
  std::vector<StatePlace> places(int queued) const;
};

/// Resolves all controllers of a study, in its order.
/// @param observed other signals that may read controllers: the signals of the objective.
/// @param states number of extra states; grows by one for each integral that is needed.
/// @throws InputError for unknown names, signals that a controller cannot read, and joints that it
/// cannot drive.
std::vector<Controller> resolve_controllers(const MotionStudy& study, const RobotDescription& robot,
                                            const Topology& topology,
                                            const std::vector<Signal>& observed, int* states);

}  // namespace codesign
