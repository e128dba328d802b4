// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/complex_efforts.h"

namespace codesign {

ComplexEfforts::ComplexEfforts(const DrivenSystem& driven, DriveMotion given,
                               const State<double>& near)
    : system_(*driven.system),
      drives_(static_cast<int>(driven.drives.size())),
      given_(given),
      near_(near),
      equations_(system_) {
  derivatives_.resize(system_.patterns());
}

Eigen::VectorXcd ComplexEfforts::operator()(const Eigen::VectorXcd& rho_and_shifts) {
  const auto tuned = static_cast<Eigen::Index>(system_.study().tuned.size());
  const Eigen::VectorXcd rho = rho_and_shifts.head(tuned);
  shifts_.setZero(drives_);
  if (rho_and_shifts.size() > tuned) shifts_ = rho_and_shifts.tail(drives_);
  std::vector<Complex> parameters;
  for (double value : system_.parameters()) parameters.emplace_back(value);
  for (Eigen::Index k = 0; k < rho.size(); ++k)
    parameters[to_index(system_.study().tuned[to_index(static_cast<int>(k))])] = rho[k];
  equations_.set_design(parameters);
  state_.resize(system_.layout());
  cast_state(near_, &state_);
  for (int iteration = 0; iteration < 4; ++iteration) correct(given_.position, true);
  for (int iteration = 0; iteration < 3; ++iteration) correct(given_.velocity, false);
  for (int iteration = 0; iteration < 6; ++iteration) correct_rates();
  Eigen::VectorXcd efforts(drives_);
  for (int k = 0; k < drives_; ++k)
    efforts[k] = -state_.z[system_.layout().lambda_column(system_.drive_row(k))];
  return efforts;
}

// The corrections end where the complex equations hold, whatever matrix leads there: the real one
// at the first state serves all.
Eigen::VectorXcd ComplexEfforts::solve(const Eigen::VectorXcd& right) {
  if (!lu_) {
    equations_.linearize(state_, &derivatives_);
    const Sparsity& pattern = system_.patterns().rate;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(right.size(), right.size());
    for (int row = 0; row < right.size(); ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
        matrix(row, pattern.column(e)) = derivatives_.rate[to_index(e)].real();
    lu_.emplace(matrix);
  }
  Eigen::VectorXcd result(right.size());
  result.real() = lu_->solve(Eigen::VectorXd(right.real()));
  result.imag() = lu_->solve(Eigen::VectorXd(right.imag()));
  return result;
}

void ComplexEfforts::correct_rates() {
  VectorX<Complex> G;
  Complex g;
  equations_.residual(state_, &G, &g);
  for (int k = 0; k < drives_; ++k)
    G[system_.layout().lambda_column(system_.drive_row(k))] -= given_.acceleration[k];
  state_.z -= solve(G);
}

void ComplexEfforts::correct(In<double> given, bool positions) {
  const Layout& layout = system_.layout();
  VectorX<Complex> Phi, Phi_rate;
  equations_.constraint_errors(state_, &Phi, &Phi_rate);
  VectorX<Complex>& errors = positions ? Phi : Phi_rate;
  for (int k = 0; k < drives_; ++k)
    errors[system_.drive_row(k)] -= given[k] + (positions ? shifts_[k] : Complex(0.0));
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(layout.columns());
  right.segment(layout.n, layout.m) = errors;
  (positions ? state_.q : state_.v) -= solve(right).head(layout.n);
}

}  // namespace codesign
