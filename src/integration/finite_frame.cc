// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/finite_frame.h"

#include <cmath>
#include <initializer_list>

namespace codesign {
namespace {

bool finite(std::initializer_list<double> values) {
  for (double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

bool finite(const JointSample& s) { return finite({s.position, s.velocity, s.acceleration, s.effort}); }
bool finite(const FrictionSample& s) {
  return finite({s.friction, s.normal_force, s.sliding_velocity}) && s.position.allFinite() && s.force.allFinite() && s.torque.allFinite();
}
bool finite(const ControllerSample& s) { return finite({s.setpoint, s.input, s.error, s.integral, s.output}); }
bool finite(const LinkSample& s) { return s.position.allFinite() && s.orientation.coeffs().allFinite(); }

template <class Sample>
std::string look(const char* what, const std::vector<std::string>& names, const std::vector<Sample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (!finite(samples[k])) return std::string(what) + " \"" + (k < names.size() ? names[k] : std::to_string(k)) + "\" is not finite";
  return "";
}

}  // namespace

std::string find_not_finite(const FrameNames& names, const Frame& frame) {
  std::string fault = look("the motion of joint", names.joints, frame.joints);
  if (fault.empty()) fault = look("the friction of joint", names.frictions, frame.frictions);
  if (fault.empty()) fault = look("controller", names.controllers, frame.controllers);
  if (fault.empty()) fault = look("the pose of link", names.links, frame.links);
  for (std::size_t k = 0; fault.empty() && k < frame.signals.size(); ++k)
    if (!std::isfinite(frame.signals[k])) fault = "signal number " + std::to_string(k + 1) + " of the requested ones is not finite";
  return fault;
}

}  // namespace codesign
