// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/derivative_products.h"

namespace codesign {

void directional_derivative(const System& system, const Linearization<double>& d, const State<double>& direction, VectorX<double>* result) {
  const Sparsity& pattern = system.sparsity();
  const Layout& layout = system.layout();
  const int *start = pattern.column_start.data(), *row = pattern.row_index.data();
  result->setZero(layout.columns() + 1);
  double* y = result->data();
  for (int column = 0; column < layout.columns(); ++column) {
    const bool body = column < layout.n, state = column >= layout.state_column(0);
    const double position = body ? direction.q[column] : state ? direction.s[column - layout.state_column(0)] : 0.0;
    const double velocity = body ? direction.v[column] : 0.0, rate = direction.z[column];
    for (int k = start[column]; k < start[column + 1]; ++k) {
      const auto e = static_cast<std::size_t>(k);
      y[row[k]] += d.by_position[e] * position + d.by_velocity[e] * velocity + d.by_rate[e] * rate;
    }
  }
}

void subtract_position_product(const System& system, const Linearization<double>& d, const double* q, double factor, double* result) {
  const Sparsity& pattern = system.sparsity();
  const int *start = pattern.column_start.data(), *row = pattern.row_index.data();
  for (int column = 0; column < system.layout().n; ++column) {
    const double x = factor * q[column];
    if (x == 0.0) continue;
    // The integrand's row, the last, is not part of G.
    for (int k = start[column]; k < start[column + 1]; ++k)
      if (row[k] < pattern.columns) result[row[k]] -= d.by_position[static_cast<std::size_t>(k)] * x;
  }
}

}  // namespace codesign
