// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/turn_follower.h"
#include "integration/increment.h"
#include "integration/rate_sizes.h"
#include "integration/stage_matrix.h"
#include "integration/tableau.h"
#include "math/arrays.h"

namespace codesign {

/// One step of a Rosenbrock-Wanner method on q' = v, v' = a, s' = sigma, 0 = G(q, v, s; a, lambda,
/// sigma), psi' = g; doc/theory.md (15)-(17).
///
/// The unknowns q, v, s of each stage are eliminated, so that one sparse matrix of the size of (a,
/// lambda, sigma) serves all stages, (16). After an accepted step (q, v) are projected onto Phi =
/// 0, Phi_q v = 0. Projection and next step use the derivatives at the unprojected point, so that a
/// step needs one linearization.
///
/// An explicit pair, (15b), needs none: each of its stages solves G = 0 for z at the stage's q, v
/// and s. The increments are u_x = h (v, sigma), u_v = h a, u_psi = h g and u_z = z_i - z, where z
/// belongs to the beginning of the step.
/// @tparam T double for the solution, std::complex<double> to check its derivatives.
template <class T>
class RosenbrockStep {
 public:
  RosenbrockStep(const CompiledSystem& system, const RosenbrockTableau& tableau);

  Equations<T>& equations() { return equations_; }
  const Equations<T>& equations() const { return equations_; }
  const RosenbrockTableau& tableau() const { return *tableau_; }
  /// Takes another method from the next attempt on. @param tableau must outlive this.
  void use(const RosenbrockTableau& tableau);

  /// Starts a solution at a consistent state. equations() must hold the design. @param psi integral
  /// of g before it
  void start(const State<T>& state, const T& psi = T(0.0));

  /// Continues a solution at another state of the same time, such as the state after a jump; psi()
  /// stays.
  void restart(const State<T>& state);

  /// Moves the end of the last step to an instant that is less than the rounding of times behind
  /// it.
  void set_time(double t) { state_.t = t; }

  /// Adds to psi(), whose derivatives jump where a guard determines an instant.
  void add_psi(const T& change) { psi_ += change; }

  /// Begins again with the pivots of keep_pivots(), or chooses pivots again if that was never
  /// called, so that no bit of later steps depends on earlier runs. To be called at the beginning
  /// of a run, after start(). @param h size of the first step [s].
  void choose_pivots(double h);
  /// SparseLu::keep_pivots() for all factorizations.
  void keep_pivots();
  /// SparseLu::keep_pivots_of() for all factorizations. @param other of the same system.
  void keep_pivots_of(const RosenbrockStep& other);
  /// Computes the step of size h [s] from state(), without accepting it. False if the matrix is
  /// singular or a value is not finite.
  bool attempt(double h);
  /// Scaled error of the last attempt, acceptable up to 1: the largest |u_last| / (absolute +
  /// relative max(|y|, |y_1|)) over (q, v, s), with |y| of velocities as in RateSizes. A mean would
  /// hide one fast joint among many bodies at rest.
  double error(double relative_tolerance, double absolute_tolerance) const;
  /// Accepts the last attempt: linearizes at its end and projects. False if the augmented matrix is
  /// singular there.
  bool accept();
  /// Continues a solution at the unprojected end of an earlier step: linearizes and projects as
  /// accept() did, so that attempt() repeats the step that followed. For the backward pass of the
  /// adjoint. False as for accept().
  bool resume(const State<T>& unprojected);

  /// Counts the whole turns of joints from the positions at the end of the last accepted step on.
  void track_turns() { equations_.track_turns(&state_); }

  const State<T>& state() const {
    return state_;
  }                                        ///< at the end of the last accepted step, projected
  const T& psi() const { return psi_; }    ///< integral of g so far
  double step_size() const { return h_; }  ///< of the last attempt [s]
  /// An estimate of the largest |eigenvalue| of the equations at the end of the last step of a
  /// Rosenbrock method [1/s], by two steps of the power method, which damped and undamped
  /// oscillations need. @param direction begins with any vector but zero, in the order of
  /// IncrementLayout; holds the eigenvector's estimate. 0 if the matrix is singular.
  double spectral_radius(VectorX<double>* direction);

  /// Explicit pairs, between steps or after an attempt: solves G = 0 for the z of any state,
  /// beginning with the z that it has. False if that fails.
  bool solve_at(State<T>* at) { return solve_rates(at, &aside_g_, &aside_factor_); }

  /// G_z of an explicit stage as the program that solved it has factored it.
  struct StageFactor {
    const MassFactor* pattern = nullptr;  ///< null if the stage was solved with a matrix
    std::vector<T> values;
  };
  /// Explicit pairs: G_z at stage i of the last attempt. If it has no pattern, factor_stage()
  /// factors it for derivatives().rate and stage_matrix(), and returns false if it is singular.
  const StageFactor& stage_factor(std::size_t i) const { return factors_[i]; }
  bool factor_stage(std::size_t i);

  // The parts of a step that its tangent and adjoint use.
  const IncrementLayout& increment_layout() const { return at_; }
  const std::vector<VectorX<T>>& increments() const {
    return increments_;
  }  ///< u_i of the last attempt
  const std::vector<State<T>>& stages() const {
    return stages_;
  }  ///< the states at which the last attempt evaluated G
  const State<T>& previous() const {
    return previous_;
  }  ///< the state at which the last accepted step began
  const State<T>& unprojected() const {
    return end_;
  }  ///< the end of the last attempt, before projection
  const Linearization<T>& derivatives() const {
    return derivatives_;
  }  ///< at the point where the next step begins, unprojected
  const VectorX<T>& position_correction() const {
    return position_correction_;
  }  ///< of the last projection: [delta q, multipliers]
  const VectorX<T>& velocity_correction() const {
    return velocity_correction_;
  }  ///< [delta v, multipliers]
  const StageMatrix<T>& stage_matrix() const { return stage_matrix_; }
  const StageProduct& product() const { return product_; }
  const StageMatrix<T>& projection_matrix() const { return projection_matrix_; }

  /// State and psi at previous().t + theta h by the method's dense output, 0 <= theta <= 1.
  void interpolate(double theta, State<T>* state, T* psi) const;
  /// The same over the last attempt, before accept().
  void interpolate_attempt(double theta, State<T>* state) const;
  /// The derivative of the dense output by time: the parts q, v and s of `rates` [per s].
  void interpolate_rates(double theta, State<T>* rates) const;

 private:
  /// The dense output between both ends of an attempt. @param weights dense_weights() at theta.
  void interpolate(double theta, const RosenbrockTableau::Row& weights, const State<T>& from,
                   const State<T>& to, State<T>* state) const;
  /// The derivatives with which a step begins at state().
  void linearize_start();
  /// The derivatives with which a step of a Rosenbrock method begins, at end_.
  void linearize_end();
  /// Whether steps solve with a matrix: implicit ones do, and explicit ones where no expression
  /// gives the accelerations.
  bool needs_matrix() {
    return !tableau_->is_explicit() || !std::is_same_v<T, double> || !equations_.mass_factor();
  }
  bool attempt_explicitly();
  std::size_t count() const { return to_index(tableau_->stages); }
  /// Solves G = 0 for the z of a state, beginning with the z that it has. @param g integrand there.
  bool solve_rates(State<T>* at, T* g, StageFactor* factor);
  void take_rates(std::size_t i, const T& g);
  void stage_start(std::size_t i);
  bool solve_stage(std::size_t i);
  /// Computes what the end of a step needs of the derivatives at end_, and projects.
  bool finish();
  bool project();

  const CompiledSystem& system_;
  const Layout& layout_;
  const IncrementLayout at_;
  const RateSizes rate_sizes_;
  const RosenbrockTableau* tableau_;
  mutable Equations<T> equations_;  ///< evaluations write to their memory
  mutable TurnFollower<T> turns_;   ///< likewise
  StageMatrix<T> stage_matrix_, projection_matrix_;
  StageProduct product_;
  Linearization<T> derivatives_;
  State<T> state_, previous_, end_;
  T psi_{0.0}, previous_psi_{0.0};
  std::vector<VectorX<T>> increments_;
  std::vector<State<T>> stages_;
  std::vector<StageFactor> factors_;  ///< of explicit stages
  StageFactor first_factor_;          ///< of first_
  StageFactor aside_factor_;          ///< of solve_at()
  State<T> first_;  ///< of an explicit pair: the first stage of the next attempt, if has_first_
  T first_g_{0.0}, last_g_{0.0}, aside_g_{0.0};
  bool has_first_ = false;
  /// whether derivatives_ are those at end_, where the next step begins
  bool has_derivatives_ = false;
  VectorX<T> residual_, z_, constraint_, constraint_rate_, position_correction_,
      velocity_correction_, estimate_;
  double h_ = 0.0;
};

}  // namespace codesign
