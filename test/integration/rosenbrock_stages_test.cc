// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rosenbrock_stages.h"

#include "equations/iteration_matrix.h"
#include "integration/step_memory.h"

namespace codesign {
namespace {

/// The stage equations (15) with all unknowns, from which the stages are not computed:
///   u_q/(h gamma) - u_v = v_i + sum_j c_ij u_qj/h,  u_v/(h gamma) - u_a = a_i + sum_j c_ij u_vj/h,
///   0 = G_i + h gamma_i G_t + G_q u_q + G_v u_v + G_s u_s + G_z u_z.
class StageEquations : public ::testing::TestWithParam<const RosenbrockTableau* (*)()> {};

TEST_P(StageEquations, AreMetByEveryStage) {
  const RosenbrockTableau& tableau = *GetParam()();
  ServoMemory servo(tableau);
  StepMemory<double>& m = servo.memory;
  RosenbrockStages<double> stages(&m);
  stages.begin();
  m.h = 0.004;
  ASSERT_TRUE(stages.attempt());
  const Linearization<double> derivatives = m.derivatives;
  const double hg = m.h * tableau.gamma;
  for (std::size_t i = 0; i < m.count(); ++i) {
    const VectorX<double>& u = m.increments[i];
    const State<double>& stage = m.stages[i];
    Eigen::VectorXd of_q = stage.v, of_v = stage.z.head(m.at.n);
    for (std::size_t j = 0; j < i; ++j) {
      of_q += tableau.c[i][j] / m.h * m.increments[j].segment(m.at.x(), m.at.n);
      of_v += tableau.c[i][j] / m.h * m.increments[j].segment(m.at.v(), m.at.n);
    }
    State<double> direction;
    direction.resize(m.layout);
    direction.q = u.segment(m.at.x(), m.at.n);
    direction.s = u.segment(m.at.s(), m.at.states);
    direction.v = u.segment(m.at.v(), m.at.n);
    direction.z = u.segment(m.at.z(), m.at.z_size);
    EXPECT_LT((direction.q / hg - direction.v - of_q).norm(), 1e-11 * (1.0 + of_q.norm())) << i;
    EXPECT_LT((direction.v / hg - direction.z.head(m.at.n) - of_v).norm(),
              1e-9 * (1.0 + of_v.norm()))
        << i;
    VectorX<double> change;
    directional_derivative(*servo.system, derivatives, direction, &change);
    const Eigen::VectorXd G = servo.residual(stage);
    const Eigen::VectorXd sum = G + m.h * tableau.gamma_i[i] * derivatives.time.head(m.at.z_size) +
                                change.head(m.at.z_size);
    EXPECT_LT(sum.norm(), 1e-9 * (1.0 + G.norm() + change.norm())) << i;
  }
  EXPECT_EQ(&stages.estimate(), &m.increments[m.count() - 1]);
}

INSTANTIATE_TEST_SUITE_P(Methods, StageEquations,
                         ::testing::Values(
                             +[] { return &rodas4(); }, +[] { return &rodas4p2(); },
                             +[] { return &rodas5p(); }));

}  // namespace
}  // namespace codesign
