// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/sensitivity/tangent_step.h"

namespace codesign {

template <int N>
TangentStep<N>::TangentStep(const System& system, const RosenbrockTableau& tableau)
    : system_(system), layout_(system.layout()), tableau_(tableau), equations_(system), stages_(static_cast<std::size_t>(tableau.stages)) {
  derivatives_.resize(system.sparsity().nonzeros());
  state_.resize(layout_);
  stage_.resize(layout_);
  for (StageTangent& stage : stages_) {
    stage.q.setZero(N, layout_.n);
    stage.v.setZero(N, layout_.n);
    stage.s.setZero(N, layout_.states);
    stage.z.setZero(N, layout_.columns());
  }
  columns_.resize(layout_.columns(), N);
}

template <int N>
void TangentStep<N>::load_lanes(const VectorX<double>& q, const VectorX<double>& v, const VectorX<double>& s, const VectorX<double>& z,
                                const Directions<N>& dq, const Directions<N>& dv, const Directions<N>& ds, const Directions<N>& dz,
                                State<Lanes<N>>* state) const {
  const auto load = [](const VectorX<double>& value, const Directions<N>& direction, VectorX<Lanes<N>>* lanes) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      (*lanes)[k].a = value[k];
      (*lanes)[k].directions() = direction.col(k);
    }
  };
  load(q, dq, &state->q);
  load(v, dv, &state->v);
  load(s, ds, &state->s);
  load(z, dz, &state->z);
}

template <int N>
void TangentStep<N>::start(const std::vector<Lanes<N>>& parameters, const Assembly& assembly, const State<double>& initial,
                           const RosenbrockStep<double>& step) {
  equations_.set_design(parameters);
  equations_.turn_references() = const_cast<RosenbrockStep<double>&>(step).equations().turn_references();
  assembly.extend(parameters, initial, &equations_, &state_);
  const auto take = [](const VectorX<Lanes<N>>& lanes, Directions<N>* direction) {
    direction->resize(N, lanes.size());
    for (Eigen::Index k = 0; k < lanes.size(); ++k) direction->col(k) = lanes[k].directions();
  };
  take(state_.q, &q_);
  take(state_.v, &v_);
  take(state_.s, &s_);
  take(state_.z, &z_);
  psi_.setZero();
  equations_.linearize(state_, &derivatives_);
}

template <int N>
void TangentStep<N>::add_matrix_tangent(const Increment<double>& u, Directions<N>* result) const {
  const Sparsity& pattern = system_.sparsity();
  for (int column = 0; column < pattern.columns; ++column) {
    const bool body = column < layout_.n, state = column >= layout_.state_column(0);
    const double position = body ? u.q[column] : state ? u.s[column - layout_.state_column(0)] : 0.0;
    const double velocity = body ? u.v[column] : 0.0, rate = u.z[column];
    for (int k = pattern.column_start[static_cast<std::size_t>(column)]; k < pattern.column_start[static_cast<std::size_t>(column) + 1]; ++k) {
      const auto e = static_cast<std::size_t>(k);
      result->col(pattern.row_index[e]) +=
          position * derivatives_.by_position[e].directions() + velocity * derivatives_.by_velocity[e].directions() +
          rate * derivatives_.by_rate[e].directions();
    }
  }
}

template <int N>
void TangentStep<N>::add_matrix_product(const Linearization<double>& d, const Directions<N>& q, const Directions<N>& s, const Directions<N>& v,
                                        Directions<N>* result) const {
  const Sparsity& pattern = system_.sparsity();
  const auto entries = [&pattern](int column) {
    return std::make_pair(pattern.column_start[static_cast<std::size_t>(column)], pattern.column_start[static_cast<std::size_t>(column) + 1]);
  };
  for (int column = 0; column < layout_.n; ++column) {
    const auto [first, last] = entries(column);
    for (int k = first; k < last; ++k) {
      const auto e = static_cast<std::size_t>(k);
      result->col(pattern.row_index[e]) += d.by_position[e] * q.col(column) + d.by_velocity[e] * v.col(column);
    }
  }
  for (int column = 0; column < layout_.states; ++column) {
    const auto [first, last] = entries(layout_.state_column(column));
    for (int k = first; k < last; ++k) {
      const auto e = static_cast<std::size_t>(k);
      result->col(pattern.row_index[e]) += d.by_position[e] * s.col(column);
    }
  }
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::integrand_product(const Linearization<double>& d, const StageTangent& u) const {
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (const auto& [column, e] : system_.integrand_entries()) {
    sum += d.by_rate[e] * u.z.col(column);
    if (column < layout_.n) sum += d.by_position[e] * u.q.col(column) + d.by_velocity[e] * u.v.col(column);
    if (column >= layout_.state_column(0)) sum += d.by_position[e] * u.s.col(column - layout_.state_column(0));
  }
  return sum;
}

template <int N>
void TangentStep<N>::solve(const StageMatrix<double>& matrix, Directions<N>* x) {
  columns_ = x->transpose();
  matrix.lu().solve(columns_.data(), N);
  *x = columns_.transpose();
}

template <int N>
void TangentStep<N>::stage_tangent(int i, const RosenbrockStep<double>& step) {
  const auto row = static_cast<std::size_t>(i);
  const double h = step.step_size(), hg = h * tableau_.gamma;
  stage_ = step.state();
  dq_ = q_;
  dv_ = v_;
  ds_ = s_;
  dz_ = z_;
  sum_q_.setZero(N, layout_.n);
  sum_v_.setZero(N, layout_.n);
  sum_s_.setZero(N, layout_.states);
  StageTangent& u = stages_[row];
  u.psi.setZero();
  for (std::size_t j = 0; j < row; ++j) {
    const double a = tableau_.a[row][j], c = tableau_.c[row][j] / h;
    const Increment<double>& increment = step.increments()[j];
    const StageTangent& earlier = stages_[j];
    stage_.q += a * increment.q;
    stage_.v += a * increment.v;
    stage_.s += a * increment.s;
    stage_.z += a * increment.z;
    dq_ += a * earlier.q;
    dv_ += a * earlier.v;
    ds_ += a * earlier.s;
    dz_ += a * earlier.z;
    sum_q_ += c * earlier.q;
    sum_v_ += c * earlier.v;
    sum_s_ += c * earlier.s;
    u.psi += c * earlier.psi;
  }
  load_lanes(stage_.q, stage_.v, stage_.s, stage_.z, dq_, dv_, ds_, dz_, &state_);
  Lanes<N> g(0.0);
  equations_.residual(state_, &residual_, &g);
  u.v = hg * (dz_.leftCols(layout_.n) + sum_v_);
  u.q = hg * (dv_ + sum_q_ + u.v);
  u.s = hg * (dz_.rightCols(layout_.states) + sum_s_);
  product_.setZero(N, layout_.columns() + 1);
  add_matrix_tangent(step.increments()[row], &product_);
  u.psi += g.directions() + product_.col(layout_.columns());
  add_matrix_product(step.derivatives(), u.q, u.s, u.v, &product_);
  for (int k = 0; k < layout_.columns(); ++k) u.z.col(k) = -(product_.col(k) + residual_[k].directions());
  solve(step.stage_matrix(), &u.z);
  u.v += hg * u.z.leftCols(layout_.n);
  u.q += hg * hg * u.z.leftCols(layout_.n);
  u.s += hg * u.z.rightCols(layout_.states);
  u.psi = hg * (u.psi + integrand_product(step.derivatives(), u)).eval();
}

template <int N>
void TangentStep<N>::advance_stages(const RosenbrockStep<double>& step) {
  equations_.turn_references() = const_cast<RosenbrockStep<double>&>(step).equations().turn_references();
  for (int i = 0; i < tableau_.stages; ++i) stage_tangent(i, step);
  for (std::size_t j = 0; j < stages_.size(); ++j) {
    const double weight = tableau_.weights[j];
    q_ += weight * stages_[j].q;
    v_ += weight * stages_[j].v;
    s_ += weight * stages_[j].s;
    z_ += weight * stages_[j].z;
    psi_ += weight * stages_[j].psi;
  }
}

template <int N>
void TangentStep<N>::advance_projection(const RosenbrockStep<double>& step) {
  const State<double>& end = step.unprojected();
  load_lanes(end.q, end.v, end.s, end.z, q_, v_, s_, z_, &state_);
  equations_.linearize(state_, &derivatives_);
  Increment<double> multipliers;
  multipliers.resize(layout_);
  const auto project = [&](const VectorX<double>& solution, const VectorX<Lanes<N>>& errors, Directions<N>* target) {
    multipliers.z = solution;
    product_.setZero(N, layout_.columns() + 1);
    add_matrix_tangent(multipliers, &product_);
    right_hand_side_ = -product_.leftCols(layout_.columns());
    for (int row = 0; row < layout_.m; ++row) right_hand_side_.col(layout_.lambda_column(row)) -= errors[row].directions();
    solve(step.projection_matrix(), &right_hand_side_);
    *target += right_hand_side_.leftCols(layout_.n);
  };
  equations_.constraint_errors(state_.q, state_.v, &errors_, &rates_);
  project(step.correction().z, errors_, &q_);
  load_lanes(step.state().q, end.v, end.s, end.z, q_, v_, s_, z_, &state_);
  equations_.constraint_errors(state_.q, state_.v, &errors_, &rates_);
  project(step.velocity_multipliers(), rates_, &v_);
}

template <int N>
Eigen::Matrix<double, N, 1> TangentStep<N>::terminal(const State<double>& state) {
  load_lanes(state.q, state.v, state.s, state.z, q_, v_, s_, z_, &state_);
  return equations_.terminal(state_, nullptr).directions();
}

template class TangentStep<4>;
template class TangentStep<8>;

}  // namespace codesign
