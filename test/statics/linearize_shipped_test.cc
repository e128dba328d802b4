// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "description/study.h"
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
    const Problem problem = load_problem({name + ".urdf", file_text("urdf/" + name + ".urdf")}, {},
                                         {name + ".yaml", file_text("config/" + name + ".yaml")});
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

}  // namespace
}  // namespace codesign
