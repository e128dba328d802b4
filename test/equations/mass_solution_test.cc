// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
//
// The programs of the explicit pair: accelerations by one expression, and derivatives that are
// recorded apart.
#include "equations/mass_solution.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "integration/mechanisms.h"

namespace codesign {
namespace {

const char* const kExplicit = "solver: {coordinates: joint, method: dopri5}\n";
const char* const kImplicit = "solver: {coordinates: joint, method: rodas5p}\n";

std::string three_bars(const std::string& in_hinge) {
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><origin xyz='0.1 0.02 -0.2'/><mass value='1.5'/><inertia ixx='0.03' "
           "ixy='0.001' ixz='0' iyy='0.02' iyz='0' "
           "izz='0.01'/></inertial></link>";
  };
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis,
                        const std::string& inside) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='0.1 0 -0.3' rpy='0.2 0.1 0'/><axis xyz='" +
           axis + "'/>" + inside + "</joint>";
  };
  return "<robot name='bars' xmlns:codesign='urn:test'><link name='ground'/>" + link("a") +
         link("b") + link("c") +
         hinge("1", "ground", "a", "0 1 0", "<dynamics damping='0.1' friction='0.2'/>") +
         hinge("2", "a", "b", "1 0 0", in_hinge) + hinge("3", "a", "c", "0 1 0.3", "") + "</robot>";
}

/// The equations at a generic state.
struct Generic : Compiled {
  Generic(const std::string& urdf, const std::string& solver)
      : Compiled(urdf, "duration: 1.0\n" + solver) {
    equations.set_design(system.parameters());
    state.resize(system.layout());
    for (VectorX<double>* x : {&state.q, &state.v, &state.z})
      for (Eigen::Index k = 0; k < x->size(); ++k)
        (*x)[k] = std::sin(1.0 + 5.0 * static_cast<double>(k));
  }
};

TEST(MassSolution, SolvesTheEquationsOfMotion) {
  Generic bars(three_bars(""), kExplicit);
  double g = -1.0;
  std::vector<double> factors;
  ASSERT_TRUE(bars.equations.accelerations(&bars.state, &g, &factors));
  VectorX<double> G;
  bars.equations.residual(bars.state, &G, &g);
  EXPECT_LT(G.cwiseAbs().maxCoeff(), 1e-13 * (1.0 + bars.state.z.cwiseAbs().maxCoeff()));
}

TEST(MassFactor, SolvesForFurtherRightHandSides) {
  constexpr int kSides = 4;
  Generic bars(three_bars(""), kExplicit);
  double g = 0.0;
  std::vector<double> factors;
  ASSERT_TRUE(bars.equations.accelerations(&bars.state, &g, &factors));
  Linearization<double> rates;
  rates.resize(bars.system.patterns());
  bars.equations.linearize_rates(bars.state, &rates);
  const Sparsity& pattern = bars.system.patterns().rate;
  Eigen::Matrix<double, kSides, Eigen::Dynamic> b(kSides, pattern.columns), x;
  for (Eigen::Index k = 0; k < b.size(); ++k)
    b.data()[k] = std::cos(1.0 + 3.0 * static_cast<double>(k));
  x = b;
  bars.equations.mass_factor()->solve<kSides>(factors, Out<double>(x.data(), x.size()));
  for (int row = 0; row < pattern.columns; ++row) {
    Eigen::Vector4d product = Eigen::Vector4d::Zero();
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      product += rates.rate[static_cast<std::size_t>(e)] * x.col(pattern.column(e));
    EXPECT_LT((product - b.col(row)).norm(), 1e-13 * (1.0 + x.norm())) << row;
  }
}

TEST(MassSolution, IsNotThereWhereReactionsMatterOrMethodsAreImplicit) {
  Generic reactions(three_bars(pin_friction()), kExplicit), implicit(three_bars(""), kImplicit);
  for (Generic* bars : {&reactions, &implicit}) {
    const VectorX<double> z = bars->state.z;
    double g = -1.0;
    std::vector<double> factors;
    EXPECT_FALSE(bars->equations.accelerations(&bars->state, &g, &factors));
    EXPECT_EQ(bars->equations.mass_factor(), nullptr);
    EXPECT_EQ(bars->state.z, z);
  }
}

TEST(MassSolution, DerivativesThatAreRecordedApartAreTheSame) {
  Generic apart(three_bars(pin_friction()), kExplicit),
      together(three_bars(pin_friction()), kImplicit);
  Linearization<double> first, second, rates;
  for (Linearization<double>* d : {&first, &second, &rates}) d->resize(apart.system.patterns());
  apart.equations.linearize(apart.state, &first);
  together.equations.linearize(together.state, &second);
  apart.equations.linearize_rates(apart.state, &rates);
  const auto expect_near = [](const std::vector<double>& x, const std::vector<double>& y) {
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_NEAR(x[k], y[k], 1e-13 * (1.0 + std::abs(y[k])));
  };
  expect_near(first.position, second.position);
  expect_near(first.velocity, second.velocity);
  expect_near(first.rate, second.rate);
  expect_near(rates.rate, second.rate);
}

}  // namespace
}  // namespace codesign
