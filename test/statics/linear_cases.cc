// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/linear_cases.h"

#include <algorithm>

#include "statics/linearize.h"

namespace codesign {

std::string carts(int count, const std::vector<std::string>& dynamics, bool carried) {
  std::string urdf =
      R"(<robot name="carts" xmlns:codesign="urn:mechanism_codesign"><link name="ground"/>)";
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k), name = "cart" + number;
    const std::string below = k > 0 && carried ? "cart" + std::to_string(k - 1) : "ground";
    urdf += body(name, 1.0);
    urdf += joint("x" + number, "prismatic", below, name, "0 0 0", "1 0 0",
                  R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)" +
                      dynamics[static_cast<std::size_t>(k)]);
  }
  return urdf + "</robot>";
}

std::string damped(double c) { return "<dynamics damping=\"" + std::to_string(c) + "\"/>"; }
std::string sprung(double k, double d) {
  return "<codesign:torsion_spring stiffness=\"" + std::to_string(k) + "\" damping=\"" +
         std::to_string(d) + "\" free_position=\"0\"/>";
}

std::string cart_servo(const std::string& keys, const std::string& number,
                       const std::string& input) {
  return "servo" + number + ": {type: pid, input: x" + number + "/" + input +
         ", setpoint: 0, output: x" + number + ", " + keys + "}";
}
std::string controlled(const std::string& controllers) {
  return "duration: 10\ngravity: [0, 0, 0]\ncontrollers: {" + controllers + "}\n";
}

LinearModel model_of(const std::string& urdf, const std::string& study,
                     const std::vector<std::string>& outputs) {
  const Problem problem = loaded(urdf, study);
  LinearQuestion question;
  question.with_loops = true;
  for (const std::string& output : outputs)
    question.outputs.push_back(parse_signal(output, {}, "outputs"));
  const LinearModel model = linearize_at_rest(*system_of(problem), problem.parameters(), question);
  EXPECT_TRUE(model.status.ok()) << model.status.cause;
  return model;
}

void expect_poles(const LinearModel& model, std::vector<std::complex<double>> expected,
                  double tolerance) {
  ASSERT_EQ(model.modes.size(), expected.size());
  for (const LinearMode& mode : model.modes) {
    const auto nearest =
        std::min_element(expected.begin(), expected.end(),
                         [&](const std::complex<double>& a, const std::complex<double>& b) {
                           return std::abs(a - mode.pole.value) < std::abs(b - mode.pole.value);
                         });
    EXPECT_LT(std::abs(*nearest - mode.pole.value), tolerance) << mode.pole.value;
    expected.erase(nearest);
  }
}

}  // namespace codesign
