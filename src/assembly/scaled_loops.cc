// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scaled_loops.h"

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

void ScaledLoops::evaluate(const TreeLoops& loops, const StartDesign& design,
                           const VectorX<double>& theta, LoopRows heeded) {
  const Equations<double>& equations = *design.equations;
  loops.jacobian.evaluate(design.parameters, theta, equations, &workspace, &unscaled);
  loops.jacobian.scales(unscaled, equations, &workspace, &scales);
  for (std::size_t k = 0; k < loops.drops.size(); ++k)
    if (loops.drops[k] && heeded == LoopRows::kEnforced) scales.rows[to_signed(k)] = 0.0;
  matrix = unscaled;
  for (int c = 0; c < loops.tree.size; ++c)
    for (SparseMatrix::InnerIterator entry(matrix, c); entry; ++entry)
      entry.valueRef() = scales.rows[entry.row()] * entry.value() * scales.columns[c];
}

void DependentSolution::factor(const ScaledLoops& loops, const std::vector<int>& coordinates,
                               double rank_tolerance) {
  columns = coordinates;
  scales = loops.scales;
  inverse.factor(loops.matrix, columns, rank_tolerance);
}

const Eigen::MatrixXd& DependentSolution::solve(const Eigen::MatrixXd& rows,
                                                Eigen::MatrixXd* scaled,
                                                LeastSquaresWorkspace* workspace) const {
  *scaled = scales.rows.asDiagonal() * rows;
  Eigen::MatrixXd& x = inverse.solve(*scaled, workspace);
  for (std::size_t k = 0; k < columns.size(); ++k)
    x.row(to_signed(k)) *= scales.columns[columns[k]];
  return x;
}

const Eigen::MatrixXd& LoopStep::find(const TreeLoops& all, const StartDesign& design,
                                      const LoopSearch& search, const VectorX<double>& theta,
                                      const Eigen::MatrixXd& errors) {
  loops.evaluate(all, design, theta, search.heeded);
  dependent.factor(loops, search.free, search.rank_tolerance);
  return dependent.solve(errors, &scaled, &solution);
}

}  // namespace codesign
