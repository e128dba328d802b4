// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_derivatives.h"

#include <algorithm>
#include <utility>

#include "linear/linear_coordinates.h"
#include "linear/period_map.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

constexpr double kRankOfConstraints = 1e-8;  // as rounding leaves of rows that depend on each other
// Of the efforts that are disturbances: they are held outputs of sampled controllers, and so extra
// states, whose columns are those of an input. No instant of theirs ever comes.
constexpr double kHeldForEver = 1.0;  // [s]

/// The rows of (14) of one of the recorded matrices, without that of the integrand.
Eigen::MatrixXcd dense(const Sparsity& pattern, const std::vector<Complex>& values, int rows) {
  Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(rows, pattern.columns);
  for (int row = 0; row < rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      matrix(row, pattern.column(e)) += values[to_index(e)];
  return matrix;
}

VectorX<Complex> stepped(const VectorX<double>& value, const Eigen::VectorXd& change) {
  VectorX<Complex> result = value.cast<Complex>();
  result.imag() = LinearDerivatives::kStep * change;
  return result;
}

}  // namespace

LinearStudy LinearDerivatives::study_of(const LinearCase& of) {
  LinearStudy study = with_inputs(bare_study(of), of.parameters, 0.0, true);
  pattern_ = sample_pattern(study.study);
  for (std::size_t c = controllers_; c < study.study.controllers.size(); ++c)
    study.study.controllers[c].realization.sample_time = kHeldForEver;
  return study;
}

LinearDerivatives::LinearDerivatives(const LinearCase& of)
    : controllers_(of.system->study().controllers.size()),
      study_(study_of(of)),
      system_(without_friction(of.system->robot()), study_.study, of.system->sharing()),
      motion_(system_, study_),
      rest_(system_, study_),
      laws_(system_, study_),
      equations_(system_) {
  equations_.compiled().allow(false);
  derivatives_.resize(system_.patterns());
}

LinearDerivatives::~LinearDerivatives() = default;

Status LinearDerivatives::take(const std::vector<double>& design, const State<double>& state,
                               const std::vector<double>& integrals) {
  design_ = design;
  space_.reset();
  motion_.set_design(study_.parameters_at(design));
  if (Status status = motion_.linearize_at_rest(state, integrals); !status.ok()) return status;
  changes_ = rest_.at(motion_.state(), design);
  keep_states();
  return {};
}

/// Q with its derivative: Phi_q Q = 0 with unit rows of y. @param rows Phi_q.
Eigen::MatrixXcd LinearDerivatives::directions_of(const Eigen::MatrixXcd& rows) const {
  const LinearCoordinates& y = motion_.coordinates();
  Eigen::MatrixXcd Q = y.Q.cast<Complex>();
  if (rows.rows() == 0 || y.Q.cols() == 0) return Q;
  const Eigen::MatrixXd real = rows.real(), turned = rows.imag();
  const Eigen::MatrixXd any = LeastNorm(real, kRankOfConstraints).solve(-product(turned, y.Q));
  Eigen::MatrixXd chosen(y.Q.cols(), y.Q.cols());
  for (Eigen::Index k = 0; k < chosen.rows(); ++k) chosen.row(k) = any.row(y.columns[to_index(k)]);
  Q.imag() = any - product(y.Q, chosen);
  return Q;
}

void LinearDerivatives::step(std::size_t direction) {
  if (space_ && space_->direction == direction) return;
  space_ = std::make_unique<Space>();
  space_->direction = direction;
  const Layout& layout = system_.layout();
  const State<double>& rest = motion_.state();
  const RestDerivatives::Change& change = changes_[direction];
  std::vector<Complex> design(design_.begin(), design_.end());
  if (direction < parameters())
    design[to_index(study_.study.tuned[direction])] += Complex(0.0, kStep);
  ComplexMotion& motion = space_->motion;
  motion.parameters = study_.parameters_at(design);
  cast_state(rest, &motion.state);
  motion.state.q = stepped(rest.q, change.q);
  motion.state.s = stepped(rest.s, change.s);
  motion.state.z = stepped(rest.z, change.z);
  equations_.set_design(motion.parameters);
  equations_.linearize(motion.state, &derivatives_);
  const int count = layout.columns();
  const Eigen::MatrixXcd position =
                             dense(system_.patterns().position, derivatives_.position, count),
                         velocity =
                             dense(system_.patterns().velocity, derivatives_.velocity, count),
                         rate = dense(system_.patterns().rate, derivatives_.rate, count);
  Eigen::MatrixXcd rows = rate.block(layout.n, 0, layout.constraints(), layout.n);
  for (const int row : system_.dropped_rows()) rows.row(row).setZero();
  const Eigen::MatrixXcd Q = directions_of(rows);
  const Eigen::Index f = Q.cols(), x = 2 * f + layout.states;
  motion.motions = 2 * f;
  motion.q = Eigen::MatrixXcd::Zero(layout.n, x);
  motion.v = Eigen::MatrixXcd::Zero(layout.n, x);
  motion.q.leftCols(f) = Q;
  motion.v.middleCols(f, f) = Q;
  Eigen::MatrixXcd right =
      product(position.leftCols(layout.n), motion.q) + product(velocity, motion.v);
  right.rightCols(layout.states) += position.rightCols(layout.states);
  motion.z = complex_solution(rate, -right);
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(x, x);
  A.block(0, f, f, f).setIdentity();
  for (Eigen::Index k = 0; k < f; ++k)
    A.row(f + k) = motion.z.row(motion_.coordinates().columns[to_index(k)]);
  A.bottomRows(layout.states) = motion.z.bottomRows(layout.states);
  set_flow(A);
}

/// Sets the states without the held outputs that are disturbances: currents of motors follow them.
void LinearDerivatives::keep_states() {
  kept_.clear();
  const Eigen::Index motions = motion_.motions();
  for (Eigen::Index k = 0; k < motions + system_.layout().states; ++k) {
    bool is_held = false;
    for (std::size_t c = controllers_; c < system_.controllers().size(); ++c)
      is_held = is_held || k == motions + system_.controllers()[c].states.held;
    if (!is_held) kept_.push_back(k);
  }
}

/// The rows of the extra states that are kept, of a jump.
Eigen::MatrixXcd LinearDerivatives::kept_rows(const Eigen::MatrixXcd& jump) const {
  const Eigen::Index motions = motion_.motions(), states = to_signed(kept_.size()) - motions;
  Eigen::MatrixXcd rows(states, jump.cols());
  for (Eigen::Index k = 0; k < states; ++k)
    rows.row(k) = jump.row(kept_[to_index(motions + k)] - motions);
  return rows;
}

/// The state that is the effort beside the output of a controller that drives.
Eigen::Index LinearDerivatives::disturbance_of(std::size_t controller) const {
  std::size_t disturbance = controllers_;
  for (std::size_t c = 0; c < controller; ++c)
    if (study_.disturbances[c] >= 0) ++disturbance;
  return motion_.motions() + system_.controllers()[disturbance].states.held;
}

/// Takes the held outputs that are disturbances from the states to the inputs.
void LinearDerivatives::set_flow(const Eigen::MatrixXcd& A) {
  const ComplexMotion& motion = space_->motion;
  const Layout& layout = system_.layout();
  Eigen::MatrixXcd C(to_signed(controllers_), A.cols());
  SparseGradient<Complex> gradient;
  for (std::size_t c = 0; c < controllers_; ++c) {
    equations_.watched_gradient(c, motion.state, &gradient);
    Eigen::RowVectorXcd row = Eigen::RowVectorXcd::Zero(A.cols());
    for (const auto& entry : gradient.position) {
      if (entry.column < layout.n)
        row += entry.value * motion.q.row(entry.column);
      else
        row[motion.motions + entry.column - layout.n] += entry.value;
    }
    for (const auto& entry : gradient.velocity) row += entry.value * motion.v.row(entry.column);
    for (const auto& entry : gradient.rate) row += entry.value * motion.z.row(entry.column);
    C.row(to_signed(c)) = row;
  }
  const Eigen::Index states = to_signed(kept_.size());
  ComplexSpace& flow = space_->flow;
  flow.A = A(kept_, kept_);
  flow.C = C(Eigen::all, kept_);
  flow.B = Eigen::MatrixXcd::Zero(states, to_signed(controllers_));
  flow.D = Eigen::MatrixXcd::Zero(to_signed(controllers_), to_signed(controllers_));
  for (std::size_t c = 0; c < controllers_; ++c) {
    if (study_.disturbances[c] < 0) continue;
    const Eigen::Index column = disturbance_of(c);
    for (Eigen::Index k = 0; k < states; ++k)
      flow.B(k, to_signed(c)) = A(kept_[to_index(k)], column);
    flow.D.col(to_signed(c)) = C.col(column);
  }
}

PeriodMap<Complex> LinearDerivatives::period_map(int opened) {
  const Eigen::MatrixXcd& A = space_->flow.A;
  return {A,
          Eigen::MatrixXcd(A.rows(), 0),
          system_,
          motion_.motions(),
          pattern_,
          opened,
          [this](const std::vector<ControlEvent>& events) -> Eigen::MatrixXcd {
            return kept_rows(laws_.jump(events, space_->motion))(Eigen::all, kept_);
          }};
}

ComplexSpace LinearDerivatives::closed(std::size_t direction) {
  step(direction);
  if (pattern_.period == 0.0) return space_->flow;
  return {period_map(-1).by_states(), {}, {}, {}};
}

ComplexSpace LinearDerivatives::loop(std::size_t controller, std::size_t direction) {
  step(direction);
  if (pattern_.samples[controller] > 0) {
    const PeriodMap<Complex> map = period_map(static_cast<int>(controller));
    return {map.by_states(), map.by_opened(), map.output(), map.direct()};
  }
  const auto c = to_signed(controller);
  ComplexSpace loop{space_->flow.A, space_->flow.B.col(c), space_->flow.C.row(c),
                    space_->flow.D.block(c, c, 1, 1)};
  const int lag = system_.controllers()[controller].states.lag;
  if (lag >= 0) {
    loop.B.setZero();
    loop.B(motion_.motions() + lag, 0) =
        1.0 / study_.study.controllers[controller].realization.time_constant->at(
                  space_->motion.parameters);
    loop.D.setZero();
  }
  if (pattern_.period > 0.0) loop.pieces = pieces(lag < 0 ? disturbance_of(controller) : -1);
  return loop;
}

/// The events and flows of a period. @param input the state that is the input; -1: none.
PeriodPieces LinearDerivatives::pieces(Eigen::Index input) {
  const Eigen::Index states = space_->flow.A.rows();
  return period_pieces(system_, motion_.motions(), states, pattern_,
                       [&](const std::vector<ControlEvent>& events) {
                         const Eigen::MatrixXcd all = laws_.jump(events, space_->motion);
                         const Eigen::MatrixXcd own = kept_rows(all);
                         Eigen::MatrixXcd after = Eigen::MatrixXcd::Zero(own.rows(), states + 1);
                         after.leftCols(states) = own(Eigen::all, kept_);
                         if (input >= 0) after.col(states) = own.col(input);
                         return after;
                       });
}

}  // namespace codesign
