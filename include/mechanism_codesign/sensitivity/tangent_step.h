// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_TANGENT_STEP_H_
#define MECHANISM_CODESIGN_SENSITIVITY_TANGENT_STEP_H_

#include <vector>

#include "mechanism_codesign/dynamics/assembly.h"
#include "mechanism_codesign/integration/rosenbrock_step.h"

namespace codesign {

/// N directional derivatives of a vector, one column per component.
template <int N>
using Directions = Eigen::Matrix<double, N, Eigen::Dynamic>;

/// The exact tangent of RosenbrockStep for N parameters at once, the step sizes held fixed; doc/theory.md (18).
///
/// The stage equation E u = -(G + G_q w_q + G_s w_s + G_v w_v) is differentiated as it stands, the derivative of E included:
///   E u' = -(G' + G_q w_q' + G_s w_s' + G_v w_v' + (dG_q) u_q + (dG_s) u_s + (dG_v) u_v + (dG_z) u_z),
/// with dG_x the change of G_x along (y', e_k). E is the factorization that the step itself used.
template <int N>
class TangentStep {
 public:
  TangentStep(const System& system, const RosenbrockTableau& tableau);

  /// Begins at the start of a solution. @param parameters all named parameters, lanes seeded with the directions wanted.
  void start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly, const State<double>& initial, const RosenbrockStep<double>& step);

  /// Tangent of the stages of an attempt that is about to be accepted.
  void advance_stages(const RosenbrockStep<double>& step);
  /// Tangent of the projection, after RosenbrockStep::accept().
  void advance_projection(const RosenbrockStep<double>& step);

  /// Derivatives of the objective: its integral so far, and with the terminal terms at the present state.
  Eigen::Matrix<double, N, 1> psi() const { return psi_; }
  Eigen::Matrix<double, N, 1> terminal(const State<double>& state);

  const Directions<N>& q() const { return q_; }
  const Directions<N>& v() const { return v_; }
  const Directions<N>& s() const { return s_; }
  const Directions<N>& z() const { return z_; }

 private:
  struct StageTangent {
    Directions<N> q, v, s, z;
    Eigen::Matrix<double, N, 1> psi;
  };

  void load_lanes(const VectorX<double>& q, const VectorX<double>& v, const VectorX<double>& s, const VectorX<double>& z, const Directions<N>& dq,
                  const Directions<N>& dv, const Directions<N>& ds, const Directions<N>& dz, State<Lanes<N>>* state) const;
  void stage_tangent(int i, const RosenbrockStep<double>& step);
  /// result += (d by_position) q + ... with the derivatives' lanes times the real increments.
  void add_matrix_tangent(const Increment<double>& u, Directions<N>* result) const;
  void add_matrix_product(const Linearization<double>& d, const Directions<N>& q, const Directions<N>& s, const Directions<N>& v, Directions<N>* result) const;
  Eigen::Matrix<double, N, 1> integrand_product(const Linearization<double>& d, const StageTangent& u) const;
  void solve(const StageMatrix<double>& matrix, Directions<N>* x);

  const System& system_;
  const Layout& layout_;
  const RosenbrockTableau& tableau_;
  Equations<Lanes<N>> equations_;
  Linearization<Lanes<N>> derivatives_;
  State<Lanes<N>> state_;
  State<double> stage_;
  Directions<N> q_, v_, s_, z_, dq_, dv_, ds_, dz_, sum_q_, sum_v_, sum_s_, product_, right_hand_side_;
  Eigen::Matrix<double, N, 1> psi_;
  std::vector<StageTangent> stages_;
  VectorX<Lanes<N>> residual_, errors_, rates_;
  Eigen::MatrixXd columns_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_TANGENT_STEP_H_
