// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_coordinates.h"

#include <algorithm>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kRankOfRows = 1e-8;  // as rounding leaves of rows that depend on each other
constexpr double kClear = 1e-2;       // part of a coordinate that the chosen ones do not determine

/// Entries of the constraint rows of one of the recorded matrices.
Eigen::MatrixXd rows_of(const CompiledSystem& system, const Sparsity& pattern,
                        const std::vector<double>& values) {
  const Layout& layout = system.layout();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(layout.constraints(), layout.n);
  for (int row = 0; row < layout.constraints(); ++row) {
    const int of = layout.lambda_column(row);
    for (int e = pattern.first(of); e < pattern.first(of + 1); ++e)
      if (pattern.column(e) < layout.n) rows(row, pattern.column(e)) = values[to_index(e)];
  }
  for (const int row : system.dropped_rows()) rows.row(row).setZero();
  return rows;
}

/// The joint of a coordinate in q; null for one of a pair with several coordinates.
const JointDescription* joint_of(const CompiledSystem& system, int column) {
  const Topology& topology = system.topology();
  for (std::size_t p = 0; p < topology.pairs.size(); ++p)
    for (std::size_t e = 0; e < topology.pairs[p].chain.size(); ++e)
      if (system.layout().element_column(static_cast<int>(p), static_cast<int>(e)) == column)
        return &system.robot().joints[to_index(topology.pairs[p].chain[e].joint)];
  return nullptr;
}

/// 0 for the joints that the study starts, 1 for other joints, 2 for other coordinates.
int tier_of(const CompiledSystem& system, int column) {
  const JointDescription* joint = joint_of(system, column);
  if (!joint) return 2;
  for (const InitialJointState& initial : system.study().initial_state)
    if (initial.joint == joint->name && initial.position) return 0;
  return 1;
}

/// Rows of N, as many as columns, that are far from dependent; of the earlier tiers where this is
/// possible.
std::vector<int> choose_rows(const Eigen::MatrixXd& N, const std::vector<int>& tiers) {
  Eigen::MatrixXd rest = N;
  std::vector<int> chosen;
  for (int tier = 0; tier <= 3; ++tier)
    while (to_signed(chosen.size()) < N.cols()) {
      int best = -1;
      for (int row = 0; row < N.rows(); ++row)
        if ((tier == 3 || tiers[to_index(row)] == tier) &&
            (best < 0 || rest.row(row).norm() > rest.row(best).norm()))
          best = row;
      if (best < 0 || (tier < 3 && rest.row(best).norm() < kClear * N.row(best).norm()) ||
          rest.row(best).norm() == 0.0)
        break;
      chosen.push_back(best);
      const Eigen::RowVectorXd direction = rest.row(best).normalized();
      rest -= rest * direction.transpose() * direction;
      rest.row(best).setZero();
    }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::string coordinate_name(const CompiledSystem& system, int column) {
  if (const JointDescription* joint = joint_of(system, column)) return joint->name;
  const Layout& layout = system.layout();
  for (int body = layout.bodies - 1; body >= 0; --body) {
    const int next = column - layout.column(body);
    if (next < 0) continue;
    const bool is_last = body + 1 == layout.bodies;
    if (!is_last && layout.column(body + 1) > layout.column(body) &&
        column >= layout.column(body + 1))
      continue;
    return system.topology().bodies[to_index(body)].name + "[" + std::to_string(next) + "]";
  }
  return "q[" + std::to_string(column) + "]";
}

}  // namespace

Eigen::MatrixXd constraint_rows(const CompiledSystem& system,
                                const Linearization<double>& derivatives) {
  return rows_of(system, system.patterns().rate, derivatives.rate);
}

// The rows Phi'' of G are Phi_q a + Phi_qq v v, so that half of their G_v is Phi_qq v.
LinearCoordinates linear_coordinates(const CompiledSystem& system,
                                     const Linearization<double>& derivatives,
                                     const State<double>& state) {
  const Eigen::MatrixXd rows = constraint_rows(system, derivatives);
  const Eigen::MatrixXd N = orthogonal_complement(rows.transpose(), kRankOfRows);
  std::vector<int> tiers;
  tiers.reserve(to_index(system.layout().n));
  for (int column = 0; column < system.layout().n; ++column)
    tiers.push_back(tier_of(system, column));
  LinearCoordinates result{choose_rows(N, tiers), {}, {}};
  const Eigen::Index count = N.cols();
  Eigen::MatrixXd chosen(count, count);
  for (Eigen::Index k = 0; k < count; ++k) chosen.row(k) = N.row(result.columns[to_index(k)]);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(count, count);
  result.Q = count == 0 ? N : product(N, least_norm(chosen).solve(unit));
  result.P = Eigen::MatrixXd::Zero(system.layout().n, count);
  if (state.v.size() == 0 || state.v.isZero(0.0) || rows.rows() == 0 || count == 0) return result;
  const Eigen::MatrixXd turned =
      0.5 * rows_of(system, system.patterns().velocity, derivatives.velocity);
  const Eigen::MatrixXd any = LeastNorm(rows, kRankOfRows).solve(-product(turned, result.Q));
  Eigen::MatrixXd of_chosen(count, count);
  for (Eigen::Index k = 0; k < count; ++k) of_chosen.row(k) = any.row(result.columns[to_index(k)]);
  result.P = any - product(result.Q, of_chosen);
  return result;
}

std::vector<std::string> linear_state_names(const CompiledSystem& system,
                                            const std::vector<int>& columns) {
  std::vector<std::string> names;
  names.reserve(2 * columns.size() + to_index(system.layout().states));
  for (const char* quantity : {"/position", "/velocity"})
    for (const int column : columns) names.push_back(coordinate_name(system, column) + quantity);
  const std::size_t first = names.size();
  for (int k = 0; k < system.layout().states; ++k) names.push_back("s[" + std::to_string(k) + "]");
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const Controller& controller = system.controllers()[c];
    const std::string of = system.study().controllers[c].name + "/";
    int filters = 0;
    for (const StatePlace& place :
         controller.places(system.study().controllers[c].realization.queued()))
      for (int k = 0; place.first >= 0 && k < place.count; ++k) {
        const std::string name = place.name;
        const bool is_list = name == "queue" || name == "feedback_filter" || name == "estimate";
        const int number = name == "feedback_filter" ? filters++ : k;
        names[first + to_index(place.first + k)] =
            of + name + (is_list ? "[" + std::to_string(number) + "]" : "");
      }
  }
  for (const Winding& winding : system.windings())
    if (winding.state >= 0) names[first + to_index(winding.state)] = winding.joint + "/current";
  return names;
}

}  // namespace codesign
