// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/idas_gradient.h"

#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "math/arrays.h"

namespace codesign {

template <int N>
IdasTangent::Group<N>::Group(const CompiledSystem& system, LaneRange<N> lanes)
    : range(lanes), equations(system) {
  state.resize(system.layout());
}

template <int N>
void IdasTangent::Group<N>::load(const State<double>& at,
                                 const std::vector<State<double>>* directions) {
  cast_state(at, &state);
  for (int k = 0; directions && k < range.count; ++k) {
    const State<double>& direction = (*directions)[to_index(range.first + k)];
    const auto put = [k](const VectorX<double>& from, VectorX<Scalar>* lanes) {
      for (Eigen::Index i = 0; i < from.size(); ++i) (*lanes)[i].v[k] = from[i];
    };
    put(direction.q, &state.q);
    put(direction.v, &state.v);
    put(direction.s, &state.s);
    put(direction.z, &state.z);
  }
}

template <int N>
void IdasTangent::Group<N>::take(int k, State<double>* direction) const {
  const auto copy = [k](const VectorX<Scalar>& from, VectorX<double>* to) {
    for (Eigen::Index i = 0; i < from.size(); ++i) (*to)[i] = from[i].v[k];
  };
  copy(state.q, &direction->q);
  copy(state.v, &direction->v);
  copy(state.s, &direction->s);
  copy(state.z, &direction->z);
}

IdasTangent::IdasTangent(const CompiledSystem& system)
    : system_(system),
      groups_(system),
      partial_(system.layout().columns() + 1, to_signed(system.study().tuned.size())),
      matrix_(system) {
  derivatives_.resize(system.patterns());
}

void IdasTangent::start(const std::vector<double>& parameters, const State<double>& initial,
                        Integrator* integrator, std::vector<State<double>>* sensitivities,
                        std::vector<double>* scales) {
  matrix_.keep_pivots_of(integrator->assembly().rates().matrix());
  matrix_.reset_pivots();
  groups_.for_each([&](auto* group) {
    group->range.seed(system_, parameters, &group->parameters);
    group->equations.set_design(group->parameters);
    integrator->assembly().extend(group->parameters, initial, &group->equations, &group->extension,
                                  &group->state);
    for (int k = 0; k < group->range.count; ++k)
      group->take(k, &(*sensitivities)[to_index(group->range.first + k)]);
  });
  for (std::size_t k = 0; k < scales->size(); ++k) {
    const double value = std::abs(parameters[to_index(system_.study().tuned[k])]);
    (*scales)[k] = value > 0.0 ? value : 1.0;
  }
}

const Linearization<double>& IdasTangent::linearize(const State<double>& state, double kappa,
                                                    Equations<double>* equations) {
  kappa_ = kappa;
  equations->linearize(state, &derivatives_);
  groups_.for_each([&](auto* group) {
    typename std::remove_pointer_t<decltype(group)>::Scalar g(0.0);
    group->load(state, nullptr);
    group->equations.residual(group->state, &group->G, &g);
    if (kappa > 0.0) {
      group->equations.constraint_errors(group->state, &group->Phi, &group->Phi_rate);
      for (int row = 0; row < system_.layout().m; ++row)
        group->G[system_.layout().n + row] +=
            2.0 * kappa * group->Phi_rate[row] + kappa * kappa * group->Phi[row];
    }
    for (int k = 0; k < group->range.count; ++k) {
      auto column = partial_.col(group->range.first + k);
      for (Eigen::Index row = 0; row < group->G.size(); ++row) column[row] = group->G[row].v[k];
      column[group->G.size()] = g.v[k];
    }
  });
  return derivatives_;
}

// The other rows of the multipliers are as they are. The derivative of Phi'' + 2 kappa Phi' +
// kappa^2 Phi along (q, v, a) equals the derivative of Phi'' along (q, v + kappa q, a + 2 kappa v +
// kappa^2 q), because (Phi'')_v = 2 (Phi')_q and (Phi'')_a = (Phi')_v = Phi_q.
void IdasTangent::derivative(int k, const State<double>& direction, VectorX<double>* result) {
  const Layout& layout = system_.layout();
  directional_derivative(system_, derivatives_, direction, result);
  if (kappa_ > 0.0) {
    stabilized_direction_ = direction;
    stabilized_direction_.v += kappa_ * direction.q;
    stabilized_direction_.z.head(layout.n) +=
        2.0 * kappa_ * direction.v + kappa_ * kappa_ * direction.q;
    directional_derivative(system_, derivatives_, stabilized_direction_, &stabilized_);
    result->segment(layout.n, layout.constraints()) =
        stabilized_.segment(layout.n, layout.constraints());
  }
  *result += partial_.col(k);
}

bool IdasTangent::factor(const State<double>& state, Equations<double>* equations) {
  linearize(state, 0.0, equations);
  return matrix_.factor(derivatives_, 0.0, 0.0, 0.0);
}

void IdasTangent::solve_rates(std::vector<State<double>>* directions) {
  for (int k = 0; k < count(); ++k) {
    State<double>& direction = (*directions)[to_index(k)];
    direction.z.setZero();
    derivative(k, direction, &dG_);
    matrix_.lu().solve(Out<double>(dG_).first(direction.z.size()));
    direction.z = -dG_.head(direction.z.size());
  }
}

// One evaluation with lanes gives the derivatives of Phi and Phi_q v along (q, v, s)_rho and the
// parameter together.
void IdasTangent::correct(const State<double>& state, VectorX<double> State<double>::*part,
                          std::vector<State<double>>* directions) {
  const Layout& layout = system_.layout();
  const bool positions = part == &State<double>::q;
  groups_.for_each([&](auto* group) {
    group->load(state, directions);
    group->equations.constraint_errors(group->state, &group->Phi, &group->Phi_rate);
    for (int k = 0; k < group->range.count; ++k) {
      dG_.setZero(layout.columns() + 1);
      for (int row = 0; row < layout.m; ++row)
        dG_[layout.n + row] = -(positions ? group->Phi : group->Phi_rate)[row].v[k];
      matrix_.lu().solve(Out<double>(dG_).first(layout.columns()));
      (*directions)[to_index(group->range.first + k)].*part += dG_.head(layout.n);
    }
  });
}

bool IdasTangent::jump(const std::vector<ControlEvent>& events, const State<double>& before,
                       const State<double>& behind, Equations<double>* equations,
                       std::vector<State<double>>* directions) {
  groups_.for_each([&](auto* group) {
    group->load(before, directions);
    group->equations.jump(events, &group->state);
    for (int k = 0; k < group->range.count; ++k)
      group->take(k, &(*directions)[to_index(group->range.first + k)]);
  });
  if (!factor(behind, equations)) return false;
  solve_rates(directions);
  return true;
}

bool IdasTangent::project(const State<double>& state, Equations<double>* equations,
                          std::vector<State<double>>* directions) {
  if (!factor(state, equations)) return false;
  correct(state, &State<double>::q, directions);
  correct(state, &State<double>::v, directions);
  solve_rates(directions);
  return true;
}

template <class Function>
void IdasTangent::differentiate(const Function& function, const State<double>& state,
                                Equations<double>* equations,
                                std::vector<State<double>>* directions, Eigen::VectorXd* gradient) {
  gradient->setZero(count());
  if (!factor(state, equations)) {
    gradient->setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  solve_rates(directions);
  groups_.for_each([&](auto* group) {
    group->load(state, directions);
    const auto value = function(&group->equations, group->state);
    for (int k = 0; k < group->range.count; ++k) (*gradient)[group->range.first + k] += value.v[k];
  });
}

void IdasTangent::terminal(const State<double>& state, Equations<double>* equations,
                           std::vector<State<double>>* directions, Eigen::VectorXd* gradient) {
  const auto sum = [](auto* of_group, const auto& lanes) { return of_group->terminal(lanes); };
  differentiate(sum, state, equations, directions, gradient);
}

void IdasTangent::watched(std::size_t k, const State<double>& state, Equations<double>* equations,
                          std::vector<State<double>>* directions, Eigen::VectorXd* gradient) {
  const auto signal = [k](auto* of_group, const auto& lanes) {
    return of_group->watched(k, lanes);
  };
  differentiate(signal, state, equations, directions, gradient);
}

void IdasTangent::residuals(ObjectivePart part, const State<double>& state,
                            Equations<double>* equations, std::vector<State<double>>* directions,
                            Eigen::MatrixXd* rows) {
  const std::vector<ResolvedTerm>& terms =
      part == ObjectivePart::kTerminal ? system_.terminal() : system_.integral();
  rows->setConstant(count(), to_signed(terms.size()), std::numeric_limits<double>::quiet_NaN());
  if (!factor(state, equations)) return;
  solve_rates(directions);
  groups_.for_each([&](auto* group) {
    group->load(state, directions);
    VectorX<typename std::remove_pointer_t<decltype(group)>::Scalar>& in_lanes =
        group->residuals[to_index(part)];
    group->equations.residuals(part, group->state, &in_lanes);
    for (int k = 0; k < group->range.count; ++k)
      for (Eigen::Index term = 0; term < rows->cols(); ++term)
        (*rows)(group->range.first + k, term) = in_lanes[term].v[k];
  });
}

IdasGradient::IdasGradient(const CompiledSystem& system)
    : system_(system),
      integrator_(system),
      watch_(system),
      residuals_(system),
      end_motion_(system) {}

// The workspace of the sensitivities is allocated only when derivatives are requested.
Status IdasGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  const bool with_gradient = derivatives != Derivatives::kNone;
  with_root_ = derivatives == Derivatives::kGaussNewton;
  if (with_gradient && !tangent_) tangent_ = std::make_unique<IdasTangent>(system_);
  integrator_.carry(with_gradient ? tangent_.get() : nullptr);
  integrator_.watch_singularities(with_gradient);
  end_motion_.start();
  const Status status = integrator_.start(parameters);
  return status.ok() ? start_watches(with_gradient) : status;
}

Status IdasGradient::start_watches(bool with_gradient) {
  if (with_root_) {
    const auto rows = [this](ObjectivePart part, const State<double>& state, Eigen::MatrixXd* to) {
      if (part == ObjectivePart::kTerminal)
        take_directions();
      else
        integrator_.interpolate_sensitivities(state.t, &directions_);
      tangent_->residuals(part, state, &integrator_.equations(), &directions_, to);
    };
    if (Status status = residuals_.start(&integrator_, rows); !status.ok()) return status;
  }
  if (watch_.is_empty()) return {};
  SignalWatch::Differentiate differentiate;
  if (with_gradient)
    differentiate = [this](std::size_t k, const State<double>& state, bool /*reads_rates*/,
                           Eigen::VectorXd* gradient) {
      integrator_.interpolate_sensitivities(state.t, &directions_);
      tangent_->watched(k, state, &integrator_.equations(), &directions_, gradient);
      if (end_motion_.moves() && state.t >= time())
        *gradient += end_motion_.watched_rate(k, &integrator_.equations()) * end_motion_.time();
    };
  return watch_.start(&integrator_, std::move(differentiate));
}

Status IdasGradient::advance(double limit) {
  Status status = integrator_.advance(limit);
  if (status.ok() && has_moving_end(system_.study()) && integrator_.has_ended())
    status = end_motion_.evaluate(
        &integrator_, duration_gradient(system_.study(), integrator_.equations().parameters()));
  if (status.ok() && with_root_) residuals_.look();
  if (status.ok() && !watch_.is_empty()) status = watch_.look();
  return status;
}

const State<double>& IdasGradient::consistent_state() {
  end_ = integrator_.state();
  integrator_.assembly().rates().solve(&integrator_.equations(), &end_);
  return end_;
}

double IdasGradient::objective() {
  return integrator_.of_losses(integrator_.psi(),
                               integrator_.equations().terminal(consistent_state()));
}

void IdasGradient::take_directions() {
  directions_.resize(to_index(tangent_->count()), integrator_.state());
  for (int k = 0; k < tangent_->count(); ++k) integrator_.sensitivity(k, &directions_[to_index(k)]);
}

void IdasGradient::jacobian_root(Eigen::MatrixXd* root) {
  residuals_.finish(consistent_state(), root);
}

void IdasGradient::gradient(Eigen::VectorXd* gradient) {
  take_directions();
  tangent_->terminal(consistent_state(), &integrator_.equations(), &directions_, gradient);
  for (int k = 0; k < tangent_->count(); ++k) (*gradient)[k] += integrator_.psi_sensitivity(k);
  if (end_motion_.moves()) *gradient += end_motion_.objective_rate() * end_motion_.time();
}

}  // namespace codesign
