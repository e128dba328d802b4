// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/stuck_start.h"

#include <algorithm>
#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

// A contact changes between holding and sliding when it is beyond its limit by more than this part
// of it: where several contacts hold one motion, one of them may rest at its limit.
constexpr double kAtLimit = 1e-9;
// A deflection whose effect is that of earlier ones but for this part of it stays zero.
constexpr double kIndependent = 1e-9;

}  // namespace

StuckStart::StuckStart(const System& system) {
  for (const StuckContact& stuck : system.stuck()) {
    const BristleContact& bristle = system.bristles()[stuck.bristle];
    contacts_.push_back({size(), bristle.size, stuck.start, false});
    for (int k = 0; k < bristle.size; ++k) states_.push_back(bristle.first + k);
  }
  begin();
}

void StuckStart::begin() {
  zeta_.setZero(size());
  for (Contact& contact : contacts_) contact.slides = false;
}

void StuckStart::set_slips(const Eigen::VectorXd& a, const Eigen::MatrixXd& response,
                           const Eigen::VectorXd& limits) {
  a_ = a;
  response_ = response;
  limits_ = limits;
}

/// w of a contact: so large that w a is the change of zeta that would stop it alone.
double StuckStart::weight(const Contact& contact) const {
  const double largest =
      response_.diagonal().segment(contact.first, contact.size).cwiseAbs().maxCoeff();
  return largest > 0.0 ? 1.0 / largest : 0.0;
}

Eigen::VectorXd StuckStart::trial(const Contact& contact) const {
  return zeta_.segment(contact.first, contact.size) +
         weight(contact) * a_.segment(contact.first, contact.size);
}

void StuckStart::change_over() {
  for (Contact& contact : contacts_) {
    const double limit = limits_[contact.first], beyond = trial(contact).norm() - limit;
    if (std::abs(beyond) > kAtLimit * limit) contact.slides = beyond > 0.0;
  }
}

/// The holding deflections whose effects are independent: those with a pivot in Gauss's elimination
/// in the order of the study.
void StuckStart::choose() {
  holds_.assign(to_index(size()), false);
  Eigen::MatrixXd left = response_;
  for (const Contact& contact : contacts_) {
    if (contact.slides) continue;
    for (Eigen::Index k = contact.first; k < contact.first + contact.size; ++k) {
      if (!(std::abs(left(k, k)) > kIndependent * std::abs(response_(k, k)))) continue;
      holds_[to_index(k)] = true;
      const Eigen::RowVectorXd pivot = left.row(k) / left(k, k);
      for (Eigen::Index row = k + 1; row < size(); ++row) left.row(row) -= left(row, k) * pivot;
    }
  }
}

/// The derivatives of the conditions by the deflections: a = 0 where a contact holds, zeta = 0
/// where others hold it, zeta - F p/|p| = 0 where it slides.
Eigen::MatrixXd StuckStart::matrix() const {
  Eigen::MatrixXd J = Eigen::MatrixXd::Identity(size(), size());
  for (const Contact& contact : contacts_) {
    if (contact.slides) {
      const Eigen::VectorXd p = trial(contact), along = p.normalized();
      const Eigen::MatrixXd across =
          limits_[contact.first] / p.norm() *
          (Eigen::MatrixXd::Identity(contact.size, contact.size) - along * along.transpose());
      J.middleRows(contact.first, contact.size) -=
          across * weight(contact) * response_.middleRows(contact.first, contact.size);
      J.block(contact.first, contact.first, contact.size, contact.size) -= across;
      continue;
    }
    for (Eigen::Index k = contact.first; k < contact.first + contact.size; ++k)
      if (holds_[to_index(k)]) J.row(k) = response_.row(k);
  }
  return J;
}

double StuckStart::improve() {
  change_over();
  choose();
  Eigen::VectorXd rows = zeta_;
  for (const Contact& contact : contacts_) {
    if (contact.slides)
      rows.segment(contact.first, contact.size) -=
          limits_[contact.first] * trial(contact).normalized();
    for (Eigen::Index k = contact.first; k < contact.first + contact.size; ++k)
      if (holds_[to_index(k)]) rows[k] = a_[k];
  }
  const Eigen::VectorXd change = PivotedLeastSquares(matrix()).solve(rows);
  zeta_ -= change;
  return change.cwiseAbs().maxCoeff() / (1.0 + zeta_.cwiseAbs().maxCoeff());
}

Eigen::MatrixXd StuckStart::derivatives(const Eigen::MatrixXd& a,
                                        const Eigen::MatrixXd& limits) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size(), a.cols());
  for (const Contact& contact : contacts_) {
    if (contact.slides) {
      const Eigen::VectorXd p = trial(contact), along = p.normalized();
      const Eigen::MatrixXd moved = weight(contact) * a.middleRows(contact.first, contact.size);
      rows.middleRows(contact.first, contact.size) =
          -limits_[contact.first] / p.norm() * (moved - along * (along.transpose() * moved)) -
          along * limits.row(contact.first);
    }
    for (Eigen::Index k = contact.first; k < contact.first + contact.size; ++k)
      if (holds_[to_index(k)]) rows.row(k) = a.row(k);
  }
  return -PivotedLeastSquares(matrix()).solve(rows);
}

std::vector<std::size_t> StuckStart::sliding() const {
  constexpr double kMoves = 1e-9;  // of the largest acceleration that a full deflection causes
  const double largest =
      1.0 + (response_ * limits_.asDiagonal().toDenseMatrix()).cwiseAbs().maxCoeff();
  std::vector<std::size_t> result;
  for (const Contact& contact : contacts_)
    if (a_.segment(contact.first, contact.size).cwiseAbs().maxCoeff() > kMoves * largest &&
        (result.empty() || result.back() != contact.start))
      result.push_back(contact.start);
  return result;
}

}  // namespace codesign
