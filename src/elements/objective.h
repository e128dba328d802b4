// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_OBJECTIVE_H_
#define MECHANISM_CODESIGN_ELEMENTS_OBJECTIVE_H_

#include "elements/signals.h"

namespace codesign {

/// Signal minus reference. Appends its gradient if requested, including the part by time of moving references.
template <class T>
T signal_error(const StateView<T>& view, const Signal& signal, const Reference<T>& moving, OptionalGradient<T> gradient) {
  const ReferenceMotion<T> reference = moving.at(view.state->t);
  const T error = signal_value(view, signal, T(1.0), gradient) - reference.value;
  if (gradient) gradient->time -= reference.rate;
  return error;
}

/// The sum of weight (signal - reference)^2 over terms of the objective: the integrand g or the terminal terms w of theory (21). Appends
/// its gradient if requested.
template <class T>
T objective_terms(const StateView<T>& view, const std::vector<ResolvedTerm>& terms, const ObjectiveNumbers<T>& numbers,
                  OptionalGradient<T> gradient) {
  T sum(0.0);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto before = mark(gradient);
    const T error = signal_error(view, terms[k].signal, numbers.references[k], gradient);
    sum += numbers.weights[k] * error * error;
    if (gradient) gradient->scale_from(before, T(2.0 * numbers.weights[k] * error));
  }
  return sum;
}

/// Signal minus reference of the k-th watched signal, theory (21a). Appends its gradient if requested.
template <class T>
T watched_value(const StateView<T>& view, std::size_t k, OptionalGradient<T> gradient) {
  return signal_error(view, view.system.watched()[k], view.design.watched[k], gradient);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_OBJECTIVE_H_
