// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "integration/increment.h"
#include "integration/one_step.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

namespace codesign {

/// The bilinear forms Theta = sum_k mu_k^T G_y u_k of some pairs of vectors, through which a step
/// depends on the derivatives of the equations, as the sum of the entries of G_q, G_s, G_v and G_z
/// times weights W = sum_k mu_k u_k^T; doc/theory.md (18c).
class MatrixWeights {
 public:
  /// @param pairs the largest number of pairs.
  MatrixWeights(const CompiledSystem& system, int pairs);

  /// Sets all pairs to zero.
  void clear();
  /// Whether no pair has been set since.
  bool is_empty() const { return is_empty_; }
  /// Sets pair k. @param u in the order of IncrementLayout. @param mu one per row of G, then one
  /// for the integrand's row.
  void set(int k, const VectorX<double>& u, const VectorX<double>& mu);

  /// W, on the patterns of the derivatives; computed by the call.
  const ByVariable<std::vector<double>>& compute();

 private:
  void compute(const Sparsity& pattern, int first_column, std::vector<double>* weights) const;

  const CompiledSystem& system_;
  const IncrementLayout at_;
  Eigen::MatrixXd u_, mu_;  ///< a row per pair
  bool is_empty_ = true;
  ByVariable<std::vector<double>> weights_;
};

/// A step, OneStep, differentiated backwards; doc/theory.md (18b), (18c).
///
/// It holds the adjoint psi_y of the state. Each step is reversed in three calls: the stages in
/// reverse order (E^T mu_i = ...), the projection at its start, and the matrices, which are
/// derivatives of the equations at the unprojected start. Each evaluation of the equations becomes
/// one transposed product by the state and by the parameters.
class AdjointStep {
 public:
  AdjointStep(const CompiledSystem& system, const RosenbrockTableau& tableau);

  /// @param parameters all named parameters (Study::parameters order).
  /// @param adjoint psi_y at the end of the last step, in the order of IncrementLayout, with 1 for
  /// psi.
  void start(const std::vector<double>& parameters, const VectorX<double>& adjoint);

  /// From now on the equations hold the mode of the steps that are reversed, theory (17d); an empty
  /// one: none.
  void hold(const std::vector<bool>& mode) {
    mode.empty() ? equations_.release() : equations_.hold(mode);
  }

  /// Reverses the stages of the step's last attempt: psi_y at its end becomes psi_y at its start.
  /// @param step of an explicit pair receives the factorization of a stage.
  void reverse_stages(OneStep<double>* step);
  /// Reverses the projection of `start`, the unprojected start of the step, as made by
  /// OneStep::resume(start).
  void reverse_projection(const State<double>& start, const OneStep<double>& step);
  /// Adds Theta_y of (18c): the dependence of stages and projection on `start` through the matrices
  /// evaluated there; nothing if none of them was used, as by explicit stages.
  void reverse_matrices(const State<double>& start);

  /// psi_y at `start` after reverse_matrices(), in the order of IncrementLayout.
  const VectorX<double>& adjoint() const { return adjoint_; }
  /// The same between two steps, where a jump or the end of the run changes it.
  VectorX<double>& adjoint() { return adjoint_; }

  /// Adds the sum of mu^T G_rho over all evaluations since start(), (18d). @param gradient p
  /// entries, order of Study::tuned.
  void add_gradient(Out<double> gradient) { equations_.add_gradient(gradient); }

  /// Resets the contributions of the previous step. Needed before a step without stages (the last
  /// point) or without projection (the start).
  void clear();

 private:
  std::size_t count() const { return to_index(tableau_->stages); }
  void reverse_explicit_stage(std::size_t i, OneStep<double>* step);
  void reverse_stage(std::size_t i, const OneStep<double>& step);
  void reverse_integrand(std::size_t i, const OneStep<double>& step);
  void reverse_solve(std::size_t i, const OneStep<double>& step);
  void reverse_elimination(std::size_t i, double hg);
  void reverse_point(std::size_t i, const OneStep<double>& step);
  void solve_projection(const OneStep<double>& step, int first, const VectorX<double>& correction,
                        int pair);
  void add_products(const Linearization<double>& derivatives, RowRange rows,
                    const VectorX<double>& mu, VectorX<double>* adjoint) const;

  const CompiledSystem& system_;
  const Layout& layout_;
  const IncrementLayout at_;
  const RosenbrockTableau* tableau_;  ///< of the step that is reversed
  CompiledEquations<double> equations_;
  MatrixWeights weights_;
  VectorX<double> adjoint_, start_adjoint_, stage_adjoint_, sum_adjoint_, z_, direction_;
  /// of the entries of G_t; one per row of G, then one for the integrand's row
  VectorX<double> time_weights_;
  VectorX<double> mu_;         ///< multipliers of the rows of G, then of the integrand's row
  VectorX<double> no_errors_;  ///< the weights of Phi or Phi_q v where the other one is reversed
  std::vector<VectorX<double>> increment_adjoints_;
  State<double> projected_;  ///< the start with the corrected positions
};

}  // namespace codesign
