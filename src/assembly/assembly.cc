// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/given_start.h"
#include "equations/derivative_products.h"
#include "math/directions.h"

namespace codesign {
namespace {

// Relative rank tolerances of the scaled Jacobian of the loops. Parts below kRank come from rounded angles and lengths or from an almost
// singular position and are ignored; if the loops do not close without them, kSingularRank is tried.
constexpr double kRank = 1e-3, kSingularRank = 1e-9;
constexpr double kClosed = 1e-12;    // a loop error below this times the mechanism's size counts as closed
constexpr double kAtRest = 1e-13;    // a Newton step [rad or m] below this times the mechanism's size counts as zero
constexpr double kSamePlace = 0.05;  // [rad or m] two positions that differ by less are taken as the same
constexpr int kNewtonIterations = 200;
constexpr double kLargestTurn =
    0.5;  // [rad or m] limit of one Newton step per coordinate, so that the solution stays on the start's branch

double size_of(const LoopMiss& miss) { return std::max(miss.length, miss.angle); }

}  // namespace

Assembly::Assembly(const CompiledSystem& system)
    : system_(system),
      tree_(system.robot()),
      loops_(system, tree_),
      rank_tolerance_(kRank),
      singular_start_(system, tree_, loops_),
      matrix_(system) {
  const Topology& topology = system.topology();
  for (int row : loops_.constraint_rows())
    drops_.push_back(std::binary_search(system.sharing().dropped.begin(), system.sharing().dropped.end(), row));
  const auto size = static_cast<std::size_t>(tree_.size);
  follows_.assign(size, false);
  for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
    followers_.push_back(tree_.offset[static_cast<std::size_t>(topology.couplings[k].terms.front().joint)]);
    follows_[static_cast<std::size_t>(followers_.back())] = true;
  }
  const GivenStart given(system, tree_);
  position_given_ = given.position;
  guess_given_ = given.guess;
  velocity_given_ = given.velocity;
  derivatives_.resize(system.patterns());
}

void Assembly::begin_at(double time, const VectorX<double>& theta) {
  start_time_ = time;
  guess_ = theta;
}

void Assembly::set_start(const std::vector<double>& parameters) {
  matrix_.forget();
  theta_.setZero(tree_.size);
  theta_rate_.setZero(tree_.size);
  for (const InitialJointState& initial : system_.study().initial_state) {
    const int joint = tree_joint(system_.robot(), initial);
    if (joint >= 0 && initial.guess) theta_[tree_.offset[static_cast<std::size_t>(joint)]] = *initial.guess;
  }
  if (guess_.size() > 0) theta_ = guess_;
  set_given_start(system_, tree_, parameters, &theta_, &theta_rate_);
}

// A follower may itself lead another coupling: after as many passes as there are couplings every chain of followers is consistent.
void Assembly::follow_couplings(const Constants<double>& constants) {
  const std::vector<Coupling>& couplings = system_.topology().couplings;
  for (std::size_t pass = 0; pass < couplings.size(); ++pass) {
    for (std::size_t k = 0; k < couplings.size(); ++k) {
      double position = constants.couplings[k].offset, rate = 0.0;
      for (std::size_t t = 1; t < couplings[k].terms.size(); ++t) {
        const int c = tree_.offset[static_cast<std::size_t>(couplings[k].terms[t].joint)];
        position -= constants.couplings[k].coefficients[t] * theta_[c];
        rate -= constants.couplings[k].coefficients[t] * theta_rate_[c];
      }
      const auto follower = static_cast<std::size_t>(followers_[k]);
      if (!position_given_[follower] && !guess_given_[follower]) theta_[followers_[k]] = position;
      if (!velocity_given_[follower]) theta_rate_[followers_[k]] = rate;
    }
  }
}

std::vector<std::vector<int>> Assembly::by_preference(const std::vector<bool>& given) const {
  std::vector<std::vector<int>> lists(2);
  for (int c = 0; c < tree_.size; ++c)
    if (const auto k = static_cast<std::size_t>(c); !given[k]) lists[follows_[k] ? 0 : 1].push_back(c);
  return lists;
}

void Assembly::place(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) const {
  set_turns(system_, tree_, theta_, state);
  body_coordinates(system_, equations->constants(), link_motions(system_.robot(), tree_, parameters, theta_, theta_rate_), &state->q,
                   &state->v);
}

Eigen::VectorXd Assembly::loop_part(const VectorX<double>& rows) const {
  Eigen::VectorXd part = loops_.part_of(rows);
  for (std::size_t k = 0; k < drops_.size(); ++k)
    if (drops_[k] && !all_rows_count_) part[static_cast<Eigen::Index>(k)] = 0.0;
  return part;
}

Assembly::ScaledLoops Assembly::scaled_loops(const std::vector<double>& parameters, const Equations<double>& equations) const {
  ScaledLoops loops;
  loops.unscaled = loops_.evaluate(parameters, theta_, equations);
  loops.scales = loops_.scales(loops.unscaled, equations);
  for (std::size_t k = 0; k < drops_.size(); ++k)
    if (drops_[k] && !all_rows_count_) loops.scales.rows[static_cast<Eigen::Index>(k)] = 0.0;
  loops.matrix = loops.scales.rows.asDiagonal() * loops.unscaled * loops.scales.columns.asDiagonal();
  return loops;
}

Assembly::Dependents Assembly::factor(const ScaledLoops& loops, const std::vector<int>& columns, double rank_tolerance) {
  Dependents dependents;
  dependents.columns = columns;
  dependents.scales = loops.scales;
  dependents.inverse.factor(columns_of(loops.matrix, columns), rank_tolerance);
  return dependents;
}

Assembly::Dependents Assembly::choose(const ScaledLoops& loops, const std::vector<std::vector<int>>& preferences) const {
  return factor(loops, independent_columns(loops.matrix, preferences, rank_tolerance_), rank_tolerance_);
}

Eigen::MatrixXd Assembly::Dependents::solve(const Eigen::MatrixXd& rows) const {
  Eigen::MatrixXd x = inverse.solve(scales.rows.asDiagonal() * rows);
  for (std::size_t k = 0; k < columns.size(); ++k) x.row(static_cast<Eigen::Index>(k)) *= scales.columns[columns[k]];
  return x;
}

Assembly::Rest Assembly::newton(const std::vector<double>& parameters, Equations<double>* equations, const std::vector<int>& free,
                                double rank_tolerance) {
  State<double> state;
  state.resize(system_.layout());
  VectorX<double> errors, rates;
  double previous = std::numeric_limits<double>::infinity(), closed = kClosed;
  LoopMiss nearest{"", previous, previous};
  for (int iteration = 0; iteration < kNewtonIterations; ++iteration) {
    if (cancelled()) return Rest::kApart;
    place(parameters, equations, &state);
    equations->constraint_errors(state, &errors, &rates);
    const Eigen::VectorXd loops = loop_part(errors);
    const double error = loops.size() == 0 ? 0.0 : loops.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return Rest::kApart;
    note_miss(errors, *equations);
    if (size_of(worst_miss_) < size_of(nearest)) nearest = worst_miss_;
    // Converged when rounding stops the quadratic decrease.
    const double size = 1.0 + theta_.cwiseAbs().maxCoeff();
    closed = kClosed * size;
    if (error == 0.0 || (error < closed && error >= 0.5 * previous)) return Rest::kClosed;
    previous = error;
    const Eigen::VectorXd step = factor(scaled_loops(parameters, *equations), free, rank_tolerance).solve(loops);
    double largest = 0.0;  // without followers of couplings: a coupling is linear and has no branches
    for (std::size_t k = 0; k < free.size(); ++k)
      if (!follows_[static_cast<std::size_t>(free[k])]) largest = std::max(largest, std::abs(step[static_cast<Eigen::Index>(k)]));
    const double shortened = largest > kLargestTurn ? kLargestTurn / largest : 1.0;
    for (std::size_t k = 0; k < free.size(); ++k) theta_[free[k]] -= shortened * step[static_cast<Eigen::Index>(k)];
    if (step.size() == 0 || (error >= closed && step.cwiseAbs().maxCoeff() < kAtRest * size)) break;
  }
  if (previous < closed) return Rest::kClosed;
  if (is_near()) return Rest::kNear;
  worst_miss_ = nearest;
  return Rest::kApart;
}

bool Assembly::is_near() const {
  const double tolerance = system_.study().solver.closure_tolerance;
  return worst_miss_.length <= tolerance && worst_miss_.angle <= tolerance;
}

void Assembly::note_miss(const VectorX<double>& errors, const Equations<double>& equations) {
  worst_miss_ = {};
  for (const LoopMiss& miss : loops_.misses(errors, equations))
    if (size_of(miss) > size_of(worst_miss_)) worst_miss_ = miss;
}

// If changing the dependent coordinates alone does not close the loops, the start may be singular (a stretched-out linkage): then all
// coordinates without a given position are changed.
Assembly::Rest Assembly::close(const std::vector<double>& parameters, Equations<double>* equations, double rank_tolerance) {
  const std::vector<std::vector<int>> preferences = by_preference(position_given_);
  std::vector<int> open = preferences[0];
  open.insert(open.end(), preferences[1].begin(), preferences[1].end());
  std::sort(open.begin(), open.end());
  const VectorX<double> start = theta_;
  rank_tolerance_ = rank_tolerance;
  const Rest rest = newton(parameters, equations, choose(scaled_loops(parameters, *equations), preferences).columns, rank_tolerance);
  if (rest != Rest::kApart) return rest;
  const LoopMiss miss = worst_miss_;
  theta_ = start;
  const Rest second = newton(parameters, equations, open, rank_tolerance);
  if (second == Rest::kApart && size_of(miss) < size_of(worst_miss_)) worst_miss_ = miss;
  return second;
}

// A position within the tolerance but not closed may be almost singular, with an exactly closed position nearby: it is taken if found.
void Assembly::refine(const std::vector<double>& parameters, Equations<double>* equations) {
  const VectorX<double> near = theta_;
  const LoopMiss miss = worst_miss_;
  const bool closes = close(parameters, equations, kSingularRank) == Rest::kClosed;
  if (closes && (theta_ - near).cwiseAbs().maxCoeff() < kSamePlace) return;
  theta_ = near;
  worst_miss_ = miss;
  rank_tolerance_ = kRank;
}

Status Assembly::closure_failed() const {
  if (cancelled()) return {StatusCode::kCancelled, 0.0, "cancelled"};
  return {StatusCode::kAssemblyFailed, 0.0, "loop or coupling '" + worst_miss_.owner + "' cannot be closed from the given initial state"};
}

Status Assembly::solve_positions(const std::vector<double>& parameters, Equations<double>* equations) {
  const VectorX<double> start = theta_;
  all_rows_count_ = true;
  Rest rest = close(parameters, equations, kRank);
  if (rest == Rest::kNear) refine(parameters, equations);
  if (rest == Rest::kApart) {
    const LoopMiss miss = worst_miss_;
    theta_ = start;
    rest = close(parameters, equations, kSingularRank);
    if (rest == Rest::kApart && size_of(miss) < size_of(worst_miss_)) worst_miss_ = miss;
  }
  if (rest == Rest::kApart) return closure_failed();
  all_rows_count_ = !system_.sharing().drops();
  if (all_rows_count_) return {};
  // Now the enforced rows alone, to rounding: the integrators start from Phi = 0 in these rows.
  const LoopMiss miss = worst_miss_;
  const std::vector<int> columns = choose(scaled_loops(parameters, *equations), by_preference(position_given_)).columns;
  if (newton(parameters, equations, columns, rank_tolerance_) != Rest::kClosed || !is_near()) {
    worst_miss_ = miss;
    return closure_failed();
  }
  return {};
}

Status Assembly::solve_positions(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) {
  warnings_.clear();
  contradicting_.clear();
  state->resize(system_.layout());
  state->t = start_time_;
  set_extra_states(system_, parameters, &state->s);
  set_start(parameters);
  follow_couplings(equations->constants());
  Status status = solve_positions(parameters, equations);
  if (status.ok()) place(parameters, equations, state);
  return status;
}

Status Assembly::solve_velocities(const std::vector<double>& parameters, Equations<double>* equations) {
  std::vector<int> held;
  std::vector<bool> not_open = velocity_given_;
  for (int c = 0; c < tree_.size; ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (!position_given_[k] || velocity_given_[k]) continue;
    held.push_back(c);
    not_open[k] = true;
  }
  std::vector<std::vector<int>> preferences = by_preference(not_open);
  preferences.push_back(held);
  const ScaledLoops loops = scaled_loops(parameters, *equations);
  positions_ = choose(loops, by_preference(position_given_));
  velocities_ = choose(loops, preferences);
  Eigen::VectorXd holds = Eigen::VectorXd::Ones(loops_.rows());
  for (std::size_t k = 0; k < drops_.size(); ++k)
    if (drops_[k]) holds[static_cast<Eigen::Index>(k)] = 0.0;
  const SparseMatrix jacobian = holds.asDiagonal() * loops.unscaled;
  const Eigen::VectorXd step = velocities_.solve(jacobian * theta_rate_);
  for (std::size_t k = 0; k < velocities_.columns.size(); ++k) theta_rate_[velocities_.columns[k]] -= step[static_cast<Eigen::Index>(k)];
  const Eigen::VectorXd left = jacobian * theta_rate_;
  if (left.size() > 0 && !(left.cwiseAbs().maxCoeff() <= 1e-9 * (1.0 + theta_rate_.cwiseAbs().maxCoeff())))
    return contradiction(jacobian, left);
  return {};
}

Status Assembly::solve_velocities(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) {
  if (Status status = solve_velocities(parameters, equations); !status.ok()) return status;
  const Status branch = choose_branch(parameters, equations);
  place(parameters, equations, state);
  return branch;
}

Status Assembly::solve_motion(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) {
  const Status status = solve_positions(parameters, equations, state);
  return status.ok() ? solve_velocities(parameters, equations, state) : status;
}

Status Assembly::solve(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) {
  if (Status status = solve_motion(parameters, equations, state); !status.ok()) return status;
  if (system_.begins_controllers()) equations->formulas().begin_controllers(state);
  if (Status status = solve_rates(equations, state); !status.ok()) return status;
  return check_rest(*state);
}

Status Assembly::solve_rates(Equations<double>* equations, State<double>* state) {
  const char* const place = state->t > 0.0 ? "" : " at the start";
  double g = 0.0, previous = std::numeric_limits<double>::infinity();
  // With redundant rows, rounding errors divided by the compliance remain in the reactions that are not unique.
  const double converged = system_.compliance() == 0.0 ? 1e-11 : 1e-7;
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (cancelled()) return {StatusCode::kCancelled, state->t, "cancelled"};
    equations->residual(*state, &residual_, &g);
    const double error = residual_.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return {StatusCode::kNonFinite, state->t, std::string("the equations of motion are not finite") + place};
    equations->linearize(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0))
      return {StatusCode::kSingularMatrix, state->t, "the augmented matrix of the equations of motion is singular"};
    matrix_.lu().solve(residual_);
    const double size = residual_.cwiseAbs().maxCoeff() / (1.0 + state->z.cwiseAbs().maxCoeff());
    state->z -= residual_;
    if (size < 1e-15 || (size < converged && size >= 0.5 * previous)) return {};
    previous = size;
  }
  return {StatusCode::kInitialReactionsFailed, state->t,
          std::string("no accelerations and reactions satisfy the equations of motion with friction") + place};
}

void Assembly::differentiate_rates(State<double>* rates) const {
  VectorX<double> change;
  rates->z.setZero(system_.layout().columns());
  directional_derivative(system_, derivatives_, *rates, &change);
  rates->z = -(change + derivatives_.time).head(rates->z.size());
  matrix_.lu().solve(rates->z);
}

template <class T>
void Assembly::correct(const Dependents& dependents, const VectorX<T>& rows, VectorX<T>* coordinates) const {
  const Eigen::MatrixXd step = dependents.solve(loops_.part_of(directions_of(rows)));
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(coordinates->size(), step.cols());
  for (std::size_t k = 0; k < dependents.columns.size(); ++k) full.row(dependents.columns[k]) = -step.row(static_cast<Eigen::Index>(k));
  add_directions(full, coordinates);
}

template <class T>
void Assembly::extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations, State<T>* state) const {
  state->resize(system_.layout());
  state->t = start.t;
  state->turns = start.turns;
  set_extra_states(system_, parameters, &state->s);
  VectorX<T> theta = theta_.template cast<T>(), rate = theta_rate_.template cast<T>(), Phi, Phi_rate;
  set_given_start(system_, tree_, parameters, &theta, &rate);
  const auto place_extended = [&] {
    body_coordinates(system_, equations->constants(), link_motions(system_.robot(), tree_, parameters, theta, rate), &state->q, &state->v);
    equations->constraint_errors(*state, &Phi, &Phi_rate);
  };
  place_extended();
  correct(positions_, Phi, &theta);
  place_extended();
  correct(velocities_, Phi_rate, &rate);
  place_extended();
  if (system_.begins_controllers()) equations->formulas().begin_controllers(state);
  extend_rates(start.z, equations, state);
}

// First-order solution of G(z) = 0 with the factorization of the last Newton iteration of solve_rates().
template <class T>
void Assembly::extend_rates(const VectorX<double>& z, Equations<T>* equations, State<T>* state) const {
  VectorX<T> G;
  T g(0.0);
  state->z = z.template cast<T>();
  equations->residual(*state, &G, &g);
  Eigen::MatrixXd step = directions_of(G);
  for (auto column : step.colwise()) matrix_.lu().solve(column);
  add_directions(Eigen::MatrixXd(-step), &state->z);
}

#define CODESIGN_INSTANTIATE(T)                                                                                   \
  template void Assembly::extend<T>(const std::vector<T>&, const State<double>&, Equations<T>*, State<T>*) const; \
  template void Assembly::extend_rates<T>(const VectorX<double>&, Equations<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
