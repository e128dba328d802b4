// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/live_reference.h"

#include "codegen/number_types.h"
#include "control/reference.h"
#include "control/time_polynomial.h"

namespace codesign {

template <class T>
void LiveReference<T>::set(const LiveDescription& live, const std::vector<T>& parameters) {
  function_ = live.function;
  planned_ = std::make_shared<const Reference<T>>(*live.planned, parameters);
}

template <class T>
ReferenceMotion<T> LiveReference<T>::at(double t) const {
  return function_->commanded ? commanded_at(*function_, t) : planned_->at(t);
}

template <class T>
ReferenceMotion<T> LiveReference<T>::commanded_at(const LiveFunction& function, double t) {
  TimePolynomial<T> polynomial{function.start, {}};
  for (std::size_t k = 0; k < polynomial.c.size(); ++k) polynomial.c[k] = T(function.c[k]);
  return polynomial.at(t);
}

#define CODESIGN_INSTANTIATE(T) template class LiveReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
