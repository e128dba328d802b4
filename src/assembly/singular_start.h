// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_SINGULAR_START_H_
#define MECHANISM_CODESIGN_ASSEMBLY_SINGULAR_START_H_

#include <string>
#include <vector>

#include "assembly/loop_jacobian.h"
#include "assembly/tree_kinematics.h"
#include "equations/equations.h"

namespace codesign {

/// Whether velocities, or accelerations from rest, are those of a motion, at a position where rows of the loops depend on each other;
/// doc/theory.md (19a). J = Phi_theta of loops and couplings, L an orthonormal basis of its left null space. First-order velocities,
/// J x = 0, belong to a motion only if J y = -(J x)_theta x has a solution y: L^T (J x)_theta x = 0. That is always so where redundancy is
/// permanent; where several motions meet it tells their tangents from all others.
class SingularStart {
 public:
  /// @param tree, loops must outlive this.
  SingularStart(const CompiledSystem& system, const TreeLayout& tree, const LoopJacobian& loops);

  /// Makes the position present. @param theta tree coordinates.
  void load(const std::vector<double>& parameters, const VectorX<double>& theta, Equations<double>* equations);

  /// Whether rates x (or, from rest, accelerations) are those of a motion.
  bool is_motion(const VectorX<double>& x);
  /// Changes the rates that are not `held` to the nearest ones found that are a motion's. False if there are none.
  bool choose_motion(const std::vector<bool>& held, VectorX<double>* x);

  /// Tree accelerations from the bodies' at rest.
  VectorX<double> tree_accelerations(const VectorX<double>& a);

  /// The joints of the loops that the last rates violate, by name: 'a', 'b' and 'c'.
  std::string joints() const;

 private:
  VectorX<double> rates(const VectorX<double>& theta, const VectorX<double>& x);
  VectorX<double> curvature(const VectorX<double>& x);
  VectorX<double> violation(const VectorX<double>& x);
  bool solve(const std::vector<int>& free, VectorX<double>* x);

  const CompiledSystem& system_;
  const TreeLayout& tree_;
  const LoopJacobian& loops_;
  std::vector<double> parameters_;
  Equations<double>* equations_ = nullptr;
  VectorX<double> theta_, q_, v_, Phi_, Phi_rate_, violated_;
  Eigen::MatrixXd J_, L_;
  double tolerance_ = 0.0;  ///< of the last violation()
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_SINGULAR_START_H_
