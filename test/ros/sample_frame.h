// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/frame.h"

namespace codesign {

constexpr double kPi = 3.14159265358979323846;

/// A made-up mechanism: ground, a cart sliding on it, a free plate, one loop, one controller.
inline FrameNames sample_names() {
  FrameNames names;
  names.joints = {"cart_joint", "hinge", "loop_joint"};
  names.tree_joints = 2;
  names.frictions = {"cart_joint", "hinge"};
  names.friction_is_torque = {false, true};
  names.controllers = {"speed"};
  names.loops = {"loop_joint"};
  names.signals = {"cart_joint/position", "speed/output"};
  names.links = {"ground", "cart", "plate"};
  names.free_links = {{2, 1}};
  return names;
}

/// As link_parents() finds them: the cart hangs on the ground, the plate on the cart.
inline std::vector<std::size_t> sample_parents() { return {0, 0, 1}; }

inline Frame sample_frame(double time) {
  Frame frame;
  frame.time = time;
  frame.joints = {{1.0, 2.0, 3.0, 4.0}, {5.0, 6.0, 7.0, 8.0}, {9.0, 10.0, 11.0, 12.0}};
  frame.frictions.resize(2);
  frame.frictions[0] = {-0.75, 2.5, -0.5, {0.1, 0.2, 0.3}, {4.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  frame.frictions[1] = {0.25, 1.5, 0.125, {0.4, 0.5, 0.6}, {0.0, 0.0, 0.0}, {0.0, 0.0, -2.0}};
  frame.controllers = {{10.0, 8.0, 2.0, 0.5, 20.0}};
  frame.loop_errors = {1e-9};
  frame.signals = {1.0, 20.0};
  frame.links.resize(3);
  // The cart stands at x = 1, turned by 90 degrees about z; the plate two metres along the world's
  // y from it, turned by 180 degrees about z.
  frame.links[1] = {{1.0, 0.0, 0.0},
                    Eigen::Quaterniond(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()))};
  frame.links[2] = {{1.0, 2.0, 0.0},
                    Eigen::Quaterniond(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ()))};
  return frame;
}

}  // namespace codesign
