// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/explicit_stages.h"

#include "integration/step_memory.h"

namespace codesign {
namespace {

TEST(ExplicitStages, MeetTheEquationsOfThePair) {
  ServoMemory servo(dopri5());
  StepMemory<double>& m = servo.memory;
  ExplicitStages<double> stages(&m);
  stages.begin();
  m.h = 0.004;
  ASSERT_TRUE(stages.attempt());
  const RosenbrockTableau& tableau = dopri5();
  Eigen::VectorXd estimate = Eigen::VectorXd::Zero(m.at.z()), q = m.state.q, v = m.state.v;
  for (std::size_t i = 0; i < m.count(); ++i) {
    const State<double>& stage = m.stages[i];
    const VectorX<double>& u = m.increments[i];
    const double loads = servo.residual(m.state).norm() + stage.z.norm();
    EXPECT_LT(servo.residual(stage).norm(), 1e-10 * (1.0 + loads)) << "stage " << i;
    EXPECT_EQ(stage.t, m.state.t + tableau.alpha[i] * m.h);
    EXPECT_LT((ServoMemory::part(u, m.at.x(), m.at.n) - m.h * stage.v).norm(), 1e-15);
    EXPECT_LT((ServoMemory::part(u, m.at.v(), m.at.n) - m.h * stage.z.head(m.at.n)).norm(), 1e-14);
    EXPECT_LT((stage.q - q).norm(), 1.0);
    estimate += tableau.estimate[i] * u.head(m.at.z());
    q += tableau.weights[i] * u.segment(m.at.x(), m.at.n);
    v += tableau.weights[i] * u.segment(m.at.v(), m.at.n);
  }
  EXPECT_LT((m.end.q - q).norm(), 1e-14);
  EXPECT_LT((m.end.v - v).norm(), 1e-12);
  EXPECT_LT((stages.estimate().head(m.at.z()) - estimate).norm(), 1e-15);
}

TEST(ExplicitStages, TheZOfAnyStateIsThatOfTheEquations) {
  ServoMemory servo(dopri5());
  ExplicitStages<double> stages(&servo.memory);
  stages.begin();
  State<double> at = servo.memory.state;
  const double before = servo.residual(at).norm();
  at.z.setZero();
  EXPECT_GT(servo.residual(at).norm(), 1e-3);
  ASSERT_TRUE(stages.solve_at(&at));
  EXPECT_LT(servo.residual(at).norm(), 1e-10 + 10.0 * before);
}

}  // namespace
}  // namespace codesign
