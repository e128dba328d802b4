// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/lagrangian.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/dense.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kAtBound = 1e-9;  // a variable nearer to its bound, in its unit, is on it
constexpr double kNoGain = 1e-12;  // a multiplier that would reduce the residual by less is left out

/// A row or bound with a multiplier c: the residual contains c times its direction, and c times its distance from being active.
struct Holder {
  Eigen::VectorXd direction;  ///< by the optimizer's variables; empty for a bound, whose direction is `sign` times a unit vector
  double distance = 0.0;
  Index variable = -1;  ///< of a bound
  double sign = 1.0;
  bool any_sign = false;  ///< an equality: the multiplier may be negative
  bool is_on_bound() const { return variable >= 0 && distance == 0.0; }
};

/// Minimizes |g - sum_k c_k direction_k|^2 + sum_k (c_k distance_k)^2 over multipliers c of their signs, by the active set of Lawson and
/// Hanson. The multiplier of a variable on its bound takes the whole component of that variable, so it is eliminated, not solved for.
class Multipliers {
 public:
  Multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders)
      : gradient_(gradient),
        holders_(holders),
        used_(holders.size(), false),
        c_(Eigen::VectorXd::Zero(static_cast<Index>(holders.size()))) {
    for (std::size_t k = 0; k < holders_.size(); ++k) {
      const Holder& holder = holders_[k];
      used_[k] = holder.any_sign || (holder.is_on_bound() && holder.sign * gradient_[holder.variable] > 0.0);
    }
    settle();
    for (std::size_t round = 0; round < 3 * holders_.size() && add_best(); ++round) settle();
  }

  const Eigen::VectorXd& values() const { return c_; }
  /// The part of the residual by the variables.
  Eigen::VectorXd rest() const {
    Eigen::VectorXd rest = gradient_;
    for (std::size_t k = 0; k < holders_.size(); ++k) {
      if (!used_[k]) continue;
      const Holder& holder = holders_[k];
      const double c = c_[static_cast<Index>(k)];
      if (holder.variable >= 0)
        rest[holder.variable] -= c * holder.sign;
      else
        rest -= c * holder.direction;
    }
    return rest;
  }
  double residual() const {
    double sum = rest().squaredNorm();
    for (std::size_t k = 0; k < holders_.size(); ++k) sum += std::pow(c_[static_cast<Index>(k)] * holders_[k].distance, 2);
    return std::sqrt(sum);
  }

 private:
  /// Adds the unused multiplier that reduces the residual fastest. False if there is none.
  bool add_best() {
    const Eigen::VectorXd rest = this->rest();
    double most = kNoGain * gradient_.norm();
    std::size_t best = holders_.size();
    for (std::size_t k = 0; k < holders_.size(); ++k) {
      if (used_[k]) continue;
      const Holder& holder = holders_[k];
      const double norm = holder.variable >= 0 ? 1.0 : holder.direction.norm();
      const double gain = holder.variable >= 0 ? holder.sign * rest[holder.variable] : holder.direction.dot(rest);
      if (!(gain > most * norm)) continue;
      most = gain / norm;
      best = k;
    }
    if (best == holders_.size()) return false;
    used_[best] = true;
    return true;
  }

  /// Moves the used multipliers towards their least-squares values, dropping those that reach zero on the way.
  void settle() {
    for (std::size_t round = 0; round <= holders_.size(); ++round) {
      const Eigen::VectorXd target = solve();
      double fraction = 1.0;
      for (Index k = 0; k < c_.size(); ++k)
        if (may_block(k) && target[k] < 0.0) fraction = std::min(fraction, c_[k] / (c_[k] - target[k]));
      c_ += fraction * (target - c_);
      bool dropped = false;
      for (Index k = 0; k < c_.size(); ++k) {
        if (!may_block(k) || !(target[k] < 0.0) || c_[k] > kNoGain * (1.0 + std::abs(target[k]))) continue;
        c_[k] = 0.0;
        used_[static_cast<std::size_t>(k)] = false;
        dropped = true;
      }
      if (!dropped) return;
    }
  }

  bool may_block(Index k) const { return used_[static_cast<std::size_t>(k)] && !holders_[static_cast<std::size_t>(k)].any_sign; }

  /// The least-squares values of the used multipliers; 0 for the others.
  Eigen::VectorXd solve() const {
    std::vector<bool> eliminated(static_cast<std::size_t>(gradient_.size()), false);
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < holders_.size(); ++k) {
      if (!used_[k]) continue;
      if (holders_[k].is_on_bound())
        eliminated[static_cast<std::size_t>(holders_[k].variable)] = true;
      else
        columns.push_back(k);
    }
    const Index size = gradient_.size(), count = static_cast<Index>(columns.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size + count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size + count);
    right.head(size) = gradient_;
    for (Index k = 0; k < count; ++k) {
      const Holder& holder = holders_[columns[static_cast<std::size_t>(k)]];
      if (holder.variable >= 0)
        A(holder.variable, k) = holder.sign;
      else
        A.col(k).head(size) = holder.direction;
      A(size + k, k) = holder.distance;
    }
    for (Index i = 0; i < size; ++i) {
      if (!eliminated[static_cast<std::size_t>(i)]) continue;
      A.row(i).setZero();
      right[i] = 0.0;
    }
    Eigen::VectorXd target = Eigen::VectorXd::Zero(c_.size()), rest = gradient_;
    if (count > 0) {
      const Eigen::VectorXd solution = least_norm(A).solve(right);
      for (Index k = 0; k < count; ++k) {
        const Holder& holder = holders_[columns[static_cast<std::size_t>(k)]];
        target[static_cast<Index>(columns[static_cast<std::size_t>(k)])] = solution[k];
        if (holder.variable < 0) rest -= solution[k] * holder.direction;
      }
    }
    for (std::size_t k = 0; k < holders_.size(); ++k)
      if (used_[k] && holders_[k].is_on_bound()) target[static_cast<Index>(k)] = holders_[k].sign * rest[holders_[k].variable];
    return target;
  }

  const Eigen::VectorXd& gradient_;
  const std::vector<Holder>& holders_;
  std::vector<bool> used_;
  Eigen::VectorXd c_;
};

void add_bound(Index variable, double sign, double distance, std::vector<Holder>* holders) {
  if (!std::isfinite(distance)) return;
  Holder holder;
  holder.variable = variable;
  holder.sign = sign;
  holder.distance = distance <= kAtBound ? 0.0 : distance;
  holders->push_back(std::move(holder));
}

/// The rows c <= 0 and c = 0 of the smooth program, and the parameter constraints -margin <= 0.
std::vector<Holder> rows_at(const Eigen::VectorXd& rho, const Eigen::VectorXd& y, Index size, const Scaling& scaling,
                            const ParameterRows& parameters, const SmoothProgram& program) {
  std::vector<Holder> rows;
  const auto add = [&](const SmoothProgram::Value& value, bool any_sign) {
    Holder row;
    row.direction.resize(size);
    spread(value, scaling, row.direction.data());
    row.direction = -row.direction;
    row.distance = any_sign ? 0.0 : std::abs(value.value);
    row.any_sign = any_sign;
    if (row.direction.allFinite() && std::isfinite(row.distance)) rows.push_back(std::move(row));
  };
  for (int i = 0; i < program.equalities(); ++i) add(program.equality(i), true);
  for (int i = 0; i < program.inequalities(); ++i) add(program.inequality(i, y), false);
  for (const ParameterRows::Row& row : parameters.rows()) {
    SmoothProgram::Value value;
    value.value = -parameters.margin(row, rho, &value.by_rho);
    value.by_rho = -value.by_rho;
    value.by_slack.setZero(y.size());
    add(value, false);
  }
  return rows;
}

}  // namespace

void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x) {
  const std::vector<double> scaled = scaling.scale_gradient(value.by_rho);
  std::copy(value.by_slack.begin(), value.by_slack.end(), std::copy(scaled.begin(), scaled.end(), by_x));
}

Optimality optimality(const EnsembleEvaluation& at, const Eigen::VectorXd& rho, const Scaling& scaling, const ParameterRows& parameters,
                      SmoothProgram* program) {
  // In the unit of the objective itself, so that its slack variables are of the magnitude of the scaled parameters.
  const double unit = at.total.objective != 0.0 ? std::abs(at.total.objective) : 1.0;
  program->take(at, rho);
  const Eigen::VectorXd y = program->start(at, unit);
  const std::vector<double> x = scaling.to_scaled(rho), lower = scaling.lower(), upper = scaling.upper();
  const auto tuned = static_cast<Index>(x.size()), size = tuned + y.size();
  Eigen::VectorXd gradient(size);
  if (program->slacks() > 0) {
    spread(program->objective(y), scaling, gradient.data());
  } else {
    const std::vector<double> scaled = scaling.scale_gradient(at.total.gradient);
    for (Index k = 0; k < tuned; ++k) gradient[k] = scaled[static_cast<std::size_t>(k)] / unit;
  }
  std::vector<Holder> holders = rows_at(rho, y, size, scaling, parameters, *program);
  const std::size_t rows = holders.size();
  for (Index k = 0; k < tuned; ++k) {
    const auto i = static_cast<std::size_t>(k);
    add_bound(k, 1.0, x[i] - lower[i], &holders);
    add_bound(k, -1.0, upper[i] - x[i], &holders);
  }
  for (Index k = 0; k < y.size(); ++k) add_bound(tuned + k, 1.0, y[k] - program->lower(static_cast<int>(k)), &holders);
  const Multipliers multipliers(gradient, holders);
  Optimality result;
  result.slope = multipliers.residual() * unit;
  result.bounds.setZero(tuned);
  std::vector<Eigen::VectorXd> active;
  for (std::size_t k = 0; k < holders.size(); ++k) {
    const double c = multipliers.values()[static_cast<Index>(k)];
    if (c == 0.0) continue;
    if (k < rows) active.push_back(holders[k].direction.head(tuned));
    if (holders[k].is_on_bound() && holders[k].variable < tuned) result.bounds[holders[k].variable] += c * holders[k].sign * unit;
  }
  result.active.resize(tuned, static_cast<Index>(active.size()));
  for (std::size_t k = 0; k < active.size(); ++k) result.active.col(static_cast<Index>(k)) = active[k];
  return result;
}

}  // namespace codesign
