// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "codegen/traced.h"
#include "equations/equations_fixture.h"
#include "integration/linkages.h"
#include "system/reaction_sharing.h"

namespace codesign {
namespace {

/// A ring with friction, closed by a hinge, of which two turns are coupled too: five rows of the
/// loop and one of the coupling may be dropped.
std::string coupled_ring() {
  std::string text = four_bar(pin_friction());
  return text.insert(text.rfind("<loop"),
                     "<coupling name='gear'><predecessor link='left'/><successor "
                     "link='right'/><ratio value='1'/></coupling>");
}

ReactionSharing dropping(const std::vector<SharedRow>& rows) {
  ReactionSharing sharing(1e-6);
  sharing.pairs = {0, 1, 2, 3};
  sharing.couplings = {0};
  sharing.dropped = rows;
  return sharing;
}

const char* const kRingStudy =
    "duration: 1.0\nobjective: {integral: [{signal: left_hinge/friction + "
    "left_hinge/normal_force}]}\n";

/// Drops a row of coincident points (16), a product row (18) and the row of the coupling (20).
class EquationsSharing : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsSharing()
      : EquationsFixture(coupled_ring(), kRingStudy,
                         dropping({{3, -1, 1}, {3, -1, 3}, {-1, 0, 0}})) {}
};

TEST_F(EquationsSharing, EveryDerivativeIsExact) { expect_exact_derivatives(1e-11); }

TEST_F(EquationsSharing, AllRowsShareAsIfTheyWereEqualSprings) {
  Linearization<double> d;
  d.resize(system.patterns());
  real.linearize(state, &d);
  const Eigen::MatrixXd G_z =
      dense(system.patterns().rate, d.rate).topRows(system.layout().columns());
  const Layout& layout = system.layout();
  const SharingLayout& at = system.sharing_layout();
  // For any eta with eta_D = 0, w = -Phi_q^T eta and lambda = Phi_q w must solve (23b).
  const Eigen::MatrixXd Phi_q = G_z.block(layout.n, 0, layout.constraints(), layout.n);
  const int last = layout.norm_row(0);
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(layout.columns()), loads(layout.constraints());
  for (Eigen::Index k = 0; k < loads.size(); ++k) loads[k] = std::cos(0.9 * static_cast<double>(k));
  for (int row : system.dropped_rows()) loads[row] = 0.0;
  const Eigen::VectorXd w = -Phi_q.transpose() * loads;
  ASSERT_EQ(at.bodies.size(), 3U);
  unknowns.segment(at.first, w.size()) = w;
  for (int row = 0; row < layout.constraints(); ++row)
    unknowns[at.load(row)] = 1e-4 * loads[row];  // eta in units of 1/kLoadUnit
  unknowns.segment(layout.n, last) = (Phi_q * w).head(last);
  const Eigen::VectorXd left = G_z * unknowns;
  for (int row = 0; row < last; ++row) EXPECT_LT(std::abs(left[at.load(row)]), 1e-9) << row;
  for (int body : at.bodies) EXPECT_LT(left.segment<7>(at.displacement(body)).norm(), 1e-9);
  for (int row : system.dropped_rows()) EXPECT_LT(std::abs(left[at.miss(row)]), 1e-9);
}

TEST_F(EquationsSharing, ARowThatIsDroppedMayMiss) {
  VectorX<double> before, after;
  double g = 0.0;
  real.residual(state, &before, &g);
  const SharingLayout& at = system.sharing_layout();
  for (int row : {15, 16}) state.z[at.miss(row)] += 0.5;
  real.residual(state, &after, &g);
  EXPECT_NEAR(after[at.miss(15)] - before[at.miss(15)], 0.5, 1e-12)
      << "of one that holds, its miss is zero";
  EXPECT_NEAR(after[at.miss(16)] - before[at.miss(16)], 0.0, 1e-12);
  EXPECT_NEAR(after[system.layout().lambda_column(16)] - before[system.layout().lambda_column(16)],
              -0.5, 1e-12);
}

}  // namespace
}  // namespace codesign
