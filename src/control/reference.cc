// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/reference.h"

#include <algorithm>

#include "codegen/number_types.h"
#include "description/formula.h"

namespace codesign {

template <class T>
void Reference<T>::set(const ReferenceDescription& of, const std::vector<T>& parameters) {
  switch (of.kind) {
    case ReferenceDescription::Kind::kConstant:
      return set_kind<ConstantReference<T>>(&function_, of.constant, parameters);
    case ReferenceDescription::Kind::kSine:
      return set_kind<SineReference<T>>(&function_, of.sine, parameters);
    case ReferenceDescription::Kind::kWaypoints:
      return set_kind<WaypointReference<T>>(&function_, of.waypoints, parameters);
    case ReferenceDescription::Kind::kSampled:
      return set_kind<SampledReference<T>>(&function_, of.sampled, parameters);
    case ReferenceDescription::Kind::kLive:
      return set_kind<LiveReference<T>>(&function_, of.live, parameters);
    case ReferenceDescription::Kind::kIntegral:
      return set_kind<IntegralReference<T>>(&function_, of.integral, parameters);
    case ReferenceDescription::Kind::kExpression:
      return set_kind<ExpressionReference<T>>(&function_, of.expression, parameters);
  }
}

template <class T>
ReferenceMotion<T> Reference<T>::at(double t) const {
  return std::visit([t](const auto& function) { return function.at(t); }, function_);
}

void Reference<Traced>::set(const ReferenceDescription& description,
                            const std::vector<Traced>& parameters) {
  motion_ = {};
  switching_ = nullptr;
  if (description.kind == ReferenceDescription::Kind::kConstant) {
    motion_.value = description.constant.at(parameters);
    return;
  }
  Recording* const recording = parameters.front().recording();
  const auto order = [&](int k) {
    return Traced(recording, recording->timed(SourceId(description), k));
  };
  is_integral_ = description.kind == ReferenceDescription::Kind::kIntegral;
  const ReferenceDescription& rate = is_integral_ ? *description.integral.rate : description;
  if (rate.kind == ReferenceDescription::Kind::kExpression && !rate.expression.parameters.empty()) {
    record(rate.expression, parameters);
    if (is_integral_) motion_.value = order(0);
    return;
  }
  motion_ = {order(0), order(1), order(2), order(3)};
}

void Reference<Traced>::record(const TimeExpression& expression,
                               const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  const Traced t(recording, recording->timed(SourceId(clock_function()), 0));
  variables_.clear();
  for (const auto& parameter : expression.parameters)
    variables_.push_back(parameter ? Taylor<Traced>(value_at(*parameter, parameters))
                                   : Taylor<Traced>::time(t));
  switching_ = expression.formula.get();
}

ReferenceMotion<Traced> Reference<Traced>::recorded() const {
  const auto time = std::find_if(variables_.begin(), variables_.end(),
                                 [](const auto& variable) { return !variable.c[0].is_literal(); });
  const NamedSwitches<Traced> named(time->c[0], *switching_);
  const Taylor<Traced> f = evaluate_formula<Taylor<Traced>>(switching_->steps(), variables_);
  if (is_integral_) return {motion_.value, f.c[0], f.c[1], 2.0 * f.c[2]};
  return {f.c[0], f.c[1], 2.0 * f.c[2], 6.0 * f.c[3]};
}

#define CODESIGN_INSTANTIATE(T) template class Reference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
