// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "integration/explicit_stages.h"
#include "integration/rate_sizes.h"
#include "integration/rosenbrock_stages.h"
#include "math/arrays.h"

namespace codesign {

/// One step of a one-step method on q' = v, v' = a, s' = sigma, 0 = G(q, v, s; a, lambda, sigma),
/// psi' = g; doc/theory.md (15)-(17). A tableau names the method, and the StepMethod of its kind
/// computes stages and end. After an accepted step (q, v) are projected onto Phi = 0, Phi_q v = 0.
/// @tparam T double for the solution, std::complex<double> to check its derivatives.
template <class T>
class OneStep {
 public:
  OneStep(const CompiledSystem& system, const RosenbrockTableau& tableau);
  OneStep(const OneStep&) = delete;  // its methods refer to its memory
  OneStep& operator=(const OneStep&) = delete;

  Equations<T>& equations() { return m_.equations; }
  const Equations<T>& equations() const { return m_.equations; }
  const RosenbrockTableau& tableau() const { return *m_.tableau; }
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
  void set_time(double t) { m_.state.t = t; }

  /// Adds to psi(), whose derivatives jump where a guard determines an instant.
  void add_psi(const T& change) { psi_ += change; }

  /// Begins again with the pivots of keep_pivots(), or chooses pivots again if that was never
  /// called, so that no bit of later steps depends on earlier runs. To be called at the beginning
  /// of a run, after start(). @param h size of the first step [s].
  void choose_pivots(double h);
  /// SparseLu::keep_pivots() for all factorizations.
  void keep_pivots();
  /// SparseLu::keep_pivots_of() for all factorizations. @param other of the same system.
  void keep_pivots_of(const OneStep& other);
  /// Computes the step of size h [s] from state(), without accepting it. False if the matrix is
  /// singular or a value is not finite.
  bool attempt(double h);
  /// Scaled error of the last attempt, acceptable up to 1: the largest |u_last| / (absolute +
  /// relative max(|y|, |y_1|)) over (q, v, s), with |y| of velocities as in RateSizes. A mean would
  /// hide one fast joint among many bodies at rest.
  double error(double relative_tolerance, double absolute_tolerance) const;
  /// The same of psi, the objective's integral. Where little moves, or a given motion does not feel
  /// its effort, of which the objective is made, steps could go over much of it.
  double psi_error(double relative_tolerance, double absolute_tolerance) const;
  /// The factor by which the method's own estimate counts.
  double caution() const { return method_->caution(); }
  /// Accepts the last attempt: linearizes at its end and projects. False if the augmented matrix is
  /// singular there.
  bool accept();
  /// Continues a solution at the unprojected end of an earlier step: linearizes and projects as
  /// accept() did, so that attempt() repeats the step that followed. For the backward pass of the
  /// adjoint. False as for accept().
  bool resume(const State<T>& unprojected);

  /// Counts the whole turns of joints from the positions at the end of the last accepted step on.
  void track_turns() { m_.equations.track_turns(&m_.state); }

  /// At the end of the last accepted step, projected.
  const State<T>& state() const { return m_.state; }
  const T& psi() const { return psi_; }      ///< integral of g so far
  double step_size() const { return m_.h; }  ///< of the last attempt [s]
  /// An estimate of the largest |eigenvalue| of the equations at the end of the last step of a
  /// Rosenbrock method [1/s], by two steps of the power method, which damped and undamped
  /// oscillations need. @param direction begins with any vector but zero, in the order of
  /// IncrementLayout; holds the eigenvector's estimate. 0 if the matrix is singular.
  double spectral_radius(VectorX<double>* direction);

  /// Of explicit pairs, between steps or after an attempt.
  ExplicitStages<T>& explicit_stages() { return explicit_; }
  const ExplicitStages<T>& explicit_stages() const { return explicit_; }

  // The parts of a step that its tangent and adjoint use.
  const IncrementLayout& increment_layout() const { return m_.at; }
  /// u_i of the last attempt.
  const std::vector<VectorX<T>>& increments() const { return m_.increments; }
  /// The states at which the last attempt evaluated G.
  const std::vector<State<T>>& stages() const { return m_.stages; }
  /// The state at which the last accepted step began.
  const State<T>& previous() const { return previous_; }
  /// The end of the last attempt, before projection.
  const State<T>& unprojected() const { return m_.end; }
  /// At the point where the next step begins, unprojected.
  const Linearization<T>& derivatives() const { return m_.derivatives; }
  /// [delta q, multipliers] and [delta v, multipliers] of the last projection.
  const VectorX<T>& position_correction() const { return position_correction_; }
  const VectorX<T>& velocity_correction() const { return velocity_correction_; }
  const StageMatrix<T>& stage_matrix() const { return m_.stage_matrix; }
  const StageProduct& product() const { return rosenbrock_.product(); }
  const StageMatrix<T>& projection_matrix() const { return m_.projection_matrix; }

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
  StepMethod<T>* method_of(const RosenbrockTableau& tableau) {
    if (tableau.is_explicit()) return &explicit_;
    return &rosenbrock_;
  }
  /// Computes what the end of a step needs, and projects. @param is_last as of StepMethod::finish()
  bool finish(bool is_last);
  bool project();
  /// psi at the end of the last attempt.
  T next_psi() const;

  StepMemory<T> m_;
  const RateSizes rate_sizes_;
  RosenbrockStages<T> rosenbrock_;
  ExplicitStages<T> explicit_;
  StepMethod<T>* method_;  ///< of the tableau
  State<T> previous_;
  T psi_{0.0}, previous_psi_{0.0};
  VectorX<T> constraint_, constraint_rate_, position_correction_, velocity_correction_;
};

}  // namespace codesign
