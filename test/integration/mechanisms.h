// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// A slender bar of 1 kg and 1 m along -z of its link frame.
std::string bar(const std::string& name);

/// A hinge about y between two links; `friction` is an element, or nothing.
std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& xyz, const std::string& friction = "");

std::string robot(const std::string& content);

const char* pin_friction();

/// The same mechanism with another law in every annotation.
std::string with_friction_model(const std::string& urdf, const std::string& model);

std::string pendulum(const std::string& friction = "");

std::string double_pendulum(const std::string& friction = "");

/// A parallelogram as people draw it: four hinges in the plane, three constraints too many in
/// space.
std::string four_bar(const std::string& friction = "");

/// A disc on a slope too steep for its friction; a bar that hangs on its rim makes it turn as it
/// slides.
std::string puck();

/// A bar on a ball joint with friction, folded from three hinges.
std::string ball_pendulum();

/// A pendulum held by a spring that hangs on the ground beside it.
std::string spring_pendulum();

/// A study that only lets the mechanism move. @param initial the `initial_state` mapping, @param
/// solver the `solver` mapping.
std::string motion_study(double duration, const std::string& initial, const std::string& signal,
                         const std::string& solver);

}  // namespace codesign
