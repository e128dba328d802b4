// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/loop_jacobian.h"
#include "system/tree_kinematics.h"

namespace codesign {

class CompiledSystem;
template <class T>
class Equations;

/// Tests whether rates of the tree coordinates (or, from rest, accelerations) belong to a motion,
/// at a position where rows of the loops depend on each other; doc/theory.md (19a). With J =
/// Phi^l_theta of loops and couplings and L an orthonormal basis of its left null space, rates x
/// with J x = 0 belong to a motion only if J y = -(J x)_theta x has a solution y, which requires
/// L^T (J x)_theta x = 0. If the redundancy is permanent, every such x satisfies this condition;
/// where several motions meet, only their tangents do.
class SingularStart {
 public:
  /// @param tree, loops must outlive this.
  SingularStart(const CompiledSystem& system, const TreeLayout& tree, const LoopJacobian& loops);

  /// Evaluates J and L at a position. Problems with more than 250,000 entries of J are not
  /// analysed: every rate then counts as a motion.
  /// @param theta tree coordinates. @param equations must hold the design at `parameters`, and
  /// outlive the calls below.
  void load(const std::vector<double>& parameters, const VectorX<double>& theta,
            Equations<double>* equations);

  /// Whether rows of the loops depend on each other at that position, nearly at least.
  bool is_singular() const { return L_.cols() > 0; }
  /// Whether rates x (or, from rest, accelerations), tree.size, belong to a motion.
  bool is_motion(const VectorX<double>& x);
  /// Changes the rates that are not `held` as little as possible so that x belongs to a motion.
  /// False, with x unchanged, if no motion is found.
  bool choose_motion(const std::vector<bool>& held, VectorX<double>* x);

  /// Tree accelerations from the bodies' accelerations a (n entries) at rest; zero at a regular
  /// position. Valid until the next call.
  const VectorX<double>& tree_accelerations(In<double> a);

  /// Names of the joints in the loops whose condition the last is_motion() found violated: 'a',
  /// 'b', 'c'.
  std::string joints() const;

 private:
  /// Sets `result` to the rates of the loops' rows at theta.
  void rates(const VectorX<double>& theta, const VectorX<double>& x, VectorX<double>* result);
  /// rates() at theta_ + step x minus that at theta_ - step x.
  void difference(double step, const VectorX<double>& x, VectorX<double>* result);
  /// Sets H_.
  void curvature(const VectorX<double>& x);
  /// L^T (J x)_theta x; valid until the next call.
  const VectorX<double>& violation(const VectorX<double>& x);
  bool solve(const std::vector<int>& free, VectorX<double>* x);

  const CompiledSystem& system_;
  const TreeLayout& tree_;
  const LoopJacobian& loops_;
  std::vector<double> parameters_;
  Equations<double>* equations_ = nullptr;
  VectorX<double> theta_, Phi_, Phi_rate_, violated_;
  State<double> state_;
  /// Rows of given motions, which are held and linear, so that they restrict no other motion; and
  /// all others.
  std::vector<int> given_, others_;
  Eigen::MatrixXd J_, L_, complement_;
  LoopWorkspace motion_;
  SparseMatrix sparse_J_;
  PivotedQr qr_;
  LeastNorm tree_of_bodies_;
  LeastNormWorkspace solution_;
  Eigen::MatrixXd a_;
  VectorX<double> moved_, forward_, near_, far_, H_, B_, unit_, accelerations_;
  double tolerance_ = 0.0;  ///< a last violation() of a smaller norm counts as zero
};

}  // namespace codesign
