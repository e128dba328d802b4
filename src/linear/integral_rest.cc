// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/integral_rest.h"

#include <algorithm>
#include <cmath>

#include "control/controller.h"
#include "description/study.h"
#include "linear/scaled_solution.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostCorrections = 200;
constexpr double kLongestCorrection = 0.2;  // of any coordinate [rad or m]
constexpr double kSmallCorrection = 1e-12;  // relative
constexpr double kBalanced = 1e-9;          // of accelerations and errors, relative to their terms

Status not_found(const RestingMechanism& mechanism) {
  const Eigen::VectorXd errors = mechanism.errors(), a = mechanism.acceleration();
  return {StatusCode::kNoEquilibrium, 0.0,
          "no posture at rest was found near the start in which the errors of all controllers with "
          "an integral vanish, and the rates of all estimates; the largest error left is " +
              readable(errors.cwiseAbs().maxCoeff(), 3) + ", the largest acceleration " +
              readable(a.cwiseAbs().maxCoeff(), 3) + " per s^2"};
}

/// Whether integrals that are bounded themselves keep their bounds.
Status check_bounds(const RestingMechanism& mechanism, const std::vector<double>& parameters,
                    const Study& study) {
  const std::vector<double> integrals = mechanism.integral_of_controllers();
  for (std::size_t c = 0; c < integrals.size(); ++c) {
    const ControllerDescription& controller = study.controllers[c];
    if (!controller.realization.i_clamp) continue;
    const Bounds<double> bounds = bounds_at(*controller.realization.i_clamp, parameters);
    const double term = controller.i.at(parameters) * integrals[c];
    if (term < bounds.lower || term > bounds.upper)
      return {StatusCode::kNoEquilibrium, 0.0,
              "no posture at rest without error: the integral of controller \"" + controller.name +
                  "\" would have to give " + readable(term, 6) + ", and i_clamp allows " +
                  readable(term < bounds.lower ? bounds.lower : bounds.upper, 6)};
  }
  return {};
}

/// The rows [N^T a; errors] of a posture and their derivatives by (y, integrals).
struct Balance {
  Eigen::MatrixXd N, matrix;
  Eigen::VectorXd rows;

  /// Whether each row is no more than rounding leaves of its terms.
  bool is_met(const Eigen::VectorXd& integrals) const {
    Eigen::VectorXd sizes = Eigen::VectorXd::Ones(matrix.cols());
    sizes.tail(integrals.size()) += integrals.cwiseAbs();
    const Eigen::VectorXd terms = matrix.cwiseAbs() * sizes;
    return (rows.cwiseAbs().array() <= kBalanced * (1.0 + terms.array())).all();
  }
};

Status find_balance(RestingMechanism* mechanism, Balance* balance) {
  if (Status status = mechanism->linearize(&balance->N); !status.ok()) return status;
  const Eigen::MatrixXd slopes = mechanism->slopes(balance->N, true);
  const Eigen::VectorXd a = mechanism->acceleration(), errors = mechanism->errors();
  const Eigen::Index free = balance->N.cols(), own = errors.size();
  balance->matrix.resize(free + own, free + own);
  balance->matrix.topRows(free) = transposed_product(balance->N, slopes.topRows(a.size()));
  balance->matrix.bottomRows(own) = slopes.bottomRows(own);
  balance->rows.resize(free + own);
  balance->rows << transposed_product(balance->N, a), errors;
  return {};
}

/// Moves by the step, or by as much of it as the loops allow.
bool move_by(const Eigen::VectorXd& move, const Eigen::VectorXd& integrals,
             RestingMechanism* mechanism) {
  constexpr int kMostHalvings = 20;
  const double size = move.size() == 0 ? 0.0 : move.cwiseAbs().maxCoeff();
  double part = size > kLongestCorrection ? kLongestCorrection / size : 1.0;
  for (int tries = 0; tries < kMostHalvings; ++tries, part *= 0.5)
    if (mechanism->go_to(mechanism->q() + part * move, mechanism->integrals() + part * integrals)
            .ok())
      return true;
  return false;
}

}  // namespace

Status rest_without_error(RestingMechanism* mechanism, const std::vector<double>& parameters,
                          const Study& study, const std::atomic<bool>* cancel, int* steps) {
  Balance balance;
  for (int step = 0; step < kMostCorrections; ++step, ++*steps) {
    if (is_set(cancel)) return {StatusCode::kCancelled, 0.0, "cancelled"};
    if (Status status = find_balance(mechanism, &balance); !status.ok()) return status;
    const Eigen::VectorXd full = ScaledSolution(balance.matrix).solve(-balance.rows);
    if (!std::isfinite(full.sum())) break;
    const Eigen::Index own = mechanism->integrals().size();
    const Eigen::VectorXd move = product(balance.N, full.head(full.size() - own));
    const double scale = 1.0 + mechanism->q().cwiseAbs().maxCoeff();
    const double largest = move.size() == 0 ? 0.0 : move.cwiseAbs().maxCoeff();
    if (largest <= kSmallCorrection * scale && balance.is_met(mechanism->integrals()))
      return check_bounds(*mechanism, parameters, study);
    if (!move_by(move, full.tail(own), mechanism)) break;
  }
  return not_found(*mechanism);
}

}  // namespace codesign
