// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/lane_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include "assembly/assembly.h"
#include "sensitivity/lane_groups.h"
#include "text/cancel.h"

namespace codesign {
namespace {

constexpr int kWidth = 8;
using Scalar = Lanes<kWidth>;
constexpr int kInstants = 64;  // instants tried for parameters without rows at t = 0, such as coefficients of a basis

/// Finds the rows whose derivative along a lane is NaN, for `kWidth` parameters at a time.
class RowProbe {
 public:
  explicit RowProbe(const CompiledSystem& system) : system_(system), layout_(system.layout()), equations_(system) {
    derivatives_.resize(system.patterns());
    state_.resize(layout_);
  }

  void find(const std::vector<Scalar>& parameters, const State<double>& at) {
    touched_.assign(static_cast<std::size_t>(layout_.columns()) + 1, Scalar(0.0));
    equations_.set_design(parameters);
    cast_state(at, &state_);
    VectorX<Scalar> G, Phi, Phi_rate;
    Scalar g(0.0);
    equations_.residual(state_, &G, &g);
    for (int row = 0; row < layout_.columns(); ++row) touch(row, G[row]);
    touch(layout_.columns(), g);
    equations_.linearize(state_, &derivatives_);
    touch(system_.patterns().position, derivatives_.position);
    touch(system_.patterns().velocity, derivatives_.velocity);
    touch(system_.patterns().rate, derivatives_.rate);
    for (int row = 0; row <= layout_.columns(); ++row) touch(row, derivatives_.time[row]);
    equations_.constraint_errors(state_, &Phi, &Phi_rate);
    for (int row = 0; row < layout_.m; ++row) touch(layout_.lambda_column(row), Phi[row] + Phi_rate[row]);
  }

  std::vector<int> rows(int lane) const {
    std::vector<int> rows;
    for (std::size_t row = 0; row < touched_.size(); ++row)
      if (std::isnan(touched_[row].v[lane])) rows.push_back(static_cast<int>(row));
    return rows;
  }

 private:
  void touch(int row, const Scalar& x) { touched_[static_cast<std::size_t>(row)].v += x.v; }
  void touch(const Sparsity& pattern, const std::vector<Scalar>& values) {
    for (int row = 0; row < pattern.rows; ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) touch(row, values[static_cast<std::size_t>(e)]);
  }

  const CompiledSystem& system_;
  const Layout& layout_;
  Equations<Scalar> equations_;
  Linearization<Scalar> derivatives_;
  State<Scalar> state_;
  std::vector<Scalar> touched_;
};

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

}  // namespace

std::vector<std::vector<int>> dependent_rows(const CompiledSystem& system, const std::vector<double>& parameters, const State<double>& at,
                                             const std::atomic<bool>* cancel) {
  std::vector<std::vector<int>> rows;
  RowProbe probe(system);
  const int count = static_cast<int>(system.study().tuned.size());
  for (int first = 0; first < count && !is_set(cancel); first += kWidth) {
    const LaneRange<kWidth> range{first, std::min(kWidth, count - first)};
    std::vector<Scalar> lanes = range.seed(system, parameters);
    for (Scalar& lane : lanes)
      for (int k = 0; k < range.count; ++k)
        if (lane.v[k] != 0.0) lane.v[k] = std::numeric_limits<double>::quiet_NaN();
    probe.find(lanes, at);
    for (int k = 0; k < range.count; ++k) rows.push_back(probe.rows(k));
  }
  rows.resize(static_cast<std::size_t>(count));
  return rows;
}

LanePlan plan_lanes(std::vector<std::vector<int>> rows) {
  LanePlan plan;
  plan.rows = std::move(rows);
  plan.lane.assign(plan.rows.size(), -1);
  std::vector<std::size_t> order(plan.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return plan.rows[a].size() > plan.rows[b].size(); });
  std::map<int, std::vector<bool>> taken;  // per row: which lanes are in use
  for (std::size_t k : order) {
    std::size_t lane = 0;
    const auto is_taken = [&](int row) { return lane < taken[row].size() && taken[row][lane]; };
    while (std::any_of(plan.rows[k].begin(), plan.rows[k].end(), is_taken)) ++lane;
    for (int row : plan.rows[k]) {
      if (taken[row].size() <= lane) taken[row].resize(lane + 1, false);
      taken[row][lane] = true;
    }
    plan.lane[k] = static_cast<int>(lane);
    plan.lanes = std::max(plan.lanes, plan.lane[k] + 1);
  }
  return plan;
}

LanePlan unshared_lanes(const CompiledSystem& system) {
  LanePlan plan;
  std::vector<int> all(static_cast<std::size_t>(system.layout().columns()) + 1);
  std::iota(all.begin(), all.end(), 0);
  plan.lanes = static_cast<int>(system.study().tuned.size());
  plan.rows.assign(system.study().tuned.size(), all);
  for (int lane = 0; lane < plan.lanes; ++lane) plan.lane.push_back(lane);
  return plan;
}

LanePlan plan_lanes(const CompiledSystem& system, const std::atomic<bool>* cancel) {
  const std::vector<double> parameters = system.parameters();
  Equations<double> equations(system);
  equations.set_design(parameters);
  Assembly assembly(system);
  assembly.obey(cancel);
  State<double> at;
  assembly.solve(parameters, &equations, &at);
  std::vector<std::vector<int>> rows = dependent_rows(system, parameters, at, cancel);
  const auto hidden = [](const std::vector<int>& found) { return found.empty(); };
  for (int k = 1; k <= kInstants && !is_set(cancel) && std::any_of(rows.begin(), rows.end(), hidden); ++k) {
    at.t = system.study().duration * k / kInstants;
    const std::vector<std::vector<int>> then = dependent_rows(system, parameters, at, cancel);
    for (std::size_t parameter = 0; parameter < rows.size(); ++parameter) rows[parameter] = united(rows[parameter], then[parameter]);
  }
  return plan_lanes(std::move(rows));
}

}  // namespace codesign
