// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/singular_start.h"

#include <algorithm>
#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kRankAtStart = 1e-4;  // a position that is solved for can be off the singular one by the square root of its tolerance
constexpr double kIsMotion = 1e-3;     // allowed norm of L^T (J x)_theta x, relative to (J x)_theta x
constexpr double kDifference = 1e-3;   // step [rad or m] of the fourth-order differences, whose error is about 1e-12
constexpr int kIterations = 50;
constexpr Eigen::Index kLargest = 250000;  // entries of J; a larger J is not analysed, since its QR factorization is dense

}  // namespace

SingularStart::SingularStart(const CompiledSystem& system, const TreeLayout& tree, const LoopJacobian& loops)
    : system_(system), tree_(tree), loops_(loops) {
  state_.resize(system.layout());
}

VectorX<double> SingularStart::rates(const VectorX<double>& theta, const VectorX<double>& x) {
  body_coordinates(system_, equations_->constants(), link_motions(system_.robot(), tree_, parameters_, theta, x), &state_.q, &state_.v);
  equations_->constraint_errors(state_, &Phi_, &Phi_rate_);
  return loops_.part_of(Phi_rate_);
}

void SingularStart::load(const std::vector<double>& parameters, const VectorX<double>& theta, Equations<double>* equations) {
  const Eigen::Index count = loops_.rows();
  parameters_ = parameters;
  theta_ = theta;
  equations_ = equations;
  L_.resize(count, 0);
  if (count == 0 || count * tree_.size > kLargest) return;
  J_ = loops_.evaluate(parameters, theta, *equations);
  L_ = orthogonal_complement(J_, kRankAtStart);
}

// (J x)_theta x, by central differences of fourth order.
VectorX<double> SingularStart::curvature(const VectorX<double>& x) {
  const double h = kDifference / x.cwiseAbs().maxCoeff();
  const VectorX<double> near = rates(theta_ + h * x, x) - rates(theta_ - h * x, x);
  const VectorX<double> far = rates(theta_ + 2.0 * h * x, x) - rates(theta_ - 2.0 * h * x, x);
  return (8.0 * near - far) / (12.0 * h);
}

VectorX<double> SingularStart::violation(const VectorX<double>& x) {
  const VectorX<double> H = curvature(x);
  tolerance_ = kIsMotion * H.norm() + 1e-8 * J_.norm() * x.squaredNorm();
  return L_.transpose() * H;
}

bool SingularStart::is_motion(const VectorX<double>& x) {
  if (L_.cols() == 0 || x.isZero(0.0)) return true;
  const VectorX<double> B = violation(x);
  violated_ = L_ * B;
  return B.norm() <= tolerance_;
}

// Newton's method on J x = 0 (without the nearly dependent part L L^T J) and L^T (J x)_theta x = 0, with steps of least norm.
bool SingularStart::solve(const std::vector<int>& free, VectorX<double>* x) {
  const Eigen::MatrixXd J = J_ - L_ * (L_.transpose() * J_);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd A(J.rows() + L_.cols(), count);
  VectorX<double> error(A.rows());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (x->isZero(0.0)) return false;
    error << J * *x, violation(*x);
    if (error.norm() <= 1e-6 * tolerance_) return true;
    for (Eigen::Index k = 0; k < count; ++k) {
      const VectorX<double> unit = x->norm() * VectorX<double>::Unit(tree_.size, free[static_cast<std::size_t>(k)]);
      A.col(k) << J.col(free[static_cast<std::size_t>(k)]), (violation(*x + unit) - violation(*x - unit)) / (2.0 * x->norm());
    }
    const VectorX<double> step = LeastNorm(A, 1e-6).solve(error);
    for (Eigen::Index k = 0; k < count; ++k) (*x)[free[static_cast<std::size_t>(k)]] -= step[k];
    if (!x->allFinite()) return false;
  }
  return false;
}

bool SingularStart::choose_motion(const std::vector<bool>& held, VectorX<double>* x) {
  std::vector<int> free;
  for (int c = 0; c < tree_.size; ++c)
    if (!held[static_cast<std::size_t>(c)]) free.push_back(c);
  const VectorX<double> first = *x;
  // The first-order solution may lie between the tangents of two motions, where Newton's method fails: it is then started from both sides.
  for (int attempt = 0; attempt <= 2 * static_cast<int>(free.size()) && attempt <= 8; ++attempt) {
    *x = first;
    if (attempt > 0) (*x)[free[static_cast<std::size_t>((attempt - 1) / 2)]] += (attempt % 2 == 1 ? 1.0 : -1.0) * first.norm();
    if (!free.empty() && solve(free, x)) return true;
  }
  *x = first;
  return false;
}

VectorX<double> SingularStart::tree_accelerations(const VectorX<double>& a) {
  if (L_.cols() == 0) return VectorX<double>::Zero(tree_.size);
  Eigen::MatrixXd body_velocities(a.size(), tree_.size);
  for (int c = 0; c < tree_.size; ++c) {
    rates(theta_, VectorX<double>::Unit(tree_.size, c));
    body_velocities.col(c) = state_.v;
  }
  return least_norm(body_velocities).solve(a);
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
    const bool has_coordinate =
        std::find(tree_.joint_order.begin(), tree_.joint_order.end(), static_cast<int>(k)) != tree_.joint_order.end();
    if (!has_coordinate || joint.type == JointType::kFixed) continue;
    if (moves[tree_.offset[k]] > 1e-6 * moves.maxCoeff()) text += (text.empty() ? "'" : ", '") + joint.name + "'";
  }
  return text;
}

}  // namespace codesign
