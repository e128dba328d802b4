// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/signal.h"
#include "elements/state_view.h"
#include "math/arrays.h"

namespace codesign {

/// Axis 0, 1 or 2 of a link, in ground axes.
template <class T>
Vector3<T> axis_of_link(const StateView<T>& view, int link, int axis) {
  const int body = view.system.topology().link_body[to_index(link)];
  return view.body(body).A * view.design.constants.links[to_index(link)].R.col(axis);
}

/// The component of a vector that a term of a signal reads. @param vector in ground axes.
template <class T>
T component_of(const StateView<T>& view, const SignalReference& of, const Vector3<T>& vector) {
  if (of.axes < 0) return vector[of.axis];
  return dot<T>(axis_of_link(view, of.axes, of.axis), vector);
}

}  // namespace codesign
