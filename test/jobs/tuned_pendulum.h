// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/optimization.h"
#include "ros/pendulum.h"

namespace codesign {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// The pendulum with an integral gain, limits, friction in its hinge, and a robot to take its gains
/// to.
inline Problem pendulum_on_hardware() {
  const std::string hinge = replaced(
      kPendulumUrdf, "<axis xyz=\"0 1 0\"/>",
      "<axis xyz=\"0 1 0\"/><limit effort=\"3\" velocity=\"2\"/><dynamics friction=\"0.2\"/>");
  const std::string study = replaced(kPendulumStudy, "{p: \"${Kp}\"}", "{p: \"${Kp}\", i: 0.25}") +
                            "hardware: {hold: {namespace: /arm_controller/gains/hinge, i_clamp: "
                            "2.0, antiwindup: true}}\n";
  return load_problem({"pendulum.urdf", hinge}, {}, {"pendulum.yaml", study});
}

}  // namespace codesign
