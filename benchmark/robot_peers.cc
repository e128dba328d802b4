// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/robot_peers.h"

#include "benchmark/articulated_body.h"
#include "benchmark/dormand_prince.h"

namespace codesign {

RobotMotion run_plain(const Robot& robot, double tolerance) {
  ArticulatedBody body(robot);
  const Eigen::Index n = body.joints();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * n);
  y.head(n) = body.start();
  const auto rates = [&body, n](const Eigen::VectorXd& state, Eigen::VectorXd* rate) {
    rate->head(n) = state.tail(n);
    body.accelerations(state.data(), state.data() + n, rate->data() + n);
  };
  DormandPrince<decltype(rates)> pair(rates, y, tolerance);
  RobotMotion motion;
  for (int k = 1; k <= kInstants; ++k) {
    pair.advance_to(robot.duration * k / kInstants);
    motion.positions.insert(motion.positions.end(), pair.state().data(), pair.state().data() + n);
  }
  motion.steps = pair.steps();
  return motion;
}

}  // namespace codesign
