// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/rate_solution.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "assembly/friction_jam.h"
#include "equations/compiled_system.h"
#include "equations/mass_solution.h"
#include "math/arrays.h"
#include "text/cancel.h"

namespace codesign {

RateSolution::RateSolution(const CompiledSystem& system) : system_(system), matrix_(system) {
  derivatives_.resize(system.patterns());
}

Status RateSolution::solve(Equations<double>* equations, State<double>* state) {
  const char* const place = state->t > 0.0 ? "" : " at the start";
  double g = 0.0, previous = std::numeric_limits<double>::infinity();
  // With redundant rows, rounding errors divided by the compliance remain in the reactions that are
  // not unique.
  const double converged = system_.compliance() == 0.0 ? 1e-11 : 1e-7;
  factor_ = nullptr;
  if (system_.begins_explicitly() && equations->mass_factor()) {
    residual_ = state->z;
    if (equations->accelerations(state, &g, &factor_values_) && std::isfinite(state->z.sum())) {
      factor_ = equations->mass_factor();
      return {};
    }
    state->z = residual_;
  }
  const bool apart = system_.has_rates_apart();
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (is_set(cancel_)) return {StatusCode::kCancelled, state->t, "cancelled"};
    apart ? equations->rates(*state, &residual_, &g, &derivatives_)
          : equations->residual(*state, &residual_, &g);
    const double error = residual_.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(error))
      return {StatusCode::kNonFinite, state->t,
              std::string("the equations of motion are not finite") + place};
    if (!apart) equations->linearize(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0))
      return {StatusCode::kSingularMatrix, state->t,
              "the augmented matrix of the equations of motion is singular"};
    matrix_.lu().solve(residual_);
    const double size = residual_.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() /
                        (1.0 + state->z.cwiseAbs().maxCoeff());
    state->z -= residual_;
    if (size < 1e-15 || (size < converged && size >= 0.5 * previous)) return {};
    previous = size;
  }
  const std::string jam = jam_advice(system_, *state, equations);
  return {StatusCode::kInitialReactionsFailed, state->t,
          std::string("no accelerations and reactions satisfy the equations of motion") + place +
              (jam.empty() ? ": the position may be a singular one; start from another" : ": ") +
              jam};
}

void RateSolution::solve_linear(Out<double> x) const {
  if (factor_)
    factor_->solve<1>(factor_values_, x);
  else
    matrix_.lu().solve(x);
}

void RateSolution::differentiate(const State<double>& at, Equations<double>* equations,
                                 State<double>* rates) {
  VectorX<double> change;
  // G_q, G_v and G_s at the last iterate but one, which the solution differs from by rounding, are
  // there already in the other case.
  if (system_.has_rates_apart()) equations->linearize(at, &derivatives_);
  rates->z.setZero(system_.layout().columns());
  directional_derivative(system_, derivatives_, *rates, &change);
  rates->z = -(change + derivatives_.time).head(rates->z.size());
  solve_linear(rates->z);
}

// First-order solution of G(z) = 0 with the factorization of the last Newton iteration of
// solve().
template <class T>
void RateSolution::extend(const VectorX<double>& z, Equations<T>* equations,
                          RateWorkspace<T>* workspace, State<T>* state) const {
  T g(0.0);
  state->z = z.template cast<T>();
  equations->residual(*state, &workspace->G, &g);
  Eigen::MatrixXd& step = workspace->change;
  directions_of(workspace->G, &step);
  for (auto column : step.colwise()) solve_linear(column);
  step = -step;
  add_directions(step, &state->z);
}

#define CODESIGN_INSTANTIATE(T)                                                                   \
  template void RateSolution::extend<T>(const VectorX<double>&, Equations<T>*, RateWorkspace<T>*, \
                                        State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
