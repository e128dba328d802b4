// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "math/arrays.h"
#include "sparse/least_squares.h"
#include "system/tree_kinematics.h"

namespace codesign {

class CompiledSystem;
struct CouplingTerm;
template <class T>
class Equations;

/// Factors of the rows and columns of a LoopJacobian that remove units and the loop's size:
/// afterwards, turning by 1 rad and sliding by the loop's longest lever have the same effect. Rows
/// that are lengths are in 1/m, columns of slides in m.
struct LoopScales {
  Eigen::VectorXd rows, columns;
};

/// Closure error of one loop or coupling: the largest of its rows, lengths and angles apart.
struct LoopMiss {
  /// name of the loop or coupling; valid as long as the LoopJacobian and its system
  std::string_view owner;
  double length = 0.0;  ///< [m]
  double angle = 0.0;   ///< [rad]; for a coupling, in the unit of its follower's coordinate
};

/// The memory that LoopJacobian computes in.
struct LoopWorkspace {
  std::vector<LinkMotion<double>> links;
  std::vector<CoordinateTwist> twists;
  VectorX<double> standstill, q, v;
  /// per row: the largest entry in all columns, in those that are no slides
  Eigen::VectorXd largest, largest_turn;
};

/// The Jacobian Phi^l_theta of the rows of loops and couplings with respect to the tree's joint
/// coordinates, doc/theory.md (19). A loop's rows have entries only in the coordinates of the
/// tree's joints along the loop, so that cost and size grow with the lengths of the loops.
class LoopJacobian {
 public:
  /// @param system, tree must outlive this.
  LoopJacobian(const CompiledSystem& system, const TreeLayout& tree);

  int rows() const { return static_cast<int>(constraint_rows_.size()); }
  /// The rows of Phi that forward kinematics of the tree does not satisfy: the rows of the loops in
  /// order, then the rows of the couplings.
  const std::vector<int>& constraint_rows() const { return constraint_rows_; }
  /// The rows of this matrix out of all constraint rows, of a vector or matrix.
  template <class Rows>
  Rows part_of(const Rows& all) const {
    Rows part;
    take_part(all, &part);
    return part;
  }
  /// The same into `part`, whose memory is used again.
  template <class All, class Part>
  void take_part(const All& all, Part* part) const {
    part->resize(rows(), all.cols());
    for (int k = 0; k < rows(); ++k) part->row(k) = all.row(constraint_rows_[to_index(k)]);
  }
  /// The row of the first coupling; one row per coupling.
  int first_coupling_row() const { return first_coupling_row_; }
  /// Name of the loop or coupling that row `row` of this matrix belongs to.
  const std::string& owner(int row) const { return owners_[to_index(row)]; }
  /// Name of the first loop or coupling that depends on a coordinate; empty if there is none.
  std::string first_owner(int coordinate) const;
  /// Coordinates that a loop or coupling depends on, ascending; the others have empty columns.
  const std::vector<int>& coordinates() const { return coordinates_; }

  /// The matrix, rows() x tree.size, at theta. `equations` must hold the design at `parameters`.
  /// @param workspace, jacobian overwritten; their memory is used again.
  void evaluate(const std::vector<double>& parameters, const VectorX<double>& theta,
                const Equations<double>& equations, LoopWorkspace* workspace,
                SparseMatrix* jacobian) const;
  SparseMatrix evaluate(const std::vector<double>& parameters, const VectorX<double>& theta,
                        const Equations<double>& equations) const;

  /// @param jacobian the result of evaluate(). @param workspace, scales overwritten; their memory
  /// is used again.
  void scales(const SparseMatrix& jacobian, const Equations<double>& equations,
              LoopWorkspace* workspace, LoopScales* scales) const;
  LoopScales scales(const SparseMatrix& jacobian, const Equations<double>& equations) const;

  /// The number of loops and couplings, in this order.
  std::size_t owners() const { return loops_.size() + to_index(rows() - first_coupling_row_); }
  /// The closure error of a loop or coupling, from constraint errors Phi (all m rows).
  LoopMiss miss(std::size_t owner, const VectorX<double>& errors,
                const Equations<double>& equations) const;

  /// A connected part: rows that share coordinates, directly or through other rows, with the pairs
  /// and couplings of these coordinates.
  struct Part {
    std::vector<int> rows;              ///< rows of this matrix
    std::vector<int> pairs, couplings;  ///< indices in Topology, ascending
  };
  /// The partition of all rows into parts that have no coordinate in common.
  std::vector<Part> parts() const;

 private:
  /// A coordinate of a tree joint along a loop, and whether it moves the loop's body j (else body
  /// i).
  struct Mover {
    int coordinate;
    bool moves_j;
  };
  struct Loop {
    int pair, first_row;
    std::vector<Mover> movers;
  };

  void add_loop(int pair);
  Loop movers_of(const CouplingTerm& term) const;
  void find_pattern();
  int rows_of(const Loop& loop) const;
  /// Power of length in the unit of a loop's row: 0 for an angle, 1 for a position [m], 2 for half
  /// a squared distance [m^2].
  static int power(const Loop& loop, int within, const Equations<double>& equations);
  void add_row(int row, const std::string& owner);
  bool slides(int coordinate) const { return slides_[to_index(coordinate)]; }

  const CompiledSystem& system_;
  const TreeLayout& tree_;
  std::vector<int> constraint_rows_, coordinates_;
  std::vector<std::string> owners_;
  std::vector<Loop> loops_;
  /// Per coupling and term; the pair is -1 for a coordinate of the tree.
  std::vector<std::vector<Loop>> couplings_;
  /// Where evaluate() puts a number: the first one of a slot is written, later ones are added.
  struct Slot {
    int slot;
    bool is_first;
  };
  SparseMatrix pattern_;       ///< zeros
  std::vector<Slot> places_;   ///< in the order of evaluate()
  std::vector<int> joint_of_;  ///< per coordinate: its joint in the description
  std::vector<bool> slides_;   ///< per coordinate: whether it is a length
  int first_coupling_row_ = 0;
};

}  // namespace codesign
