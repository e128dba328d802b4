// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_ASSEMBLY_H_
#define MECHANISM_CODESIGN_DYNAMICS_ASSEMBLY_H_

#include <Eigen/Core>
#include <vector>

#include "mechanism_codesign/dynamics/equations.h"
#include "mechanism_codesign/dynamics/iteration_matrix.h"
#include "mechanism_codesign/dynamics/status.h"
#include "mechanism_codesign/dynamics/tree_kinematics.h"

namespace codesign {

/// Consistent initial conditions of a design; doc/theory.md (19), (20).
///
/// Positions: the tree's joint coordinates theta start from the study's values (or guesses, or zero); those the study fixes stay, and as
/// many of the others as loops and couplings determine are solved for by Newton's method, the rest staying where they started. Joints that
/// follow others by a coupling start from them, and depend rather than they. Velocities likewise, linearly. Accelerations and multipliers:
/// Newton on G(z) = 0 from z = 0, where friction has no normal force to act on.
class Assembly {
 public:
  explicit Assembly(const System& system);

  /// Solves for `state` (at t = 0, extra states zero). `equations` must hold the design at `parameters`; its turn references are set too.
  Status solve(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state);

  /// Carries first-order parts (complex step or lanes) of `parameters` through the solution found by solve(): exact initial sensitivities.
  /// @param start what solve() gave. `equations` must hold the design at the extended parameters.
  template <class T>
  void extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations, State<T>* state) const;

  /// Tree joint coordinates of the last solution, TreeLayout order.
  const VectorX<double>& theta() const { return theta_; }
  const TreeLayout& tree() const { return tree_; }
  /// Accelerations and multipliers consistent with state->q, v, s; starts from state->z.
  Status solve_rates(Equations<double>* equations, State<double>* state);
  /// The name of the loop or coupling that is violated most in the last failed assembly; empty if none.
  const std::string& worst_loop() const { return worst_loop_; }
  /// How near that assembly came: the largest constraint error of the loops and couplings [m, rad or -].
  double nearest_miss() const { return nearest_miss_; }

 private:
  struct Dependents {
    std::vector<int> columns;  ///< dependent coordinates
    Eigen::MatrixXd inverse;   ///< pseudo-inverse of their columns of the loops' Jacobian
  };

  Status solve_positions(const std::vector<double>& parameters, Equations<double>* equations);
  Status solve_velocities(const std::vector<double>& parameters, Equations<double>* equations);
  bool newton(const std::vector<double>& parameters, Equations<double>* equations, const std::vector<int>& free);
  void place(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) const;
  void set_start(const std::vector<double>& parameters);
  void follow_couplings(const Constants<double>& constants);
  void set_turns(Equations<double>* equations) const;
  std::vector<std::vector<int>> by_preference(const std::vector<bool>& given) const;
  Eigen::MatrixXd loop_jacobian(const std::vector<double>& parameters, Equations<double>* equations);
  Eigen::VectorXd loop_part(const VectorX<double>& rows) const;
  Dependents choose(const Eigen::MatrixXd& jacobian, const std::vector<std::vector<int>>& preferences) const;
  void note_worst_loop(const Eigen::VectorXd& errors);
  template <class T>
  void correct(const Dependents& dependents, const VectorX<T>& rows, VectorX<T>* coordinates) const;

  const System& system_;
  TreeLayout tree_;
  std::vector<int> loop_rows_;  ///< constraint rows that the tree does not satisfy by itself
  std::vector<std::string> loop_row_name_;
  std::vector<int> followers_;  ///< per coupling: the coordinate that follows the others
  std::vector<bool> follows_;   ///< per coordinate
  std::vector<bool> position_given_, guess_given_, velocity_given_;
  VectorX<double> theta_, theta_rate_;
  Dependents positions_, velocities_;
  Linearization<double> derivatives_;
  IterationMatrix matrix_;
  std::string worst_loop_;
  double nearest_miss_ = 0.0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_ASSEMBLY_H_
