// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/derivative_products.h"

#include <cassert>

#include "sparse/row_product.h"

namespace codesign {

void directional_derivative(const CompiledSystem& system, const Linearization<double>& d, const State<double>& direction,
                            VectorX<double>* result) {
  const ByVariable<Sparsity>& patterns = system.patterns();
  const Layout& layout = system.layout();
  result->resize(patterns.rate.rows);
  // Columns of `position` are (q, s), which State keeps in two vectors, so row_product() does not serve.
  for (int row = 0; row < patterns.rate.rows; ++row) {
    double sum = row_product(patterns.velocity, d.velocity, row, direction.v) + row_product(patterns.rate, d.rate, row, direction.z);
    for (int e = patterns.position.first(row); e < patterns.position.first(row + 1); ++e) {
      const int column = patterns.position.column(e);
      sum += d.position[static_cast<std::size_t>(e)] * (column < layout.n ? direction.q[column] : direction.s[column - layout.n]);
    }
    (*result)[row] = sum;
  }
}

void subtract_position_product(const CompiledSystem& system, const Linearization<double>& d, In<double> q, double factor,
                               Out<double> result) {
  assert(q.size() == system.layout().n && result.size() == system.layout().columns());
  const double* const direction = q.data();
  double* const sum = result.data();
  const Sparsity& pattern = system.patterns().position;
  for (int row = 0; row < system.layout().columns(); ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      if (pattern.column(e) < system.layout().n)
        sum[row] -= d.position[static_cast<std::size_t>(e)] * factor * direction[pattern.column(e)];
}

}  // namespace codesign
