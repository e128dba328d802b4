// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "math/scalar.h"

namespace codesign {

/// The pose of a frame in the frame of its body, or in the ground.
template <class T>
struct LinkConstants {
  Vector3<T> s = Vector3<T>::Zero();      ///< origin [m]
  Matrix3<T> R = Matrix3<T>::Identity();  ///< frame axes to body axes
};

/// Per link, as in Constants.
template <class T>
using LinkFrames = std::vector<LinkConstants<T>>;

}  // namespace codesign
