// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/sine_reference.h"

#include <cmath>

#include "codegen/number_types.h"

namespace codesign {

template <class T>
void ConstantReference<T>::set(const Quantity& constant, const std::vector<T>& parameters) {
  value_ = constant.at(parameters);
}

template <class T>
ReferenceMotion<T> ConstantReference<T>::at(double) const {
  ReferenceMotion<T> motion;
  motion.value = value_;
  return motion;
}

template <class T>
ReferenceMotion<T> ConstantReference<T>::integral_at(double t) const {
  ReferenceMotion<T> motion;
  motion.value = value_ * t;
  motion.rate = value_;
  return motion;
}

template <class T>
void SineReference<T>::set(const SineDescription& sine, const std::vector<T>& parameters) {
  const T frequency = sine.frequency.at(parameters);
  offset_ = sine.offset.at(parameters);
  amplitude_ = sine.amplitude.at(parameters);
  phase_ = sine.phase.at(parameters);
  angular_frequency_ = sine.is_period ? T(2.0 * M_PI) / frequency : T(2.0 * M_PI) * frequency;
}

template <class T>
ReferenceMotion<T> SineReference<T>::at(double t) const {
  using std::cos;
  using std::sin;
  const T angle = angular_frequency_ * T(t) + phase_, s = amplitude_ * sin(angle),
          c = amplitude_ * cos(angle);
  const T square = angular_frequency_ * angular_frequency_;
  return {offset_ + s, angular_frequency_ * c, -(square * s), -(square * angular_frequency_ * c)};
}

template <class T>
ReferenceMotion<T> SineReference<T>::integral_at(double t) const {
  using std::cos;
  const ReferenceMotion<T> rate = at(t);
  const T area = offset_ * t + amplitude_ / angular_frequency_ *
                                   (cos(phase_) - cos(angular_frequency_ * T(t) + phase_));
  return {area, rate.value, rate.rate, rate.acceleration};
}

#define CODESIGN_INSTANTIATE(T)        \
  template class ConstantReference<T>; \
  template class SineReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
