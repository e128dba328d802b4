// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "sensitivity/gradient_cases.h"

namespace codesign {

/// A mechanism that rests, with one tuned parameter that would move it, and the derivative of its
/// objective from the closed form.
struct MotionAtRest {
  std::string name, urdf, study;
  double derivative;
  double amplitude;  ///< of the derivative's oscillation by the duration, or the derivative itself

  /// @param solver the lines of the block `solver`.
  std::shared_ptr<const CompiledSystem> compile(const std::string& solver) const {
    const GradientCase test = from_texts(name, urdf, study + "solver: {" + solver + "}\n");
    return make_system(test.robot, test.study);
  }
};

/// y(t) of y' = A y + b from zero, by the series of the exponential function over small steps.
inline Eigen::VectorXd linear_response(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       double t) {
  const int steps = static_cast<int>(std::ceil(2.0 * A.norm() * t)) + 1;
  const double h = t / steps;
  Eigen::MatrixXd once = Eigen::MatrixXd::Identity(A.rows(), A.rows()), term = once;
  Eigen::VectorXd part = h * b, push = part;
  for (int k = 1; k < 25; ++k) {
    term = (term * A * h / k).eval();
    once += term;
    part = (A * part * h / (k + 1)).eval();
    push += part;
  }
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.rows());
  for (int k = 0; k < steps; ++k) y = once * y + push;
  return y;
}

/// x of m x'' = -k x - b x' at time t: after x(0) = 1, or under a force k.
inline double released(double m, double k, double b, double t) {
  const double decay = b / (2.0 * m), w = std::sqrt(k / m - decay * decay);
  return std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
}

/// A mass of 1 kg on a spring, released at ${start} = 0.
inline MotionAtRest resting_slide(const std::string& name, double k, double b, double duration) {
  return {name,
          robot("<link name='mass'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
                "iyy='1' iyz='0' izz='1'/></inertial></link><joint name='slide' "
                "type='prismatic'><parent link='ground'/><child link='mass'/><axis xyz='1 0 0'/>"
                "<limit lower='-9' upper='9' effort='0' velocity='0'/><codesign:torsion_spring "
                "stiffness='" +
                std::to_string(k) + "' damping='" + std::to_string(b) + "'/></joint>"),
          "duration: " + std::to_string(duration) +
              "\ninitial_state: {slide: {position: \"${start}\"}}\nparameters: {start: {initial: "
              "0, lower: -2, upper: 2}}\nobjective: {terminal: [{signal: slide/position, "
              "reference: -1}]}\n",
          2.0 * released(1.0, k, b, duration), 2.0 * std::exp(-0.5 * b * duration)};
}

/// A pendulum that hangs at rest, held there by a controller whose setpoint is tuned.
inline MotionAtRest held_pendulum(double p, double d, double duration) {
  const double inertia = 0.0834 + 0.25, gravity = 9.81 * 0.5,
               derivative =
                   -p / (p + gravity) * (1.0 - released(inertia, p + gravity, d, duration));
  return {"pendulum", pendulum(),
          "duration: " + std::to_string(duration) +
              "\ncontrollers: {servo: {type: pid, input: hinge/position, setpoint: \"${goal}\", "
              "output: hinge, gains: {p: " +
              std::to_string(p) + ", d: " + std::to_string(d) +
              "}}}\nparameters: {goal: {initial: 0, lower: -2, upper: 2}}\nobjective: "
              "{terminal: [{signal: hinge/position, reference: 0.5}]}\n",
          derivative, std::abs(derivative)};
}

/// A body without joints on a spring to the ground whose free length is tuned.
inline MotionAtRest free_body() {
  const double derivative = 2.0 * (1.0 - released(2.0, 90.0, 0.4, 8.0));
  return {"free_body",
          robot("<link name='body'><inertial><mass value='2'/><inertia ixx='0.1' ixy='0' ixz='0' "
                "iyy='0.1' iyz='0' izz='0.1'/></inertial></link><joint name='free' "
                "type='floating'><parent link='ground'/><child link='body'/><origin xyz='1 0 "
                "0'/></joint><codesign:spring_damper name='spring' stiffness='90' damping='0.4' "
                "free_length='1' codesign:free_length='${length}'><predecessor "
                "link='ground'/><successor link='body'/></codesign:spring_damper>"
                "<codesign:parameter name='length' value='1' lower='0.5' upper='2'/>"),
          "duration: 8.0\ngravity: [0, 0, 0]\nparameters: {length: {}}\nobjective: {terminal: "
          "[{signal: body/position/x}]}\n",
          derivative, std::abs(derivative)};
}

/// A motor behind an elastic gear, held by a controller of the load whose setpoint is tuned.
inline MotionAtRest elastic_gear() {
  const double load = 0.5, rotor = 0.2, k = 300.0, c = 6.0, p = 10.0, d = 2.0, duration = 6.0;
  Eigen::MatrixXd A(4, 4);  // load and motor, their rates
  A << 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -k / load, k / load, -c / load, c / load,
      (k - p) / rotor, -k / rotor, (c - d) / rotor, -c / rotor;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(4);
  b[3] = p / rotor;
  const double derivative = -linear_response(A, b, duration)[0];
  return {"elastic_gear",
          robot("<link name='load'><inertial><mass value='0.5'/><inertia ixx='0.5' ixy='0' ixz='0' "
                "iyy='0.5' iyz='0' izz='0.5'/></inertial></link><joint name='axis' "
                "type='continuous'><parent link='ground'/><child link='load'/><axis xyz='0 0 1'/>"
                "<limit effort='50' velocity='0'/><codesign:actuator gear_ratio='20' "
                "rotor_inertia='5e-4' stiffness='300' damping='6'/></joint>"),
          "duration: 6.0\ncontrollers: {servo: {type: pid, input: axis/position, setpoint: "
          "\"${goal}\", output: axis, gains: {p: 10, d: 2}}}\nparameters: {goal: {initial: 0, "
          "lower: -3, upper: 3}}\nobjective: {terminal: [{signal: axis/position, reference: "
          "0.5}], integral: [{signal: axis/position}]}\n",
          derivative, std::abs(derivative)};
}

inline std::vector<MotionAtRest> motions_at_rest() {
  return {resting_slide("soft_slide", 1.0, 0.1, 50.0),
          resting_slide("stiff_slide", 1e4, 1.0, 3.0),
          resting_slide("undamped_slide", 30.0, 0.0, 20.0),
          held_pendulum(20.0, 2.0, 3.0),
          held_pendulum(4000.0, 10.0, 2.0),
          free_body(),
          elastic_gear()};
}

}  // namespace codesign
