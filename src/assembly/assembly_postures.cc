// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Assembly that goes from posture to posture, doc/theory.md (21f).
#include <algorithm>

#include "assembly/assembly.h"
#include "assembly/assembly_walk.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// A position that is solved for is off a singular one by the square root of its tolerance.
constexpr double kSingularPosture = 1e-5;
constexpr double kLanding = 0.2;  // [rad or m] from the last solution before a singular posture
// Of the way, so that no step ends at a posture that was left out, whatever their number.
constexpr double kGolden = 0.6180339887498949;
constexpr double kUndetermined = 1e12;  // larger unknowns follow from a pivot that is rounding

}  // namespace

/// Whether at theta_ the loops determine fewer of the coordinates that are not given than in
/// another posture so far.
bool Assembly::is_singular_posture(const std::vector<double>& parameters,
                                   const Equations<double>& equations) {
  prefer_positions();
  scale_loops(parameters, equations);
  const std::size_t rank =
      work_.independent.choose(work_.loops.matrix, work_.positions, kSingularPosture).size();
  postures_.usual_rank = std::max(postures_.usual_rank, rank);
  return rank < postures_.usual_rank;
}

void Assembly::note_posture(const State<double>& state, bool is_singular) {
  postures_.is_singular = is_singular;
  if (is_singular) return;
  postures_.has_regular = true;
  postures_.theta = theta_;
  postures_.state = state;
  postures_.number = posture_;
}

/// The joints of the list with their positions in this posture: crank = 3.14159.
std::string Assembly::posture_text(const std::vector<double>& parameters) const {
  std::string text;
  for (const InitialJointState& initial : system_.study().initial_state) {
    if (initial.positions.empty()) continue;
    const Quantity& position = initial.positions[static_cast<std::size_t>(posture_)];
    text += (text.empty() ? "" : ", ") + initial.joint + " = " + readable(position.at(parameters));
  }
  return text;
}

void Assembly::warn_of_singular_posture(const std::vector<double>& parameters, bool has_forces) {
  warnings_.push_back(
      {"singular_posture",
       "posture " + readable(posture_) + " (" + posture_text(parameters) +
           ") is singular: it is a dead centre, or several motions meet there, so that the given "
           "positions do not determine how the mechanism moves on" +
           (has_forces ? ""
                       : ", and accelerations, efforts and reactions are not determined: 0 is "
                         "shown") +
           ". The list goes on beyond it, but on which of these motions is not determined: choose "
           "postures beside it, between which it is",
       {}});
}

/// Goes on to posture `to` from the last regular one. True if theta_ is there; `counted` then has
/// the turns of loops.
bool Assembly::walk_to_posture(double to, const std::vector<double>& parameters,
                               Equations<double>* equations, double* opens_at,
                               State<double>* counted) {
  const double from = postures_.number, way = to - from;
  work_.followed = theta_ = postures_.theta;
  *counted = postures_.state;
  VectorX<double> counted_at = theta_;
  posture_ = time_ = from;
  set_given_start(system_, tree_, parameters, posture_, &theta_, &theta_rate_);
  prefer_positions();
  scale_loops(parameters, *equations);
  work_.free = choose_columns(work_.positions);
  theta_rate_.setZero();
  TurnFollower<double> turns(system_);
  double reached = 0.0;
  const auto arrive = [&] {
    reached = posture_ - from;
    count_turns(counted_at, parameters, equations, &turns, counted);
    counted_at = theta_;
  };
  const bool arrived = walk(
      work_.free, way > 1.0 ? kGolden / way : 1.0,
      [&](double part) -> const std::vector<double>& {
        time_ = posture_ = from + way * part;
        *opens_at = part;
        return parameters;
      },
      arrive, equations);
  if (arrived || cancelled()) return arrived;
  // At a singular posture Newton's method converges slowly, from beside it.
  theta_ = work_.followed + (1.0 - reached / way) * work_.slope;
  time_ = posture_ = to;
  set_given_start(system_, tree_, parameters, posture_, &theta_, &theta_rate_);
  follow_couplings(*equations);
  const bool lands = newton(parameters, equations, work_.free, kSingularRank) != Closure::kApart &&
                     (theta_ - work_.followed).cwiseAbs().maxCoeff() < kLanding &&
                     is_singular_posture(parameters, *equations);
  if (lands) arrive();
  return lands;
}

/// Finds a posture as the first one is found, from the study's guesses, if the one before is
/// singular: if it is known to be, or if the loops determine more here.
bool Assembly::restart_posture(double to, const std::vector<double>& parameters,
                               Equations<double>* equations, State<double>* counted) {
  const std::size_t before = postures_.usual_rank;
  const LoopMiss miss = worst_miss_;
  time_ = posture_ = to;
  set_start(parameters);
  follow_couplings(*equations);
  bool closes = solve_positions(parameters, equations).ok();
  if (closes && !postures_.is_singular) {
    is_singular_posture(parameters, *equations);
    closes = postures_.usual_rank > before;
    posture_ = to - 1.0;
    if (closes) warn_of_singular_posture(parameters, true);
    posture_ = to;
  }
  if (closes)
    place(parameters, equations, counted);
  else
    worst_miss_ = miss;
  return closes;
}

Status Assembly::solve_next(const std::vector<double>& parameters, Equations<double>* equations,
                            State<double>* state) {
  warnings_.clear();
  contradicting_.clear();
  rates_.reset_pivots();
  const double before = posture_, to = before + 1.0;
  all_rows_count_ = !system_.sharing().drops();
  if (before == 0.0) {
    postures_ = {};
    note_posture(*state, is_singular_posture(parameters, *equations));
  }
  double opens_at = 0.0;
  State<double> counted = *state;
  bool reached =
      postures_.has_regular && walk_to_posture(to, parameters, equations, &opens_at, &counted);
  if (!reached && !cancelled()) reached = restart_posture(to, parameters, equations, &counted);
  state->t = time_ = posture_ = to;
  if (cancelled()) return {StatusCode::kCancelled, state->t, "cancelled"};
  if (!reached)
    return {StatusCode::kAssemblyFailed, state->t,
            "loop or coupling '" + std::string(worst_miss_.owner) +
                "' cannot be closed on the way from posture " +
                readable(postures_.has_regular ? postures_.number : before) + ": it opens at " +
                readable(100.0 * opens_at, 2) + " % of the way"};
  const bool is_singular = is_singular_posture(parameters, *equations);
  set_extra_states(system_, parameters, &state->s);
  state->z.setZero();
  if (Status status = solve_velocities(parameters, equations, state); !status.ok()) return status;
  set_turns(system_, tree_, theta_, state);
  keep_loop_turns(counted.turns, state);
  equations->track_turns(state);
  const Status status = rates_.solve(equations, state);
  note_posture(*state, is_singular);
  if (!is_singular) return status;
  const bool has_forces = status.ok() && state->z.cwiseAbs().maxCoeff() < kUndetermined;
  if (!has_forces) state->z.setZero();
  warn_of_singular_posture(parameters, has_forces);
  return {};
}

}  // namespace codesign
