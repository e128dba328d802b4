// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/signal_filter.h"
#include "elements/state_view.h"
#include "math/arrays.h"

// What controllers read: signals behind their filters, theory (49).
namespace codesign {

// Defined in elements/signals.h. Declared here because controllers read signals and signals read
// controllers.
template <class T>
T signal_value(const StateView<T>& view, const Signal& signal);

/// How a robot runs a controller.
template <class T>
const ControlRealization& realization_of(const StateView<T>& view, int controller) {
  return view.system.study().controllers[to_index(controller)].realization;
}

/// The filters of one input of a controller with their states.
template <class T>
struct FilterChain {
  FilterChain(const StateView<T>& view, int controller, std::size_t input, const VectorX<T>& s)
      : places(view.controller(controller).states.inputs[input]),
        sections(view.controller_numbers(controller).filters[input]),
        states(s) {}

  /// The output of all with this input. @param visit (section, place, its input, its output)
  template <class Visit>
  T output(T u, const Visit& visit) const {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      const T y = sections[k].output(u, T(states[places[k].state]));
      visit(sections[k], places[k], u, y);
      u = y;
    }
    return u;
  }
  T output(const T& u) const {
    return output(u, [](const auto&...) {});
  }

  /// What the states of a section go to: (x1, x2), x2 only of a second order.
  std::pair<T, T> next(const FilterSection<T>& section, const FilterPlace& place, const T& u,
                       const T& y) const {
    const T x2 = place.order == 2 ? T(states[place.state + 1]) : T(0.0);
    return {section.first(u, y, x2), section.second(u, y)};
  }

  const std::vector<FilterPlace>& places;
  const std::vector<FilterSection<T>>& sections;
  const VectorX<T>& states;
};

/// The input x of a controller with an error, behind its filters.
template <class T>
T control_input(const StateView<T>& view, int controller) {
  const T raw = signal_value(view, view.controller(controller).input);
  return FilterChain<T>(view, controller, 0, view.state->s).output(raw);
}

/// The signal of one term of state feedback behind its filters.
template <class T>
T feedback_input(const StateView<T>& view, int controller, std::size_t term) {
  const T raw = signal_value(view, view.controller(controller).feedback[term]);
  return FilterChain<T>(view, controller, term, view.state->s).output(raw);
}

/// The rate of an input of a continuous controller behind its filters, y' = direct u' + x1'.
/// @param raw the input before them. @param raw_rate its rate; not read if a filter lets no steps
/// pass.
template <class T>
T filtered_rate(const StateView<T>& view, int controller, std::size_t input, const T& raw,
                const T& raw_rate) {
  T rate = raw_rate;
  const FilterChain<T> chain(view, controller, input, view.state->s);
  chain.output(raw, [&](const auto& section, const FilterPlace& place, const T& u, const T& y) {
    rate = section.direct * rate + chain.next(section, place, u, y).first;
  });
  return rate;
}

/// x', the rate of control_input() of a continuous controller.
template <class T>
T control_input_rate(const StateView<T>& view, int controller) {
  const Controller& resolved = view.controller(controller);
  const T raw_rate = resolved.input_rate.empty() ? T(0.0) : signal_value(view, resolved.input_rate);
  if (resolved.states.inputs.front().empty()) return raw_rate;
  return filtered_rate(view, controller, 0, signal_value(view, resolved.input), raw_rate);
}

/// The raw signals of the inputs of a controller, in the order of Controller's states.inputs.
inline const Signal& input_of(const Controller& controller, std::size_t input) {
  return controller.kind->has_error() ? controller.input : controller.feedback[input];
}

/// The rates of the filters' states. @param set (state, rate)
template <class T, class Set>
void filter_residual(const StateView<T>& view, int controller, const Set& set) {
  const Controller& resolved = view.controller(controller);
  const bool is_sampled = realization_of(view, controller).is_sampled();
  for (std::size_t input = 0; input < resolved.states.inputs.size(); ++input) {
    if (resolved.states.inputs[input].empty()) continue;
    const FilterChain<T> chain(view, controller, input, view.state->s);
    const T raw = signal_value(view, input_of(resolved, input));
    chain.output(raw, [&](const auto& section, const FilterPlace& place, const T& u, const T& y) {
      const auto [first, second] = chain.next(section, place, u, y);
      set(place.state, is_sampled ? T(0.0) : first);
      if (place.order == 2) set(place.state + 1, is_sampled ? T(0.0) : second);
    });
  }
}

// The observer of a joint, theory (49a).

/// Its k-th estimate: position, velocity, disturbance.
template <class T>
T estimate(const StateView<T>& view, int controller, int k) {
  return view.state->s[view.controller(controller).states.estimate + k];
}

/// e = y - x of (49a).
template <class T>
T innovation(const StateView<T>& view, int controller) {
  return signal_value(view, view.controller(controller).input) - estimate(view, controller, 0);
}

}  // namespace codesign
