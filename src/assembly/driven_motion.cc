// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/driven_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

constexpr int kMostIterations = 40;
constexpr double kRounding = 4e-15;  // a relative step below this is rounding
// A relative step below this that no longer shrinks is rounding, too.
constexpr double kConverged = 1e-11;
// The same for reactions of redundant rows, whose rounding is divided by a compliance of 1e-9.
constexpr double kSharedRounding = 1e-7;
// If a step is larger than this fraction of the previous one, the matrix is factorized again.
constexpr double kSlow = 0.05;
constexpr double kFar = 0.5;  // [rad] a larger turn of a body or joint might leave the branch
constexpr int kMostDivisions = 12;

/// Convergence of a Newton iteration by the sizes of its steps, relative to the unknowns.
class Convergence {
 public:
  explicit Convergence(double converged) : converged_(converged) {}
  /// Takes the next step; true if no further one is needed.
  bool done(double step) {
    slow_ = !(step < kSlow * previous_);
    const bool rounding = step < kRounding || (step < converged_ && step >= 0.5 * previous_);
    previous_ = step;
    return rounding;
  }
  bool slow() const { return slow_; }

 private:
  double converged_, previous_ = std::numeric_limits<double>::infinity();
  bool slow_ = false;
};

Status singular() {
  return {StatusCode::kSingularMatrix, 0.0,
          "the matrix of the equations of the driven motion is singular"};
}

Status not_closed() {
  return {StatusCode::kAssemblyFailed, 0.0,
          "the loops and couplings cannot follow the measured positions"};
}

}  // namespace

DrivenMotion::DrivenMotion(const DrivenSystem& driven)
    : system_(*driven.system),
      drives_(static_cast<int>(driven.drives.size())),
      equations_(system_),
      follower_(system_),
      matrix_(system_) {
  const Layout& layout = system_.layout();
  derivatives_.resize(system_.patterns());
  step_.setZero(layout.columns());
  turns_.setZero(layout.n);
  for (int body = 0; body < layout.bodies; ++body) note_turns(body);
  uncertain_.setOnes(layout.columns());
  const std::vector<Coupling>& couplings = system_.topology().couplings;
  for (int k = 0; k < drives_; ++k) {
    const CouplingTerm& at = couplings[couplings.size() - to_index(drives_ - k)].terms.front();
    turn_slots_.push_back(layout.turn(at.pair, at.element));
    columns_.push_back(layout.element_column(at.pair, at.element));
    if (columns_.back() >= 0) uncertain_[layout.lambda_column(system_.drive_row(k))] = 0.0;
  }
  all_given_ = layout.n == drives_ && layout.m == drives_ &&
               std::count(columns_.begin(), columns_.end(), -1) == 0;
}

// A small turn is twice the change of an Euler parameter.
void DrivenMotion::note_turns(int body) {
  const Layout& layout = system_.layout();
  const int c = layout.column(body);
  if (layout.is_free(body)) {
    turns_.segment<4>(c + 3).setConstant(2.0);
    return;
  }
  const auto pair = to_index(layout.forest.pair_above[to_index(body)]);
  int column = c;
  for (const ChainElement& element : system_.topology().pairs[pair].chain) {
    const JointFreedoms& freedoms = system_.robot().joints[to_index(element.joint)].freedoms();
    for (int k = 0; k < freedoms.size(); ++k)
      turns_[column++] = freedoms.each[to_index(k)].turns ? 1.0 : 0.0;
  }
}

void DrivenMotion::set_design(const std::vector<double>& parameters) {
  equations_.set_design(parameters);
}

void DrivenMotion::reset_pivots() {
  matrix_.reset_pivots();
  equations_.compiled().use_first_variant();
  is_factored_ = false;
}

void DrivenMotion::give(In<double> given, VectorX<double>* x) const {
  for (int k = 0; k < drives_; ++k)
    if (const int column = columns_[to_index(k)]; column >= 0) (*x)[column] = given[k];
}

// Where all coordinates are given, the solutions are those of the unit columns of the drives, the
// same at all states.
Status DrivenMotion::linearize(const State<double>& state) {
  if (all_given_ && is_factored_) return {};
  double g = 0.0;
  equations_.rates(state, &step_, &g, &derivatives_);
  is_factored_ = matrix_.factor(derivatives_, 0.0, 0.0, 0.0);
  return is_factored_ ? Status() : singular();
}

// Like the projection (17): the rows of G below the rows of the bodies are Phi_q times the unknown,
// so that one matrix serves positions, velocities and rates.
void DrivenMotion::find_correction(Part part, In<double> given, const State<double>& state) {
  const Layout& layout = system_.layout();
  equations_.constraint_errors(state, &Phi_, &Phi_rate_);
  VectorX<double>& errors = part == Part::kPositions ? Phi_ : Phi_rate_;
  for (int k = 0; k < drives_; ++k) errors[system_.drive_row(k)] -= given[k];
  step_.setZero();
  step_.segment(layout.n, layout.m) = errors;
  matrix_.lu().solve(step_);
}

Status DrivenMotion::solve_positions(In<double> given, State<double>* state) {
  const Layout& layout = system_.layout();
  for (int k = 0; k < drives_; ++k) state->turns[to_index(turn_slots_[to_index(k)])] = given[k];
  give(given, &state->q);
  Convergence convergence(kConverged);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    find_correction(Part::kPositions, given, *state);
    const double size = step_.head(layout.n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(size) ||
        step_.head(layout.n).cwiseProduct(turns_).cwiseAbs().maxCoeff() > kFar)
      return not_closed();
    state->q -= step_.head(layout.n);
    if (convergence.done(size / (1.0 + state->q.cwiseAbs().maxCoeff()))) return {};
    if (iteration > 0 && convergence.slow())
      if (Status status = linearize(*state); !status.ok()) return status;
  }
  return not_closed();
}

Status DrivenMotion::solve_velocities(In<double> given, State<double>* state) {
  const Layout& layout = system_.layout();
  give(given, &state->v);
  Convergence convergence(kConverged);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    find_correction(Part::kVelocities, given, *state);
    const double size = step_.head(layout.n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(size)) break;
    state->v -= step_.head(layout.n);
    if (convergence.done(size / (1.0 + state->v.cwiseAbs().maxCoeff()))) return {};
    if (iteration > 0 && convergence.slow())
      if (Status status = linearize(*state); !status.ok()) return status;
  }
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "the loops and couplings cannot follow the measured velocities"};
}

Status DrivenMotion::solve_rates(In<double> given, State<double>* state) {
  double g = 0.0;
  give(given, &state->z);
  Convergence convergence(system_.compliance() == 0.0 ? kConverged : kSharedRounding);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    equations_.residual(*state, &step_, &g);
    for (int k = 0; k < drives_; ++k)
      step_[system_.layout().lambda_column(system_.drive_row(k))] -= given[k];
    matrix_.lu().solve(step_);
    const double size = step_.cwiseProduct(uncertain_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(size))
      return {StatusCode::kNonFinite, 0.0, "the equations of the driven motion are not finite"};
    state->z -= step_;
    if (convergence.done(size / (1.0 + state->z.cwiseAbs().maxCoeff()))) return {};
    if (convergence.slow())
      if (Status status = linearize(*state); !status.ok()) return status;
  }
  return {StatusCode::kInitialReactionsFailed, 0.0,
          "no reactions satisfy the equations of the driven motion with friction"};
}

Status DrivenMotion::solve(const DriveMotion& given, State<double>* state) {
  if (Status status = linearize(*state); !status.ok()) return status;
  if (Status status = solve_positions(given.position, state); !status.ok()) return status;
  if (Status status = solve_velocities(given.velocity, state); !status.ok()) return status;
  return solve_rates(given.acceleration, state);
}

// After a failure the distance is halved; `state` then has the last position that was reached.
Status DrivenMotion::move_to(In<double> given, int depth, State<double>* state) {
  State<double> trial = *state;
  Status status = linearize(trial);
  if (status.ok()) status = solve_positions(given, &trial);
  if (status.ok()) {
    follower_.follow(*state, &equations_, &trial);
    for (std::size_t k = 0; k < turn_slots_.size(); ++k)
      trial.turns[to_index(turn_slots_[k])] = given[to_signed(k)];
    *state = trial;
    equations_.track_turns(state);
    return status;
  }
  if (depth == kMostDivisions) return status;
  std::vector<double> half(given.begin(), given.end());
  for (std::size_t k = 0; k < half.size(); ++k)
    half[k] = 0.5 * (half[k] + state->turns[to_index(turn_slots_[k])]);
  if (Status first = move_to(half, depth + 1, state); !first.ok()) return first;
  return move_to(given, depth + 1, state);
}

Status DrivenMotion::follow(const DriveMotion& given, State<double>* state) {
  if (Status status = move_to(given.position, 0, state); !status.ok()) return status;
  if (Status status = linearize(*state); !status.ok()) return status;
  if (Status status = solve_velocities(given.velocity, state); !status.ok()) return status;
  Status status = solve_rates(given.acceleration, state);
  if (status.code != StatusCode::kInitialReactionsFailed) return status;
  state->z.setZero();  // try again, beginning with the reactions without friction
  if (Status again = linearize(*state); !again.ok()) return again;
  return solve_rates(given.acceleration, state);
}

double DrivenMotion::fastest_follower(const State<double>& state) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (!linearize(state).ok()) return kAny;
  double fastest = 0.0;
  for (int drive = 0; drive < drives_; ++drive) {
    step_.setZero();
    step_[system_.layout().lambda_column(system_.drive_row(drive))] = 1.0;
    matrix_.lu().solve(step_);
    const double rate = step_.head(system_.layout().n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    fastest = std::isfinite(rate) ? std::max(fastest, rate) : kAny;
  }
  return fastest;
}

}  // namespace codesign
