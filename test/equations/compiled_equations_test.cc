// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The compiled code against the formulas. The tests of single elements also check the derivatives
// of both, for every load and controller.
#include "equations/compiled_equations.h"
#include "equations/formulas.h"

#include <gtest/gtest.h>

#include "equations/equation_variant.h"
#include "equations/generic_state.h"
#include "equations/joint_cases.h"
#include "integration/servo.h"
#include "math/scalar.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

#define SKIP_WITHOUT_CODE() \
  if (!ValueCode::is_available()) GTEST_SKIP() << "no machine code on this processor"

double largest_difference(const VectorX<double>& x, const VectorX<double>& y) {
  return (x - y).lpNorm<Eigen::Infinity>() / (1.0 + y.lpNorm<Eigen::Infinity>());
}

/// The recorded equations and what they are compared with: the formulas, or for Lanes the complex
/// step along each direction.
template <class T>
struct Twins {
  explicit Twins(const CompiledSystem& mechanism)
      : system(mechanism), with(system), formulas(system) {}

  void set_design(const std::vector<double>& parameters) {
    with.set_design(parameters);
    formulas.set_design(parameters);
  }

  void expect_same(const State<double>& state) {
    VectorX<double> G, expected;
    double g = 0.0, expected_g = 0.0;
    with.residual(state, &G, &g);
    formulas.residual(state, &expected, &expected_g);
    EXPECT_LT(largest_difference(G, expected), 1e-12);
    EXPECT_LT(std::abs(g - expected_g), 1e-12 * (1.0 + std::abs(expected_g)));
    VectorX<double> Phi, Phi_rate, expected_Phi, expected_rate;
    with.constraint_errors(state, &Phi, &Phi_rate);
    formulas.constraint_errors(state, &expected_Phi, &expected_rate);
    EXPECT_LT(largest_difference(Phi, expected_Phi), 1e-12);
    EXPECT_LT(largest_difference(Phi_rate, expected_rate), 1e-12);
  }

  const CompiledSystem& system;
  Equations<double> with;
  Formulas<double> formulas;
};

/// The same for N directional derivatives, which are compared with the complex step along each
/// direction.
template <int N>
struct Twins<Lanes<N>> {
  explicit Twins(const CompiledSystem& mechanism) : with(mechanism), complex(mechanism) {}

  void set_design(const std::vector<Lanes<N>>& values) {
    with.set_design(values);
    parameters = values;
  }

  void expect_same(const State<Lanes<N>>& state) {
    VectorX<Lanes<N>> G, Phi, Phi_rate;
    Lanes<N> g(0.0);
    with.residual(state, &G, &g);
    with.constraint_errors(state, &Phi, &Phi_rate);
    for (int lane = 0; lane < N; ++lane) {
      const auto along = [lane](const auto& from, auto* to) {
        to->resize(from.size());
        for (decltype(from.size()) k = 0; k < from.size(); ++k)
          (*to)[k] = {from[k].a, kStep * from[k].v[lane]};
      };
      std::vector<Complex> design;
      along(parameters, &design);
      complex.set_design(design);
      State<Complex> moved;
      moved.t = state.t;
      moved.turns = state.turns;
      along(state.q, &moved.q), along(state.v, &moved.v), along(state.s, &moved.s),
          along(state.z, &moved.z);
      VectorX<Complex> expected, expected_Phi, expected_rate;
      Complex expected_g;
      complex.residual(moved, &expected, &expected_g);
      complex.constraint_errors(moved, &expected_Phi, &expected_rate);
      expect_near(G, expected, lane), expect_near(Phi, expected_Phi, lane),
          expect_near(Phi_rate, expected_rate, lane);
      expect_near(VectorX<Lanes<N>>::Constant(1, g), VectorX<Complex>::Constant(1, expected_g),
                  lane);
    }
  }

  static void expect_near(const VectorX<Lanes<N>>& x, const VectorX<Complex>& y, int lane) {
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double size = 1.0 + std::abs(y[k].real()) + x[k].directions().norm();
      EXPECT_LT(std::abs(x[k].a - y[k].real()), 1e-12 * size);
      EXPECT_LT(std::abs(x[k].v[lane] - y[k].imag() / kStep), 1e-11 * size);
    }
  }

  Equations<Lanes<N>> with;
  Equations<Complex> complex;
  std::vector<Lanes<N>> parameters;
};

/// A generic state; for Lanes with generic directions.
template <class T>
State<T> some_state(const Layout& layout) {
  State<T> state;
  state.resize(layout);
  state.t = 0.37;
  const auto fill = [](VectorX<T>* x, double phase) {
    const Eigen::VectorXd values = waves(x->size(), phase);
    for (Eigen::Index k = 0; k < x->size(); ++k) {
      (*x)[k] = T(values[k]);
      if constexpr (!std::is_same_v<T, double>)
        for (int lane = 0; lane < (*x)[k].directions().size(); ++lane)
          (*x)[k].v[lane] = std::sin(phase + 0.3 * lane + static_cast<double>(k));
    }
  };
  fill(&state.q, 0.3), fill(&state.v, 1.1), fill(&state.s, 2.0), fill(&state.z, 0.7);
  return state;
}

template <class T>
std::vector<T> some_design(const CompiledSystem& system) {
  const std::vector<double> values = system.parameters();
  std::vector<T> parameters(values.begin(), values.end());
  if constexpr (!std::is_same_v<T, double>)
    for (std::size_t k = 0; k < parameters.size(); ++k)
      parameters[k].v[static_cast<int>(k) % 4] = 1.0;
  return parameters;
}

template <class T>
void expect_same(const CompiledSystem& system) {
  SKIP_WITHOUT_CODE();
  Twins<T> twins(system);
  twins.set_design(some_design<T>(system));
  twins.expect_same(some_state<T>(system.layout()));
}

class CompiledJoints : public ::testing::TestWithParam<JointCase> {
 protected:
  const std::shared_ptr<const CompiledSystem> system =
      compile(joint_cases::model(GetParam()),
              "duration: 1.0\nobjective: {integral: [{signal: tip/position/x}]}\n");
};

TEST_P(CompiledJoints, GiveTheSameValues) { expect_same<double>(*system); }
TEST_P(CompiledJoints, GiveTheSameFourDerivatives) { expect_same<Lanes<4>>(*system); }
TEST_P(CompiledJoints, GiveTheSameEightDerivatives) { expect_same<Lanes<8>>(*system); }

INSTANTIATE_TEST_SUITE_P(AllJoints, CompiledJoints, ::testing::ValuesIn(joint_cases::all()),
                         [](const auto& c) { return c.param.name; });

/// Moving setpoints, a shaped input with parameters, positions of turning joints, springs.
const char* const kDriven =
    "duration: 1.0\n"
    "parameters: {Kp: {initial: 3.0}, amplitude: {initial: 0.7}}\n"
    "controllers:\n"
    "  a: {type: pid, input: shoulder/position, output: shoulder, gains: {p: \"${Kp}\", i: 2.0, d: "
    "0.5},\n"
    "    setpoint: {type: sine, amplitude: \"${amplitude}\", period: 1.3, phase: 0.4}}\n"
    "  b: {type: basis, output: elbow, shape: linear, coefficients: {count: 3, initial: [0.0, "
    "-0.4, 1.0], lower: -5.0, upper: 5.0}}\n"
    "objective: {integral: [{signal: a/output + b/output, reference: {type: waypoints, times: "
    "[0.1, 0.5, 0.9], positions: [0.2, -0.5, "
    "1.0]}}]}\n";

template <class T>
void expect_same_at_all_times(const CompiledSystem& system) {
  SKIP_WITHOUT_CODE();
  Twins<T> twins(system);
  twins.set_design(some_design<T>(system));
  State<T> state = some_state<T>(system.layout());
  for (double t : {0.37, 0.05, 0.95}) {
    state.t = t;
    twins.expect_same(state);
  }
}

TEST(CompiledEquations, FollowFunctionsOfTimeAndTheirParameters) {
  const std::shared_ptr<const CompiledSystem> system =
      compile(double_pendulum(pin_friction()), kDriven);
  expect_same_at_all_times<double>(*system);
  expect_same_at_all_times<Lanes<8>>(*system);
}

TEST(CompiledEquations, RecordAVariantForADesignThatDecidesOtherwise) {
  SKIP_WITHOUT_CODE();
  const std::string friction =
      "<codesign:friction mu_static='0.6' mu_dynamic='0.4' transition_velocity='0.1' "
      "joint_length='0.2' friction_arm='0.02' "
      "pin_radius='0.05' "
      "codesign:pin_radius='${radius}'/>";
  const std::shared_ptr<const CompiledSystem> system =
      compile(robot("<codesign:parameter name='radius' value='0.05'/>" + bar("arm") +
                    hinge("shoulder", "ground", "arm", "0 0 0", friction)),
              motion_study(1.0, "{}", "shoulder/velocity", "{}"));
  Twins<double> twins(*system);
  const State<double> state = some_state<double>(system->layout());
  VectorX<double> G, expected;
  double g = 0.0;
  for (double radius : {0.05, 0.0, 0.03}) {
    twins.set_design({radius});
    twins.with.residual(state, &G, &g);
    twins.formulas.residual(state, &expected, &g);
    EXPECT_LT(largest_difference(G, expected), 1e-13) << radius;
  }
  EXPECT_NE(system->equation_variant(1), nullptr);
  EXPECT_EQ(system->equation_variant(2), nullptr) << "each design needs one of two variants";
}

/// A cylindrical loop has two coordinates although its chain has one element; both must have a turn
/// reference.
TEST(CompiledEquations, CountTheTurnsOfEveryCoordinate) {
  SKIP_WITHOUT_CODE();
  const std::string loop =
      joint_cases::free("tip") + joint_cases::loop("codesign:cylindrical", "base");
  const std::shared_ptr<const CompiledSystem> system =
      compile(joint_cases::model(
                  {"", loop + bar("arm") +
                           joint_cases::tree("swing", "continuous", "base", "arm", "1 0 0.5")}),
              "duration: 1.0\nobjective: {integral: [{signal: swing/position}]}\n");
  Twins<double> twins(*system);
  twins.set_design(system->parameters());
  State<double> state = some_state<double>(system->layout());
  for (std::size_t k = 0; k < state.turns.size(); ++k)
    state.turns[k] = 2.0 * M_PI * static_cast<double>(k + 1);
  twins.expect_same(state);
}

/// An angle exactly half a turn from its reference must be rounded to the same turn by code and
/// formulas.
TEST(CompiledEquations, RoundHalfATurnAsTheFormulasDo) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system =
      compile(pendulum(), motion_study(1.0, "{}", "hinge/position", "{}"));
  for (double sign : {1.0, -1.0}) {
    Twins<double> twins(*system);
    twins.set_design(system->parameters());
    State<double> state;
    state.resize(system->layout());
    state.q[5] = sign;  // turned by pi about y
    twins.expect_same(state);
  }
}

TEST(CompiledEquations, FollowTheDesign) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  Twins<double> twins(*system);
  for (double Kp : {40.0, -3.0}) {
    std::vector<double> parameters = system->parameters();
    parameters[0] = Kp;
    twins.set_design(parameters);
    twins.expect_same(some_state<double>(system->layout()));
  }
}

TEST(CompiledEquations, CountTurns) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  Twins<double> twins(*system);
  twins.set_design(system->parameters());
  State<double> state = some_state<double>(system->layout());
  state.turns.assign(state.turns.size(), 4.0 * M_PI);
  twins.expect_same(state);
}

/// A narrow joint between its stops, in the smoothed beginning of one and deep in it.
TEST(CompiledEquations, RecordAVariantForEachBranch) {
  const std::string narrow = "<limit lower='-0.05' upper='0.04' effort='2' velocity='1'/>";
  const std::shared_ptr<const CompiledSystem> system =
      compile(robot(bar("arm") +
                    "<joint name='hinge' type='revolute'><parent link='ground'/><child "
                    "link='arm'/><axis xyz='0 1 0'/>" +
                    narrow + "</joint>"),
              motion_study(1.0, "{}", "hinge/velocity", "{}") +
                  "limits: {position: true, stiffness: 20.0, width: 0.01}\n");
  Twins<double> twins(*system);
  twins.set_design(system->parameters());
  for (int round = 0; round < 2; ++round)
    for (double angle : {0.0, 0.045, 0.2, -0.2}) {
      State<double> state = some_state<double>(system->layout());
      state.q.setZero();
      state.q[3] = std::cos(0.5 * angle), state.q[5] = std::sin(0.5 * angle);
      twins.expect_same(state);
    }
  EXPECT_NE(system->equation_variant(3), nullptr);
  EXPECT_EQ(system->equation_variant(4), nullptr) << "the second round needs no further variants";
}

TEST(CompiledEquations, RecordAVariantWhereAStateIsNotANumber) {
  const std::shared_ptr<const CompiledSystem> system =
      compile(double_pendulum(pin_friction()), kDriven);
  Equations<double> equations(*system);
  equations.set_design(system->parameters());
  State<double> state = some_state<double>(system->layout());
  state.v.setConstant(std::nan(""));
  VectorX<double> G;
  double g = 0.0;
  equations.residual(state, &G, &g);
  EXPECT_TRUE(G.hasNaN());
}

TEST(CompiledEquations, GiveDerivativesAloneFromArraysOfTheirOwn) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  Twins<Lanes<4>> twins(*system);
  twins.set_design(some_design<Lanes<4>>(*system));
  const State<Lanes<4>> state = some_state<Lanes<4>>(system->layout());
  std::vector<double> values[4], directions[4];
  const VectorX<Lanes<4>>* const parts[] = {&state.q, &state.v, &state.s, &state.z};
  for (std::size_t k = 0; k < 4; ++k)
    for (const Lanes<4>& x : *parts[k]) {
      values[k].push_back(x.a);
      for (int lane = 0; lane < 4; ++lane) directions[k].push_back(x.v[lane]);
    }
  Eigen::Matrix<double, 4, Eigen::Dynamic> result(4, system->layout().columns());
  Eigen::Vector4d g_result;
  twins.with.compiled().tangents(EquationFunction::kResidual, state.t, state.turns,
                                 {values[0], values[1], values[2], values[3]},
                                 {directions[0], directions[1], directions[2], directions[3]},
                                 {result, g_result, {}, {}});
  VectorX<Lanes<4>> expected;
  Lanes<4> g;
  twins.with.residual(state, &expected, &g);
  for (Eigen::Index row = 0; row < expected.size(); ++row)
    EXPECT_LT((result.col(row) - expected[row].directions()).norm(),
              1e-11 * (1.0 + expected[row].directions().norm()))
        << row;
  EXPECT_LT((g_result - g.directions()).norm(), 1e-11 * (1.0 + g.directions().norm()));
}

}  // namespace
}  // namespace codesign
