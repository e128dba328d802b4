// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_LOOP_JACOBIAN_H_
#define MECHANISM_CODESIGN_ASSEMBLY_LOOP_JACOBIAN_H_

#include <string>
#include <vector>

#include "assembly/tree_kinematics.h"
#include "equations/equations.h"
#include "sparse/least_squares.h"

namespace codesign {

/// Factors of rows and columns that make a LoopJacobian free of units and of a loop's size: turning by 1 rad and sliding by the loop's
/// longest lever count the same.
struct LoopScales {
  Eigen::VectorXd rows, columns;
};

/// By how much a loop or coupling is not closed.
struct LoopMiss {
  std::string owner;
  double length = 0.0;  ///< [m]
  double angle = 0.0;   ///< [rad]; of a coupling in the unit of the coordinate that follows
};

/// What loops and couplings ask of the tree's joint coordinates, Phi^l_theta of doc/theory.md (19). Its cost and its size grow with the
/// lengths of the loops: only coordinates on the way around a loop have entries in its rows.
class LoopJacobian {
 public:
  LoopJacobian(const CompiledSystem& system, const TreeLayout& tree);

  int rows() const { return static_cast<int>(constraint_rows_.size()); }
  /// Rows of Phi that the tree does not satisfy by itself: of loops in order, then of couplings.
  const std::vector<int>& constraint_rows() const { return constraint_rows_; }
  /// The loop or coupling that a row belongs to.
  const std::string& owner(int row) const { return owners_[static_cast<std::size_t>(row)]; }
  /// Coordinates that a loop or coupling depends on, ascending; the others have empty columns.
  const std::vector<int>& coordinates() const { return coordinates_; }

  /// rows() by tree.size at theta. `equations` must hold the design at `parameters`.
  SparseMatrix evaluate(const std::vector<double>& parameters, const VectorX<double>& theta, const Equations<double>& equations) const;

  LoopScales scales(const SparseMatrix& jacobian, const Equations<double>& equations) const;

  /// What constraint errors (rows of Phi) mean for each loop, then for each coupling.
  std::vector<LoopMiss> misses(const VectorX<double>& errors, const Equations<double>& equations) const;

  /// Pairs and couplings that a row shares coordinates with, and those that these do, and so on. One part for each set of rows that has no
  /// coordinate in common with the others.
  struct Part {
    std::vector<int> rows;              ///< of this matrix
    std::vector<int> pairs, couplings;  ///< ascending
  };
  std::vector<Part> parts() const;

 private:
  /// A coordinate and which body of the loop it moves.
  struct Mover {
    int coordinate;
    bool moves_j;
  };
  struct Loop {
    int pair, first_row;
    std::vector<Mover> movers;
  };

  void add_loop(int pair);
  int rows_of(const Loop& loop) const;
  /// Of the length that a row of a loop is measured in: 0 for an angle, 1 for a position, 2 for half the square of a distance.
  static int power(const Loop& loop, int within, const Equations<double>& equations);
  void add_row(int row, const std::string& owner);
  bool slides(int coordinate) const { return slides_[static_cast<std::size_t>(coordinate)]; }

  const CompiledSystem& system_;
  const TreeLayout& tree_;
  std::vector<int> constraint_rows_, coordinates_;
  std::vector<std::string> owners_;
  std::vector<Loop> loops_;
  std::vector<int> joint_of_;  ///< per coordinate
  std::vector<bool> slides_;   ///< per coordinate
  int first_coupling_row_ = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_LOOP_JACOBIAN_H_
