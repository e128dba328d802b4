// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/control_clock.h"
#include "control/sampled_pid.h"
#include "elements/controllers.h"
#include "math/arrays.h"

namespace codesign {

// The jumps of a sampled controller's states, theory (51), (52). Each function reads a loaded view
// and writes to `s`, the extra states of the state that is loaded, so that a later event at the
// same instant reads the result of an earlier one.

/// An input as it is measured, before its filters: rounded to a multiple of the quantization if
/// there is one.
template <class T>
T measured_input(const StateView<T>& view, int controller, std::size_t input) {
  const T raw = signal_value(view, input_of(view.controller(controller), input));
  const double quantum = realization_of(view, controller).quantization;
  if (!(quantum > 0.0)) return raw;
  return T(quantum) * nearest_integer(T(raw / T(quantum)));
}

/// The measured input's error: setpoint minus the filtered input.
template <class T>
T measured_error(const StateView<T>& view, int controller, const VectorX<T>& s) {
  const T input =
      FilterChain<T>(view, controller, 0, s).output(measured_input(view, controller, 0));
  return view.controller_numbers(controller).setpoint.at(view.state->t).value - input;
}

/// Sets the filters of a controller at rest with their inputs: at the start.
template <class T>
void begin_filters(const StateView<T>& view, int controller, VectorX<T>* s) {
  const bool is_sampled = realization_of(view, controller).is_sampled();
  const Controller& resolved = view.controller(controller);
  for (std::size_t input = 0; input < resolved.states.inputs.size(); ++input) {
    const FilterChain<T> chain(view, controller, input, *s);
    if (chain.places.empty()) continue;
    const T u = measured_input(view, controller, input);
    for (std::size_t k = 0; k < chain.places.size(); ++k) {
      const FilterRest<T> rest = rest_of(chain.sections[k], is_sampled, u);
      (*s)[chain.places[k].state] = rest.x1;
      if (chain.places[k].order == 2) (*s)[chain.places[k].state + 1] = rest.x2;
    }
  }
}

/// Carries the filters of a sampled controller over one sample.
template <class T>
void advance_filters(const StateView<T>& view, int controller, VectorX<T>* s) {
  const Controller& resolved = view.controller(controller);
  for (std::size_t input = 0; input < resolved.states.inputs.size(); ++input) {
    const FilterChain<T> chain(view, controller, input, *s);
    if (chain.places.empty()) continue;
    chain.output(measured_input(view, controller, input),
                 [&](const auto& section, const FilterPlace& place, const T& u, const T& y) {
                   const auto [first, second] = chain.next(section, place, u, y);
                   (*s)[place.state] = first;
                   if (place.order == 2) (*s)[place.state + 1] = second;
                 });
  }
}

/// The output of a PID at a sample, before its limit; updates its memory.
template <class T>
T sampled_pid_output(const StateView<T>& view, int controller, bool is_first, VectorX<T>* s) {
  const Controller& resolved = view.controller(controller);
  const ControllerConstants<T>& k = view.controller_numbers(controller);
  const ControlRealization& realization = realization_of(view, controller);
  const auto read = [s](int state) { return state < 0 ? T(0.0) : T((*s)[state]); };
  const auto write = [s](int state, const T& value) {
    if (state >= 0) (*s)[state] = value;
  };
  SampledPidMemory<T> memory{read(resolved.state), read(resolved.states.last),
                             read(resolved.states.filter)};
  const SampledPidNumbers<T> numbers{k.pid,
                                     realization.sample_time,
                                     k.derivative_filter,
                                     realization.i_clamp ? &k.i_clamp : nullptr,
                                     realization.antiwindup,
                                     realization.output_limit ? &k.output_limit : nullptr,
                                     k.tracking};
  const T error = measured_error(view, controller, *s);
  const T rated = realization.rates_input ? T(error - k.setpoint.at(view.state->t).value) : error;
  const T output = sample_pid(numbers, error, rated, is_first, &memory);
  write(resolved.state, memory.integral);
  write(resolved.states.last, memory.last_error);
  write(resolved.states.filter, memory.error_rate);
  return output;
}

/// u_k of a sample, u_(k-1) + T times rate_limit at most, theory (53a); updates its memory. The
/// first sample has none before it.
template <class T>
T within_rate(const StateView<T>& view, int controller, bool is_first, const T& output,
              VectorX<T>* s) {
  const int computed = view.controller(controller).states.computed;
  if (computed < 0) return output;
  const Bounds<T>& rate = view.controller_numbers(controller).rate_limit;
  const T period(realization_of(view, controller).sample_time);
  T next = output;
  if (!is_first)
    next = (*s)[computed] + clamp(T(output - (*s)[computed]),
                                  {period * rate.lower, period * rate.upper, rate.is_symmetric});
  (*s)[computed] = next;
  return next;
}

/// The innovation of an observer at a sample, by which it corrects its estimates in `s`, theory
/// (49a). At the start, `is_first`, they are those of rest in the measured position; 0.
template <class T>
T sample_observer(const StateView<T>& view, int controller, bool is_first, VectorX<T>* s) {
  const Controller& resolved = view.controller(controller);
  const JointObserver<T>& k = view.controller_numbers(controller).observer;
  const int first = resolved.states.estimate;
  const T measured = signal_value(view, resolved.input);
  if (is_first) {
    (*s)[first] = measured;
    for (int other = 1; other < resolved.states.estimates; ++other) (*s)[first + other] = T(0.0);
    return T(0.0);
  }
  const T e = measured - (*s)[first];
  for (int other = 0; other < resolved.states.estimates; ++other) {
    const T unit = other == 2 ? k.inertia : T(1.0);
    (*s)[first + other] += T(unit * k.gains[to_index(other)] * e);
  }
  return e;
}

/// The output of a controller at a sample, within its limit; updates its memory in `s`. At the
/// start of a continuous controller, `is_first`, its filters are set at rest; 0.
/// @param s of the loaded state itself.
template <class T>
T sample_controller(const StateView<T>& view, int controller, bool is_first, VectorX<T>* s) {
  if (view.controller(controller).states.estimate >= 0)
    return sample_observer(view, controller, is_first, s);
  if (is_first) begin_filters(view, controller, s);
  if (!realization_of(view, controller).is_sampled()) {
    const int filter = view.controller(controller).states.filter;
    if (filter >= 0) (*s)[filter] = rated_error(view, controller);
    return T(0.0);
  }
  const T output = view.controller(controller).kind->is_pid
                       ? sampled_pid_output(view, controller, is_first, s)
                       : law_output(view, controller);
  advance_filters(view, controller, s);
  return within_rate(view, controller, is_first,
                     realization_of(view, controller).output_limit
                         ? clamp(output, view.controller_numbers(controller).output_limit)
                         : output,
                     s);
}

/// The extra state that an event writes an output to (kSample) or reads one from (kApply): the
/// output in effect, or a place in the queue of delayed ones.
inline int output_state(const System& system, const ControlEvent& event) {
  const auto c = to_index(event.controller);
  const ControllerStates& states = system.controllers()[c].states;
  const int queued = system.study().controllers[c].realization.queued();
  return queued == 0 ? states.held : states.queue + static_cast<int>(event.sample % queued);
}

/// Carries the extra states over one event. @param sample (controller, is_first) -> its output at a
/// sample; it updates the memory in `s`.
template <class T, class Sample>
void jump_controller(const System& system, const ControlEvent& event, const Sample& sample,
                     VectorX<T>* s) {
  const int place = output_state(system, event);
  if (event.kind == ControlEvent::Kind::kApply)
    (*s)[system.controllers()[to_index(event.controller)].states.held] = T((*s)[place]);
  else
    (*s)[place] = sample(event.controller, event.sample == 0);
}

/// The start of a controller at t = 0: its filters are at rest, and a sampled one takes its first
/// sample. @param sample as of jump_controller().
template <class T, class Sample>
void begin_controller(const System& system, int controller, const Sample& sample, VectorX<T>* s) {
  const Controller& resolved = system.controllers()[to_index(controller)];
  if (resolved.states.held >= 0)
    jump_controller(system, {ControlEvent::Kind::kSample, controller, 0}, sample, s);
  else if (resolved.has_start())
    sample(controller, true);
}

}  // namespace codesign
