// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <utility>
#include <vector>

#include "assembly/extension_workspace.h"
#include "assembly/loop_jacobian.h"
#include "assembly/rate_solution.h"
#include "assembly/singular_start.h"
#include "assembly/stuck_start.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "equations/turn_follower.h"
#include "mechanism_codesign/status.h"
#include "system/tree_kinematics.h"
#include "text/cancel.h"

namespace codesign {

template <class T>
class Equations;

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
  explicit Assembly(const CompiledSystem& system);

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
  RateSolution& rates() { return rates_; }
  const RateSolution& rates() const { return rates_; }

  /// Tree joint coordinates of the last solution [rad or m], in the order of TreeLayout.
  const VectorX<double>& theta() const { return theta_; }
  const TreeLayout& tree() const { return tree_; }
  /// Warnings about the last start: `singular_start`, `branch_continued`, `branch_lost`,
  /// `guessed_start`, `start_slides`, or none.
  const Warnings& warnings() const { return warnings_; }
  /// Indices of the entries of Study::initial_state whose velocities contradict each other; empty
  /// unless kInitialVelocityFailed.
  const std::vector<std::size_t>& contradicting() const { return contradicting_; }
  /// Once `cancel` is set (by any thread), a running or later solve ends soon with kCancelled.
  /// nullptr: no cancellation.
  void obey(const std::atomic<bool>* cancel) {
    cancel_ = cancel;
    rates_.obey(cancel);
  }
  /// The largest closure error of a loop or coupling at the last positions; after a failure, at the
  /// nearest positions that were tried.
  const LoopMiss& worst_miss() const { return worst_miss_; }
  const LoopJacobian& loops() const { return loops_; }

 private:
  // A loop error below this times the mechanism's size counts as closed.
  static constexpr double kClosed = 1e-12;
  // A Newton step [rad or m] below this times the mechanism's size counts as zero.
  static constexpr double kAtRest = 1e-13;
  // Relative rank tolerances of the scaled Jacobian of the loops. Parts below kRank come from
  // rounded angles and lengths or from an almost singular position and are ignored; if the loops do
  // not close without them, kSingularRank is tried.
  static constexpr double kRank = 1e-3, kSingularRank = 1e-9;

  struct ScaledLoops {
    SparseMatrix matrix,
        unscaled;  ///< loops_.rows() x tree_.size; in `matrix` the rows that do not count are zero
    LoopScales scales;
  };
  struct Dependents {
    std::vector<int> columns;  ///< the dependent coordinates
    LeastSquares inverse;      ///< factorization of their columns of the scaled Jacobian
    LoopScales scales;
    /// Least-squares changes of the dependent coordinates for given (unscaled) changes of the
    /// loops' rows, one column per case. @param scaled, workspace overwritten; the result is in the
    /// workspace.
    const Eigen::MatrixXd& solve(const Eigen::MatrixXd& rows, Eigen::MatrixXd* scaled,
                                 LeastSquaresWorkspace* workspace) const;
  };
  /// The memory that positions and velocities are solved for in.
  struct Workspace {
    ScaledLoops loops;
    LoopWorkspace motion;
    IndependentColumns independent;
    Dependents newton;
    LeastSquaresWorkspace solution;
    SparseMatrix enforced;  ///< the unscaled Jacobian, dropped rows zero
    State<double> state;
    VectorX<double> errors, rates, given, left;
    VectorX<double> start, first,
        near;  ///< tree coordinates to return to, of solve_positions(), close() and refine()
    VectorX<double> plain, followed, direct,
        rate;  ///< tree coordinates and rates to return to, of keep_branch() and follow()
    VectorX<double> slope;        ///< of the way, walk()
    std::vector<double> between;  ///< a design on the way, of follow()
    Eigen::MatrixXd rows, scaled;
    ColumnPreferences positions, velocities;
    std::vector<int> free, open, moved;  ///< `moved`: the coordinates that the last close() changed
    std::vector<bool> not_open;
  };
  /// Result of Newton's method: closed to rounding, within the closure tolerance, or neither.
  enum class Closure { kClosed, kNear, kApart };
  /// The solution at the study's own design, from which other designs are continued.
  struct Origin {
    bool is_known = false;
    VectorX<double> theta;
    std::vector<int> free;  ///< the dependent coordinates
    double rank_tolerance = 0.0;
    VectorX<double> nudge;  ///< small guesses that every start needs [rad or m]; empty: none
  };

  /// The postures of a list so far.
  struct Postures {
    bool is_singular = false;  ///< the last one
    bool has_regular = false;
    double number = 0.0;    ///< of the last regular one
    VectorX<double> theta;  ///< its position
    State<double> state;
    std::size_t usual_rank = 0;  ///< most coordinates that the loops determine in any of them
  };

  Status solve_positions(const std::vector<double>& parameters, Equations<double>* equations);
  Status solve_velocities(const std::vector<double>& parameters, Equations<double>* equations);
  Status close_from(const TreeCoordinates& from, const std::vector<double>& parameters,
                    Equations<double>* equations);
  Closure close(const std::vector<double>& parameters, Equations<double>* equations,
                double rank_tolerance);
  Closure newton(const std::vector<double>& parameters, Equations<double>* equations,
                 const std::vector<int>& free, double rank_tolerance);
  double find_errors(const std::vector<double>& parameters, Equations<double>* equations);
  const Eigen::MatrixXd& newton_step(const std::vector<double>& parameters,
                                     const Equations<double>& equations,
                                     const std::vector<int>& free, double rank_tolerance);
  double largest_turn(const std::vector<int>& free, const Eigen::MatrixXd& step) const;
  Closure close_or_nudge(const std::vector<double>& parameters, Equations<double>* equations);
  Closure nearest_to_guess(Closure plain, const std::vector<double>& parameters,
                           Equations<double>* equations);
  void descend(const std::vector<double>& parameters, Equations<double>* equations,
               const std::vector<int>& columns, double most);
  std::vector<int> guessed_coordinates() const;
  double distance_from(const VectorX<double>& start, const std::vector<int>& guessed,
                       const VectorX<double>& levers) const;
  Closure close_from_start(const std::vector<double>& parameters, Equations<double>* equations);
  Status keep_branch(const Status& plain, const std::vector<double>& parameters,
                     Equations<double>* equations);
  bool follow(const std::vector<double>& parameters, Equations<double>* equations);
  template <class PlaceAt, class Arrive>
  bool walk(const std::vector<int>& free, double step, const PlaceAt& place_at,
            const Arrive& arrive, Equations<double>* equations);
  bool is_singular_posture(const std::vector<double>& parameters,
                           const Equations<double>& equations);
  void note_posture(const State<double>& state, bool is_singular);
  std::string posture_text(const std::vector<double>& parameters) const;
  void warn_of_singular_posture(const std::vector<double>& parameters, bool has_forces);
  bool walk_to_posture(double to, const std::vector<double>& parameters,
                       Equations<double>* equations, double* opens_at, State<double>* counted);
  bool restart_posture(double to, const std::vector<double>& parameters,
                       Equations<double>* equations, State<double>* counted);
  void count_turns(const VectorX<double>& from, const std::vector<double>& parameters,
                   Equations<double>* equations, TurnFollower<double>* turns, State<double>* state);
  /// Whether theta_ belongs to the branch of `other`.
  bool is_same(const VectorX<double>& other) const;
  bool converges_at_once(const std::vector<double>& parameters, const std::vector<int>& free,
                         Equations<double>* equations);
  void keep_loop_turns(const std::vector<double>& turns, State<double>* state) const;
  void note_origin();
  std::string guesses_for(const VectorX<double>& theta, const std::vector<int>& coordinates) const;
  void warn_of_branch(const char* code, const std::string& message, const VectorX<double>& theta,
                      const VectorX<double>& other, const std::vector<double>& parameters);
  bool is_own_design(const std::vector<double>& parameters) const {
    return guess_.size() == 0 && parameters == own_design_;
  }
  void refine(const std::vector<double>& parameters, Equations<double>* equations);
  bool cancelled() const { return is_set(cancel_); }
  Status closure_failed() const;
  void note_miss(const VectorX<double>& errors, const Equations<double>& equations);
  /// Whether worst_miss_ is within solver.closure_tolerance.
  bool is_near() const;
  Status choose_branch(const std::vector<double>& parameters, Equations<double>* equations);
  Status check_rest(const State<double>& state);
  Status require_rest(const State<double>& state, Equations<double>* equations);
  Status hold_stuck(Equations<double>* equations, State<double>* state);
  void find_response(const State<double>& state, Equations<double>* equations);
  void warn_of_slides();
  template <class T>
  void extend_stuck(const State<double>& start, Equations<T>* equations,
                    ExtensionWorkspace<T>* workspace, State<T>* state) const;
  Status contradiction();
  Status forbidden();
  double largest_rate(const VectorX<double>& rate) const;
  void place(const std::vector<double>& parameters, Equations<double>* equations,
             State<double>* state);
  void set_start(const std::vector<double>& parameters);
  void follow_couplings(const Equations<double>& equations);
  /// The first two lists of column preferences: followers, then the other coordinates that are not
  /// given.
  void by_preference(const std::vector<bool>& given, ColumnPreferences* lists) const;
  /// Open positions close the loops together, by the least change: one of them alone may bring its
  /// loop to a dead centre.
  void prefer_positions() { by_preference(position_given_, &work_.positions); }
  ReferenceMotion<double> given_motion(const Equations<double>& equations,
                                       const Coupling& coupling) const;
  void find_given_rates(const Equations<double>& equations);
  /// The motor behind an elastic gear starts with its joint: nothing is deflected.
  void follow_gears() {
    for (const auto& [motor, joint] : tree_.motors) {
      theta_[motor] = theta_[joint];
      theta_rate_[motor] = theta_rate_[joint];
    }
  }
  /// Sets work_.loops.
  void scale_loops(const std::vector<double>& parameters, const Equations<double>& equations);
  /// Sets work_.rows to the rows of the loops and couplings of work_.errors; dropped rows are zero
  /// unless all_rows_count_.
  void take_loop_rows();
  /// The dependent coordinates at work_.loops, valid until the next call.
  const std::vector<int>& choose_columns(const ColumnPreferences& preferences);
  void choose(const ColumnPreferences& preferences, Dependents* dependents);
  void factor(const std::vector<int>& columns, double rank_tolerance, Dependents* dependents) const;
  template <class T>
  void correct(const Dependents& dependents, const VectorX<T>& rows,
               ExtensionWorkspace<T>* workspace, VectorX<T>* coordinates) const;

  const CompiledSystem& system_;
  TreeLayout tree_;
  LoopJacobian loops_;
  std::vector<bool> drops_;     ///< per row of loops_: whether the system does not enforce it
  bool all_rows_count_ = true;  ///< whether dropped rows take part in the solution
  double rank_tolerance_;  ///< relative; the tolerance with which the last positions were found
  SingularStart singular_start_;
  StuckStart stuck_{system_};
  Warnings warnings_;
  std::vector<std::size_t> contradicting_;
  /// per coupling: the coordinate that follows the others; -1 for the drive of a loop
  std::vector<int> followers_;
  std::vector<bool> follows_;  ///< per coordinate: whether it is in followers_
  std::vector<bool> position_given_, guess_given_, velocity_given_;
  std::vector<bool> velocity_beside_;  ///< GivenStart
  VectorX<double> theta_, theta_rate_;
  double start_time_ = 0.0;  ///< [s]
  double time_ = 0.0;        ///< of the positions that are sought [s]
  /// number of the posture that theta_ belongs to, or on the way to the next
  double posture_ = 0.0;
  VectorX<double> guess_;                 ///< of theta_, instead of the study's; empty: none
  const std::vector<double> own_design_;  ///< the start values of the study's parameters
  Origin origin_;
  Postures postures_;
  Dependents positions_, velocities_;
  RateSolution rates_;
  LoopMiss worst_miss_;
  Workspace work_;
  const std::atomic<bool>* cancel_ = nullptr;
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
