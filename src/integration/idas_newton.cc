// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_newton.h"

#include <cassert>

#include "equations/derivative_products.h"

namespace codesign {
namespace {

// The solver's content is the IdasNewton itself and must not be freed with the SUNLinearSolver.
int free_shell(SUNLinearSolver solver) {
  SUNLinSolFreeEmpty(solver);
  return kSundialsSuccess;
}

}  // namespace

IdasNewton::IdasNewton(const CompiledSystem& system, SUNContext context)
    : system_(system), reduced_(system), matrix_(SUNMatNewEmpty(context)), solver_(SUNLinSolNewEmpty(context)) {
  if (!matrix_ || !solver_) throw std::bad_alloc();
  derivatives_.resize(system.patterns());
  u_.setZero(system.layout().columns());
  // IDAS requires a matrix for a direct solver; this one is empty, since the entries are in derivatives_.
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

int IdasNewton::setup(SUNLinearSolver solver, SUNMatrix) {
  auto* self = static_cast<IdasNewton*>(solver->content);
  const double h = 1.0 / self->c_j_;
  self->singular_ = !self->reduced_.factor(self->derivatives_, h, h * h, h);
  // A positive value makes IDAS try a smaller step.
  return self->singular_ ? SUNLS_LUFACT_FAIL : kSundialsSuccess;
}

int IdasNewton::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
  static_cast<IdasNewton*>(solver->content)->solve(span_of(b), span_of(x));
  return kSundialsSuccess;
}

void IdasNewton::solve(In<double> b, Out<double> x) {
  const Layout& layout = system_.layout();
  const double h = 1.0 / c_j_;
  assert(b.size() == layout.n + layout.columns() && x.size() == b.size());
  u_ = Eigen::Map<const VectorX<double>>(b.data() + layout.n, layout.columns());
  subtract_position_product(system_, derivatives_, b.first(layout.n), h, u_);
  u_.segment(layout.n, layout.m) /= (1.0 + kappa_ * h) * (1.0 + kappa_ * h);
  reduced_.lu().solve(u_);
  Eigen::Map<VectorX<double>> x_q(x.data(), layout.n), x_v(x.data() + layout.n, layout.n), x_s(x.data() + 2 * layout.n, layout.states),
      x_lambda(x.data() + 2 * layout.n + layout.states, layout.m);
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
