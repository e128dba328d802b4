// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations_fixture.h"

#include <cmath>

#include "codegen/value_code.h"
#include "equations/compiled_equations.h"
#include "equations/equation_variant.h"
#include "equations/formulas.h"
#include "math/differences.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

EquationsFixture::EquationsFixture(const std::string& urdf, const std::string& study,
                                   const ReactionSharing& sharing)
    : robot(read_urdf({"all.urdf", urdf})),
      system(robot, read_study({"all.yaml", study}, robot), sharing),
      real(system),
      complex(system) {
  const std::vector<double> parameters = system.parameters();
  real.set_design(parameters);
  complex.set_design(std::vector<std::complex<double>>(parameters.begin(), parameters.end()));
  state.resize(system.layout());
  // Any point will do; the formulas hold off the constraints too.
  const auto fill = [](VectorX<double>* x, double phase) {
    for (Eigen::Index k = 0; k < x->size(); ++k)
      (*x)[k] = std::sin(1.7 * static_cast<double>(k) + phase);
  };
  fill(&state.q, 0.3);
  fill(&state.v, 1.1);
  fill(&state.s, 2.0);
  fill(&state.z, 0.7);
  for (int b = 0; b < system.layout().bodies; ++b)
    state.q.segment<4>(kBodySize * b + 3).normalize();
}

Eigen::MatrixXd EquationsFixture::reference(
    VectorX<std::complex<double>> State<std::complex<double>>::*member, const VectorX<double>& at) {
  State<std::complex<double>> point;
  cast_state(state, &point);
  return complex_step_jacobian(
      [&](const Eigen::VectorXcd& x) {
        point.*member = x;
        VectorX<std::complex<double>> G;
        std::complex<double> g;
        complex.residual(point, &G, &g);
        Eigen::VectorXcd all(G.size() + 1);
        all << G, g;
        return all;
      },
      at);
}

Eigen::VectorXd EquationsFixture::time_reference() {
  State<double> moved = state;
  VectorX<double> G;
  double g = 0.0;
  Eigen::VectorXd derivative(system.layout().columns() + 1);
  for (Eigen::Index row = 0; row < derivative.size(); ++row) {
    const auto entry = [&](double t) {
      moved.t = t;
      real.residual(moved, &G, &g);
      return row < G.size() ? G[row] : g;
    };
    derivative[row] = ridders_derivative(entry, state.t, 1e-2).value;
  }
  return derivative;
}

Eigen::MatrixXd EquationsFixture::dense(const Sparsity& pattern,
                                        const std::vector<double>& values) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(pattern.rows, pattern.columns);
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      matrix(row, pattern.column(e)) = values[static_cast<std::size_t>(e)];
  return matrix;
}

void EquationsFixture::expect_exact_derivatives(double tolerance) {
  expect_same_bits();
  expect_exact_lanes();
  expect_exact_derivatives_of_real(tolerance);
}

void EquationsFixture::expect_exact_derivatives_of_real(double tolerance) {
  using S = State<std::complex<double>>;
  Linearization<double> d;
  d.resize(system.patterns());
  real.linearize(state, &d);
  expect_exact_residual();
  const Layout& layout = system.layout();
  const Eigen::MatrixXd by_position = dense(system.patterns().position, d.position);
  EXPECT_LT(compare_jacobians(by_position.leftCols(layout.n), reference(&S::q, state.q)).largest,
            tolerance);
  if (layout.states > 0) {
    EXPECT_LT(
        compare_jacobians(by_position.rightCols(layout.states), reference(&S::s, state.s)).largest,
        tolerance);
  }
  EXPECT_LT(
      compare_jacobians(dense(system.patterns().velocity, d.velocity), reference(&S::v, state.v))
          .largest,
      tolerance);
  EXPECT_LT(
      compare_jacobians(dense(system.patterns().rate, d.rate), reference(&S::z, state.z)).largest,
      tolerance);
  EXPECT_LT(compare_jacobians(d.time, time_reference()).largest, 1e-8);
}

namespace {

using L = Lanes<4>;

/// The state with some directions.
State<L> directed(const State<double>& state) {
  State<L> point;
  point.t = state.t;
  point.turns = state.turns;
  const auto direct = [](const VectorX<double>& x, VectorX<L>* lanes) {
    *lanes = x.cast<L>();
    for (Eigen::Index k = 0; k < x.size(); ++k)
      for (int lane = 0; lane < 4; ++lane)
        (*lanes)[k].v[lane] = std::sin(0.9 * static_cast<double>(k) + lane);
  };
  direct(state.q, &point.q), direct(state.v, &point.v), direct(state.s, &point.s),
      direct(state.z, &point.z);
  return point;
}

std::vector<L> directed(const std::vector<double>& values) {
  std::vector<L> parameters;
  for (double value : values) {
    parameters.emplace_back(value);
    parameters.back().v[static_cast<int>(parameters.size()) % 4] = 1.0;
  }
  return parameters;
}

/// All numbers that the recorded equations give at a state, side by side.
template <class T>
std::vector<double> all_numbers(const CompiledSystem& system, const std::vector<T>& parameters,
                                const State<T>& state, bool machine_code) {
  Equations<T> equations(system);
  equations.compiled().allow(machine_code);
  equations.set_design(parameters);
  VectorX<T> G, Phi, Phi_rate;
  T g;
  Linearization<T> d;
  d.resize(system.patterns());
  equations.residual(state, &G, &g);
  equations.linearize(state, &d);
  equations.constraint_errors(state, &Phi, &Phi_rate);
  std::vector<double> numbers;
  const auto append = [&numbers](const auto& from) {
    const auto* const first = reinterpret_cast<const double*>(from.data());
    numbers.insert(numbers.end(), first,
                   first + static_cast<std::size_t>(from.size()) * sizeof(T) / sizeof(double));
  };
  append(G), append(Phi), append(Phi_rate), append(d.position), append(d.velocity), append(d.rate),
      append(d.time);
  append(std::vector<T>{g});
  return numbers;
}

void expect_equal(const std::vector<double>& x, const std::vector<double>& y) {
  ASSERT_EQ(x.size(), y.size());
  int different = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
    different += x[k] == y[k] || (std::isnan(x[k]) && std::isnan(y[k])) ? 0 : 1;
  EXPECT_EQ(different, 0) << "of " << x.size();
}

}  // namespace

void EquationsFixture::expect_same_bits() {
  expect_equal(all_numbers(system, system.parameters(), state, true),
               all_numbers(system, system.parameters(), state, false));
  const std::vector<L> parameters = directed(system.parameters());
  const State<L> point = directed(state);
  expect_equal(all_numbers(system, parameters, point, true),
               all_numbers(system, parameters, point, false));
}

void EquationsFixture::expect_exact_lanes() {
  constexpr double kStep = 1e-30;
  Equations<L> recorded(system);
  const std::vector<L> parameters = directed(system.parameters());
  recorded.set_design(parameters);
  const State<L> point = directed(state);
  VectorX<L> G;
  L g;
  recorded.residual(point, &G, &g);
  for (int lane = 0; lane < 4; ++lane) {
    const auto along = [lane](const auto& from, auto* to) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(from.size()); ++k)
        to->data()[k] = std::complex<double>(from.data()[k].a, kStep * from.data()[k].v[lane]);
    };
    std::vector<std::complex<double>> design(parameters.size());
    along(parameters, &design);
    complex.set_design(design);
    State<std::complex<double>> moved;
    cast_state(state, &moved);
    along(point.q, &moved.q), along(point.v, &moved.v), along(point.s, &moved.s),
        along(point.z, &moved.z);
    VectorX<std::complex<double>> expected;
    std::complex<double> expected_g;
    complex.residual(moved, &expected, &expected_g);
    const auto compare = [lane](const L& x, const std::complex<double>& y) {
      const double size = 1.0 + std::abs(y.real()) + x.directions().norm();
      EXPECT_LT(std::max(std::abs(x.a - y.real()), std::abs(x.v[lane] - y.imag() / kStep)),
                1e-11 * size);
    };
    compare(g, expected_g);
    for (Eigen::Index k = 0; k < G.size(); ++k) compare(G[k], expected[k]);
  }
  const std::vector<double> values = system.parameters();
  complex.set_design({values.begin(), values.end()});
}

void EquationsFixture::expect_exact_residual() {
  VectorX<double> expected, G;
  double expected_g = 0.0, g = 0.0;
  real.formulas().residual(state, &expected, &expected_g);
  real.residual(state, &G, &g);
  EXPECT_LT((G - expected).lpNorm<Eigen::Infinity>(),
            1e-12 * (1.0 + expected.lpNorm<Eigen::Infinity>()));
  EXPECT_NEAR(g, expected_g, 1e-12 * (1.0 + std::abs(expected_g)));
  State<double> counted = state, by_formulas = state;
  real.track_turns(&counted);
  real.formulas().track_turns(&by_formulas);
  for (int slot = 0; slot < system.layout().drop_slot; ++slot)
    EXPECT_NEAR(counted.turns[to_index(slot)], by_formulas.turns[to_index(slot)], 1e-12);
}

}  // namespace codesign
