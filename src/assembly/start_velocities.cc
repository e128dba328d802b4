// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_velocities.h"

#include <algorithm>
#include <cmath>

#include "assembly/tree_loops.h"
#include "control/reference.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kTakesPart = 1e-9;  // smaller entries of the loops' Jacobian count as zero
// Rates that are that many times the given ones follow from a lever that is zero but for rounding:
// positions at a dead centre are known to the square root of 1e-12.
constexpr double kLongestLever = 1e5;

double largest_entry(const VectorX<double>& x) {
  return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace

/// The largest rate of a coordinate of the loops, with slides by their levers [1/s].
double StartVelocities::largest_rate(const VectorX<double>& rate) const {
  double largest = 0.0;
  for (const int c : loops_.jacobian.coordinates())
    largest = std::max(largest, std::abs(rate[c]) / scaled_.scales.columns[c]);
  return largest;
}

/// The given velocities and the joint that cannot follow them, since it has no lever.
Status StartVelocities::forbidden(const VectorX<double>& rates,
                                  std::vector<std::size_t>* contradicting) const {
  const LoopJacobian& jacobian = loops_.jacobian;
  const RobotDescription& robot = loops_.system.robot();
  int fastest = jacobian.coordinates().front();
  const auto rate = [&](int c) { return std::abs(rates[c]) / scaled_.scales.columns[c]; };
  for (const int c : jacobian.coordinates())
    if (rate(c) > rate(fastest)) fastest = c;
  std::string owner, joints, follower;
  double lever = -1.0;
  for (SparseMatrix::InnerIterator entry(scaled_.matrix, fastest); entry; ++entry)
    if (std::abs(entry.value()) > lever) {
      lever = std::abs(entry.value());
      owner = jacobian.owner(static_cast<int>(entry.row()));
    }
  const std::vector<InitialJointState>& given = loops_.system.study().initial_state;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const bool moves = given[k].velocity || given[k].linear_velocity || given[k].angular_velocity;
    if (tree_joint(robot, given[k]) < 0 || !moves) continue;
    joints += (joints.empty() ? "'" : ", '") + given[k].joint + "'";
    contradicting->push_back(k);
  }
  for (const int j : loops_.tree.joint_order)
    if (loops_.tree.offset[to_index(j)] <= fastest) follower = robot.joints[to_index(j)].name;
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "loop or coupling '" + owner + "' forbids the given velocities" +
              (joints.empty() ? "" : " of " + joints) + ": joint '" + follower +
              "' has no lever there (a dead centre) and would have to follow at " +
              readable(rates[fastest], 3) +
              " rad/s or m/s; start from another position, or "
              "give the velocity of '" +
              follower + "'"};
}

/// Sets given_: zero but for motions that are given.
void StartVelocities::find_given_rates(const StartDesign& design, double time) {
  given_.setZero(loops_.jacobian.rows());
  for (std::size_t k = 0; k < loops_.system.topology().couplings.size(); ++k)
    given_[loops_.jacobian.first_coupling_row() + to_signed(k)] =
        loops_.followers.given_motion(*design.equations, k, time).rate;
}

void StartVelocities::choose(const GivenStart& given, StartDependents* dependents,
                             double rank_tolerance) {
  velocities_.resize(4);
  not_open_ = given.velocity;
  for (std::size_t k = 0; k < given.position.size(); ++k)
    if (given.position[k] || given.velocity_beside[k]) not_open_[k] = true;
  loops_.followers.by_preference(not_open_, &velocities_);
  for (int c = 0; c < loops_.tree.size; ++c)
    if (const auto k = to_index(c); not_open_[k] && !given.velocity[k])
      velocities_[given.position[k] ? 3 : 2].push_back(c);
  loops_.followers.by_preference(given.position, &positions_);
  const auto factor = [&](const ColumnPreferences& preferences, DependentSolution* solution) {
    solution->factor(scaled_, independent_.choose(scaled_.matrix, preferences, rank_tolerance),
                     rank_tolerance);
  };
  factor(positions_, &dependents->positions);
  factor(velocities_, &dependents->velocities);
}

Status StartVelocities::find(const StartDesign& design, Posture* posture,
                             StartDependents* dependents, std::vector<std::size_t>* contradicting) {
  VectorX<double>& rate = posture->rate;
  scaled_.evaluate(loops_, design, posture->theta, LoopRows::kEnforced);
  choose(posture->given, dependents, posture->rank_tolerance);
  enforced_ = scaled_.unscaled;
  for (int c = 0; c < loops_.tree.size; ++c)
    for (SparseMatrix::InnerIterator entry(enforced_, c); entry; ++entry)
      if (loops_.drops[to_index(entry.row())]) entry.valueRef() *= 0.0;
  find_given_rates(design, posture->time);
  rows_.noalias() = enforced_ * rate;
  rows_ -= given_;
  const double given = largest_rate(rate) + largest_entry(given_);
  const DependentSolution& velocities = dependents->velocities;
  const Eigen::MatrixXd& step = velocities.solve(rows_, &scaled_rows_, &solution_);
  for (std::size_t k = 0; k < velocities.columns.size(); ++k)
    rate[velocities.columns[k]] -= step(to_signed(k), 0);
  left_.noalias() = enforced_ * rate;
  left_ -= given_;
  if (left_.size() > 0 &&
      !(left_.cwiseAbs().maxCoeff() <= 1e-9 * (1.0 + rate.cwiseAbs().maxCoeff())))
    return contradiction(contradicting);
  if (largest_rate(rate) > kLongestLever * given) return forbidden(rate, contradicting);
  return {};
}

// The message names the joints with a given velocity that appear in a violated row.
Status StartVelocities::contradiction(std::vector<std::size_t>* contradicting) const {
  const double most = left_.cwiseAbs().maxCoeff();
  std::string joints, loop;
  const std::vector<InitialJointState>& given = loops_.system.study().initial_state;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const int joint = tree_joint(loops_.system.robot(), given[k]);
    if (joint < 0 || !given[k].velocity) continue;
    for (Eigen::Index row = 0; row < left_.size(); ++row) {
      if (std::abs(left_[row]) < 1e-3 * most) continue;
      loop = loops_.jacobian.owner(static_cast<int>(row));
      if (std::abs(enforced_.coeff(row, loops_.tree.offset[to_index(joint)])) < kTakesPart)
        continue;
      joints += (joints.empty() ? "'" : ", '") + given[k].joint + "'";
      contradicting->push_back(k);
      break;
    }
  }
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "the given initial velocities of " + joints +
              " contradict each other: loop or coupling '" + loop + "' cannot follow them"};
}

}  // namespace codesign
