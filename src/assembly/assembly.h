// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_ASSEMBLY_H_
#define MECHANISM_CODESIGN_ASSEMBLY_ASSEMBLY_H_

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "assembly/loop_jacobian.h"
#include "assembly/singular_start.h"
#include "assembly/tree_kinematics.h"
#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Consistent initial conditions of a design; doc/theory.md (19), (20).
///
/// Positions: the tree's joint coordinates theta start from the study's values (or guesses, or zero); those the study fixes stay, and as
/// many of the others as loops and couplings determine are solved for by Newton's method, the rest staying where they started. Joints that
/// follow others by a coupling start from them, and depend rather than they. Velocities likewise, linearly. Accelerations and multipliers:
/// Newton on G(z) = 0 from z = 0, where friction has no normal force to act on.
class Assembly {
 public:
  explicit Assembly(const CompiledSystem& system);

  /// Solves for `state` (at t = 0, extra states zero). `equations` must hold the design at `parameters`; its turn references are set too.
  Status solve(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state);

  /// The same without accelerations and multipliers.
  Status solve_motion(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state);
  /// Positions alone, with every row of loops and couplings, those that the system drops too.
  Status solve_positions(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state);

  /// Carries first-order parts (complex step or lanes) of `parameters` through the solution found by solve(): exact initial sensitivities.
  /// @param start what solve() gave. `equations` must hold the design at the extended parameters.
  template <class T>
  void extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations, State<T>* state) const;

  /// Tree joint coordinates of the last solution, TreeLayout order.
  const VectorX<double>& theta() const { return theta_; }
  const TreeLayout& tree() const { return tree_; }
  /// What is doubtful about the last start.
  const Warnings& warnings() const { return warnings_; }
  /// Entries of Study::initial_state whose velocities contradict each other in the last start.
  const std::vector<std::size_t>& contradicting() const { return contradicting_; }
  /// Accelerations and multipliers consistent with state->q, v, s; starts from state->z.
  Status solve_rates(Equations<double>* equations, State<double>* state);
  /// From now on every solve ends with kCancelled soon after `cancel` is set, from any thread. Null: never.
  void obey(const std::atomic<bool>* cancel) { cancel_ = cancel; }
  /// How far the loop or coupling that is violated most is from closed at the positions found last.
  const LoopMiss& worst_miss() const { return worst_miss_; }
  const LoopJacobian& loops() const { return loops_; }

 private:
  /// The loops' Jacobian, scaled, its columns those of every coordinate.
  struct ScaledLoops {
    SparseMatrix matrix, unscaled;
    LoopScales scales;
  };
  struct Dependents {
    std::vector<int> columns;  ///< dependent coordinates
    LeastSquares inverse;      ///< of their columns of the scaled Jacobian
    LoopScales scales;
    /// Changes of the dependent coordinates that make changes of the loops' rows.
    Eigen::MatrixXd solve(const Eigen::MatrixXd& rows) const;
  };
  /// Where Newton's method came to rest.
  enum class Rest { kClosed, kNear, kApart };

  Status solve_positions(const std::vector<double>& parameters, Equations<double>* equations);
  Status solve_velocities(const std::vector<double>& parameters, Equations<double>* equations);
  Rest close(const std::vector<double>& parameters, Equations<double>* equations, double rank_tolerance);
  Rest newton(const std::vector<double>& parameters, Equations<double>* equations, const std::vector<int>& free, double rank_tolerance);
  void refine(const std::vector<double>& parameters, Equations<double>* equations);
  bool cancelled() const { return cancel_ != nullptr && *cancel_; }
  /// Why no closed position was found.
  Status closure_failed() const;
  void note_miss(const VectorX<double>& errors, const Equations<double>& equations);
  /// Within the closure tolerance.
  bool is_near() const;
  Status choose_branch(const std::vector<double>& parameters, Equations<double>* equations);
  Status check_rest(const State<double>& state);
  Status contradiction(const SparseMatrix& jacobian, const Eigen::VectorXd& left);
  void place(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) const;
  void set_start(const std::vector<double>& parameters);
  void follow_couplings(const Constants<double>& constants);
  void set_turns(Equations<double>* equations) const;
  std::vector<std::vector<int>> by_preference(const std::vector<bool>& given) const;
  ScaledLoops scaled_loops(const std::vector<double>& parameters, const Equations<double>& equations) const;
  /// The loops' rows; zero for those that are dropped, unless all count.
  Eigen::VectorXd loop_part(const VectorX<double>& rows) const;
  Dependents choose(const ScaledLoops& loops, const std::vector<std::vector<int>>& preferences) const;
  static Dependents factor(const ScaledLoops& loops, const std::vector<int>& columns, double rank_tolerance);
  template <class T>
  void correct(const Dependents& dependents, const VectorX<T>& rows, VectorX<T>* coordinates) const;

  const CompiledSystem& system_;
  TreeLayout tree_;
  LoopJacobian loops_;
  std::vector<bool> drops_;     ///< per row of the loops
  bool all_rows_count_ = true;  ///< and none is left out, though the system drops it
  double rank_tolerance_;       ///< by which the positions were found
  SingularStart singular_start_;
  Warnings warnings_;
  std::vector<std::size_t> contradicting_;
  std::vector<int> followers_;  ///< per coupling: the coordinate that follows the others
  std::vector<bool> follows_;   ///< per coordinate
  std::vector<bool> position_given_, guess_given_, velocity_given_;
  VectorX<double> theta_, theta_rate_;
  Dependents positions_, velocities_;
  Linearization<double> derivatives_;
  IterationMatrix matrix_;
  LoopMiss worst_miss_;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_ASSEMBLY_H_
