// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that start from known positions: of a run, or of the study's own design.
#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/assembly.h"
#include "assembly/assembly_walk.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Relative; tree coordinates that differ by less belong to one branch.
constexpr double kSameBranch = 1e-6;
// [rad or m] limit of the first Newton step per coordinate on the way between two designs.
constexpr double kFirstTurn = 0.5;
constexpr double kContraction = 0.25;  // of Newton steps; with less, the solution nearest to the
                                       // start of the iteration is found
constexpr int kMostCorrections = 12;

double to_four_digits(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

/// The tuned parameters with their values: a = 0.1, b = 0.2.
std::string design_text(const MotionStudy& study, const std::vector<double>& parameters) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, study.tuned.size()); ++k) {
    const auto index = to_index(study.tuned[k]);
    text +=
        (k > 0 ? ", " : "") + study.parameters[index].name + " = " + readable(parameters[index], 6);
  }
  return text + (study.tuned.size() > kMost ? ", ..." : "");
}

}  // namespace

Status Assembly::close_from(const TreeCoordinates& from, const std::vector<double>& parameters,
                            Equations<double>* equations) {
  warnings_.clear();
  contradicting_.clear();
  rates_.reset_pivots();
  theta_ = from.theta;
  theta_rate_ = from.rate;
  follow_couplings(*equations);
  const Status status = solve_positions(parameters, equations);
  return status.ok() ? solve_velocities(parameters, equations) : status;
}

// A start may give more positions than the mechanism has freedoms, if they happen to fit. They fit
// no other dimensions, so that a second attempt holds none.
Status Assembly::solve_from(const TreeCoordinates& from, const std::vector<double>& parameters,
                            Equations<double>* equations, State<double>* state) {
  const VectorX<double> theta = theta_, rate = theta_rate_;
  const std::vector<bool> positions = position_given_, guesses = guess_given_,
                          velocities = velocity_given_;
  const std::vector<bool> none(positions.size(), false);
  guess_given_ = velocity_given_ = none;
  time_ = state->t;
  Status status = close_from(from, parameters, equations);
  if (!status.ok() && positions != none) {
    position_given_ = none;
    status = close_from(from, parameters, equations);
  }
  position_given_ = positions;
  guess_given_ = guesses;
  velocity_given_ = velocities;
  if (!status.ok()) {
    theta_ = theta;
    theta_rate_ = rate;
    status.time = state->t;
    return status;
  }
  const std::vector<double> turns = state->turns;
  place(parameters, equations, state);
  keep_loop_turns(turns, state);
  return {};
}

bool Assembly::is_same(const VectorX<double>& other) const {
  return (theta_ - other).cwiseAbs().maxCoeff() <=
         kSameBranch * (1.0 + theta_.cwiseAbs().maxCoeff());
}

void Assembly::note_origin() {
  // If all open coordinates had to move, the position has no dependent coordinates that other
  // designs could share.
  origin_.is_known = loops_.rows() > 0 && work_.moved.size() <= work_.free.size();
  origin_.theta = theta_;
  origin_.free = work_.moved;
  origin_.rank_tolerance = rank_tolerance_;
  work_.between = own_design_;
  work_.plain = work_.followed = work_.direct = work_.rate = work_.slope =
      theta_;  // of their size already, so that later designs ask for no memory
}

// The solution from the study's guesses is kept to the last bit where it is the continued one.
Status Assembly::keep_branch(const Status& plain, const std::vector<double>& parameters,
                             Equations<double>* equations) {
  if (cancelled()) return plain;
  work_.plain = theta_;
  work_.rate = theta_rate_;
  const LoopMiss miss = worst_miss_;
  const double rank_tolerance = rank_tolerance_;
  const bool all_rows_count = all_rows_count_, reached = follow(parameters, equations);
  theta_rate_ = work_.rate;
  const bool same = plain.ok() && is_same(work_.plain);
  if (reached && !same) {
    warn_of_branch("branch_continued",
                   "the guesses of the study lead to another position of the loop than its "
                   "position at the study's own values, continued to this design; the continued "
                   "position is used, so that the objective does not jump; to find it where this "
                   "design is simulated by itself",
                   theta_, work_.plain, parameters);
    return {};
  }
  theta_ = work_.plain;
  worst_miss_ = miss;
  rank_tolerance_ = rank_tolerance;
  all_rows_count_ = all_rows_count;
  if (!reached && plain.ok() && !cancelled())
    warn_of_branch("branch_lost",
                   "the position of the loop at the study's own values cannot be continued to this "
                   "design, since the loop cannot be closed or is in a singular position on the "
                   "way; the position found from the study's guesses is used, and the objective "
                   "may jump here; to stay near the position reached on the way",
                   work_.followed, theta_, parameters);
  return plain;
}

/// Continues the position at the study's own design along the straight line to `parameters`, which
/// `equations` must hold, with steps that are halved where Newton's method does not converge at
/// once. True if theta_ is the solution at `parameters`; else work_.followed is the last solution
/// on the way.
bool Assembly::follow(const std::vector<double>& parameters, Equations<double>* equations) {
  rank_tolerance_ = origin_.rank_tolerance;
  all_rows_count_ = !system_.sharing().drops();
  work_.followed = origin_.theta;
  bool is_held = true;  // whether `equations` hold the design at `parameters`
  const bool reached = walk(
      origin_.free, 1.0,
      [&](double part) -> const std::vector<double>& {
        work_.between = parameters;
        if (part < 1.0)
          for (std::size_t k = 0; k < own_design_.size(); ++k)
            work_.between[k] = own_design_[k] + part * (parameters[k] - own_design_[k]);
        if (part < 1.0 || !is_held) equations->set_design(work_.between);
        is_held = part == 1.0;
        return work_.between;
      },
      [] {}, equations);
  if (!is_held) equations->set_design(parameters);
  return reached;
}

/// Newton's method for the `free` coordinates, from theta_. True if it converges
/// with contracting steps from the first one on, as it does in the neighbourhood of a regular
/// solution only.
bool Assembly::converges_at_once(const std::vector<double>& parameters,
                                 const std::vector<int>& free, Equations<double>* equations) {
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostCorrections && !cancelled(); ++iteration) {
    const double error = find_errors(parameters, equations),
                 size = 1.0 + theta_.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return false;
    if (error == 0.0) return true;
    const Eigen::MatrixXd& step = newton_step(parameters, *equations, free, rank_tolerance_);
    const double turn = largest_turn(free, step),
                 change = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
    if (!(turn <= kFirstTurn)) return false;
    if (change <= kAtRest * size || change > kContraction * previous) return error < kClosed * size;
    for (std::size_t k = 0; k < free.size(); ++k) theta_[free[k]] -= step(to_signed(k), 0);
    previous = change;
  }
  return false;
}

/// The study's own start is tried again with small guesses for the joints along the loops that have
/// neither position nor guess.
Assembly::Closure Assembly::close_or_nudge(const std::vector<double>& parameters,
                                           Equations<double>* equations) {
  Closure plain = close_from_start(parameters, equations);
  if (plain == Closure::kApart || is_own_design(parameters))
    plain = nearest_to_guess(plain, parameters, equations);
  if (plain != Closure::kApart || !is_own_design(parameters) || origin_.nudge.size() > 0)
    return plain;
  constexpr double kNudge = 0.01;  // [rad], or this part of the loop's longest lever
  const VectorX<double> start = work_.start, apart = theta_;
  const LoopMiss miss = worst_miss_;
  theta_ = start;
  scale_loops(parameters, *equations);
  const Eigen::VectorXd columns = work_.loops.scales.columns;
  std::vector<int> open;
  for (int c : loops_.coordinates())
    if (const auto k = to_index(c); !position_given_[k] && !guess_given_[k] && !follows_[k])
      open.push_back(c);
  // All joints in one direction, every other one in the opposite direction, every other pair.
  for (unsigned period = 0; period < 3 && !open.empty() && !cancelled(); ++period) {
    VectorX<double> nudge = VectorX<double>::Zero(tree_.size);
    for (std::size_t k = 0; k < open.size(); ++k)
      nudge[open[k]] = kNudge * columns[open[k]] * ((k * period / 2) % 2 == 0 ? 1.0 : -1.0);
    theta_ = start + nudge;
    follow_couplings(*equations);
    const Closure closure = close_from_start(parameters, equations);
    if (closure == Closure::kApart) continue;
    warnings_.push_back(
        {"guessed_start",
         "loop or coupling '" + std::string(miss.owner) +
             "' cannot be closed from the start values, where its joints may be stretched " +
             "out in a line: small guesses were tried, and in which direction it bends is "
             "arbitrary; to choose it, write initial_state: {" +
             guesses_for(nudge, open) + "}, with other signs for another direction",
         {}});
    origin_.nudge = nudge;
    return closure;
  }
  theta_ = apart;
  worst_miss_ = miss;
  return plain;
}

/// Guesses for a study's initial_state, of joints with one coordinate: a: {guess: 0.1}, b: {guess:
/// 0.2}.
std::string Assembly::guesses_for(const VectorX<double>& theta,
                                  const std::vector<int>& coordinates) const {
  std::string text;
  for (int j : tree_.joint_order) {
    const JointDescription& joint = system_.robot().joints[to_index(j)];
    const int c = tree_.offset[to_index(j)];
    if (joint.has_one_coordinate() &&
        std::find(coordinates.begin(), coordinates.end(), c) != coordinates.end())
      text += (text.empty() ? "" : ", ") + joint.name +
              ": {guess: " + to_decimal(to_four_digits(theta[c])) + "}";
  }
  return text;
}

/// Warns of a start at a design whose position is not the one that the study leads to. @param
/// message what was done, and why to write guesses. @param theta the guesses. @param other the
/// coordinates that these are to replace.
void Assembly::warn_of_branch(const char* code, const std::string& message,
                              const VectorX<double>& theta, const VectorX<double>& other,
                              const std::vector<double>& parameters) {
  const double most = (theta - other).cwiseAbs().maxCoeff();
  std::vector<int> moved;
  std::string loop;
  for (int c : origin_.free) {
    if (follows_[to_index(c)] || !(std::abs(theta[c] - other[c]) >= 0.01 * most)) continue;
    moved.push_back(c);
    const SparseMatrix::InnerIterator entry(work_.loops.unscaled, c);
    if (loop.empty() && entry) loop = loops_.owner(static_cast<int>(entry.row()));
  }
  const std::vector<InitialJointState>& given = system_.study().initial_state;
  warnings_.push_back(
      warn(code, {given.empty() ? SourceLocation{system_.study().file, 1} : given.front().where,
                  "initial_state, loop '" + loop + "'",
                  message + ", write initial_state: {" + guesses_for(theta, moved) + "}",
                  design_text(system_.study(), parameters), ""}));
}

}  // namespace codesign
