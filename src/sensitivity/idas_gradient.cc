// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/idas_gradient.h"
#include "equations/equations.h"

namespace codesign {

IdasGradient::IdasGradient(const CompiledSystem& system) : system_(system), integrator_(system), watch_(system), residuals_(system) {}

// The workspace of the sensitivities is allocated only when derivatives are requested.
Status IdasGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  const bool with_gradient = derivatives != Derivatives::kNone;
  with_root_ = derivatives == Derivatives::kGaussNewton;
  if (with_gradient && !tangent_) tangent_ = std::make_unique<IdasTangent>(system_);
  integrator_.carry(with_gradient ? tangent_.get() : nullptr);
  integrator_.watch_singularities(with_gradient);
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
    differentiate = [this](std::size_t k, const State<double>& state, bool /*reads_rates*/, Eigen::VectorXd* gradient) {
      integrator_.interpolate_sensitivities(state.t, &directions_);
      tangent_->watched(k, state, &integrator_.equations(), &directions_, gradient);
    };
  return watch_.start(&integrator_, std::move(differentiate));
}

Status IdasGradient::advance(double limit) {
  Status status = integrator_.advance(limit);
  if (status.ok() && with_root_) residuals_.look();
  if (status.ok() && !watch_.is_empty()) status = watch_.look();
  return status;
}

const State<double>& IdasGradient::consistent_state() {
  end_ = integrator_.state();
  integrator_.assembly().solve_rates(&integrator_.equations(), &end_);
  return end_;
}

double IdasGradient::objective() { return integrator_.psi() + integrator_.equations().terminal(consistent_state()); }

void IdasGradient::take_directions() {
  directions_.resize(static_cast<std::size_t>(tangent_->count()), integrator_.state());
  for (int k = 0; k < tangent_->count(); ++k) integrator_.sensitivity(k, &directions_[static_cast<std::size_t>(k)]);
}

void IdasGradient::jacobian_root(Eigen::MatrixXd* root) { residuals_.finish(consistent_state(), root); }

void IdasGradient::gradient(Eigen::VectorXd* gradient) {
  take_directions();
  tangent_->terminal(consistent_state(), &integrator_.equations(), &directions_, gradient);
  for (int k = 0; k < tangent_->count(); ++k) (*gradient)[k] += integrator_.psi_sensitivity(k);
}

}  // namespace codesign
