// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTROLLERS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTROLLERS_H_

#include "equations/equations.h"

namespace codesign {

// The laws of control, theory (C1)-(C8). Their gradients by time are what the setpoints' motion brings in.

template <class T>
T Equations<T>::controller_error(int controller, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  if (!has_error(system_.controllers()[c].kind)) return T(0.0);
  const ReferenceMotion<T> setpoint = controllers_[c].setpoint.at(state_->t);
  if (gradient) gradient->time += setpoint.rate;
  return setpoint.value + signal_value(system_.controllers()[c].input, T(-1.0), gradient);
}

template <class T>
T Equations<T>::controller_error_rate(int controller, const T& factor, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ReferenceMotion<T> setpoint = controllers_[c].setpoint.at(state_->t);
  if (gradient) gradient->time += factor * setpoint.acceleration;
  return factor * setpoint.rate + signal_value(system_.controllers()[c].input_rate, T(-factor), gradient);
}

template <class T>
T Equations<T>::controller_output(int controller, SparseGradient<T>* gradient) {
  switch (system_.controllers()[static_cast<std::size_t>(controller)].kind) {
    case ControllerKind::kPid:
      return pid(controller, gradient);
    case ControllerKind::kPdGravity: {
      // In this order for every scalar, as the gradient's entries are found again by it.
      const T feedback = pid(controller, gradient);
      return feedback + inverse_dynamics(controller, nullptr, gradient);
    }
    case ControllerKind::kComputedTorque:
      return computed_torque(controller, gradient);
    case ControllerKind::kStateFeedback:
      return state_feedback(controller, gradient);
    case ControllerKind::kBasis:
      break;
  }
  return shaped_input(controller, gradient);
}

template <class T>
T Equations<T>::pid(int controller, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const Controller& resolved = system_.controllers()[c];
  const ControllerConstants<T>& k = controllers_[c];
  const ReferenceMotion<T> setpoint = k.setpoint.at(state_->t);
  T output = k.p * setpoint.value + signal_value(resolved.input, T(-k.p), gradient);
  if (gradient) gradient->time += k.p * setpoint.rate;
  if (resolved.state >= 0) {
    output += k.i * state_->s[resolved.state];
    if (gradient) gradient->position.push_back({layout_.position_column(resolved.state), k.i});
  }
  if (!resolved.input_rate.empty()) output += controller_error_rate(controller, k.d, gradient);
  return output;
}

template <class T>
T Equations<T>::inverse_dynamics(int controller, const T* accelerations, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const T load = inverse_dynamics_[c].load(constants_, kinematics_, gravity_, accelerations, rates_.data());
  if (gradient) inverse_dynamics_[c].append_gradient(T(1.0), gradient, by_acceleration_.data(), by_rate_.data());
  return load;
}

// All controllers of this kind are one law: each joint gets what the tree needs to follow the accelerations that they ask for together.
template <class T>
T Equations<T>::computed_torque(int controller, SparseGradient<T>* gradient) {
  const std::vector<DrivenTree::Node>& nodes = system_.controllers()[static_cast<std::size_t>(controller)].tree.nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    accelerations_[k] = nodes[k].controller < 0 ? T(0.0) : wanted_acceleration(nodes[k].controller, nullptr);
  const CoordinateDetail detail = gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].rotor) rates_[k] = coordinate(nodes[k].pair, 0, detail).rate;
  const T load = inverse_dynamics(controller, accelerations_.data(), gradient);
  for (std::size_t k = 0; gradient && k < nodes.size(); ++k) {
    if (nodes[k].controller < 0) continue;
    const auto before = mark(gradient);
    wanted_acceleration(nodes[k].controller, gradient);
    gradient->scale_from(before, by_acceleration_[k]);
  }
  for (std::size_t k = 0; gradient && k < nodes.size(); ++k)
    if (nodes[k].rotor) append_rate(nodes[k].pair, 0, coordinate(nodes[k].pair, 0, detail), by_rate_[k], gradient);
  return load;
}

template <class T>
T Equations<T>::wanted_acceleration(int controller, SparseGradient<T>* gradient) {
  const ReferenceMotion<T> setpoint = controllers_[static_cast<std::size_t>(controller)].setpoint.at(state_->t);
  if (gradient) gradient->time += setpoint.jerk;
  return setpoint.acceleration + pid(controller, gradient);
}

template <class T>
T Equations<T>::state_feedback(int controller, SparseGradient<T>* gradient) {
  const auto c = static_cast<std::size_t>(controller);
  const ControllerConstants<T>& k = controllers_[c];
  const ReferenceMotion<T> feedforward = k.feedforward.at(state_->t);
  T output = feedforward.value;
  if (gradient) gradient->time += feedforward.rate;
  for (std::size_t term = 0; term < k.gains.size(); ++term) {
    const ReferenceMotion<T> reference = k.references[term].at(state_->t);
    output += k.gains[term] * reference.value + signal_value(system_.controllers()[c].feedback[term], T(-k.gains[term]), gradient);
    if (gradient) gradient->time += k.gains[term] * reference.rate;
  }
  return output;
}

template <class T>
T Equations<T>::shaped_input(int controller, SparseGradient<T>* gradient) {
  const ReferenceMotion<T> input = controllers_[static_cast<std::size_t>(controller)].shape.at(state_->t);
  if (gradient) gradient->time += input.rate;
  return input.value;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONTROLLERS_H_
