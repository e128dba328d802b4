// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_newton.h"

#include <cassert>

#include "equations/compiled_system.h"
#include "equations/iteration_matrix.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

namespace codesign {
namespace {

// The solver's content is the IdasNewton itself and must not be freed with the SUNLinearSolver.
int free_shell(SUNLinearSolver solver) {
  SUNLinSolFreeEmpty(solver);
  return kSundialsSuccess;
}

}  // namespace

IdasNewton::IdasNewton(const CompiledSystem& system, SUNContext context)
    : system_(system),
      reduced_(system),
      matrix_(SUNMatNewEmpty(context)),
      solver_(SUNLinSolNewEmpty(context)) {
  if (!matrix_ || !solver_) throw std::bad_alloc();
  derivatives_.resize(system.patterns());
  u_.setZero(system.layout().columns());
  // IDAS requires a matrix for a direct solver; this one is empty, since the entries are in
  // derivatives_.
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return kSundialsSuccess; };
  matrix_->ops->destroy = SUNMatFreeEmpty;
  solver_->content = this;
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver_->ops->setup = setup;
  solver_->ops->solve = solve;
  solver_->ops->free = free_shell;
}

// Divides the derivatives of the constraint rows. Since (Phi'')_v = 2 (Phi')_q, those of the
// stabilized row come out as those of Phi'' with h/(1 + kappa h) in place of h, (26a).
void IdasNewton::stabilize() {
  const Layout& layout = system_.layout();
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const double scale = 1.0 / (1.0 + kappa_ / c_j_);
  const auto multiply = [](const Sparsity& pattern, int row, int first_column, double factor,
                           std::vector<double>* values) {
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      if (pattern.column(e) >= first_column) (*values)[to_index(e)] *= factor;
  };
  for (int row = layout.n; row < layout.n + layout.m; ++row) {
    multiply(patterns.position, row, 0, scale * scale, &derivatives_.position);
    multiply(patterns.velocity, row, 0, scale, &derivatives_.velocity);
    multiply(patterns.rate, row, layout.n, scale * scale, &derivatives_.rate);
  }
}

// The terms of (26a) with Phi''_v b_q and Phi_q b_q; subtract_position_product() has subtracted
// those with Phi''_q b_q.
void IdasNewton::subtract_stabilization(In<double> b_q) {
  const Layout& layout = system_.layout();
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const double h = 1.0 / c_j_, damping = kappa_ / (1.0 + kappa_ * h);
  for (int row = layout.n; row < layout.n + layout.m; ++row) {
    double sum = damping * row_product(patterns.velocity, derivatives_.velocity, row, b_q);
    for (int e = patterns.rate.first(row); e < patterns.rate.first(row + 1); ++e)
      if (const int column = patterns.rate.column(e); column < layout.n)
        sum += damping * damping * derivatives_.rate[to_index(e)] * b_q[column];
    u_[row] -= h * sum;
  }
}

bool IdasNewton::factor() {
  const double h = 1.0 / c_j_;
  if (kappa_ > 0.0) stabilize();
  singular_ = !reduced_.factor(derivatives_, h, h * h, h);
  return !singular_;
}

bool IdasNewton::refactor(const Linearization<double>& derivatives) {
  derivatives_ = derivatives;
  return factor();
}

int IdasNewton::setup(SUNLinearSolver solver, SUNMatrix) {
  // A positive value makes IDAS try a smaller step.
  return static_cast<IdasNewton*>(solver->content)->factor() ? kSundialsSuccess : SUNLS_LUFACT_FAIL;
}

int IdasNewton::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
  static_cast<IdasNewton*>(solver->content)->solve(span_of(b), span_of(x));
  return kSundialsSuccess;
}

void IdasNewton::solve(In<double> b, Out<double> x) {
  const Layout& layout = system_.layout();
  const double h = 1.0 / c_j_;
  assert(b.size() == layout.n + layout.columns() && x.size() == b.size());
  const In<double> b_q = b.first(layout.n);
  u_ = Eigen::Map<const VectorX<double>>(b.data() + layout.n, layout.columns());
  u_.segment(layout.n, layout.m - layout.gears) /= (1.0 + kappa_ * h) * (1.0 + kappa_ * h);
  subtract_position_product(system_, derivatives_, b_q, h, u_);
  if (kappa_ > 0.0) subtract_stabilization(b_q);
  reduced_.lu().solve(u_);
  const std::ptrdiff_t n = layout.n;
  Eigen::Map<VectorX<double>> x_q(x.data(), n), x_v(x.data() + n, n),
      x_s(x.data() + 2 * n, layout.states), x_lambda(x.data() + 2 * n + layout.states, layout.m);
  x_v = h * u_.head(layout.n);
  x_q = h * (x_v + Eigen::Map<const VectorX<double>>(b.data(), layout.n));
  x_s = h * u_.tail(layout.states);
  x_lambda = u_.segment(layout.n, layout.m);
}

void IdasNewton::correct(const VectorX<double>& error, VectorX<double>* correction) const {
  const Layout& layout = system_.layout();
  correction->setZero(layout.columns());
  correction->segment(layout.n, layout.m) = -error;
  reduced_.lu().solve(*correction);
}

}  // namespace codesign
