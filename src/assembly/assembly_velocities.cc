// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that solve for velocities, doc/theory.md (20).
#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kTakesPart = 1e-9;  // smaller entries of the loops' Jacobian count as zero
// Rates that are that many times the given ones follow from a lever that is zero but for rounding:
// positions at a dead centre are known to the square root of 1e-12.
constexpr double kLongestLever = 1e5;

double largest_of(const VectorX<double>& x) { return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0; }

}  // namespace

/// The largest rate of a coordinate of the loops, with slides by their levers [1/s].
double Assembly::largest_rate(const VectorX<double>& rate) const {
  double largest = 0.0;
  for (const int c : loops_.coordinates())
    largest = std::max(largest, std::abs(rate[c]) / work_.loops.scales.columns[c]);
  return largest;
}

/// The given velocities and the joint that cannot follow them, since it has no lever.
Status Assembly::forbidden() {
  int fastest = loops_.coordinates().front();
  const auto rate = [&](int c) { return std::abs(theta_rate_[c]) / work_.loops.scales.columns[c]; };
  for (const int c : loops_.coordinates())
    if (rate(c) > rate(fastest)) fastest = c;
  std::string owner, joints, follower;
  double lever = -1.0;
  for (SparseMatrix::InnerIterator entry(work_.loops.matrix, fastest); entry; ++entry)
    if (std::abs(entry.value()) > lever) {
      lever = std::abs(entry.value());
      owner = loops_.owner(static_cast<int>(entry.row()));
    }
  const std::vector<InitialJointState>& given = system_.study().initial_state;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const int joint = tree_joint(system_.robot(), given[k]);
    const bool moves = given[k].velocity || given[k].linear_velocity || given[k].angular_velocity;
    if (joint < 0 || !moves) continue;
    joints += (joints.empty() ? "'" : ", '") + given[k].joint + "'";
    contradicting_.push_back(k);
  }
  for (int j : tree_.joint_order)
    if (tree_.offset[to_index(j)] <= fastest) follower = system_.robot().joints[to_index(j)].name;
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "loop or coupling '" + owner + "' forbids the given velocities" +
              (joints.empty() ? "" : " of " + joints) + ": joint '" + follower +
              "' has no lever there (a dead centre) and would have to follow at " +
              readable(theta_rate_[fastest], 3) +
              " rad/s or m/s; start from another position, or "
              "give the velocity of '" +
              follower + "'"};
}

/// Sets work_.given to the rates that the rows of the loops and couplings have: zero but for
/// motions that are given.
void Assembly::find_given_rates(const Equations<double>& equations) {
  work_.given.setZero(loops_.rows());
  const std::vector<Coupling>& couplings = system_.topology().couplings;
  for (std::size_t k = 0; k < couplings.size(); ++k)
    work_.given[loops_.first_coupling_row() + static_cast<int>(k)] =
        given_motion(equations, couplings[k]).rate;
}

Status Assembly::solve_velocities(const std::vector<double>& parameters,
                                  Equations<double>* equations) {
  ColumnPreferences& preferences = work_.velocities;
  preferences.resize(4);
  work_.not_open = velocity_given_;
  for (std::size_t k = 0; k < position_given_.size(); ++k)
    if (position_given_[k] || velocity_beside_[k]) work_.not_open[k] = true;
  by_preference(work_.not_open, &preferences);
  for (int c = 0; c < tree_.size; ++c)
    if (const auto k = to_index(c); work_.not_open[k] && !velocity_given_[k])
      preferences[position_given_[k] ? 3 : 2].push_back(c);
  scale_loops(parameters, *equations);
  prefer_positions();
  choose(work_.positions, &positions_);
  choose(preferences, &velocities_);
  work_.enforced = work_.loops.unscaled;
  for (int c = 0; c < tree_.size; ++c)
    for (SparseMatrix::InnerIterator entry(work_.enforced, c); entry; ++entry)
      if (drops_[to_index(entry.row())]) entry.valueRef() *= 0.0;
  find_given_rates(*equations);
  work_.rows.noalias() = work_.enforced * theta_rate_;
  work_.rows -= work_.given;
  const double given = largest_rate(theta_rate_) + largest_of(work_.given);
  const Eigen::MatrixXd& step = velocities_.solve(work_.rows, &work_.scaled, &work_.solution);
  for (std::size_t k = 0; k < velocities_.columns.size(); ++k)
    theta_rate_[velocities_.columns[k]] -= step(to_signed(k), 0);
  work_.left.noalias() = work_.enforced * theta_rate_;
  work_.left -= work_.given;
  if (work_.left.size() > 0 &&
      !(work_.left.cwiseAbs().maxCoeff() <= 1e-9 * (1.0 + theta_rate_.cwiseAbs().maxCoeff())))
    return contradiction();
  if (largest_rate(theta_rate_) > kLongestLever * given) return forbidden();
  return {};
}

Status Assembly::solve_velocities(const std::vector<double>& parameters,
                                  Equations<double>* equations, State<double>* state) {
  if (Status status = solve_velocities(parameters, equations); !status.ok()) return status;
  const Status branch = choose_branch(parameters, equations);
  follow_gears();
  place(parameters, equations, state);
  return branch.ok() ? require_rest(*state, equations) : branch;
}

// The message names the joints with a given velocity that appear in a violated row.
Status Assembly::contradiction() {
  const VectorX<double>& left = work_.left;
  const double most = left.cwiseAbs().maxCoeff();
  std::string joints, loop;
  const std::vector<InitialJointState>& given = system_.study().initial_state;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const int joint = tree_joint(system_.robot(), given[k]);
    if (joint < 0 || !given[k].velocity) continue;
    for (Eigen::Index row = 0; row < left.size(); ++row) {
      if (std::abs(left[row]) < 1e-3 * most) continue;
      loop = loops_.owner(static_cast<int>(row));
      if (std::abs(work_.enforced.coeff(row, tree_.offset[to_index(joint)])) < kTakesPart) continue;
      joints += (joints.empty() ? "'" : ", '") + given[k].joint + "'";
      contradicting_.push_back(k);
      break;
    }
  }
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "the given initial velocities of " + joints +
              " contradict each other: loop or coupling '" + loop + "' cannot follow them"};
}

}  // namespace codesign
