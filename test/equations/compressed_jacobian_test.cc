// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compressed_jacobian.h"

#include <gtest/gtest.h>

#include <complex>
#include <utility>

#include "equations/compiled.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

const char* const kLugre =
    "<codesign:friction model='lugre' mu_static='0.2' mu_dynamic='0.15' transition_velocity='0.01' "
    "joint_length='0.05' pin_radius='0.02'/>";

/// A tree of hinges in two branches, the last one a slide; friction by reactions, bristles and dry
/// friction, and a controller with a filter that follows a function of time.
std::string branches() {
  const auto turned = [](const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& axis,
                         const std::string& inside, const char* type = "continuous") {
    return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
           "'/><child link='" + child +
           "'/><origin xyz='0.1 0 -0.3' rpy='0.2 0.1 0.3'/><axis xyz='" + axis + "'/>" + inside +
           "</joint>";
  };
  std::string links;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) links += bar(name);
  return robot(links +
               turned("1", "ground", "a", "0 1 0",
                      "<codesign:actuator gear_ratio='20' rotor_inertia='1e-4'/>") +
               turned("2", "a", "b", "1 0 0", pin_friction()) +
               turned("3", "b", "c", "0 0.6 0.8", kLugre) +
               turned("4", "a", "d", "1 0 0", "<dynamics damping='0.1' friction='0.2'/>") +
               turned("5", "d", "e", "0 1 0", "") +
               turned("6", "e", "f", "0 0 1",
                      "<limit lower='-1' upper='1' effort='100' velocity='10'/>", "prismatic"));
}

const char* const kBranchesStudy = R"(duration: 1.0
controllers:
  servo: {type: pid, input: 1/position, setpoint: {type: sine, amplitude: 0.3, frequency: 2.0}, output: "1", gains: {p: 20.0, i: 3.0, d: 1.0},
          derivative_filter: 0.01}
objective: {integral: [{signal: servo/output, weight: 0.5}, {signal: 5/velocity}]}
)";

/// A system in joint coordinates at a generic state.
struct Branches : Compiled {
  Branches(const std::string& urdf, const std::string& study,
           const std::string& solver = "coordinates: joint, method: rodas5p")
      : Compiled(urdf, study + "solver: {" + solver + "}\n") {
    equations.set_design(system.parameters());
    state.resize(system.layout());
    double phase = 0.3;
    for (VectorX<double>* x : {&state.q, &state.v, &state.s, &state.z}) {
      for (Eigen::Index k = 0; k < x->size(); ++k)
        (*x)[k] = std::sin(1.7 * static_cast<double>(k) + phase);
      phase += 0.8;
    }
    state.t = 0.13;
  }
};

/// What the program for the derivatives gives, which complex numbers always use.
Linearization<Complex> recorded(const Branches& at) {
  Equations<Complex> equations(at.system);
  const std::vector<double> parameters = at.system.parameters();
  equations.set_design({parameters.begin(), parameters.end()});
  State<Complex> state;
  cast_state(at.state, &state);
  Linearization<Complex> derivatives;
  derivatives.resize(at.system.patterns());
  equations.linearize(state, &derivatives);
  return derivatives;
}

template <class Numbers, class Expected>
void expect_near(const Numbers& numbers, const Expected& expected) {
  ASSERT_EQ(numbers.size(), expected.size());
  double size = 1.0;
  for (const Complex& x : expected) size = std::max(size, std::abs(x.real()));
  for (decltype(numbers.size()) k = 0; k < numbers.size(); ++k)
    EXPECT_NEAR(numbers[k], expected[k].real(), 1e-13 * size) << k;
}

TEST(CompressedJacobian, EqualsTheProgramForTheDerivatives) {
  Branches tree(branches(), kBranchesStudy);
  ASSERT_TRUE(tree.system.compresses_jacobian());
  ASSERT_GT(tree.system.layout().positions(), tree.system.layout().n) << "extra states";
  const Linearization<Complex> expected = recorded(tree);
  Linearization<double> derivatives;
  derivatives.resize(tree.system.patterns());
  tree.equations.linearize(tree.state, &derivatives);
  expect_near(derivatives.position, expected.position);
  expect_near(derivatives.velocity, expected.velocity);
  expect_near(derivatives.rate, expected.rate);
  ASSERT_GT(expected.time.cwiseAbs().maxCoeff(), 0.1) << "the reference moves";
  expect_near(derivatives.time, expected.time);
}

TEST(CompressedJacobian, RatesAreTheResidualAndOneOfItsMatrices) {
  Branches tree(branches(), kBranchesStudy);
  Linearization<double> derivatives, rates;
  for (Linearization<double>* d : {&derivatives, &rates}) d->resize(tree.system.patterns());
  VectorX<double> G, expected_G;
  double g = 0.0, expected_g = 0.0;
  tree.equations.linearize(tree.state, &derivatives);
  tree.equations.residual(tree.state, &expected_G, &expected_g);
  tree.equations.rates(tree.state, &G, &g, &rates);
  EXPECT_EQ(rates.rate, derivatives.rate);
  EXPECT_EQ(G, expected_G);
  EXPECT_EQ(g, expected_g);
}

TEST(CompressedJacobian, FollowsTheDesignAndIsTheSameWithoutMachineCode) {
  Branches tree(branches(), kBranchesStudy), loop(branches(), kBranchesStudy);
  loop.equations.compiled().allow(false);
  for (double factor : {1.0, 2.0}) {
    std::vector<double> parameters = tree.system.parameters();
    for (double& x : parameters) x *= factor;
    Linearization<double> by_code, by_loop;
    for (auto& [at, d] : {std::pair{&tree, &by_code}, {&loop, &by_loop}}) {
      d->resize(at->system.patterns());
      at->equations.set_design(parameters);
      at->equations.linearize(at->state, d);
    }
    EXPECT_EQ(by_code.position, by_loop.position);
    EXPECT_EQ(by_code.velocity, by_loop.velocity);
    EXPECT_EQ(by_code.rate, by_loop.rate);
    EXPECT_EQ(by_code.time, by_loop.time);
  }
}

TEST(CompressedJacobian, ServesTreesOfSomeSizeInJointCoordinates) {
  EXPECT_FALSE(
      Branches(branches(), kBranchesStudy, "coordinates: absolute").system.compresses_jacobian());
  EXPECT_FALSE(Branches(double_pendulum(), "duration: 1.0\n").system.compresses_jacobian());
}

}  // namespace
}  // namespace codesign
