// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/transposed_code.h"

#include <gtest/gtest.h>

#include "equations/equations.h"
#include "equations/generic_state.h"
#include "integration/servo.h"
#include "math/differences.h"

namespace codesign {
namespace {

using C = std::complex<double>;

/// All results of a function side by side.
Eigen::VectorXcd results(EquationFunction function, const State<C>& state, Equations<C>* equations,
                         const CompiledSystem& system) {
  std::vector<C> all;
  const auto add = [&all](const auto& part) { all.insert(all.end(), part.begin(), part.end()); };
  VectorX<C> first, second;
  C g(0.0);
  Linearization<C> d;
  d.resize(system.patterns());
  switch (function) {
    case EquationFunction::kResidual:
      equations->residual(state, &first, &g);
      add(first), all.push_back(g);
      break;
    case EquationFunction::kLinearization:
      equations->linearize(state, &d);
      add(d.position), add(d.velocity), add(d.rate), add(d.time);
      break;
    default:
      equations->constraint_errors(state, &first, &second);
      add(first), add(second);
  }
  return Eigen::Map<const Eigen::VectorXcd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

using Case = std::tuple<EquationFunction, bool>;

class TransposedCodeTest : public ::testing::TestWithParam<Case> {
 protected:
  TransposedCodeTest() {
    at.resize(system->layout());
    at.t = 0.37;
    at.q = waves(at.q.size(), 0.2), at.v = waves(at.v.size(), 0.9), at.s = waves(at.s.size(), 0.4),
    at.z = waves(at.z.size(), 1.3);
  }

  /// The weighted sum of the results, with columns of the state and then tuned parameters moved.
  Eigen::VectorXcd weighted(const Eigen::VectorXd& weights, const Eigen::VectorXcd& moved) const {
    State<C> state;
    cast_state(at, &state);
    const std::vector<double> parameters = system->parameters();
    std::vector<C> design(parameters.begin(), parameters.end());
    Eigen::Index k = 0;
    for (VectorX<C>* part : {&state.q, &state.s, &state.v, &state.z})
      for (C& x : *part) x += moved[k++];
    for (int tuned : system->study().tuned) design[static_cast<std::size_t>(tuned)] += moved[k++];
    Equations<C> equations(*system);
    equations.set_design(design);
    const Eigen::VectorXcd all = results(std::get<0>(GetParam()), state, &equations, *system);
    return Eigen::VectorXcd::Constant(1, all.cwiseProduct(weights.cast<C>()).sum());
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  State<double> at;
};

TEST_P(TransposedCodeTest, IsTheComplexStepOfTheWeightedSum) {
  const auto& [function, machine_code] = GetParam();
  const Layout& layout = system->layout();
  const ByVariable<Sparsity>& patterns = system->patterns();
  const auto sizes = [&]() -> std::array<std::ptrdiff_t, 4> {
    if (function == EquationFunction::kResidual) return {layout.columns(), 1, 0, 0};
    if (function == EquationFunction::kConstraintErrors) return {layout.m, layout.m, 0, 0};
    const auto size = [](const Sparsity& pattern) {
      return static_cast<std::ptrdiff_t>(pattern.column_index.size());
    };
    return {size(patterns.position), size(patterns.velocity), size(patterns.rate),
            layout.columns() + 1};
  }();
  const Eigen::VectorXd weights = waves(sizes[0] + sizes[1] + sizes[2] + sizes[3], 0.6);
  In<double> parts[4];
  for (std::ptrdiff_t k = 0, first = 0; k < 4; first += sizes[static_cast<std::size_t>(k++)])
    parts[k] = In<double>(weights).subspan(first, sizes[static_cast<std::size_t>(k)]);

  CompiledEquations<double> equations(*system);
  equations.allow(machine_code);
  equations.set_design(system->parameters());
  const int columns = layout.positions() + layout.n + layout.columns(),
            tuned = static_cast<int>(system->study().tuned.size());
  Eigen::VectorXd derived = Eigen::VectorXd::Zero(columns + tuned);
  const Out<double> all = derived;
  // What is added twice counts twice.
  equations.add_transposed(function, at, parts, all.first(columns));
  equations.add_transposed(function, at, parts, all.first(columns));
  equations.add_gradient(all.subspan(columns, tuned));
  const Eigen::MatrixXd reference =
      complex_step_jacobian([&](const Eigen::VectorXcd& x) { return weighted(weights, x); },
                            Eigen::VectorXd::Zero(columns + tuned));
  EXPECT_GT(reference.norm(), 1.0);
  EXPECT_LT(compare_jacobians(0.5 * derived.transpose(), reference).largest, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Functions, TransposedCodeTest,
                         ::testing::Combine(::testing::Values(EquationFunction::kResidual,
                                                              EquationFunction::kLinearization,
                                                              EquationFunction::kConstraintErrors),
                                            ::testing::Bool()));

/// Compares transposed products with the complex step of weighted sums. @param results the numbers
/// that the weights multiply, at a state and a design. @param mode to hold; empty: none.
template <class Results>
void expect_transposed(const CompiledSystem& system, EquationPart part, EquationFunction function,
                       const State<double>& at, const Eigen::VectorXd& first,
                       const Eigen::VectorXd& second, const Results& results,
                       const std::vector<bool>& mode = {}) {
  const Layout& layout = system.layout();
  const std::vector<int>& all_tuned = system.study().tuned;
  const int columns = layout.positions() + layout.n + layout.columns(),
            tuned = static_cast<int>(all_tuned.size());
  CompiledEquations<double> equations(system, part);
  equations.set_design(system.parameters());
  if (!mode.empty()) equations.hold(mode);
  Eigen::VectorXd derived = Eigen::VectorXd::Zero(columns + tuned);
  const Out<double> all = derived;
  equations.add_transposed(function, at, {first, second, {}, {}}, all.first(columns));
  equations.add_gradient(all.subspan(columns, tuned));
  Eigen::VectorXd weights(first.size() + second.size());
  weights << first, second;
  const auto weighted = [&](const Eigen::VectorXcd& moved) -> Eigen::VectorXcd {
    State<C> state;
    cast_state(at, &state);
    const std::vector<double> parameters = system.parameters();
    std::vector<C> design(parameters.begin(), parameters.end());
    Eigen::Index k = 0;
    for (VectorX<C>* part_of_state : {&state.q, &state.s, &state.v, &state.z})
      for (C& x : *part_of_state) x += moved[k++];
    for (int parameter : all_tuned) design[static_cast<std::size_t>(parameter)] += moved[k++];
    CompiledEquations<C> complex(system, part);
    complex.set_design(design);
    if (!mode.empty()) complex.hold(mode);
    const VectorX<C> numbers = results(&complex, state);
    return Eigen::VectorXcd::Constant(1, numbers.cwiseProduct(weights.cast<C>()).sum());
  };
  const Eigen::MatrixXd reference =
      complex_step_jacobian(weighted, Eigen::VectorXd::Zero(columns + tuned));
  EXPECT_GT(reference.norm(), 0.1);
  EXPECT_LT(compare_jacobians(derived.transpose(), reference).largest, 1e-11);
}

State<double> waving(const CompiledSystem& system) {
  State<double> at;
  at.resize(system.layout());
  at.t = 0.37;
  at.q = waves(at.q.size(), 0.2), at.v = waves(at.v.size(), 0.9), at.s = waves(at.s.size(), 0.4);
  return at;
}

TEST(TransposedSwitches, AreTheComplexStepOfTheGuards) {
  const auto system =
      compile(double_pendulum(),
              "duration: 1.0\nparameters: {edge: {initial: 0.3}, k: {initial: 2.0}}\n"
              "loads: [{joint: elbow, effort: \"${k*shoulder/position > edge*t ? 1 : "
              "0}\"}, {joint: shoulder, effort: \"${abs(elbow/velocity - k)}\"}]\n"
              "objective: {integral: [{signal: elbow/position}]}\n");
  const auto switches = [](CompiledEquations<C>* equations, const State<C>& state) {
    VectorX<C> differences, right;
    equations->switches(state, &differences, &right);
    VectorX<C> all(differences.size() + right.size());
    all << differences, right;
    return all;
  };
  CompiledEquations<double> equations(*system);
  equations.set_design(system->parameters());
  const std::vector<bool> mode = equations.mode_of(waving(*system));
  ASSERT_EQ(mode.size(), 2U);
  expect_transposed(*system, EquationPart::kMotion, EquationFunction::kSwitches, waving(*system),
                    waves(2, 0.5), waves(2, 1.1), switches, mode);
}

TEST(TransposedSamples, AreTheComplexStepOfOutputAndMemory) {
  const auto system =
      compile(double_pendulum(),
              "duration: 1.0\nparameters: {p: {initial: 3.0}, i: {initial: 2.0}, d: "
              "{initial: 0.4}, aim: {initial: 0.1}, tau: {initial: 0.02}}\n"
              "controllers: {servo: {type: pid, input: shoulder/position, setpoint: "
              "\"${aim*sin(t)}\", output: shoulder, sample_time: 0.05, delay: 0.02, "
              "derivative_filter: \"${tau}\", gains: {p: \"${p}\", i: \"${i}\", d: "
              "\"${d}\"}}}\n"
              "objective: {integral: [{signal: elbow/position}]}\n");
  ASSERT_GT(system->layout().states, 3);
  for (const bool is_first : {true, false}) {
    const auto sample = [is_first](CompiledEquations<C>* equations, State<C> state) {
      VectorX<C> all(1 + state.s.size());
      const C output = equations->sample(0, is_first, &state);
      all << output, state.s;
      return all;
    };
    expect_transposed(*system, EquationPart::kStart,
                      controller_function(0, is_first ? ControllerFunction::kFirstSample
                                                      : ControllerFunction::kSample),
                      waving(*system), waves(1, 0.5), waves(system->layout().states, 1.1), sample);
  }
}

}  // namespace
}  // namespace codesign
