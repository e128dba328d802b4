// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint_sweep.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// A pair that turns, slides and turns about skew axes.
PairConstants<double> turn_slide_turn() {
  PairConstants<double> pair;
  pair.s_i = {0.1, -0.2, 0.3};
  pair.s_j = {-0.4, 0.1, 0.2};
  pair.R_ij = rotation(Vector4<double>(Vector4<double>(0.9, 0.1, -0.3, 0.2).normalized()));
  pair.steps = {{true, Vector3<double>(0.2, 0.1, 1.0).normalized()},
                {false, Vector3<double>(1.0, 0.5, -0.3).normalized()},
                {true, Vector3<double>(0.0, 1.0, 0.4).normalized()}};
  return pair;
}

AxesMotion<double> some_motion() {
  AxesMotion<double> m;
  m.A = rotation(Vector4<double>(Vector4<double>(0.8, -0.2, 0.4, 0.1).normalized()));
  m.r = {1.0, 2.0, 3.0};
  m.velocity = {0.3, -0.1, 0.7};
  m.omega = {1.0, -2.0, 0.5};
  m.alpha = {0.4, 3.0, -1.0};
  m.acceleration = {-2.0, 0.6, 9.0};
  m.update_turning();
  return m;
}

struct StepMotion {
  double q[3] = {0.7, 0.3, -1.2}, v[3] = {1.5, -0.8, 2.0}, a[3] = {-3.0, 4.0, 1.0};
};

TEST(JointSweep, ThePoseTurnsTheAxes) {
  const PairConstants<double> pair = turn_slide_turn();
  const AxesMotion<double> parent = some_motion();
  const StepMotion x;
  const JointPose<double> pose = joint_pose(pair, x.q);
  const AxesMotion<double> child = move_child(parent, pair, pose, x.q, x.v, x.a);
  EXPECT_LT((child.A - parent.A * pose.R).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((rotation(joint_parameters(pair, x.q)) - pose.R).cwiseAbs().maxCoeff(), 1e-15);
  PairConstants<double> hinge = pair;
  hinge.steps.resize(1);
  const JointPose<double> turned = joint_pose(hinge, x.q),
                          seen = joint_pose_of(parent.A, Matrix3<double>(parent.A * turned.R));
  EXPECT_LT((seen.turn[0] - turned.turn[0]).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((seen.R - turned.R).cwiseAbs().maxCoeff(), 1e-15);
}

// Velocities and accelerations against differences of positions and velocities, with a parent at
// rest that gravity loads.
TEST(JointSweep, MotionsAreDerivatives) {
  const PairConstants<double> pair = turn_slide_turn();
  const StepMotion x;
  AxesMotion<double> ground;
  ground.acceleration = {0.0, 0.0, 9.81};
  const auto at = [&](double t) {
    double q[3], v[3];
    for (int k = 0; k < 3; ++k) {
      q[k] = x.q[k] + t * x.v[k] + 0.5 * t * t * x.a[k];
      v[k] = x.v[k] + t * x.a[k];
    }
    return move_child(ground, pair, joint_pose(pair, q), q, v, x.a);
  };
  constexpr double kStep = 1e-5;
  const AxesMotion<double> here = at(0.0), before = at(-kStep), after = at(kStep);
  const Vector3<double> velocity = (after.r - before.r) / (2.0 * kStep);
  EXPECT_LT((here.A * here.velocity - velocity).cwiseAbs().maxCoeff(), 1e-9);
  const Vector3<double> acceleration =
      (after.A * after.velocity - before.A * before.velocity) / (2.0 * kStep);
  EXPECT_LT((here.A * here.acceleration - acceleration - ground.acceleration).cwiseAbs().maxCoeff(),
            1e-8);
  const Vector3<double> alpha = (after.A * after.omega - before.A * before.omega) / (2.0 * kStep);
  EXPECT_LT((here.A * here.alpha - alpha).cwiseAbs().maxCoeff(), 1e-8);
}

// A wrench has the same power on body j as its parts have along the coordinates and on body i.
TEST(JointSweep, WhatIsCarriedBackKeepsItsPower) {
  const PairConstants<double> pair = turn_slide_turn();
  const AxesMotion<double> parent = some_motion();
  const StepMotion x;
  const JointPose<double> pose = joint_pose(pair, x.q);
  const AxesMotion<double> child = move_child(parent, pair, pose, x.q, x.v, x.a);
  Wrench<double> wrench{{1.0, -2.0, 3.0}, {0.5, 4.0, -1.0}};
  wrench +=
      inertia_wrench(2.0, Matrix3<double>(Vector3<double>(0.1, 0.2, 0.3).asDiagonal()), child);
  double rows[3];
  const Wrench<double> below = carry_back(wrench, pair, pose, x.q, rows);
  double power = wrench.force.dot(child.velocity) + wrench.moment.dot(child.omega);
  for (int k = 0; k < 3; ++k) power -= rows[k] * x.v[k];
  EXPECT_NEAR(power, below.force.dot(parent.velocity) + below.moment.dot(parent.omega), 1e-12);
}

}  // namespace
}  // namespace codesign
