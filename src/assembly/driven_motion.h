// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "equations/turn_follower.h"
#include "math/arrays.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// A mechanism whose motion is prescribed, doc/theory.md (28): the measured joints that determine
/// the motion are driven, those whose motion the study gives among them. Each drive adds a
/// constraint row whose multiplier is minus the effort. The study of the system has neither
/// controllers nor given motions nor an objective.
struct DrivenSystem {
  std::shared_ptr<const CompiledSystem> system;
  /// the driven joints as indices in the list of measured joints, ascending; drive k has row
  /// System::drive_row(k)
  std::vector<int> drives;
  /// the surplus joints, likewise as indices: their motion follows from the motion of the drives
  std::vector<int> surplus;
};

/// The motion of the drives at one instant, in the order of DrivenSystem::drives.
struct DriveMotion {
  In<double> position, velocity, acceleration;  ///< [rad or m], per s, per s^2
};

/// Positions, velocities, accelerations, reactions and efforts of a driven mechanism at one design;
/// doc/theory.md (28). A workspace: no allocation once warm, not thread-safe.
///
/// Coordinates of the forest that are driven are set; everything else follows by Newton's method,
/// which has nothing to do for a tree all of whose joints are driven: the efforts are then those of
/// one residual, inverse dynamics.
///
/// Statuses: kAssemblyFailed (no position near the start satisfies the given positions of the
/// drives), kSingularMatrix, kNonFinite, kInitialReactionsFailed (no reactions satisfy the
/// equations with friction).
class DrivenMotion {
 public:
  /// @param driven must outlive this.
  explicit DrivenMotion(const DrivenSystem& driven);

  /// Evaluates all constants at `parameters` (all named parameters). Allocates.
  void set_design(const std::vector<double>& parameters);
  /// Later solutions do not depend on earlier ones, to the last bit.
  void reset_pivots();
  /// Keeps the present pivots as the pivots that reset_pivots() returns to. Call it at a state near
  /// all later states.
  void keep_pivots() { matrix_.keep_pivots(); }

  /// Solves for the whole state at a motion of the drives near the motion of `state`, which is the
  /// start of the iterations.
  Status solve(const DriveMotion& given, State<double>* state);
  /// solve(), for positions of the drives that may be far from `state`: the drives are moved there
  /// in steps. Counts whole turns.
  Status follow(const DriveMotion& given, State<double>* state);
  /// Computes and factorizes G_z of (14) at a solution, for derivatives; matrix() returns it.
  Status linearize(const State<double>& state);

  /// Effort of drive k on the child of its joint, positive along the coordinate [N m or N].
  double effort(const State<double>& state, int k) const {
    return -state.z[system_.layout().lambda_column(system_.drive_row(k))];
  }
  /// The largest rate of a coordinate per rate of a drive, over all drives, at a solution; infinite
  /// if the drives do not determine it. The state's matrix is factorized.
  double fastest_follower(const State<double>& state);
  const SparseLu& lu() const { return matrix_.lu(); }
  const CompiledSystem& system() const { return system_; }
  Equations<double>& equations() { return equations_; }
  int drives() const { return drives_; }

 private:
  enum class Part { kPositions, kVelocities };
  /// Sets the driven coordinates in q, v or z.
  void give(In<double> given, VectorX<double>* x) const;
  Status solve_positions(In<double> given, State<double>* state);
  Status solve_velocities(In<double> given, State<double>* state);
  Status solve_rates(In<double> given, State<double>* state);
  /// Computes the correction of q or v for the errors of the constraints, in the first n entries of
  /// step_.
  void find_correction(Part part, In<double> given, const State<double>& state);
  Status move_to(In<double> given, int depth, State<double>* state);
  /// Sets the entries of turns_ of one body.
  void note_turns(int body);

  const CompiledSystem& system_;
  const int drives_;
  std::vector<int> turn_slots_;  ///< per drive: the entry of State::turns
  std::vector<int> columns_;     ///< per drive: its coordinate, or -1 if it drives a cut pair
  bool all_given_ = false;       ///< whether all coordinates are driven and nothing else is unknown
  bool is_factored_ = false;     ///< since reset_pivots()
  VectorX<double> turns_;        ///< n: turn [rad] per change of a coordinate
  /// 0 for the efforts of driven coordinates, else 1: G is affine in these efforts, with constant
  /// columns, so that an error of one of them alone is removed by one step.
  VectorX<double> uncertain_;
  Equations<double> equations_;
  TurnFollower<double> follower_;
  Linearization<double> derivatives_;
  IterationMatrix matrix_;
  VectorX<double> step_, Phi_, Phi_rate_;
};

}  // namespace codesign
