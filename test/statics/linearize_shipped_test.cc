// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assembly/assembly.h"
#include "cases/shipped.h"
#include "description/study.h"
#include "equations/iteration_matrix.h"
#include "found_robots.h"
#include "linear/linear_motion.h"
#include "mechanism_codesign/source_text.h"
#include "paths.h"
#include "statics/linearize.h"
#include "statics/statics_cases.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A shipped case as it is, or with one number of its start changed.
struct Start {
  std::string joint;
  bool of_position = true;
  double change = 0.0;
};

/// The accelerations of coordinates at the assembled start, from the equations that runs use.
std::vector<double> start_accelerations(const Problem& problem, const Start& start,
                                        const std::vector<int>& columns) {
  Study study = study_of(problem);
  const std::vector<double> parameters = problem.parameters();
  const auto is_given = [&](const InitialJointState& initial) {
    return initial.joint == start.joint;
  };
  if (std::none_of(study.initial_state.begin(), study.initial_state.end(), is_given)) {
    study.initial_state.emplace_back();
    study.initial_state.back().joint = start.joint;
  }
  for (InitialJointState& initial : study.initial_state) {
    if (!is_given(initial)) continue;
    std::optional<Quantity>& number = start.of_position ? initial.position : initial.velocity;
    number = Quantity((number ? number->at(parameters) : 0.0) + start.change);
  }
  const Problem changed = with_study(problem, study);
  StartWorkspace workspace(*system_of(changed), parameters);
  const Status status = workspace.solve();
  EXPECT_TRUE(status.ok()) << status.cause;
  std::vector<double> values;
  for (const int column : columns) values.push_back(workspace.state.z[column]);
  return values;
}

int column_of(const CompiledSystem& system, const std::string& joint) {
  const Topology& topology = system.topology();
  for (std::size_t p = 0; p < topology.pairs.size(); ++p)
    for (std::size_t e = 0; e < topology.pairs[p].chain.size(); ++e)
      if (system.robot().joints[to_index(topology.pairs[p].chain[e].joint)].name == joint)
        return system.layout().element_column(static_cast<int>(p), static_cast<int>(e));
  ADD_FAILURE() << joint;
  return 0;
}

/// The derivative of start_accelerations(), by central differences of two steps.
std::vector<double> differences(const Problem& problem, Start start,
                                const std::vector<int>& columns) {
  const auto central = [&](double h) {
    start.change = h;
    std::vector<double> slope = start_accelerations(problem, start, columns);
    start.change = -h;
    const std::vector<double> back = start_accelerations(problem, start, columns);
    for (std::size_t k = 0; k < slope.size(); ++k) slope[k] = (slope[k] - back[k]) / (2.0 * h);
    return slope;
  };
  constexpr double kStep = 2e-4;
  const std::vector<double> wide = central(kStep), near = central(0.5 * kStep);
  std::vector<double> result;
  for (std::size_t k = 0; k < wide.size(); ++k) result.push_back((4.0 * near[k] - wide[k]) / 3.0);
  return result;
}

// Loops, friction that depends on reactions, controllers, all in motion.
TEST(Linearize, ShippedCasesAgreeWithDifferences) {
  for (const std::string name : {"slider_crank", "governor", "two_link_arm", "gantry"}) {
    const Problem problem = shipped_problem(name, {});
    const CompiledSystem& system = *system_of(problem);
    const LinearModel model = linearize_in_motion(system, problem.parameters(), {}, 0.0);
    ASSERT_TRUE(model.status.ok()) << model.status.cause;
    std::vector<std::string> joints;
    std::vector<int> columns;
    for (const std::string& state : model.system.states)
      if (ends_with(state, "/position")) {
        joints.push_back(state.substr(0, state.find('/')));
        columns.push_back(column_of(system, joints.back()));
      }
    const auto count = to_signed(joints.size());
    for (Eigen::Index k = 0; k < 2 * count; ++k) {
      const std::vector<double> expected =
          differences(problem, {joints[to_index(k % count)], k < count}, columns);
      for (Eigen::Index row = 0; row < count; ++row) {
        const double scale =
            1.0 + model.system.A.block(count, 0, count, 2 * count).cwiseAbs().maxCoeff();
        EXPECT_NEAR(model.system.A(count + row, k), expected[to_index(row)], 1e-6 * scale)
            << name << " " << model.system.states[to_index(k)];
      }
    }
  }
}

/// Compares the motion between samples about the start with a complex step through the equations
/// of runs: the derivatives of accelerations and of states by (y, y', s) and by all inputs.
void expect_complex_steps(const CompiledSystem& of, const std::vector<double>& parameters,
                          const std::string& name) {
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  const LinearStudy study =
      with_inputs(bare_study({&of, parameters, {}, false, {}}), parameters, 0.0, false);
  const CompiledSystem system(of.robot(), study.study, of.sharing());
  const Layout& layout = system.layout();
  StartWorkspace start(system, study.parameters);
  const Status started = start.solve();
  ASSERT_TRUE(started.ok()) << name << ": " << started.cause;
  LinearMotion motion(system, study);
  const Status status = motion.linearize(start.state);
  ASSERT_TRUE(status.ok()) << name << ": " << status.cause;
  Linearization<double> derivatives;
  derivatives.resize(system.patterns());
  motion.equations().linearize(motion.state(), &derivatives);
  IterationMatrix matrix(system);
  ASSERT_TRUE(matrix.factor(derivatives, 0.0, 0.0, 0.0)) << name;
  Equations<Complex> equations(system);
  equations.compiled().allow(false);
  const LinearCoordinates& y = motion.coordinates();
  const Eigen::Index f = y.Q.cols(), x = 2 * f + layout.states;
  Eigen::MatrixXd expected(x, x + to_signed(study.inputs.size()));
  for (Eigen::Index k = 0; k < expected.cols(); ++k) {
    State<Complex> state;
    cast_state(motion.state(), &state);
    std::vector<Complex> design(study.parameters.begin(), study.parameters.end());
    const Complex step(0.0, kStep);
    if (k < f) {
      state.q += step * y.Q.col(k).cast<Complex>();
      state.v += step * y.P.col(k).cast<Complex>();
    } else if (k < 2 * f) {
      state.v += step * y.Q.col(k - f).cast<Complex>();
    } else if (k < x) {
      state.s[k - 2 * f] += step;
    } else {
      design[study.first + to_index(k - x)] += step;
    }
    equations.set_design(design);
    VectorX<Complex> G, Phi, Phi_rate;
    Complex g;
    if (k < 2 * f) {
      equations.constraint_errors(state, &Phi, &Phi_rate);
      for (const VectorX<Complex>* errors : {&Phi, &Phi_rate})
        for (Eigen::Index row = 0; row < errors->size(); ++row)
          EXPECT_NEAR((*errors)[row].imag() / kStep, 0.0, 1e-8) << name << ", direction " << k;
    }
    equations.residual(state, &G, &g);
    VectorX<double> rates = -G.head(layout.columns()).imag() / kStep;
    matrix.lu().solve(rates);
    expected.col(k).setZero();
    if (k >= f && k < 2 * f) expected(k - f, k) = 1.0;
    for (Eigen::Index row = 0; row < f; ++row)
      expected(f + row, k) = rates[y.columns[to_index(row)]];
    expected.col(k).tail(layout.states) = rates.tail(layout.states);
  }
  Eigen::MatrixXd found(x, expected.cols());
  found << motion.flow().A, motion.flow().B;
  const double scale = 1.0 + expected.cwiseAbs().maxCoeff();
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11 * scale) << name;
}

TEST(Linearize, EveryShippedCaseAgreesWithComplexSteps) {
  int compared = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(source_dir()) / "config")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string name = entry.path().stem().string();
    const Shipped shipped(name);
    if (shipped.study.postures > 0) continue;
    expect_complex_steps(*make_system(shipped.robot, shipped.study), shipped.parameters(), name);
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

// Robots as vendors describe them, hanging from their bases.
TEST(Linearize, RobotsAsTheyAreFoundAgreeWithComplexSteps) {
  if (found_robots().empty()) GTEST_SKIP() << kNoFoundRobots;
  int compared = 0;
  for (const std::filesystem::path& file : found_robots()) {
    try {
      const Problem problem = loaded(read_source(file.string()).text, "duration: 1\n");
      expect_complex_steps(*system_of(problem), problem.parameters(), file.filename());
      ++compared;
    } catch (const InputError&) {
      continue;  // not a machine whose motion is determined: those of doc/corpus.md
    }
  }
  EXPECT_GE(compared, 20);
}

}  // namespace
}  // namespace codesign
