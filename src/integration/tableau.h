// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "description/solver_options.h"

namespace codesign {

/// Coefficients of a stiffly accurate Rosenbrock-Wanner method in Hairer's transformed variables;
/// doc/theory.md (15):
///   (M/(h gamma) - f_y) u_i = f(t + alpha_i h, y + sum_j a_ij u_j)
///                             + M sum_j (c_ij/h) u_j + gamma_i h f_t,
/// with y_1 = y + sum_j m_j u_j (`weights`). The methods are stiffly accurate: the last rows of `a`
/// and `weights` differ only by the last increment, which therefore is the error estimate.
///
/// With gamma = 0 the method is an explicit pair, (15b): u_i = h f(t + alpha_i h, y + sum_j a_ij
/// u_j), where the last stage is at y_1, and the error estimate is the sum of `estimate`_j u_j.
struct RosenbrockTableau {
  static constexpr int kMaximumStages = 8;
  using Row = std::array<double, kMaximumStages>;

  const char* name;
  int stages;
  int order;  ///< order of y_1; the embedded solution is one order lower
  double gamma;
  std::array<Row, kMaximumStages> a, c;
  Row weights;  ///< m_j of y_1
  /// alpha_i = sum of alpha_ij, gamma_i = sum of gamma_ij, for equations that depend on time
  Row alpha, gamma_i;
  int dense_terms;  ///< rows of `dense` in use
  /// y(theta) = (1-theta) y + theta (y_1 + (1-theta) (d_0 + theta (d_1 + theta d_2))), d_k = sum_j
  /// dense_kj u_j
  std::array<Row, 3> dense;
  Row estimate{};  ///< of an explicit pair

  bool is_explicit() const { return gamma == 0.0; }
};

/// Rodas4 (Hairer and Wanner, Solving ODE II, 1996, code RODAS), order 4, 6 stages.
const RosenbrockTableau& rodas4();
/// Rodas4P2 (Steinebach 2020), order 4, 6 stages, no order reduction for stiff problems and inexact
/// Jacobians.
const RosenbrockTableau& rodas4p2();
/// Rodas5P (Steinebach 2023), order 5, 8 stages.
const RosenbrockTableau& rodas5p();
/// The explicit pair of Dormand and Prince (1980), order 5, 7 stages, the last of which is the
/// first of the next step; dense output of order 4 (Hairer, Norsett and Wanner, Solving ODE I,
/// 1993, II.6, code DOPRI5).
const RosenbrockTableau& dopri5();

/// The factor theta (1 - theta) sum_k d_kj theta^k of each u_j in the dense output, 0 <= theta
/// <= 1.
RosenbrockTableau::Row dense_weights(const RosenbrockTableau& tableau, double theta);
/// Their derivatives by theta.
RosenbrockTableau::Row dense_weight_slopes(const RosenbrockTableau& tableau, double theta);
/// Their second derivatives by theta.
RosenbrockTableau::Row dense_weight_curvatures(const RosenbrockTableau& tableau, double theta);
/// Of an explicit pair: the weights of the increments u_z in the dense output of z, the derivative
/// of the dense output of psi if z is its integrand: m_j plus dense_weight_slopes().
RosenbrockTableau::Row rate_weights(const RosenbrockTableau& tableau, double theta);

/// The coefficients of the method that solver.method selects; of kAuto, those with which a run
/// begins.
const RosenbrockTableau& rosenbrock_tableau(RosenbrockMethod method);
/// The largest number of stages of a step with this method: kAuto changes between dopri5() and
/// rodas5p().
int most_stages(RosenbrockMethod method);

}  // namespace codesign
