// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "equations/iteration_matrix.h"
#include "equations/mass_solution.h"
#include "math/arrays.h"
#include "mechanism/constants.h"

namespace codesign {
namespace {

// [rad or m] two positions that differ by less are taken as the same.
constexpr double kSamePlace = 0.05;
constexpr int kNewtonIterations = 200;
constexpr double kLargestTurn = 0.5;  // [rad or m] limit of one Newton step per coordinate, so that
                                      // the solution stays on the start's branch

double size_of(const LoopMiss& miss) { return std::max(miss.length, miss.angle); }

}  // namespace

Assembly::Assembly(const CompiledSystem& system)
    : system_(system),
      tree_(system.robot()),
      loops_(system, tree_),
      rank_tolerance_(kRank),
      singular_start_(system, tree_, loops_),
      own_design_(system.parameters()),
      rates_(system) {
  const Topology& topology = system.topology();
  const std::vector<int>& dropped = system.dropped_rows();
  for (int row : loops_.constraint_rows())
    drops_.push_back(std::binary_search(dropped.begin(), dropped.end(), row));
  const auto size = to_index(tree_.size);
  follows_.assign(size, false);
  for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
    const CouplingTerm& first = topology.couplings[k].terms.front();
    const bool in_tree = !topology.pairs[to_index(first.pair)].is_loop;
    followers_.push_back(in_tree ? tree_.offset[to_index(first.joint)] : -1);
    if (in_tree) follows_[to_index(followers_.back())] = true;
  }
  const GivenStart given(system, &tree_);
  position_given_ = given.position;
  guess_given_ = given.guess;
  velocity_given_ = given.velocity;
  velocity_beside_ = given.velocity_beside;
}

void Assembly::begin_at(double time, const VectorX<double>& theta) {
  start_time_ = time;
  guess_ = theta;
}

void Assembly::set_start(const std::vector<double>& parameters) {
  rates_.reset_pivots();
  theta_.setZero(tree_.size);
  theta_rate_.setZero(tree_.size);
  for (const InitialJointState& initial : system_.study().initial_state) {
    const int joint = tree_joint(system_.robot(), initial);
    if (joint >= 0 && initial.guess) theta_[tree_.offset[to_index(joint)]] = *initial.guess;
  }
  if (guess_.size() > 0) theta_ = guess_;
  if (guess_.size() == 0 && origin_.nudge.size() > 0) theta_ += origin_.nudge;
  set_given_start(system_, tree_, parameters, posture_, &theta_, &theta_rate_);
}

ReferenceMotion<double> Assembly::given_motion(const Equations<double>& equations,
                                               const Coupling& coupling) const {
  if (coupling.motion < 0) return {};
  return equations.formulas().view().design.motion[to_index(coupling.motion)].at(time_);
}

// A follower may itself lead another coupling: after as many passes as there are couplings every
// chain of followers is consistent.
void Assembly::follow_couplings(const Equations<double>& equations) {
  const Constants<double>& constants = equations.constants();
  const std::vector<Coupling>& couplings = system_.topology().couplings;
  for (std::size_t pass = 0; pass < couplings.size(); ++pass) {
    for (std::size_t k = 0; k < couplings.size(); ++k) {
      if (followers_[k] < 0) continue;
      const ReferenceMotion<double> given = given_motion(equations, couplings[k]);
      double position = constants.couplings[k].offset + given.value, rate = given.rate;
      for (std::size_t t = 1; t < couplings[k].terms.size(); ++t) {
        const int c = tree_.offset[to_index(couplings[k].terms[t].joint)];
        position -= constants.couplings[k].coefficients[t] * theta_[c];
        rate -= constants.couplings[k].coefficients[t] * theta_rate_[c];
      }
      const auto follower = to_index(followers_[k]);
      if (!position_given_[follower] && !guess_given_[follower]) theta_[followers_[k]] = position;
      if (!velocity_given_[follower]) theta_rate_[followers_[k]] = rate;
    }
  }
}

void Assembly::by_preference(const std::vector<bool>& given, ColumnPreferences* lists) const {
  if (lists->size() < 2) lists->resize(2);
  for (std::vector<int>& list : *lists) list.clear();
  for (int c = 0; c < tree_.size; ++c)
    if (const auto k = to_index(c); !given[k]) (*lists)[follows_[k] ? 0 : 1].push_back(c);
}

void Assembly::place(const std::vector<double>& parameters, Equations<double>* equations,
                     State<double>* state) {
  set_turns(system_, tree_, theta_, state);
  link_motions(system_.robot(), tree_, parameters, theta_, theta_rate_, &work_.motion.links);
  state_coordinates(system_, tree_, equations->constants(), work_.motion.links, theta_, theta_rate_,
                    &state->q, &state->v);
  set_signs(system_, equations->constants(), work_.motion.links, state);
}

void Assembly::take_loop_rows() {
  loops_.take_part(work_.errors, &work_.rows);
  for (std::size_t k = 0; k < drops_.size(); ++k)
    if (drops_[k] && !all_rows_count_) work_.rows(to_signed(k), 0) = 0.0;
}

void Assembly::scale_loops(const std::vector<double>& parameters,
                           const Equations<double>& equations) {
  ScaledLoops& loops = work_.loops;
  loops_.evaluate(parameters, theta_, equations, &work_.motion, &loops.unscaled);
  loops_.scales(loops.unscaled, equations, &work_.motion, &loops.scales);
  for (std::size_t k = 0; k < drops_.size(); ++k)
    if (drops_[k] && !all_rows_count_) loops.scales.rows[to_signed(k)] = 0.0;
  loops.matrix = loops.unscaled;
  for (int c = 0; c < tree_.size; ++c)
    for (SparseMatrix::InnerIterator entry(loops.matrix, c); entry; ++entry)
      entry.valueRef() = loops.scales.rows[entry.row()] * entry.value() * loops.scales.columns[c];
}

void Assembly::factor(const std::vector<int>& columns, double rank_tolerance,
                      Dependents* dependents) const {
  dependents->columns = columns;
  dependents->scales = work_.loops.scales;
  dependents->inverse.factor(work_.loops.matrix, columns, rank_tolerance);
}

const std::vector<int>& Assembly::choose_columns(const ColumnPreferences& preferences) {
  return work_.independent.choose(work_.loops.matrix, preferences, rank_tolerance_);
}

void Assembly::choose(const ColumnPreferences& preferences, Dependents* dependents) {
  factor(choose_columns(preferences), rank_tolerance_, dependents);
}

const Eigen::MatrixXd& Assembly::Dependents::solve(const Eigen::MatrixXd& rows,
                                                   Eigen::MatrixXd* scaled,
                                                   LeastSquaresWorkspace* workspace) const {
  *scaled = scales.rows.asDiagonal() * rows;
  Eigen::MatrixXd& x = inverse.solve(*scaled, workspace);
  for (std::size_t k = 0; k < columns.size(); ++k)
    x.row(to_signed(k)) *= scales.columns[columns[k]];
  return x;
}

/// Sets work_.rows to the errors of the loops and couplings at theta_, and worst_miss_ from them.
/// @returns the largest error.
double Assembly::find_errors(const std::vector<double>& parameters, Equations<double>* equations) {
  work_.state.resize(system_.layout());
  work_.state.t = time_;
  place(parameters, equations, &work_.state);
  equations->constraint_errors(work_.state, &work_.errors, &work_.rates);
  take_loop_rows();
  const double error =
      work_.rows.size() == 0 ? 0.0 : work_.rows.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (std::isfinite(error)) note_miss(work_.errors, *equations);
  return error;
}

/// Newton's change of the `free` coordinates for work_.rows at theta_, to be subtracted; valid
/// until the next call.
const Eigen::MatrixXd& Assembly::newton_step(const std::vector<double>& parameters,
                                             const Equations<double>& equations,
                                             const std::vector<int>& free, double rank_tolerance) {
  scale_loops(parameters, equations);
  factor(free, rank_tolerance, &work_.newton);
  return work_.newton.solve(work_.rows, &work_.scaled, &work_.solution);
}

/// The largest change but those of followers of couplings: a coupling is linear and has no
/// branches.
double Assembly::largest_turn(const std::vector<int>& free, const Eigen::MatrixXd& step) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (!follows_[to_index(free[k])]) largest = std::max(largest, std::abs(step(to_signed(k), 0)));
  return largest;
}

Assembly::Closure Assembly::newton(const std::vector<double>& parameters,
                                   Equations<double>* equations, const std::vector<int>& free,
                                   double rank_tolerance) {
  double previous = std::numeric_limits<double>::infinity(), closed = kClosed;
  LoopMiss nearest{"", previous, previous};
  for (int iteration = 0; iteration < kNewtonIterations; ++iteration) {
    if (cancelled()) return Closure::kApart;
    const double error = find_errors(parameters, equations);
    if (!std::isfinite(error)) return Closure::kApart;
    if (size_of(worst_miss_) < size_of(nearest)) nearest = worst_miss_;
    // Converged when rounding stops the quadratic decrease.
    const double size = 1.0 + theta_.cwiseAbs().maxCoeff();
    closed = kClosed * size;
    if (error == 0.0 || (error < closed && error >= 0.5 * previous)) return Closure::kClosed;
    previous = error;
    const Eigen::MatrixXd& step = newton_step(parameters, *equations, free, rank_tolerance);
    const double largest = largest_turn(free, step),
                 shortened = largest > kLargestTurn ? kLargestTurn / largest : 1.0;
    for (std::size_t k = 0; k < free.size(); ++k)
      theta_[free[k]] -= shortened * step(to_signed(k), 0);
    if (step.size() == 0 || (error >= closed && step.cwiseAbs().maxCoeff() < kAtRest * size)) break;
  }
  if (previous < closed) return Closure::kClosed;
  if (is_near()) return Closure::kNear;
  worst_miss_ = nearest;
  return Closure::kApart;
}

bool Assembly::is_near() const {
  const double tolerance = system_.study().solver.closure_tolerance;
  return worst_miss_.length <= tolerance && worst_miss_.angle <= tolerance;
}

void Assembly::note_miss(const VectorX<double>& errors, const Equations<double>& equations) {
  worst_miss_ = {};
  for (std::size_t k = 0; k < loops_.owners(); ++k)
    if (const LoopMiss miss = loops_.miss(k, errors, equations);
        size_of(miss) > size_of(worst_miss_))
      worst_miss_ = miss;
}

// If changing the dependent coordinates alone does not close the loops, the start may be singular
// (a stretched-out linkage): then all coordinates without a given position are changed.
Assembly::Closure Assembly::close(const std::vector<double>& parameters,
                                  Equations<double>* equations, double rank_tolerance) {
  const ColumnPreferences& preferences = work_.positions;
  prefer_positions();
  work_.open.clear();
  for (const std::vector<int>& list : preferences)
    work_.open.insert(work_.open.end(), list.begin(), list.end());
  std::sort(work_.open.begin(), work_.open.end());
  work_.first = theta_;
  rank_tolerance_ = rank_tolerance;
  scale_loops(parameters, *equations);
  work_.free = choose_columns(preferences);
  const Closure closure = newton(parameters, equations, work_.free, rank_tolerance);
  work_.moved = work_.free;
  if (closure != Closure::kApart) return closure;
  const LoopMiss miss = worst_miss_;
  theta_ = work_.first;
  work_.moved = work_.open;
  const Closure second = newton(parameters, equations, work_.open, rank_tolerance);
  if (second == Closure::kApart && size_of(miss) < size_of(worst_miss_)) worst_miss_ = miss;
  return second;
}

// A position within the tolerance but not closed may be almost singular, with an exactly closed
// position nearby: it is taken if found.
void Assembly::refine(const std::vector<double>& parameters, Equations<double>* equations) {
  work_.near = theta_;
  const LoopMiss miss = worst_miss_;
  const bool closes = close(parameters, equations, kSingularRank) == Closure::kClosed;
  if (closes && (theta_ - work_.near).cwiseAbs().maxCoeff() < kSamePlace) return;
  theta_ = work_.near;
  worst_miss_ = miss;
  rank_tolerance_ = kRank;
}

Status Assembly::closure_failed() const {
  if (cancelled()) return {StatusCode::kCancelled, 0.0, "cancelled"};
  return {StatusCode::kAssemblyFailed, 0.0,
          "loop or coupling '" + std::string(worst_miss_.owner) +
              "' cannot be closed from the given initial state"};
}

Assembly::Closure Assembly::close_from_start(const std::vector<double>& parameters,
                                             Equations<double>* equations) {
  work_.start = theta_;
  Closure closure = close(parameters, equations, kRank);
  if (closure == Closure::kNear) refine(parameters, equations);
  if (closure != Closure::kApart) return closure;
  const LoopMiss miss = worst_miss_;
  theta_ = work_.start;
  closure = close(parameters, equations, kSingularRank);
  if (closure == Closure::kApart && size_of(miss) < size_of(worst_miss_)) worst_miss_ = miss;
  return closure;
}

Status Assembly::solve_positions(const std::vector<double>& parameters,
                                 Equations<double>* equations) {
  all_rows_count_ = true;
  if (close_or_nudge(parameters, equations) == Closure::kApart) return closure_failed();
  all_rows_count_ = !system_.sharing().drops();
  if (all_rows_count_) return {};
  // Now the enforced rows alone, to rounding: the integrators start from Phi = 0 in these rows.
  const LoopMiss miss = worst_miss_;
  prefer_positions();
  scale_loops(parameters, *equations);
  work_.free = choose_columns(work_.positions);
  if (newton(parameters, equations, work_.free, rank_tolerance_) != Closure::kClosed ||
      !is_near()) {
    worst_miss_ = miss;
    return closure_failed();
  }
  return {};
}

Status Assembly::solve_positions(const std::vector<double>& parameters,
                                 Equations<double>* equations, State<double>* state) {
  warnings_.clear();
  contradicting_.clear();
  posture_ = 0.0;
  state->resize(system_.layout());
  state->t = time_ = start_time_;
  set_extra_states(system_, parameters, &state->s);
  set_start(parameters);
  follow_couplings(*equations);
  Status status = solve_positions(parameters, equations);
  if (is_own_design(parameters)) {
    if (status.ok()) note_origin();
  } else if (origin_.is_known && guess_.size() == 0) {
    status = keep_branch(status, parameters, equations);
  }
  follow_gears();
  if (status.ok()) place(parameters, equations, state);
  return status;
}

Status Assembly::solve_motion(const std::vector<double>& parameters, Equations<double>* equations,
                              State<double>* state) {
  const Status status = solve_positions(parameters, equations, state);
  return status.ok() ? solve_velocities(parameters, equations, state) : status;
}

Status Assembly::solve(const std::vector<double>& parameters, Equations<double>* equations,
                       State<double>* state) {
  if (Status status = solve_motion(parameters, equations, state); !status.ok()) return status;
  equations->begin_states(state);
  const Status status = hold_stuck(equations, state);
  return status.ok() ? check_rest(*state) : status;
}

}  // namespace codesign
