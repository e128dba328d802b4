// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/assembly.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "dynamics/given_start.h"
#include "mechanism_codesign/math/directions.h"

namespace codesign {
namespace {

constexpr double kRankTolerance = 1e-9;
constexpr double kClosed = 1e-12;  // loop error that counts as closed, of a mechanism of size one
constexpr int kNewtonIterations = 200;
constexpr double kLargestTurn = 0.5;  // [rad or m] that one Newton step may move a coordinate: keeps to the branch of the start

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& matrix, const std::vector<int>& columns) {
  Eigen::MatrixXd result(matrix.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = matrix.col(columns[k]);
  return result;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  if (matrix.cols() == 0) return Eigen::MatrixXd(0, matrix.rows());
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod;
  cod.setThreshold(kRankTolerance);
  return cod.compute(matrix).pseudoInverse();
}

}  // namespace

Assembly::Assembly(const System& system) : system_(system), tree_(system.robot()), matrix_(system) {
  const Topology& topology = system.topology();
  for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
    if (!topology.pairs[k].is_loop) continue;
    for (int row = system.layout().pair_row[k]; row < system.layout().pair_end(static_cast<int>(k)); ++row) {
      loop_rows_.push_back(row);
      loop_row_name_.push_back(topology.pairs[k].name);
    }
  }
  const auto size = static_cast<std::size_t>(tree_.size);
  follows_.assign(size, false);
  for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
    loop_rows_.push_back(system.layout().coupling_row(static_cast<int>(k)));
    loop_row_name_.push_back(topology.couplings[k].name);
    followers_.push_back(tree_.offset[static_cast<std::size_t>(topology.couplings[k].terms.front().joint)]);
    follows_[static_cast<std::size_t>(followers_.back())] = true;
  }
  const GivenStart given(system, tree_);
  position_given_ = given.position;
  guess_given_ = given.guess;
  velocity_given_ = given.velocity;
  derivatives_.resize(system.patterns());
}

void Assembly::set_start(const std::vector<double>& parameters) {
  theta_.setZero(tree_.size);
  theta_rate_.setZero(tree_.size);
  for (const InitialJointState& initial : system_.study().initial_state) {
    const int joint = tree_joint(system_.robot(), initial);
    if (joint >= 0 && initial.guess) theta_[tree_.offset[static_cast<std::size_t>(joint)]] = *initial.guess;
  }
  set_given_start(system_, tree_, parameters, &theta_, &theta_rate_);
}

// Followers of followers come right after as many passes as there are couplings.
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

// Positions are continued from the tree's: a start of several turns counts.
void Assembly::set_turns(Equations<double>* equations) const {
  for (std::size_t p = 0; p < system_.topology().pairs.size(); ++p) {
    const Pair& pair = system_.topology().pairs[p];
    for (std::size_t e = 0; e < pair.chain.size(); ++e) {
      const JointDescription& joint = system_.robot().joints[static_cast<std::size_t>(pair.chain[e].joint)];
      equations->turn_references()[p][e] = joint.is_loop ? 0.0 : theta_[tree_.offset[static_cast<std::size_t>(pair.chain[e].joint)]];
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
  set_turns(equations);
  body_coordinates(system_, equations->constants(), link_motions(system_.robot(), tree_, parameters, theta_, theta_rate_), &state->q,
                   &state->v);
}

Eigen::VectorXd Assembly::loop_part(const VectorX<double>& rows) const {
  Eigen::VectorXd part(static_cast<Eigen::Index>(loop_rows_.size()));
  for (std::size_t k = 0; k < loop_rows_.size(); ++k) part[static_cast<Eigen::Index>(k)] = rows[loop_rows_[k]];
  return part;
}

// Columns of Phi_q q_theta: each coordinate's unit rate gives body velocities, whose constraint rates are the column.
Eigen::MatrixXd Assembly::loop_jacobian(const std::vector<double>& parameters, Equations<double>* equations) {
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(loop_rows_.size()), tree_.size);
  VectorX<double> q, v, errors, rates;
  for (int c = 0; c < tree_.size; ++c) {
    const VectorX<double> unit = VectorX<double>::Unit(tree_.size, c);
    body_coordinates(system_, equations->constants(), link_motions(system_.robot(), tree_, parameters, theta_, unit), &q, &v);
    equations->constraint_errors(q, v, &errors, &rates);
    jacobian.col(c) = loop_part(rates);
  }
  return jacobian;
}

Assembly::Dependents Assembly::choose(const Eigen::MatrixXd& jacobian, const std::vector<std::vector<int>>& preferences) const {
  Dependents chosen;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> whole;
  whole.setThreshold(kRankTolerance);
  const Eigen::Index rank = jacobian.size() == 0 ? 0 : whole.compute(jacobian).rank();
  for (const std::vector<int>& candidates : preferences) {
    // What the columns chosen so far do not reach, the best of the next candidates must.
    const auto missing = rank - static_cast<Eigen::Index>(chosen.columns.size());
    if (missing <= 0 || candidates.empty()) continue;
    const Eigen::MatrixXd taken = columns_of(jacobian, chosen.columns);
    Eigen::MatrixXd rest = columns_of(jacobian, candidates);
    if (taken.cols() > 0) rest -= taken * (pseudo_inverse(taken) * rest);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(kRankTolerance);
    qr.compute(rest);
    const Eigen::Index take = std::min(missing, qr.rank());
    for (Eigen::Index k = 0; k < take; ++k)
      chosen.columns.push_back(candidates[static_cast<std::size_t>(qr.colsPermutation().indices()[k])]);
  }
  std::sort(chosen.columns.begin(), chosen.columns.end());
  chosen.inverse = pseudo_inverse(columns_of(jacobian, chosen.columns));
  return chosen;
}

bool Assembly::newton(const std::vector<double>& parameters, Equations<double>* equations, const std::vector<int>& free) {
  State<double> state;
  state.resize(system_.layout());
  VectorX<double> errors, rates;
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kNewtonIterations; ++iteration) {
    place(parameters, equations, &state);
    equations->constraint_errors(state.q, state.v, &errors, &rates);
    const Eigen::VectorXd loops = loop_part(errors);
    const double error = loops.size() == 0 ? 0.0 : loops.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return false;
    // Converged when rounding stops the quadratic decrease.
    const double closed = kClosed * (1.0 + theta_.cwiseAbs().maxCoeff());
    if (error == 0.0 || (error < closed && error >= 0.5 * previous)) return true;
    previous = error;
    note_worst_loop(loops);
    Eigen::VectorXd step = pseudo_inverse(columns_of(loop_jacobian(parameters, equations), free)) * loops;
    double largest = 0.0;  // but for what only follows: a coupling is linear and has no branches
    for (std::size_t k = 0; k < free.size(); ++k)
      if (!follows_[static_cast<std::size_t>(free[k])]) largest = std::max(largest, std::abs(step[static_cast<Eigen::Index>(k)]));
    if (largest > kLargestTurn) step *= kLargestTurn / largest;
    for (std::size_t k = 0; k < free.size(); ++k) theta_[free[k]] -= step[static_cast<Eigen::Index>(k)];
  }
  return previous < kClosed;
}

void Assembly::note_worst_loop(const Eigen::VectorXd& errors) {
  Eigen::Index worst = 0;
  if (errors.size() == 0) return;
  const double error = errors.cwiseAbs().maxCoeff(&worst);
  if (!worst_loop_.empty() && error >= nearest_miss_) return;
  nearest_miss_ = error;
  worst_loop_ = loop_row_name_[static_cast<std::size_t>(worst)];
}

Status Assembly::solve_positions(const std::vector<double>& parameters, Equations<double>* equations) {
  const std::vector<std::vector<int>> preferences = by_preference(position_given_);
  std::vector<int> open = preferences[0];
  open.insert(open.end(), preferences[1].begin(), preferences[1].end());
  std::sort(open.begin(), open.end());
  const VectorX<double> start = theta_;
  worst_loop_.clear();
  positions_ = choose(loop_jacobian(parameters, equations), preferences);
  if (!newton(parameters, equations, positions_.columns)) {
    // The start may be singular (a stretched-out linkage): let every open coordinate move.
    theta_ = start;
    if (!newton(parameters, equations, open))
      return {StatusCode::kAssemblyFailed, 0.0, "loop or coupling '" + worst_loop_ + "' cannot be closed from the given initial state"};
  }
  positions_ = choose(loop_jacobian(parameters, equations), preferences);
  worst_loop_.clear();
  return {};
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
  const Eigen::MatrixXd jacobian = loop_jacobian(parameters, equations);
  velocities_ = choose(jacobian, preferences);
  const Eigen::VectorXd rates = jacobian * theta_rate_;
  const Eigen::VectorXd step = velocities_.inverse * rates;
  for (std::size_t k = 0; k < velocities_.columns.size(); ++k) theta_rate_[velocities_.columns[k]] -= step[static_cast<Eigen::Index>(k)];
  const Eigen::VectorXd left = jacobian * theta_rate_;
  if (left.size() > 0 && !(left.cwiseAbs().maxCoeff() <= 1e-9 * (1.0 + theta_rate_.cwiseAbs().maxCoeff())))
    return {StatusCode::kInitialVelocityFailed, 0.0, "the given initial velocities contradict each other: the loops cannot follow them"};
  return {};
}

Status Assembly::solve(const std::vector<double>& parameters, Equations<double>* equations, State<double>* state) {
  state->resize(system_.layout());
  state->t = 0.0;
  set_start(parameters);
  follow_couplings(equations->constants());
  if (Status status = solve_positions(parameters, equations); !status.ok()) return status;
  if (Status status = solve_velocities(parameters, equations); !status.ok()) return status;
  place(parameters, equations, state);
  return solve_rates(equations, state);
}

Status Assembly::solve_rates(Equations<double>* equations, State<double>* state) {
  VectorX<double> G, step;
  double g = 0.0, previous = std::numeric_limits<double>::infinity();
  // Rounding of the redundant rows, divided by their compliance, is left in the reactions that these rows leave open.
  const double converged = system_.compliance() == 0.0 ? 1e-11 : 1e-7;
  for (int iteration = 0; iteration < 100; ++iteration) {
    equations->residual(*state, &G, &g);
    const double error = G.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return {StatusCode::kNonFinite, state->t, "the equations of motion are not finite at the start"};
    equations->linearize(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0))
      return {StatusCode::kSingularMatrix, state->t, "the augmented matrix of the equations of motion is singular"};
    step = G;
    matrix_.lu().solve(step.data());
    const double size = step.cwiseAbs().maxCoeff() / (1.0 + state->z.cwiseAbs().maxCoeff());
    state->z -= step;
    if (size < 1e-15 || (size < converged && size >= 0.5 * previous)) return {};
    previous = size;
  }
  return {StatusCode::kInitialReactionsFailed, state->t,
          "no accelerations and reactions satisfy the equations of motion with friction at the start"};
}

template <class T>
void Assembly::correct(const Dependents& dependents, const VectorX<T>& rows, VectorX<T>* coordinates) const {
  const Eigen::MatrixXd all = directions_of(rows);
  Eigen::MatrixXd loops(static_cast<Eigen::Index>(loop_rows_.size()), all.cols());
  for (std::size_t k = 0; k < loop_rows_.size(); ++k) loops.row(static_cast<Eigen::Index>(k)) = all.row(loop_rows_[k]);
  const Eigen::MatrixXd step = dependents.inverse * loops;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(coordinates->size(), all.cols());
  for (std::size_t k = 0; k < dependents.columns.size(); ++k) full.row(dependents.columns[k]) = -step.row(static_cast<Eigen::Index>(k));
  add_directions(full, coordinates);
}

template <class T>
void Assembly::extend(const std::vector<T>& parameters, const State<double>& start, Equations<T>* equations, State<T>* state) const {
  state->resize(system_.layout());
  state->t = start.t;
  VectorX<T> theta = theta_.template cast<T>(), rate = theta_rate_.template cast<T>(), Phi, Phi_rate;
  set_given_start(system_, tree_, parameters, &theta, &rate);
  const auto place_extended = [&] {
    body_coordinates(system_, equations->constants(), link_motions(system_.robot(), tree_, parameters, theta, rate), &state->q, &state->v);
    equations->constraint_errors(state->q, state->v, &Phi, &Phi_rate);
  };
  place_extended();
  correct(positions_, Phi, &theta);
  place_extended();
  correct(velocities_, Phi_rate, &rate);
  place_extended();
  // G(z) = 0 to first order: the matrix is that of the last Newton iteration of solve_rates().
  VectorX<T> G;
  T g(0.0);
  state->z = start.z.template cast<T>();
  equations->residual(*state, &G, &g);
  Eigen::MatrixXd step = directions_of(G);
  for (Eigen::Index k = 0; k < step.cols(); ++k) matrix_.lu().solve(step.col(k).data());
  add_directions(Eigen::MatrixXd(-step), &state->z);
}

#define CODESIGN_INSTANTIATE(T) \
  template void Assembly::extend<T>(const std::vector<T>&, const State<double>&, Equations<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
