// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/parameter_lanes.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

/// The weight xi_k of a parameter: irrational ratios, so that contributions do not cancel by chance.
double xi(std::size_t parameter) { return 1.0 + std::fmod(0.6180339887498949 * static_cast<double>(parameter + 1), 1.0); }

}  // namespace

template <int N>
ParameterLanes<N>::ParameterLanes(const CompiledSystem& system, LaneRange<N> lanes, const LanePlan& plan)
    : system_(system), layout_(system.layout()), lanes_(lanes), plan_(plan), equations_(system) {
  derivatives_.resize(system.patterns());
  state_.resize(layout_);
  xi_.assign(static_cast<std::size_t>(layout_.columns()) + 1, Vector{});
  for (std::size_t k = 0; k < plan.lane.size(); ++k) {
    const int lane = plan.lane[k] - lanes.first;
    if (lane < 0 || lane >= lanes.count) continue;
    for (int row : plan.rows[k]) xi_[static_cast<std::size_t>(row)][lane] = xi(k);
  }
}

template <int N>
void ParameterLanes<N>::start(const std::vector<double>& parameters) {
  seeded_.assign(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < plan_.lane.size(); ++k) {
    const int lane = plan_.lane[k] - lanes_.first;
    if (lane < 0 || lane >= lanes_.count) continue;
    Scalar& parameter = seeded_[static_cast<std::size_t>(system_.study().tuned[k])];
    parameter.v[lane] = 1.0;
    parameter.v[lanes_.count] = xi(k);
  }
  equations_.set_design(seeded_);
  sums_.assign(xi_.size(), Vector{});
  largest_.assign(xi_.size(), 0.0);
  largest_error_.assign(xi_.size(), 0.0);
}

template <int N>
void ParameterLanes<N>::load(const State<double>& at) {
  cast_state(at, &state_);
}

template <int N>
void ParameterLanes<N>::add_stages(const AdjointStep& adjoint) {
  const int last = layout_.columns();
  for (const WeightedPoint& stage : adjoint.stages()) {
    load(stage.point);
    equations_.residual(state_, &G_, &g_);
    for (int row = 0; row < last; ++row) {
      const auto k = static_cast<std::size_t>(row);
      sums_[k] += stage.mu[row] * G_[row].v;
      check(k, G_[row]);
    }
    sums_.back() += stage.mu[last] * g_.v;
    check(sums_.size() - 1, g_);
  }
}

template <int N>
void ParameterLanes<N>::check(std::size_t row, const Scalar& value) {
  double expected = 0.0;
  for (int lane = 0; lane < lanes_.count; ++lane) expected += xi_[row][lane] * value.v[lane];
  const double found = value.v[lanes_.count];
  largest_[row] = std::max(largest_[row], std::abs(found));
  largest_error_[row] = std::max(largest_error_[row], std::abs(found - expected));
}

// The second tolerance allows for rounding in rows that should be zero, relative to the largest row.
template <int N>
bool ParameterLanes<N>::plan_holds() const {
  const double largest = *std::max_element(largest_.begin(), largest_.end());
  for (std::size_t row = 0; row < largest_.size(); ++row)
    if (largest_error_[row] > 1e-8 * largest_[row] + 1e-13 * largest) return false;
  return true;
}

template <int N>
void ParameterLanes<N>::add_errors(const VectorX<Scalar>& errors, const VectorX<double>& mu) {
  for (int k = 0; k < layout_.m; ++k) {
    const int row = layout_.lambda_column(k);
    sums_[static_cast<std::size_t>(row)] += mu[row] * errors[k].v;
  }
}

template <int N>
void ParameterLanes<N>::add_projection(const AdjointStep& adjoint) {
  load(adjoint.position_errors().point);
  equations_.constraint_errors(state_, &Phi_, &Phi_rate_);
  add_errors(Phi_, adjoint.position_errors().mu);
  load(adjoint.velocity_errors().point);
  equations_.constraint_errors(state_, &Phi_, &Phi_rate_);
  add_errors(Phi_rate_, adjoint.velocity_errors().mu);
}

template <int N>
void ParameterLanes<N>::add_entries(const Sparsity& pattern, const std::vector<Scalar>& values, const std::vector<double>& weights) {
  for (int row = 0; row < pattern.rows; ++row) {
    Vector sum{};
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      sum += weights[static_cast<std::size_t>(e)] * values[static_cast<std::size_t>(e)].v;
    sums_[static_cast<std::size_t>(row)] += sum;
  }
}

template <int N>
void ParameterLanes<N>::add_matrices(const State<double>& start, const AdjointStep& adjoint) {
  load(start);
  equations_.linearize(state_, &derivatives_);
  add_entries(system_.patterns().position, derivatives_.position, adjoint.matrix_weights().position);
  add_entries(system_.patterns().velocity, derivatives_.velocity, adjoint.matrix_weights().velocity);
  add_entries(system_.patterns().rate, derivatives_.rate, adjoint.matrix_weights().rate);
  for (std::size_t row = 0; row < sums_.size(); ++row) {
    const auto k = static_cast<Eigen::Index>(row);
    sums_[row] += adjoint.time_weights()[k] * derivatives_.time[k].v;
  }
}

template <int N>
void ParameterLanes<N>::collect(Eigen::VectorXd* gradient) const {
  for (std::size_t k = 0; k < plan_.lane.size(); ++k) {
    const int lane = plan_.lane[k] - lanes_.first;
    if (lane < 0 || lane >= lanes_.count) continue;
    double sum = 0.0;
    for (int row : plan_.rows[k]) sum += sums_[static_cast<std::size_t>(row)][lane];
    (*gradient)[static_cast<Eigen::Index>(k)] += sum;
  }
}

template class ParameterLanes<4>;
template class ParameterLanes<8>;

}  // namespace codesign
