// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_step.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "assembly/assembly.h"
#include "equations/mass_solution.h"
#include "integration/mode_watch.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"
#include "sparse/sparsity.h"

namespace codesign {
template <int N>
TangentStep<N>::TangentStep(const CompiledSystem& system, const RosenbrockTableau& tableau)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      tableau_(&tableau),
      equations_(system),
      y_(at_.size()),
      stage_y_(y_),
      rows_(layout_.columns() + 1),
      estimate_(y_),
      stages_(to_index(std::max(tableau.stages, most_stages(system.study().solver.method))), y_),
      matrix_changes_(stages_.size(), rows_) {
  projected_.resize(layout_);
}

template <int N>
void TangentStep<N>::start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly,
                           const State<double>& initial, const std::vector<bool>& mode) {
  equations_.equations().hold({});
  equations_.equations().set_design(parameters);
  assembly.extend(parameters, initial, &equations_.equations(), &extension_, &start_);
  equations_.equations().hold(mode);
  y_.setZero();
  take_up(initial, start_);
  scale_.start(system_, parameters);
  scale_.measure(at_, initial, y_);
  if (keeps_previous_) previous_y_ = y_;
}

template <int N>
void TangentStep<N>::take_up(const State<double>& at, const State<Lanes<N>>& lanes) {
  const auto take = [this](const VectorX<Lanes<N>>& of, int first) {
    for (Eigen::Index k = 0; k < of.size(); ++k) y_.col(first + k) = of[k].directions();
  };
  take(lanes.q, at_.x());
  take(lanes.s, at_.s());
  take(lanes.v, at_.v());
  take(lanes.z, at_.z());
  has_changes_ = false;
  if (!tableau_->is_explicit()) linearize(at);
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::guard_time(int guard, double rate,
                                                       const State<double>& end) {
  equations_.equations().compiled().switches(equations_.lanes(end, y_), &guards_, &right_);
  return guards_[guard].directions() * (-1.0 / rate);
}

template <int N>
void TangentStep<N>::cross(const ModeChange& change) {
  equations_.equations().compiled().switches(equations_.lanes(change.end, y_), &guards_, &right_);
  const Vector tau = guards_[change.guard].v * (-1.0 / change.guard_rate);
  const auto grow = [&](int column, double difference) { y_.vector(column) += difference * tau; };
  const VectorX<double> jump = change.before.z - change.behind.z;
  for (int k = 0; k < at_.n; ++k) grow(at_.v() + k, jump[k]);
  for (int k = 0; k < at_.states; ++k) grow(at_.s() + k, jump[layout_.state_column(k)]);
  grow(at_.psi(), change.g_before - change.g);
}

template <int N>
void TangentStep<N>::jump(const std::vector<ControlEvent>& events, const State<double>& before,
                          const State<double>& behind, const Assembly& assembly,
                          const std::vector<bool>& mode) {
  equations_.equations().hold(mode);
  point_ = equations_.lanes(before, y_);
  if (!events.empty()) equations_.equations().jump(events, &point_);
  assembly.extend_rates(behind.z, &equations_.equations(), &extension_, &point_);
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
void TangentStep<N>::combine(In<double> from, In<double> factors, int first, Out<double> to) const {
  const double* parts[RosenbrockTableau::kMaximumStages];
  for (std::ptrdiff_t j = 0; j < factors.size(); ++j)
    parts[j] = stages_[to_index(j)].data() + std::ptrdiff_t{N} * first;
  codesign::combine(from, factors, parts, to);
}

// Sets w' in increment i, the derivative of RosenbrockStep::stage_start().
template <int N>
void TangentStep<N>::stage_start(std::size_t i, double h) {
  const double hg = h * tableau_->gamma;
  Directions<N>& u = stages_[i];
  RosenbrockTableau::Row factors;
  for (std::size_t j = 0; j < i; ++j) factors[j] = tableau_->c[i][j] / h;
  const auto add = [&](const Directions<N>& from, int rate, int first, int size) {
    combine(from.part(rate, size), In<double>(factors).first(to_signed(i)), first,
            u.part(first, size));
  };
  add(stage_y_, at_.z(), at_.v(), at_.n);
  add(stage_y_, at_.v(), at_.x(), at_.n);
  add(stage_y_, at_.sigma(), at_.s(), at_.states);
  u.vector(at_.psi()) = Vector{};
  add(u, at_.psi(), at_.psi(), 1);
  for (int k = 0; k < at_.n; ++k) {
    const Vector u_v = hg * u.vector(at_.v() + k);
    u.vector(at_.v() + k) = u_v;
    u.vector(at_.x() + k) = hg * (u.vector(at_.x() + k) + u_v);
  }
  for (int k = 0; k < at_.states; ++k) u.vector(at_.s() + k) = hg * u.vector(at_.s() + k);
}

// (dG_q) u_q + (dG_s) u_s + (dG_v) u_v + (dG_z) u_z, with the integrand's row, for several stages
// at once: dG is by far the largest array, so it is read as few times as possible. The increments u
// of the step are known.
template <int N>
template <std::size_t together>
void TangentStep<N>::change_matrices(const RosenbrockStep<double>& step) {
  const ByVariable<Sparsity>& patterns = system_.patterns();
  for (std::size_t first = 0; first < count(); first += together) {
    In<double> u[together];
    for (std::size_t k = 0; k < together; ++k) u[k] = step.increments()[first + k];
    for (int row = 0; row <= at_.z_size; ++row) {
      Vector sums[together] = {};
      add_row_tangents<N, together>(patterns.position, equations_.changes().position, row, u,
                                    at_.x(), sums);
      add_row_tangents<N, together>(patterns.velocity, equations_.changes().velocity, row, u,
                                    at_.v(), sums);
      add_row_tangents<N, together>(patterns.rate, equations_.changes().rate, row, u, at_.z(),
                                    sums);
      for (std::size_t k = 0; k < together; ++k)
        matrix_changes_[first + k].vector(row) =
            sums[k] + (step.step_size() * tableau_->gamma_i[first + k]) *
                          equations_.time_changes().vector(row);
    }
  }
}

template <int N>
void TangentStep<N>::stage_tangent(std::size_t i, const RosenbrockStep<double>& step) {
  const double hg = step.step_size() * tableau_->gamma;
  const ByVariable<Sparsity>& patterns = system_.patterns();
  const Linearization<double>& matrices = step.derivatives();
  combine(y_.part(0, at_.psi()), In<double>(tableau_->a[i]).first(to_signed(i)), 0,
          stage_y_.part(0, at_.psi()));
  equations_.residual(step.stages()[i], stage_y_, &residual_);
  stage_start(i, step.step_size());
  Directions<N>& u = stages_[i];
  const In<double> x = u.part(at_.x(), at_.x_size), v = u.part(at_.v(), at_.n);
  const Out<double> z = u.part(at_.z(), at_.z_size);
  for (int row = 0; row < at_.z_size; ++row)
    u.vector(at_.z() + row) = -(residual_.vector(row) + matrix_changes_[i].vector(row));
  step.product().template subtract<N>(matrices, u.part(0, at_.z()), z);
  step.stage_matrix().lu().template solve_rows<N>(z);
  for (int k = 0; k < at_.n; ++k) {
    const Vector change = hg * u.vector(at_.z() + k);
    u.vector(at_.v() + k) += change;
    u.vector(at_.x() + k) += hg * change;
  }
  for (int k = 0; k < at_.states; ++k) u.vector(at_.s() + k) += hg * u.vector(at_.sigma() + k);
  Vector psi =
      residual_.vector(at_.z_size) + matrix_changes_[i].vector(at_.z_size) + u.vector(at_.psi());
  add_row_product<N>(patterns.position, matrices.position, at_.z_size, x, &psi);
  add_row_product<N>(patterns.velocity, matrices.velocity, at_.z_size, v, &psi);
  add_row_product<N>(patterns.rate, matrices.rate, at_.z_size, z, &psi);
  u.vector(at_.psi()) = hg * psi;
}

// The derivative of RosenbrockStep::take_rates(), with z' from G = 0.
template <int N>
void TangentStep<N>::explicit_stage(std::size_t i, RosenbrockStep<double>* step) {
  const double h = step->step_size();
  const int z_size = at_.z_size;
  combine(y_.part(0, at_.z()), In<double>(tableau_->a[i]).first(to_signed(i)), 0,
          stage_y_.part(0, at_.z()));
  for (int k = 0; k < z_size; ++k) stage_y_.vector(at_.z() + k) = Vector{};
  equations_.residual(step->stages()[i], stage_y_, &residual_);
  const Out<double> z = stage_y_.part(at_.z(), z_size);
  for (int k = 0; k < z_size; ++k) stage_y_.vector(at_.z() + k) = -residual_.vector(k);
  Directions<N>& u = stages_[i];
  Vector psi = residual_.vector(z_size);
  if (const auto& [pattern, values] = step->stage_factor(i); pattern) {
    pattern->template solve<N>(values, z);  // then g does not depend on z
  } else {
    step->factor_stage(i);
    step->stage_matrix().lu().template solve_rows<N>(z);
    add_row_product<N>(system_.patterns().rate, step->derivatives().rate, z_size, z, &psi);
  }
  u.vector(at_.psi()) = h * psi;
  for (int k = 0; k < at_.n; ++k) {
    u.vector(at_.x() + k) = h * stage_y_.vector(at_.v() + k);
    u.vector(at_.v() + k) = h * stage_y_.vector(at_.z() + k);
  }
  for (int k = 0; k < at_.states; ++k) u.vector(at_.s() + k) = h * stage_y_.vector(at_.sigma() + k);
  for (int k = 0; k < z_size; ++k)
    u.vector(at_.z() + k) = stage_y_.vector(at_.z() + k) - y_.vector(at_.z() + k);
}

template <int N>
void TangentStep<N>::linearize(const State<double>& state) {
  equations_.linearize(state, y_);
  has_changes_ = true;
}

template <int N>
void TangentStep<N>::attempt(RosenbrockStep<double>* step) {
  tableau_ = &step->tableau();
  if (tableau_->is_explicit()) {
    for (std::size_t i = 0; i < count(); ++i) explicit_stage(i, step);
    estimate_.setZero();
    combine(estimate_, In<double>(tableau_->estimate).first(tableau_->stages), 0, estimate_);
    return;
  }
  if (!has_changes_) linearize(step->state());
  if (count() % 4 == 0)
    change_matrices<4>(*step);
  else if (count() % 3 == 0)
    change_matrices<3>(*step);
  else
    change_matrices<1>(*step);
  for (std::size_t i = 0; i < count(); ++i) stage_tangent(i, *step);
}

// The last stage lies at the end, but for the error. The pair's estimate counts as in
// RosenbrockStep::error().
template <int N>
double TangentStep<N>::error(const RosenbrockStep<double>& step, double tolerance) const {
  constexpr double kPairCaution = 5.0;
  const bool pair = tableau_->is_explicit();
  Vector change{};
  for (std::size_t j = 0; j < count(); ++j)
    change += tableau_->weights[j] * stages_[j].vector(at_.psi());
  const Eigen::Map<const Eigen::Array<double, N, 1>> by(reinterpret_cast<const double*>(&change));
  return scale_.error(at_,
                      {step.unprojected(), stage_y_, pair ? estimate_ : stages_[count() - 1],
                       y_.col(at_.psi()).array() + by, step.psi()},
                      pair ? tolerance / kPairCaution : tolerance);
}

// Differentiates the projection [G_a G_lambda; Phi_q 0] [delta; mu] = [0; -error], (17), and adds
// delta' to the directions at `target`.
template <int N>
void TangentStep<N>::project(const VectorX<double>& correction, const Directions<N>& errors,
                             const SparseLu& lu, Out<double> target) {
  assert(target.size() == N * layout_.n);
  for (int row = 0; row < at_.z_size; ++row) {
    Vector sum[1] = {};
    const In<double> x[1] = {correction};
    add_row_tangents<N, 1>(system_.patterns().rate, equations_.changes().rate, row, x, 0, sum);
    const int constraint = row - layout_.n;
    if (constraint >= 0 && constraint < layout_.m) sum[0] += errors.vector(constraint);
    rows_.vector(row) = -sum[0];
  }
  const Out<double> delta = rows_.part(0, at_.z_size);
  lu.template solve_rows<N>(delta);
  for (int k = 0; k < N * layout_.n; ++k) target[k] += delta[k];
}

template <int N>
void TangentStep<N>::accept(const RosenbrockStep<double>& step) {
  if (keeps_previous_) previous_y_ = y_;
  combine(y_, In<double>(tableau_->weights).first(tableau_->stages), 0, y_);
  // The rates at the end of an explicit step are those of its last stage.
  if (tableau_->is_explicit())
    for (int k = at_.z(); k < at_.psi(); ++k) y_.vector(k) = stage_y_.vector(k);
  has_changes_ = false;
  if (!tableau_->is_explicit() || layout_.m > 0) linearize(step.unprojected());
  if (layout_.m > 0) project(step);
  scale_.measure(at_, step.state(), y_);
}

template <int N>
void TangentStep<N>::project(const RosenbrockStep<double>& step) {
  const SparseLu& lu = step.projection_matrix().lu();
  equations_.constraint_errors(step.unprojected(), y_, &errors_, &rates_);
  project(step.position_correction(), errors_, lu, y_.part(at_.x(), at_.n));
  projected_ = step.unprojected();
  projected_.q = step.state().q;
  equations_.constraint_errors(projected_, y_, &errors_, &rates_);
  project(step.velocity_correction(), rates_, lu, y_.part(at_.v(), at_.n));
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::terminal(const State<double>& state) {
  return equations_.equations().terminal(equations_.lanes(state, y_)).directions();
}

// The derivative of RosenbrockStep::interpolate() for a fixed time.
template <int N>
void TangentStep<N>::interpolate(const RosenbrockStep<double>& step, double time) {
  const double h = step.step_size(), theta = h > 0.0 ? (time - step.previous().t) / h : 1.0;
  const RosenbrockTableau::Row weights = dense_weights(*tableau_, theta);
  const int size = at_.psi();
  for (int k = 0; k < size; ++k)
    stage_y_.vector(k) = (1.0 - theta) * previous_y_.vector(k) + theta * y_.vector(k);
  combine(stage_y_.part(0, size), In<double>(weights).first(tableau_->stages), 0,
          stage_y_.part(0, size));
  if (tableau_->is_explicit())
    combine(previous_y_.part(at_.z(), at_.z_size),
            In<double>(rate_weights(*tableau_, theta)).first(tableau_->stages), at_.z(),
            stage_y_.part(at_.z(), at_.z_size));
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::watched(std::size_t k,
                                                    const RosenbrockStep<double>& step,
                                                    const State<double>& state, bool reads_rates,
                                                    const Assembly& assembly) {
  go_to(step, state, reads_rates, assembly);
  return equations_.equations().watched(k, point_).directions();
}

template <int N>
void TangentStep<N>::go_to(const RosenbrockStep<double>& step, const State<double>& state,
                           bool reads_rates, const Assembly& assembly) {
  interpolate(step, state.t);
  point_ = equations_.lanes(state, stage_y_);
  if (reads_rates) assembly.extend_rates(state.z, &equations_.equations(), &extension_, &point_);
}

template <int N>
void TangentStep<N>::all_watched(const RosenbrockStep<double>& step, const State<double>& state,
                                 bool reads_rates, const Assembly& assembly,
                                 Directions<N>* signals) {
  go_to(step, state, reads_rates, assembly);
  signals->resize(to_signed(system_.watched().size()));
  for (std::size_t k = 0; k < system_.watched().size(); ++k)
    signals->col(to_signed(k)) = equations_.equations().watched(k, point_).directions();
}

template <int N>
void TangentStep<N>::integral_residuals(const RosenbrockStep<double>& step,
                                        const State<double>& state, Directions<N>* residuals) {
  interpolate(step, state.t);
  differentiate_residuals(ObjectivePart::kIntegral, equations_.lanes(state, stage_y_), residuals);
}

template <int N>
void TangentStep<N>::terminal_residuals(const State<double>& state, Directions<N>* residuals) {
  differentiate_residuals(ObjectivePart::kTerminal, equations_.lanes(state, y_), residuals);
}

template <int N>
void TangentStep<N>::differentiate_residuals(ObjectivePart part, const State<Lanes<N>>& state,
                                             Directions<N>* residuals) {
  VectorX<Lanes<N>>& terms = objective_residuals_[to_index(part)];
  equations_.equations().residuals(part, state, &terms);
  residuals->resize(terms.size());
  for (Eigen::Index k = 0; k < terms.size(); ++k) residuals->col(k) = terms[k].directions();
}

template class TangentStep<4>;
template class TangentStep<8>;

}  // namespace codesign
