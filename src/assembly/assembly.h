// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "assembly/extension_workspace.h"
#include "assembly/loop_jacobian.h"
#include "assembly/rate_solution.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/status.h"
#include "system/tree_kinematics.h"

namespace codesign {

/// Consistent initial conditions of a design; doc/theory.md (19), (20).
///
/// Positions: the tree's joint coordinates theta start from the study's positions, else from its
/// guesses, else from zero. Coordinates with a given position are held. Of the others, Newton's
/// method changes as many as the loops and couplings determine (the dependent coordinates); the
/// rest keep their start values. The follower of a coupling starts at the value that the coupling
/// implies and is chosen as a dependent coordinate first. If the loops do not close at the study's
/// own design, and joints along them have neither position nor guess, small guesses are tried: a
/// linkage that is stretched out in a line cannot bend by Newton's method alone.
/// Branch: the solution at the study's own design is kept, and that of every other design is
/// compared with its continuation along the straight line between the two designs, doc/theory.md
/// (19b). Where they differ, the continuation counts, so that positions are continuous in the
/// design and do not depend on the designs solved before. Velocities: the same choice of dependent
/// coordinates for the rates, with one linear solve. Accelerations and multipliers: Newton's method
/// on G(z) = 0 from z = 0, where the multipliers, and with them friction, are zero. Joints that
/// start stuck are held by their bristles, (13h).
///
/// Statuses of the solve functions: kAssemblyFailed (a loop or coupling does not close within
/// solver.closure_tolerance), kInitialVelocityFailed (given velocities contradict each other),
/// kSingularConfiguration, kSingularMatrix, kNonFinite, kInitialReactionsFailed, kCancelled. Not
/// thread-safe.
class Assembly {
 public:
  /// @param system must outlive this.
  explicit Assembly(const CompiledSystem& system);
  ~Assembly();

  /// Later solutions start at `time` [s] in place of 0, with the coordinates `theta` (TreeLayout
  /// order) in place of the study's guesses.
  void begin_at(double time, const VectorX<double>& theta);

  /// Finds positions, velocities, accelerations and multipliers and writes them to `state`, with t
  /// = 0, or as begin_at() says, and the extra states as set_extra_states() says, except for
  /// controllers and bristles with another begin (Equations::begin_states()), and bristles that
  /// hold a joint.
  /// @param parameters all named parameters (Study::parameters order).
  /// @param equations must hold the design at `parameters`.
  Status solve(const std::vector<double>& parameters, Equations<double>* equations,
               State<double>* state);

  /// Finds positions and velocities only; the accelerations and multipliers in `state` are zero.
  Status solve_motion(const std::vector<double>& parameters, Equations<double>* equations,
                      State<double>* state);
  /// Finds positions only. First every row of the loops and couplings counts, dropped ones too; if
  /// the system drops rows, the enforced rows are then solved to rounding. The rates in `state` are
  /// those given by the study, not solved for.
  Status solve_positions(const std::vector<double>& parameters, Equations<double>* equations,
                         State<double>* state);
  /// Finds velocities at the positions that the last solve_positions() found, which `state` must
  /// hold.
  Status solve_velocities(const std::vector<double>& parameters, Equations<double>* equations,
                          State<double>* state);

  /// Finds positions and velocities near a state of a run whose design has changed, in place of the
  /// study's start: coordinates whose positions the study gives keep their positions and rates if
  /// the loops allow it; the other coordinates follow. Extra states and accelerations in `state`
  /// stay. @param from tree coordinates of the run. @param state of the run, overwritten unless
  /// this fails.
  Status solve_from(const TreeCoordinates& from, const std::vector<double>& parameters,
                    Equations<double>* equations, State<double>* state);

  /// Goes from the posture that was solved last to the next one of the study's list, doc/theory.md
  /// (21f): along the straight line between the given positions, with the other coordinates
  /// following, so that the branch stays. Fills `state` as solve() does, which finds the first
  /// posture. @param state of the posture before. @returns kAssemblyFailed also where the loops
  /// cannot be closed on the way.
  Status solve_next(const std::vector<double>& parameters, Equations<double>* equations,
                    State<double>* state);

  /// Exact initial sensitivities, doc/theory.md (20): carries the first-order parts of `parameters`
  /// (complex step or lanes) through the last solution of solve(). `state` receives that solution
  /// with its derivatives.
  /// @param start the state that the last solve() found. @param equations must hold the design at
  /// `parameters`, derivatives included.
  template <class T>
  void extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations,
              ExtensionWorkspace<T>* workspace, State<T>* state) const;
  template <class T>
  void extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations,
              State<T>* state) const {
    ExtensionWorkspace<T> workspace;
    extend(parameters, start, equations, &workspace, state);
  }

  /// Of any state, not only of those that this finds.
  RateSolution& rates();
  const RateSolution& rates() const;

  /// Tree joint coordinates of the last solution [rad or m], in the order of TreeLayout.
  const VectorX<double>& theta() const;
  const TreeLayout& tree() const;
  /// Warnings about the last start: `singular_start`, `branch_continued`, `branch_lost`,
  /// `guessed_start`, `start_slides`, or none.
  const Warnings& warnings() const;
  /// Indices of the entries of Study::initial_state whose velocities contradict each other; empty
  /// unless kInitialVelocityFailed.
  const std::vector<std::size_t>& contradicting() const;
  /// Once `cancel` is set (by any thread), a running or later solve ends soon with kCancelled.
  /// nullptr: no cancellation.
  void obey(const std::atomic<bool>* cancel);
  /// The largest closure error of a loop or coupling at the last positions; after a failure, at the
  /// nearest positions that were tried.
  const LoopMiss& worst_miss() const;
  const LoopJacobian& loops() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The workspace of one analysis at t = 0: a design, its equations, an Assembly and the state that
/// the Assembly computes. Not thread-safe.
struct StartWorkspace {
  /// @param system must outlive the workspace.
  /// @param design all named parameters (Study::parameters order).
  StartWorkspace(const CompiledSystem& system, std::vector<double> design)
      : parameters(std::move(design)), equations(system), assembly(system) {
    equations.compiled().allow(
        false);  // recording and compiling takes longer than the few evaluations at t = 0
    equations.set_design(parameters);
  }

  /// The functions of Assembly of the same name, for this design; they fill `state`.
  Status solve_positions() { return assembly.solve_positions(parameters, &equations, &state); }
  Status solve_velocities() { return assembly.solve_velocities(parameters, &equations, &state); }
  Status solve_motion() { return assembly.solve_motion(parameters, &equations, &state); }
  Status solve() { return assembly.solve(parameters, &equations, &state); }

  const std::vector<double> parameters;  ///< the design
  Equations<double> equations;
  Assembly assembly;
  State<double> state;
};

}  // namespace codesign
