// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/residual_rows.h"

#include <cmath>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Gauss's rule with two points on [0, 1]: both have the weight 1/2. Its weights are positive, which
// their roots require; some weights of the integrators' own quadrature are negative.
const double kGaussPoints[] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
constexpr double kGaussWeight = 0.5;

}  // namespace

ResidualRows::ResidualRows(const CompiledSystem& system) : system_(system) {
  state_.resize(system.layout());
}

Status ResidualRows::start(Integrator* integrator, Differentiate differentiate) {
  integrator_ = integrator;
  differentiate_ = std::move(differentiate);
  time_ = integrator->state().t;
  root_.start(to_signed(system_.study().tuned.size()));
  for (const ObjectivePart part : {ObjectivePart::kIntegral, ObjectivePart::kTerminal})
    if (Status status = check_squares(part); !status.ok()) return status;
  return {};
}

Status ResidualRows::check_squares(ObjectivePart part) const {
  const bool terminal = part == ObjectivePart::kTerminal;
  const auto& design = integrator_->equations().formulas().view().design;
  const std::vector<double>& weights = (terminal ? design.terminal : design.integral).weights;
  const std::vector<ResolvedTerm>& terms = terminal ? system_.terminal() : system_.integral();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const bool is_square = terms[k].loss->is_square();
    if (is_square && weights[k] >= 0.0) continue;
    const std::string term = term_name(system_.study(), part, k);
    if (is_square)
      return {StatusCode::kInvalidDesign, 0.0,
              "the weight of " + term + " is " + to_decimal(weights[k]) +
                  " at this design; a sum of squares has weights of 0 or more"};
    return {StatusCode::kInvalidDesign, 0.0,
            "the loss of " + term + " is " + terms[k].loss->name +
                "; a sum of squares has the losses square, above and below"};
  }
  return {};
}

void ResidualRows::look() {
  const double from = time_, to = integrator_->state().t;
  time_ = to;
  if (system_.integral().empty()) return;
  for (const double point : kGaussPoints) {
    double psi = 0.0;
    integrator_->interpolate(from + point * (to - from), &state_, &psi);
    look_at(state_, kGaussWeight * (to - from));
  }
}

void ResidualRows::look_at(const State<double>& state, double weight) {
  if (system_.integral().empty()) return;
  differentiate_(ObjectivePart::kIntegral, state, &integral_rows_);
  add(weight, &integral_rows_);
}

void ResidualRows::finish(const State<double>& state, Eigen::MatrixXd* root) {
  if (!system_.terminal().empty()) {
    differentiate_(ObjectivePart::kTerminal, state, &terminal_rows_);
    add(1.0, &terminal_rows_);
  }
  root_.root(root);
}

void ResidualRows::add(double weight, Eigen::MatrixXd* rows) {
  *rows *= std::sqrt(weight);
  for (Eigen::Index k = 0; k < rows->cols(); ++k) root_.add(rows->col(k));
}

}  // namespace codesign
