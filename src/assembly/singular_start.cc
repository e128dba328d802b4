// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/singular_start.h"

#include <algorithm>
#include <cmath>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "mechanism/constants.h"

namespace codesign {
namespace {

// A position that is solved for can be off the singular one by the square root of its tolerance.
constexpr double kRankAtStart = 1e-4;
constexpr double kIsMotion = 1e-3;  // allowed norm of L^T (J x)_theta x, relative to (J x)_theta x
// Step [rad or m] of the fourth-order differences, whose error is about 1e-12.
constexpr double kDifference = 1e-3;
constexpr int kIterations = 50;
// Number of entries of J; a larger J is not analysed, since its QR factorization is dense.
constexpr Eigen::Index kLargest = 250000;

}  // namespace

SingularStart::SingularStart(const CompiledSystem& system, const TreeLayout& tree,
                             const LoopJacobian& loops)
    : system_(system), tree_(tree), loops_(loops) {
  state_.resize(system.layout());
  const std::vector<Coupling>& couplings = system.topology().couplings;
  for (int row = 0; row < loops.rows(); ++row) {
    const int coupling = row - loops.first_coupling_row();
    const bool is_given = coupling >= 0 && coupling < static_cast<int>(couplings.size()) &&
                          couplings[to_index(coupling)].motion >= 0;
    (is_given ? given_ : others_).push_back(row);
  }
}

void SingularStart::rates(const VectorX<double>& theta, const VectorX<double>& x,
                          VectorX<double>* result) {
  link_motions(system_.robot(), tree_, parameters_, theta, x, &motion_.links);
  state_coordinates(system_, tree_, equations_->constants(), motion_.links, theta, x, &state_.q,
                    &state_.v);
  equations_->constraint_errors(state_, &Phi_, &Phi_rate_);
  loops_.take_part(Phi_rate_, result);
}

void SingularStart::difference(double step, const VectorX<double>& x, VectorX<double>* result) {
  moved_ = theta_ + step * x;
  rates(moved_, x, &forward_);
  moved_ = theta_ - step * x;
  rates(moved_, x, result);
  *result = forward_ - *result;
}

void SingularStart::load(const std::vector<double>& parameters, const VectorX<double>& theta,
                         Equations<double>* equations) {
  const Eigen::Index count = loops_.rows();
  parameters_ = parameters;
  theta_ = theta;
  equations_ = equations;
  if (count == 0 || count * tree_.size > kLargest) {
    L_.resize(count, 0);
    return;
  }
  loops_.evaluate(parameters, theta, *equations, &motion_, &sparse_J_);
  J_ = sparse_J_;
  for (const int row : given_) J_.row(row).setZero();
  const auto count_of_others = to_signed(others_.size());
  Eigen::MatrixXd& analysed = qr_.matrix(count_of_others, J_.cols());
  for (Eigen::Index k = 0; k < count_of_others; ++k) analysed.row(k) = J_.row(others_[to_index(k)]);
  qr_.factor(kRankAtStart);
  qr_.complement(&complement_);
  L_.setZero(J_.rows(), complement_.cols());
  for (Eigen::Index k = 0; k < count_of_others; ++k)
    L_.row(others_[to_index(k)]) = complement_.row(k);
}

// (J x)_theta x, by central differences of fourth order.
void SingularStart::curvature(const VectorX<double>& x) {
  const double h = kDifference / x.cwiseAbs().maxCoeff();
  difference(h, x, &near_);
  difference(2.0 * h, x, &far_);
  H_ = (8.0 * near_ - far_) / (12.0 * h);
}

const VectorX<double>& SingularStart::violation(const VectorX<double>& x) {
  curvature(x);
  tolerance_ = kIsMotion * H_.norm() + 1e-8 * J_.norm() * x.squaredNorm();
  B_.noalias() = L_.transpose() * H_;
  return B_;
}

bool SingularStart::is_motion(const VectorX<double>& x) {
  if (L_.cols() == 0 || x.isZero(0.0)) return true;
  const VectorX<double>& B = violation(x);
  violated_.noalias() = L_ * B;
  return B.norm() <= tolerance_;
}

// Newton's method on J x = 0 (without the nearly dependent part L L^T J) and L^T (J x)_theta x = 0,
// with steps of least norm.
bool SingularStart::solve(const std::vector<int>& free, VectorX<double>* x) {
  const Eigen::MatrixXd J = J_ - product(L_, transposed_product(L_, J_));
  const auto count = to_signed(free.size());
  Eigen::MatrixXd A(J.rows() + L_.cols(), count);
  VectorX<double> error(A.rows());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (x->isZero(0.0)) return false;
    error << J * *x, violation(*x);
    if (error.norm() <= 1e-6 * tolerance_) return true;
    for (Eigen::Index k = 0; k < count; ++k) {
      const VectorX<double> unit = x->norm() * VectorX<double>::Unit(tree_.size, free[to_index(k)]);
      const VectorX<double> forward = violation(*x + unit), backward = violation(*x - unit);
      A.col(k) << J.col(free[to_index(k)]), (forward - backward) / (2.0 * x->norm());
    }
    const VectorX<double> step = LeastNorm(A, 1e-6).solve(error);
    for (Eigen::Index k = 0; k < count; ++k) (*x)[free[to_index(k)]] -= step[k];
    if (!x->allFinite()) return false;
  }
  return false;
}

bool SingularStart::choose_motion(const std::vector<bool>& held, VectorX<double>* x) {
  std::vector<int> free;
  for (int c = 0; c < tree_.size; ++c)
    if (!held[to_index(c)]) free.push_back(c);
  const VectorX<double> first = *x;
  // The first-order solution may lie between the tangents of two motions, where Newton's method
  // fails: it is then started from both sides.
  for (int attempt = 0; attempt <= 2 * static_cast<int>(free.size()) && attempt <= 8; ++attempt) {
    *x = first;
    if (attempt > 0)
      (*x)[free[to_index((attempt - 1) / 2)]] += (attempt % 2 == 1 ? 1.0 : -1.0) * first.norm();
    if (!free.empty() && solve(free, x)) return true;
  }
  *x = first;
  return false;
}

const VectorX<double>& SingularStart::tree_accelerations(In<double> a) {
  accelerations_.setZero(tree_.size);
  if (!is_singular()) return accelerations_;
  Eigen::MatrixXd& body_velocities = tree_of_bodies_.matrix(a.size(), tree_.size);
  unit_.setZero(tree_.size);
  for (int c = 0; c < tree_.size; ++c) {
    unit_[c] = 1.0;
    rates(theta_, unit_, &forward_);
    unit_[c] = 0.0;
    body_velocities.col(c) = state_.v;
  }
  tree_of_bodies_.factor(least_norm_threshold(a.size(), tree_.size));
  a_ = Eigen::Map<const Eigen::VectorXd>(a.data(), a.size());
  accelerations_ = tree_of_bodies_.solve(a_, &solution_);
  return accelerations_;
}

std::string SingularStart::joints() const {
  std::string text;
  const double largest = violated_.cwiseAbs().maxCoeff();
  VectorX<double> moves = VectorX<double>::Zero(tree_.size);
  for (Eigen::Index row = 0; row < violated_.size(); ++row) {
    if (std::abs(violated_[row]) < 1e-6 * largest) continue;
    for (Eigen::Index other = 0; other < violated_.size(); ++other)
      if (loops_.owner(static_cast<int>(other)) == loops_.owner(static_cast<int>(row)))
        moves = moves.cwiseMax(J_.row(other).transpose().cwiseAbs());
  }
  for (std::size_t k = 0; k < system_.robot().joints.size(); ++k) {
    const JointDescription& joint = system_.robot().joints[k];
    const bool has_coordinate = std::find(tree_.joint_order.begin(), tree_.joint_order.end(),
                                          static_cast<int>(k)) != tree_.joint_order.end();
    if (!has_coordinate || joint.is_fixed()) continue;
    if (moves[tree_.offset[k]] > 1e-6 * moves.maxCoeff())
      text += (text.empty() ? "'" : ", '") + joint.name + "'";
  }
  return text;
}

}  // namespace codesign
