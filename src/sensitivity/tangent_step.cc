// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_step.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "assembly/assembly.h"
#include "integration/mode_watch.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"

namespace codesign {

template <int N>
TangentStep<N>::TangentStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : m_(system, tableau),
      rosenbrock_(&m_),
      explicit_(&m_),
      method_(method_of(tableau)),
      rows_(m_.layout.columns() + 1) {
  projected_.resize(m_.layout);
}

template <int N>
void TangentStep<N>::start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly,
                           const State<double>& initial, const std::vector<bool>& mode) {
  m_.equations.equations().hold({});
  m_.equations.equations().set_design(parameters);
  assembly.extend(parameters, initial, &m_.equations.equations(), &extension_, &start_);
  m_.equations.equations().hold(mode);
  m_.y.setZero();
  take_up(initial, start_);
  scale_.start(m_.system, parameters);
  scale_.measure(m_.at, initial, m_.y);
  if (keeps_previous_) previous_y_ = m_.y;
}

template <int N>
void TangentStep<N>::take_up(const State<double>& at, const State<Lanes<N>>& lanes) {
  const auto take = [this](const VectorX<Lanes<N>>& of, int first) {
    for (Eigen::Index k = 0; k < of.size(); ++k) m_.y.col(first + k) = of[k].directions();
  };
  take(lanes.q, m_.at.x());
  take(lanes.s, m_.at.s());
  take(lanes.v, m_.at.v());
  take(lanes.z, m_.at.z());
  m_.has_changes = false;
  method_->begin(at);
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::guard_time(int guard, double rate,
                                                       const State<double>& end) {
  m_.equations.equations().compiled().switches(m_.equations.lanes(end, m_.y), &guards_, &right_);
  return guards_[guard].directions() * (-1.0 / rate);
}

template <int N>
void TangentStep<N>::cross(const ModeChange& change) {
  m_.equations.equations().compiled().switches(m_.equations.lanes(change.end, m_.y), &guards_,
                                               &right_);
  const Vector tau = guards_[change.guard].v * (-1.0 / change.guard_rate);
  const auto grow = [&](int column, double difference) { m_.y.vector(column) += difference * tau; };
  const VectorX<double> jump = change.before.z - change.behind.z;
  for (int k = 0; k < m_.at.n; ++k) grow(m_.at.v() + k, jump[k]);
  for (int k = 0; k < m_.at.states; ++k) grow(m_.at.s() + k, jump[m_.layout.state_column(k)]);
  grow(m_.at.psi(), change.g_before - change.g);
}

template <int N>
void TangentStep<N>::jump(const std::vector<ControlEvent>& events, const State<double>& before,
                          const State<double>& behind, const Assembly& assembly,
                          const std::vector<bool>& mode) {
  m_.equations.equations().hold(mode);
  point_ = m_.equations.lanes(before, m_.y);
  if (!events.empty()) m_.equations.equations().jump(events, &point_);
  assembly.rates().extend(behind.z, &m_.equations.equations(), &extension_.rates, &point_);
  take_up(behind, point_);
}

template <int N>
void TangentStep<N>::jump(RosenbrockIntegrator* integrator) {
  if (integrator->mode_change().guard >= 0) cross(integrator->mode_change());
  const bool has_events = !integrator->jump_events().empty();
  jump(integrator->jump_events(), has_events ? integrator->before_jump() : integrator->state(),
       integrator->state(), integrator->assembly(), integrator->mode());
}

template <int N>
void TangentStep<N>::attempt(OneStep<double>* step) {
  m_.tableau = &step->tableau();
  method_ = method_of(*m_.tableau);
  method_->attempt(step);
}

template <int N>
double TangentStep<N>::error(const OneStep<double>& step, double tolerance) const {
  Vector change{};
  for (std::size_t j = 0; j < m_.count(); ++j)
    change += m_.tableau->weights[j] * m_.stages[j].vector(m_.at.psi());
  const Eigen::Map<const Eigen::Array<double, N, 1>> by(reinterpret_cast<const double*>(&change));
  return scale_.error(m_.at,
                      {step.unprojected(), m_.stage_y, method_->estimate(),
                       m_.y.col(m_.at.psi()).array() + by, step.psi()},
                      tolerance / step.caution());
}

// Differentiates the projection [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error], (17), and adds
// delta' to the directions at `target`.
template <int N>
void TangentStep<N>::project(const VectorX<double>& correction, const Directions<N>& errors,
                             const SparseLu& lu, Out<double> target) {
  assert(target.size() == N * m_.layout.n);
  for (int row = 0; row < m_.at.z_size; ++row) {
    Vector sum[1] = {};
    const In<double> x[1] = {correction};
    add_row_tangents<N, 1>(m_.system.patterns().rate, m_.equations.changes().rate, row, x, 0, sum);
    const int constraint = row - m_.layout.n;
    if (constraint >= 0 && constraint < m_.layout.m) sum[0] += errors.vector(constraint);
    rows_.vector(row) = -sum[0];
  }
  const Out<double> delta = rows_.part(0, m_.at.z_size);
  lu.template solve_rows<N>(delta);
  for (int k = 0; k < N * m_.layout.n; ++k) target[k] += delta[k];
}

template <int N>
void TangentStep<N>::accept(const OneStep<double>& step) {
  if (keeps_previous_) previous_y_ = m_.y;
  m_.combine(m_.y, In<double>(m_.tableau->weights).first(m_.tableau->stages), 0, m_.y);
  m_.has_changes = false;
  method_->finish(step);
  if (m_.layout.m > 0) project(step);
  scale_.measure(m_.at, step.state(), m_.y);
}

template <int N>
void TangentStep<N>::project(const OneStep<double>& step) {
  const SparseLu& lu = step.projection_matrix().lu();
  m_.equations.constraint_errors(step.unprojected(), m_.y, &errors_, &rates_);
  project(step.position_correction(), errors_, lu, m_.y.part(m_.at.x(), m_.at.n));
  projected_ = step.unprojected();
  projected_.q = step.state().q;
  m_.equations.constraint_errors(projected_, m_.y, &errors_, &rates_);
  project(step.velocity_correction(), rates_, lu, m_.y.part(m_.at.v(), m_.at.n));
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::terminal(const State<double>& state) {
  return m_.equations.equations().terminal(m_.equations.lanes(state, m_.y)).directions();
}

// The derivative of OneStep::interpolate() for a fixed time.
template <int N>
void TangentStep<N>::interpolate(const OneStep<double>& step, double time) {
  const double h = step.step_size(), theta = h > 0.0 ? (time - step.previous().t) / h : 1.0;
  const RosenbrockTableau::Row weights = dense_weights(*m_.tableau, theta);
  const int size = m_.at.psi();
  for (int k = 0; k < size; ++k)
    m_.stage_y.vector(k) = (1.0 - theta) * previous_y_.vector(k) + theta * m_.y.vector(k);
  m_.combine(m_.stage_y.part(0, size), In<double>(weights).first(m_.tableau->stages), 0,
             m_.stage_y.part(0, size));
  method_->interpolate_z(theta, previous_y_);
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::watched(std::size_t k, const OneStep<double>& step,
                                                    const State<double>& state, bool reads_rates,
                                                    const Assembly& assembly) {
  go_to(step, state, reads_rates, assembly);
  return m_.equations.equations().watched(k, point_).directions();
}

template <int N>
void TangentStep<N>::go_to(const OneStep<double>& step, const State<double>& state,
                           bool reads_rates, const Assembly& assembly) {
  interpolate(step, state.t);
  point_ = m_.equations.lanes(state, m_.stage_y);
  if (reads_rates)
    assembly.rates().extend(state.z, &m_.equations.equations(), &extension_.rates, &point_);
}

template <int N>
void TangentStep<N>::all_watched(const OneStep<double>& step, const State<double>& state,
                                 bool reads_rates, const Assembly& assembly,
                                 Directions<N>* signals) {
  go_to(step, state, reads_rates, assembly);
  signals->resize(to_signed(m_.system.watched().size()));
  for (std::size_t k = 0; k < m_.system.watched().size(); ++k)
    signals->col(to_signed(k)) = m_.equations.equations().watched(k, point_).directions();
}

template <int N>
void TangentStep<N>::integral_residuals(const OneStep<double>& step, const State<double>& state,
                                        Directions<N>* residuals) {
  interpolate(step, state.t);
  differentiate_residuals(ObjectivePart::kIntegral, m_.equations.lanes(state, m_.stage_y),
                          residuals);
}

template <int N>
void TangentStep<N>::terminal_residuals(const State<double>& state, Directions<N>* residuals) {
  differentiate_residuals(ObjectivePart::kTerminal, m_.equations.lanes(state, m_.y), residuals);
}

template <int N>
void TangentStep<N>::differentiate_residuals(ObjectivePart part, const State<Lanes<N>>& state,
                                             Directions<N>* residuals) {
  VectorX<Lanes<N>>& terms = objective_residuals_[to_index(part)];
  m_.equations.equations().residuals(part, state, &terms);
  residuals->resize(terms.size());
  for (Eigen::Index k = 0; k < terms.size(); ++k) residuals->col(k) = terms[k].directions();
}

template class TangentStep<4>;
template class TangentStep<8>;

}  // namespace codesign
