// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "assembly/posture.h"
#include "assembly/scaled_loops.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "mechanism_codesign/status.h"
#include "sparse/least_squares.h"

namespace codesign {

struct TreeLoops;

/// The coordinates whose positions and those whose rates follow from the others at a start, with
/// the solutions that give their derivatives, doc/theory.md (20).
struct StartDependents {
  DependentSolution positions, velocities;
};

/// The rates of a start, doc/theory.md (20): those that are given are kept, the others are changed
/// as little as the loops and couplings demand. Not thread-safe.
class StartVelocities {
 public:
  /// @param loops must outlive this.
  explicit StartVelocities(const TreeLoops& loops) : loops_(loops) {}

  /// Changes posture->rate at a closed posture. @param dependents overwritten. @param contradicting
  /// receives the indices in Study::initial_state of velocities that contradict each other or a
  /// loop. @returns kInitialVelocityFailed.
  Status find(const StartDesign& design, Posture* posture, StartDependents* dependents,
              std::vector<std::size_t>* contradicting);

 private:
  void choose(const GivenStart& given, StartDependents* dependents, double rank_tolerance);
  void find_given_rates(const StartDesign& design, double time);
  double largest_rate(const VectorX<double>& rate) const;
  Status forbidden(const VectorX<double>& rate, std::vector<std::size_t>* contradicting) const;
  Status contradiction(std::vector<std::size_t>* contradicting) const;

  const TreeLoops& loops_;
  ScaledLoops scaled_;
  SparseMatrix enforced_;  ///< the unscaled Jacobian, dropped rows zero
  VectorX<double> given_;  ///< the rates that the rows have
  VectorX<double> left_;   ///< what they miss
  Eigen::MatrixXd rows_, scaled_rows_;
  LeastSquaresWorkspace solution_;
  IndependentColumns independent_;
  ColumnPreferences positions_, velocities_;
  std::vector<bool> not_open_;
};

}  // namespace codesign
