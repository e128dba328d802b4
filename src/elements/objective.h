// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/signals.h"

namespace codesign {

/// Signal minus reference.
template <class T>
T signal_error(const StateView<T>& view, const Signal& signal, const Reference<T>& moving) {
  return signal_value(view, signal) - moving.at(view.state->t).value;
}

/// The sum of weight (signal - reference)^2 over terms of the objective: the integrand g or the terminal terms w of theory (21).
template <class T>
T objective_terms(const StateView<T>& view, const std::vector<ResolvedTerm>& terms, const ObjectiveNumbers<T>& numbers) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const T error = signal_error(view, terms[k].signal, numbers.references[k]);
    sum += numbers.weights[k] * error * error;
  }
  return sum;
}

/// Signal minus reference of the k-th watched signal, theory (21a).
template <class T>
T watched_value(const StateView<T>& view, std::size_t k) {
  return signal_error(view, view.system.watched()[k], view.design.watched[k]);
}

}  // namespace codesign
