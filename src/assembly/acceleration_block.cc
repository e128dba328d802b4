// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/acceleration_block.h"

namespace codesign {

std::vector<Eigen::Triplet<double>> acceleration_block(const CompiledSystem& system, Equations<double>* equations,
                                                       const State<double>& state, int first, int count) {
  Linearization<double> d;
  d.resize(system.patterns());
  equations->linearize_rates(state, &d);
  const Sparsity& G_z = system.patterns().rate;
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < count; ++row)
    for (int e = G_z.first(first + row); e < G_z.first(first + row + 1); ++e)
      if (G_z.column(e) < system.layout().n) entries.emplace_back(row, G_z.column(e), d.rate[static_cast<std::size_t>(e)]);
  return entries;
}

SparseMatrix constraint_jacobian(const CompiledSystem& system, Equations<double>* equations, const State<double>& state) {
  const Layout& layout = system.layout();
  const std::vector<Eigen::Triplet<double>> entries =
      acceleration_block(system, equations, state, layout.lambda_column(0), layout.constraints());
  SparseMatrix Phi_q(layout.constraints(), layout.n);
  Phi_q.setFromTriplets(entries.begin(), entries.end());
  return Phi_q;
}

}  // namespace codesign
