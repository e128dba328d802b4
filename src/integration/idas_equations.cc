// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"

namespace codesign {
namespace {

/// `size` entries of an array from the `first` on, as a vector.
Eigen::Map<const VectorX<double>> part(In<double> from, int first, int size) {
  return {from.subspan(first, size).data(), size};
}
Eigen::Map<VectorX<double>> part(Out<double> from, int first, int size) {
  return {from.subspan(first, size).data(), size};
}

// Return values of callbacks: success; retry with a smaller step; stop with a failure.
constexpr int kDone = 0, kRetry = 1, kGiveUp = -1;

// kappa times the study's duration: drift decays within a twentieth of the study, which is fast
// enough to keep it small and far too slow to make the equations stiff.
constexpr double kStabilizations = 20.0;

/// Runs `action` and turns an exception into a message and kGiveUp, since none may pass through the
/// C code of IDAS.
template <class Action>
int guarded(std::string* failure, const Action& action) {
  try {
    return action();
  } catch (const std::exception& error) {
    *failure = error.what();
  } catch (...) {
    *failure = "unknown exception";
  }
  return kGiveUp;
}

}  // namespace

IdasEquations::IdasEquations(const CompiledSystem& system, IdasNewton* newton)
    : layout_(system.layout()),
      newton_(*newton),
      equations_(system),
      turns_(system),
      kappa_(kStabilizations / system.study().duration),
      visited_(to_index(1 + 2 * size())) {
  state_.resize(layout_);
  direction_.resize(layout_);
  start();
}

void IdasEquations::start() {
  newton_.reset_pivots();
  visited_[0] = std::numeric_limits<double>::quiet_NaN();
  failure_.clear();
}

void IdasEquations::unpack(double t, In<double> y, In<double> y_dot, State<double>* state) const {
  const int n = layout_.n, m = layout_.m, states = layout_.states;
  state->t = t;
  state->q = part(y, 0, n);
  state->v = part(y, n, n);
  state->s = part(y, 2 * n, states);
  state->z.head(n) = part(y_dot, n, n);
  state->z.segment(n, m) = part(y, 2 * n + states, m);
  state->z.tail(states) = part(y_dot, 2 * n, states);
}

void IdasEquations::load(double t, In<double> y, In<double> y_dot) {
  unpack(t, y, y_dot, &state_);
  count_turns(&state_);
}

// lambda' does not appear in F; zero makes the first predictor keep the multipliers.
void IdasEquations::pack(const State<double>& state, Out<double> y, Out<double> y_dot) const {
  const int n = layout_.n, m = layout_.m, states = layout_.states;
  part(y, 0, n) = state.q;
  part(y, n, n) = state.v;
  part(y, 2 * n, states) = state.s;
  part(y, 2 * n + states, m) = state.z.segment(n, m);
  part(y_dot, 0, n) = state.v;
  part(y_dot, n, n) = state.z.head(n);
  part(y_dot, 2 * n, states) = state.z.tail(states);
  part(y_dot, 2 * n + states, m).setZero();
}

int IdasEquations::residual(double t, In<double> y, In<double> y_dot, Out<double> F) {
  double g = 0.0;
  order_floor_.begin();
  load(t, y, y_dot);
  equations_.residual(state_, &G_, &g);
  equations_.constraint_errors(state_, &Phi_, &Phi_rate_);
  G_.segment(layout_.n, layout_.m) += 2.0 * kappa_ * Phi_rate_ + kappa_ * kappa_ * Phi_;
  part(F, 0, layout_.n) = part(y_dot, 0, layout_.n) - state_.v;
  part(F, layout_.n, layout_.columns()) = G_;
  return std::isfinite(G_.sum()) ? kDone : kRetry;
}

int IdasEquations::jacobian(double t, double c_j, In<double> y, In<double> y_dot) {
  load(t, y, y_dot);
  equations_.linearize(state_, newton_.derivatives());
  newton_.set_rates(c_j, kappa_);
  return kDone;
}

int IdasEquations::integrand(double t, In<double> y, In<double> y_dot, Out<double> g) {
  load(t, y, y_dot);
  equations_.residual(state_, &G_, &g[0]);
  equations_.constraint_errors(state_, &Phi_, &Phi_rate_);
  // W' of (17a). lambda^T Phi_q v - v^T G corrects for violated constraints, so that the work that
  // they do appears as an energy error.
  g[1] = motion_->power(state_.q, state_.v, state_.z) +
         state_.z.segment(layout_.n, layout_.m).dot(Phi_rate_) - state_.v.dot(G_.head(layout_.n));
  return std::isfinite(g[0]) ? kDone : kRetry;
}

const Linearization<double>* IdasEquations::visit(double t, In<double> y, In<double> y_dot) {
  const Out<double> known = visited_, known_y = known.subspan(1, size()),
                    known_y_dot = known.subspan(1 + size(), size());
  if (known[0] == t && std::equal(y.begin(), y.end(), known_y.begin()) &&
      std::equal(y_dot.begin(), y_dot.end(), known_y_dot.begin()))
    return nullptr;
  known[0] = t;
  std::copy(y.begin(), y.end(), known_y.begin());
  std::copy(y_dot.begin(), y_dot.end(), known_y_dot.begin());
  load(t, y, y_dot);
  return &sensitivities_->linearize(state_, kappa_, &equations_);
}

// The equations of the sensitivities are linear, with the matrix of this very point. With the
// matrix of an earlier point their corrector may fail in each step through a steep part of a
// friction law, where the solution itself needs no new matrix.
bool IdasEquations::visit_to_solve(double t, In<double> y, In<double> y_dot) {
  const Linearization<double>* const derivatives = visit(t, y, y_dot);
  return !derivatives || newton_.refactor(*derivatives);
}

void IdasEquations::derivative(int k, In<double> y_rho, In<double> y_dot_rho) {
  unpack(state_.t, y_rho, y_dot_rho, &direction_);
  sensitivities_->derivative(k, direction_, &dG_);
}

int IdasEquations::residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector F, void* self) {
  auto* equations = static_cast<IdasEquations*>(self);
  return guarded(&equations->failure_,
                 [&] { return equations->residual(t, span_of(y), span_of(y_dot), span_of(F)); });
}

int IdasEquations::jacobian(sunrealtype t, sunrealtype c_j, N_Vector y, N_Vector y_dot, N_Vector,
                            SUNMatrix, void* self, N_Vector, N_Vector, N_Vector) {
  auto* equations = static_cast<IdasEquations*>(self);
  return guarded(&equations->failure_,
                 [&] { return equations->jacobian(t, c_j, span_of(y), span_of(y_dot)); });
}

int IdasEquations::integrand(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector g, void* self) {
  auto* equations = static_cast<IdasEquations*>(self);
  return guarded(&equations->failure_,
                 [&] { return equations->integrand(t, span_of(y), span_of(y_dot), span_of(g)); });
}

int IdasEquations::sensitivity_residual(int count, sunrealtype t, N_Vector y, N_Vector y_dot,
                                        N_Vector, N_Vector* y_rho, N_Vector* y_dot_rho,
                                        N_Vector* F_rho, void* self, N_Vector, N_Vector, N_Vector) {
  auto* equations = static_cast<IdasEquations*>(self);
  return guarded(&equations->failure_, [&] {
    const Layout& layout = equations->layout_;
    bool finite = true;
    if (!equations->visit_to_solve(t, span_of(y), span_of(y_dot))) return kRetry;
    for (int k = 0; k < count; ++k) {
      const Span<double> F = span_of(F_rho[k]);
      equations->derivative(k, span_of(y_rho[k]), span_of(y_dot_rho[k]));
      part(F, 0, layout.n) = part(span_of(y_dot_rho[k]), 0, layout.n) - equations->direction_.v;
      part(F, layout.n, layout.columns()) = equations->dG_.head(layout.columns());
      finite = finite && std::isfinite(equations->dG_.sum());
    }
    return finite ? kDone : kRetry;
  });
}

int IdasEquations::sensitivity_integrand(int count, sunrealtype t, N_Vector y, N_Vector y_dot,
                                         N_Vector* y_rho, N_Vector* y_dot_rho, N_Vector,
                                         N_Vector* g_rho, void* self, N_Vector, N_Vector,
                                         N_Vector) {
  auto* equations = static_cast<IdasEquations*>(self);
  return guarded(&equations->failure_, [&] {
    equations->visit(t, span_of(y), span_of(y_dot));
    for (int k = 0; k < count; ++k) {
      equations->derivative(k, span_of(y_rho[k]), span_of(y_dot_rho[k]));
      span_of(g_rho[k])[0] = equations->dG_[equations->layout_.columns()];
      span_of(g_rho[k])[1] = 0.0;
    }
    return kDone;
  });
}

}  // namespace codesign
