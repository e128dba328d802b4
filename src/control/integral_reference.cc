// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/reference.h"

#include <stdexcept>

#include "codegen/number_types.h"

namespace codesign {

template <class T>
void IntegralReference<T>::set(const IntegralDescription& integral,
                               const std::vector<T>& parameters) {
  using Kind = ReferenceDescription::Kind;
  const ReferenceDescription& rate = *integral.rate;
  switch (rate.kind) {
    case Kind::kConstant:
      set_kind<ConstantReference<T>>(&rate_, rate.constant, parameters);
      break;
    case Kind::kSine:
      set_kind<SineReference<T>>(&rate_, rate.sine, parameters);
      break;
    case Kind::kWaypoints:
      set_kind<WaypointReference<T>>(&rate_, rate.waypoints, parameters);
      break;
    case Kind::kExpression:
      set_kind<ExpressionReference<T>>(&rate_, rate.expression, parameters);
      break;
    case Kind::kSampled:
    case Kind::kLive:
    case Kind::kIntegral:
      throw std::logic_error("a function of time of this kind has no integral");
  }
  std::visit([&](auto& function) { function.prepare_integral(integral.duration); }, rate_);
  start_ = integral.start.at(parameters);
}

template <class T>
ReferenceMotion<T> IntegralReference<T>::at(double t) const {
  ReferenceMotion<T> motion =
      std::visit([t](const auto& function) { return function.integral_at(t); }, rate_);
  motion.value = start_ + motion.value;
  return motion;
}

#define CODESIGN_INSTANTIATE(T) template class IntegralReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
