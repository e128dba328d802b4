// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/sampled_reference.h"

#include "codegen/number_types.h"

namespace codesign {

template <class T>
void SampledReference<T>::set(const SampledDescription& sampled, const std::vector<T>& parameters) {
  samples_ = sampled.samples;
  scale_ = sampled.scale.at(parameters);
  delay_ = sampled.delay.at(parameters);
  offset_ = sampled.offset.at(parameters);
}

// The first-order part of the delay is carried by the slope of f.
template <class T>
ReferenceMotion<T> SampledReference<T>::at(double t) const {
  const double delay = value_of(delay_);
  const T moved = delay_ - T(delay);
  const SampledFunction::Sample sample = samples_->at(t + delay);
  ReferenceMotion<T> motion;
  motion.value = scale_ * (T(sample.value) + T(sample.slope) * moved) - offset_;
  motion.rate = scale_ * (T(sample.slope) + T(sample.second) * moved);
  motion.acceleration = scale_ * (T(sample.second) + T(sample.third) * moved);
  motion.jerk = scale_ * T(sample.third);
  return motion;
}

#define CODESIGN_INSTANTIATE(T) template class SampledReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
