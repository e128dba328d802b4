// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations_fixture.h"

#include <cmath>

#include "codegen/operate.h"
#include "codegen/value_code.h"
#include "control/reference.h"
#include "control/shaped_input.h"
#include "equations/compiled_equations.h"
#include "equations/equation_code.h"
#include "equations/recorded_equations.h"
#include "math/derivative_check.h"
#include "math/ridders.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

ReferenceMotion<double> motion_at(const SourceId& source, double t, const std::vector<double>& parameters) {
  if (const auto* basis = source.as<BasisDescription>()) {
    ShapedInput<double> input;
    input.set(*basis, parameters);
    return input.at(t);
  }
  Reference<double> reference;
  reference.set(*source.as<ReferenceDescription>(), parameters);
  return reference.at(t);
}

/// The values of all nodes at a state of one design, one after the other.
std::vector<double> node_values(const Recording& recording, const State<double>& state, const std::vector<double>& parameters) {
  std::vector<double> values;
  const auto leaf = [&](const Recording::Node& node) {
    const VectorX<double>* const vectors[] = {&state.q, &state.v, &state.s, &state.z};
    if (node.a <= EquationArrays::kZ) return (*vectors[node.a])[node.b];
    if (node.a == RecordedEquations::kTurns) return state.turns[static_cast<std::size_t>(node.b)];
    if (node.a == Recording::kSupplied)
      return node.b < 0 ? 0.0 : value_at(*recording.supplied_sources()[static_cast<std::size_t>(node.b)].as<Expression>(), parameters);
    const SourceId& source = recording.timed_sources()[static_cast<std::size_t>(node.b / Recording::kFunctionOrders)];
    const ReferenceMotion<double> motion = motion_at(source, state.t, parameters);
    const double orders[] = {motion.value, motion.rate, motion.acceleration, motion.jerk};
    return orders[node.b % Recording::kFunctionOrders];
  };
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    const bool is_input = node.operation == Operation::kLeaf || node.operation == Operation::kLiteral;
    const double a = is_input || node.a < 0 ? 0.0 : values[static_cast<std::size_t>(node.a)];
    const double b = is_input || node.b < 0 ? 0.0 : values[static_cast<std::size_t>(node.b)];
    values.push_back(node.operation == Operation::kLeaf      ? leaf(node)
                     : node.operation == Operation::kLiteral ? node.literal
                                                             : operate(node.operation, a, b));
  }
  return values;
}

}  // namespace

EquationsFixture::EquationsFixture(const std::string& urdf, const std::string& study, const ReactionSharing& sharing)
    : robot(read_urdf({"all.urdf", urdf})), system(robot, read_study({"all.yaml", study}, robot), sharing), real(system), complex(system) {
  const std::vector<double> parameters = system.parameters();
  real.set_design(parameters);
  complex.set_design(std::vector<std::complex<double>>(parameters.begin(), parameters.end()));
  state.resize(system.layout());
  // Any point will do; the formulas hold off the constraints too.
  const auto fill = [](VectorX<double>* x, double phase) {
    for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k] = std::sin(1.7 * static_cast<double>(k) + phase);
  };
  fill(&state.q, 0.3);
  fill(&state.v, 1.1);
  fill(&state.s, 2.0);
  fill(&state.z, 0.7);
  for (int b = 0; b < system.layout().bodies; ++b) state.q.segment<4>(kBodySize * b + 3).normalize();
}

Eigen::MatrixXd EquationsFixture::reference(VectorX<std::complex<double>> State<std::complex<double>>::*member, const VectorX<double>& at) {
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

Eigen::MatrixXd EquationsFixture::dense(const Sparsity& pattern, const std::vector<double>& values) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(pattern.rows, pattern.columns);
  for (int row = 0; row < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) matrix(row, pattern.column(e)) = values[static_cast<std::size_t>(e)];
  return matrix;
}

void EquationsFixture::expect_exact_derivatives(double tolerance, bool recorded) {
  expect_code(recorded);
  expect_same_lanes();
  if (recorded) expect_same_derived(tolerance);
  for (bool compiled : {true, false}) {
    SCOPED_TRACE(compiled ? "compiled" : "not compiled");
    real.compiled().allow(compiled);
    expect_exact_derivatives_of_real(tolerance);
  }
  real.compiled().allow(true);
}

void EquationsFixture::expect_exact_derivatives_of_real(double tolerance) {
  using S = State<std::complex<double>>;
  Linearization<double> d;
  d.resize(system.patterns());
  real.linearize(state, &d);
  expect_exact_residual();
  const Layout& layout = system.layout();
  const Eigen::MatrixXd by_position = dense(system.patterns().position, d.position);
  EXPECT_LT(compare_jacobians(by_position.leftCols(layout.n), reference(&S::q, state.q)).largest, tolerance);
  if (layout.states > 0) {
    EXPECT_LT(compare_jacobians(by_position.rightCols(layout.states), reference(&S::s, state.s)).largest, tolerance);
  }
  EXPECT_LT(compare_jacobians(dense(system.patterns().velocity, d.velocity), reference(&S::v, state.v)).largest, tolerance);
  EXPECT_LT(compare_jacobians(dense(system.patterns().rate, d.rate), reference(&S::z, state.z)).largest, tolerance);
  EXPECT_LT(compare_jacobians(d.time, time_reference()).largest, 1e-8);
}

void EquationsFixture::expect_code(bool recorded) {
  if (!ValueCode::is_available()) return;
  ASSERT_NE(system.equation_code(), nullptr) << "the equations decide something without is_less()";
  VectorX<double> G;
  double g = 0.0;
  EXPECT_EQ(real.compiled().residual(state, &G, &g), recorded);
}

void EquationsFixture::expect_same_derived(double tolerance) {
  Linearization<double> formulas;
  formulas.resize(system.patterns());
  real.formulas().linearize(state, system.plan(), &formulas);
  for (const EliminationOrder order : {EliminationOrder::kForward, EliminationOrder::kReverse, EliminationOrder::kMarkowitz}) {
    Recording recording;
    RecordedEquations recorded(system, &recording);
    recorded.record_residual();
    const Linearization<Traced> derived = derive_linearization(system.patterns(), order, &recorded);
    const std::vector<double> values = node_values(recording, state, system.parameters());
    const auto numbers = [&values](const auto& of) {
      std::vector<double> result;
      for (const Traced& x : of) result.push_back(x.is_literal() ? x.value() : values[static_cast<std::size_t>(x.node())]);
      return result;
    };
    const auto compare = [&](const Sparsity& pattern, const std::vector<Traced>& by, const std::vector<double>& expected) {
      EXPECT_LT(compare_jacobians(dense(pattern, numbers(by)), dense(pattern, expected)).largest, tolerance);
    };
    compare(system.patterns().position, derived.position, formulas.position);
    compare(system.patterns().velocity, derived.velocity, formulas.velocity);
    compare(system.patterns().rate, derived.rate, formulas.rate);
    const std::vector<double> time = numbers(derived.time);
    EXPECT_LT(compare_jacobians(Eigen::Map<const Eigen::VectorXd>(time.data(), formulas.time.size()), formulas.time).largest, tolerance);
  }
}

void EquationsFixture::expect_same_lanes() {
  using L = Lanes<4>;
  Equations<L> compiled(system), formulas(system);
  formulas.compiled().allow(false);
  std::vector<L> parameters;
  for (double value : system.parameters()) {
    parameters.emplace_back(value);
    parameters.back().v[static_cast<int>(parameters.size()) % 4] = 1.0;
  }
  State<L> point;
  point.t = state.t;
  point.turns = state.turns;
  const auto direct = [](const VectorX<double>& x, VectorX<L>* lanes) {
    *lanes = x.cast<L>();
    for (Eigen::Index k = 0; k < x.size(); ++k)
      for (int lane = 0; lane < 4; ++lane) (*lanes)[k].v[lane] = std::sin(0.9 * static_cast<double>(k) + lane);
  };
  direct(state.q, &point.q), direct(state.v, &point.v), direct(state.s, &point.s), direct(state.z, &point.z);
  VectorX<L> G[2];
  L g[2];
  Linearization<L> d[2];
  for (int k = 0; k < 2; ++k) {
    Equations<L>& equations = k == 0 ? compiled : formulas;
    equations.set_design(parameters);
    equations.residual(point, &G[k], &g[k]);
    d[k].resize(system.patterns());
    equations.linearize(point, &d[k]);
  }
  const auto compare = [](const L& x, const L& y) {
    const double size = 1.0 + std::abs(y.a) + y.directions().norm();
    EXPECT_LT(std::max(std::abs(x.a - y.a), (x.directions() - y.directions()).norm()), 1e-11 * size);
  };
  compare(g[0], g[1]);
  for (Eigen::Index k = 0; k < G[0].size(); ++k) compare(G[0][k], G[1][k]);
  for (std::size_t k = 0; k < d[0].position.size(); ++k) compare(d[0].position[k], d[1].position[k]);
  for (std::size_t k = 0; k < d[0].velocity.size(); ++k) compare(d[0].velocity[k], d[1].velocity[k]);
  for (std::size_t k = 0; k < d[0].rate.size(); ++k) compare(d[0].rate[k], d[1].rate[k]);
  for (Eigen::Index k = 0; k < d[0].time.size(); ++k) compare(d[0].time[k], d[1].time[k]);
}

void EquationsFixture::expect_exact_residual() {
  State<std::complex<double>> point;
  cast_state(state, &point);
  VectorX<std::complex<double>> expected;
  std::complex<double> expected_g;
  complex.residual(point, &expected, &expected_g);
  VectorX<double> G;
  double g = 0.0;
  real.residual(state, &G, &g);
  EXPECT_LT((G - expected.real()).lpNorm<Eigen::Infinity>(), 1e-12 * (1.0 + expected.real().lpNorm<Eigen::Infinity>()));
  EXPECT_NEAR(g, expected_g.real(), 1e-12 * (1.0 + std::abs(expected_g)));
}

}  // namespace codesign
