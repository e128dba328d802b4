// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_motion.h"

#include <algorithm>
#include <cmath>

#include "equations/formulas.h"
#include "linear/resting_mechanism.h"
#include "linear/sampled_motion.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kMostIterations = 30;
constexpr double kConverged = 1e-13;  // of the rates, relative

}  // namespace

LinearMotion::LinearMotion(const CompiledSystem& system, const LinearStudy& study)
    : system_(system), study_(study), equations_(system), lanes_(system), matrix_(system) {
  equations_.compiled().allow(false);
  lanes_.compiled().allow(false);
  set_design(study.parameters);
  derivatives_.resize(system.patterns());
  flow_.inputs = study.inputs;
  for (const WatchedSignal& watched : study.study.watched)
    flow_.outputs.push_back(watched.signal.text);
}

void LinearMotion::set_design(const std::vector<double>& parameters) {
  parameters_ = parameters;
  equations_.set_design(parameters);
}

Status LinearMotion::solve_rates() {
  VectorX<double> step;
  double g = 0.0, last = 0.0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    equations_.residual(state_, &step, &g);
    equations_.linearize(state_, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0))
      return {StatusCode::kSingularMatrix, state_.t,
              "the equations of motion are singular at the state that is linearized"};
    VectorX<double> change = step.head(system_.layout().columns());
    matrix_.lu().solve(change);
    const double size =
        change.size() == 0 ? 0.0 : change.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(size)) break;
    state_.z -= change;
    const double scale = 1.0 + (state_.z.size() == 0 ? 0.0 : state_.z.cwiseAbs().maxCoeff());
    if (size <= kConverged * scale || (iteration > 2 && size >= 0.5 * last)) {
      equations_.linearize(state_, &derivatives_);
      if (matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return {};
    }
    last = size;
  }
  return {StatusCode::kNonFinite, state_.t,
          "the equations of motion are not finite at the state that is linearized"};
}

// What sampled controllers hold follows from the estimates that they read.
void LinearMotion::settle_estimates(const std::vector<double>& integrals) {
  const std::vector<Controller>& controllers = system_.controllers();
  const std::size_t first = study_.disturbances.size();
  std::size_t next = first;
  for (const Controller& controller : controllers)
    for (int k = 0; k < controller.states.estimates && next < integrals.size(); ++k)
      state_.s[controller.states.estimate + k] = integrals[next++];
  if (next == first) return;
  for (std::size_t c = 0; c < controllers.size(); ++c) {
    const ControlRealization& realization = system_.study().controllers[c].realization;
    if (realization.is_sampled() && controllers[c].states.estimate < 0)
      equations_.jump(
          {{ControlEvent::Kind::kSample, static_cast<int>(c), first_sample(realization)}}, &state_);
  }
}

/// Currents that controllers read are those that were found; other ones follow from the outputs.
void LinearMotion::settle_currents(const std::vector<double>& integrals) {
  std::size_t next = study_.disturbances.size();
  for (const Controller& controller : system_.controllers())
    next += to_index(controller.states.estimates);
  for (const Winding& winding : read_windings(system_))
    if (next < integrals.size()) state_.s[winding.state] = integrals[next++];
}

// Outputs of cascades follow each other: as many rounds as there are controllers settle all.
void LinearMotion::settle(const std::vector<double>& integrals) {
  const std::vector<Controller>& controllers = system_.controllers();
  for (std::size_t round = 0; round < controllers.size() + 1; ++round) {
    for (std::size_t c = 0; c < controllers.size(); ++c)
      if (controllers[c].state >= 0)
        state_.s[controllers[c].state] = c < integrals.size() ? integrals[c] : 0.0;
    settle_currents(integrals);
    equations_.begin_states(&state_);
    settle_estimates(integrals);
    for (std::size_t c = 0; c < controllers.size(); ++c) {
      const ControllerStates& states = controllers[c].states;
      const int queued = system_.study().controllers[c].realization.queued();
      if (states.held >= 0 && queued > 0) {
        const double output = state_.s[states.queue];
        state_.s[states.held] = output;
        state_.s.segment(states.queue, queued).setConstant(output);
      }
      if (states.lag < 0) continue;
      // sigma = (u - f)/tau of the present f gives u.
      equations_.formulas().load(state_);
      state_.s[states.lag] = equations_.formulas().controller_output(static_cast<int>(c));
    }
  }
  const std::vector<Winding> read = read_windings(system_);
  for (const Winding& winding : system_.windings()) {
    const auto is_it = [&winding](const Winding& other) { return other.state == winding.state; };
    if (winding.state < 0 || std::any_of(read.begin(), read.end(), is_it)) continue;
    equations_.formulas().load(state_);
    state_.s[winding.state] = equations_.formulas().steady_current(winding);
  }
}

Status LinearMotion::linearize_at_rest(State<double> state, const std::vector<double>& integrals) {
  state_ = std::move(state);
  state_.v.setZero();
  state_.s.setZero(system_.layout().states);
  state_.z.setZero(system_.layout().columns());
  settle(integrals);
  if (Status status = solve_rates(); !status.ok()) return status;
  return differentiate();
}

Status LinearMotion::linearize(State<double> state) {
  state_ = std::move(state);
  if (Status status = solve_rates(); !status.ok()) return status;
  return differentiate();
}

void LinearMotion::set_directions() {
  const Layout& layout = system_.layout();
  coordinates_ = linear_coordinates(system_, derivatives_, state_);
  const Eigen::Index f = to_signed(coordinates_.columns.size());
  const Eigen::Index count = 2 * f + layout.states + to_signed(study_.inputs.size());
  q_.setZero(layout.n, count);
  v_.setZero(layout.n, count);
  s_.setZero(layout.states, count);
  z_.setZero(layout.columns(), count);
  q_.leftCols(f) = coordinates_.Q;
  v_.leftCols(f) = coordinates_.P;
  v_.middleCols(f, f) = coordinates_.Q;
  s_.middleCols(2 * f, layout.states).setIdentity();
}

void LinearMotion::load_lanes(Eigen::Index first) {
  const Eigen::Index x = motions() + system_.layout().states;
  const Eigen::Index count = std::min<Eigen::Index>(kLanes, q_.cols() - first);
  parameter_lanes_.assign(parameters_.begin(), parameters_.end());
  for (Eigen::Index k = 0; k < count; ++k)
    if (first + k >= x)
      parameter_lanes_[study_.first + to_index(first + k - x)].v[static_cast<int>(k)] = 1.0;
  lanes_.set_design(parameter_lanes_);
  cast_state(state_, &state_lanes_);
  const auto seed = [&](const Eigen::MatrixXd& directions, VectorX<Number>* lanes) {
    for (Eigen::Index row = 0; row < directions.rows(); ++row)
      for (Eigen::Index k = 0; k < count; ++k)
        (*lanes)[row].v[static_cast<int>(k)] = directions(row, first + k);
  };
  seed(q_, &state_lanes_.q);
  seed(v_, &state_lanes_.v);
  seed(s_, &state_lanes_.s);
  seed(z_, &state_lanes_.z);
}

template <class Visit>
void LinearMotion::for_each_group(const Visit& visit) {
  for (Eigen::Index first = 0; first < q_.cols(); first += kLanes) {
    load_lanes(first);
    visit(first, std::min<Eigen::Index>(kLanes, q_.cols() - first));
  }
}

Status LinearMotion::differentiate() {
  const Layout& layout = system_.layout();
  set_directions();
  for_each_group([&](Eigen::Index first, Eigen::Index count) {
    VectorX<Number> G;
    Number g(0.0);
    lanes_.residual(state_lanes_, &G, &g);
    for (Eigen::Index k = 0; k < count; ++k) {
      VectorX<double> rates(layout.columns());
      for (Eigen::Index row = 0; row < rates.size(); ++row)
        rates[row] = -G[row].v[static_cast<int>(k)];
      matrix_.lu().solve(rates);
      z_.col(first + k) = rates;
    }
  });
  const Eigen::Index f = motions() / 2, x = motions() + layout.states;
  Eigen::MatrixXd rates(x, q_.cols());
  rates.topRows(f).setZero();
  rates.block(0, f, f, f).setIdentity();
  for (Eigen::Index k = 0; k < f; ++k) rates.row(f + k) = z_.row(coordinates_.columns[to_index(k)]);
  rates.bottomRows(layout.states) = z_.bottomRows(layout.states);
  Eigen::MatrixXd outputs(to_signed(flow_.outputs.size()), q_.cols());
  if (outputs.rows() > 0)
    for_each_group([&](Eigen::Index first, Eigen::Index count) {
      for (Eigen::Index row = 0; row < outputs.rows(); ++row) {
        const Number value = lanes_.watched(to_index(row), state_lanes_);
        for (Eigen::Index k = 0; k < count; ++k)
          outputs(row, first + k) = value.v[static_cast<int>(k)];
      }
    });
  flow_.A = rates.leftCols(x);
  flow_.B = rates.rightCols(q_.cols() - x);
  flow_.C = outputs.leftCols(x);
  flow_.D = outputs.rightCols(q_.cols() - x);
  flow_.states = linear_state_names(system_, coordinates_.columns);
  if (!rates.allFinite() || !outputs.allFinite())
    return {StatusCode::kNonFinite, state_.t, "the derivatives about the state are not finite"};
  return {};
}

Eigen::MatrixXd LinearMotion::jump(const std::vector<ControlEvent>& events) {
  Eigen::MatrixXd after(system_.layout().states, q_.cols());
  for_each_group([&](Eigen::Index first, Eigen::Index count) {
    lanes_.jump(events, &state_lanes_);
    for (Eigen::Index row = 0; row < after.rows(); ++row)
      for (Eigen::Index k = 0; k < count; ++k)
        after(row, first + k) = state_lanes_.s[row].v[static_cast<int>(k)];
  });
  return after;
}

}  // namespace codesign
