// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compressed_jacobian.h"

#include <algorithm>
#include <numeric>

#include "math/arrays.h"

namespace codesign {
namespace {

/// A column of one of the matrices, or of all of them side by side.
struct Column {
  int variable, index;  ///< 0: (q, s), 1: v, 2: z
  std::vector<int> rows, entries;
};

std::vector<Column> columns_of(const std::array<const Sparsity*, 3>& patterns) {
  std::vector<Column> columns;
  for (int variable = 0; variable < 3; ++variable) {
    const Sparsity* const pattern = patterns[to_index(variable)];
    if (!pattern) continue;
    const std::size_t first = columns.size();
    for (int index = 0; index < pattern->columns; ++index)
      columns.push_back({variable, index, {}, {}});
    for (int row = 0; row < pattern->rows; ++row)
      for (int e = pattern->first(row); e < pattern->first(row + 1); ++e) {
        Column& column = columns[first + to_index(pattern->column(e))];
        column.rows.push_back(row);
        column.entries.push_back(e);
      }
  }
  return columns;
}

/// The group of each column, so that columns of a group share no row: each one, the fullest first,
/// goes to the first group with room.
std::vector<int> group(const std::vector<Column>& columns, int rows) {
  std::vector<int> order(columns.size()), groups(columns.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) {
    return columns[to_index(x)].rows.size() > columns[to_index(y)].rows.size();
  });
  std::vector<std::vector<bool>> taken;
  for (int k : order) {
    const std::vector<int>& own = columns[to_index(k)].rows;
    const auto has_room = [&own](const std::vector<bool>& by) {
      return std::none_of(own.begin(), own.end(), [&by](int row) { return by[to_index(row)]; });
    };
    auto place = std::find_if(taken.begin(), taken.end(), has_room);
    if (place == taken.end()) place = taken.insert(taken.end(), std::vector<bool>(to_index(rows)));
    for (int row : own) (*place)[to_index(row)] = true;
    groups[to_index(k)] = static_cast<int>(place - taken.begin());
  }
  return groups;
}

}  // namespace

CompressedJacobian::CompressedJacobian(const CompiledSystem& system)
    : system_(system),
      rows_(system.patterns().rate.rows),
      tangents_(system),
      all_(compress(
          {&system.patterns().position, &system.patterns().velocity, &system.patterns().rate})),
      rates_(compress({nullptr, nullptr, &system.patterns().rate})) {
  all_.seeds.push_back(no_directions());
  results_.resize(all_.seeds.size() * to_index(rows_ * kLanes));
  add_passes(&all_);
  add_passes(&rates_);
  time_ = all_.passes.back();
  all_.passes.pop_back();
}

std::array<LineVector, 4> CompressedJacobian::no_directions() const {
  const Layout& layout = system_.layout();
  const auto zeros = [](int size) { return LineVector(to_index(size * kLanes)); };
  return {zeros(layout.n), zeros(layout.n), zeros(layout.positions() - layout.n),
          zeros(layout.columns())};
}

CompressedJacobian::Compression CompressedJacobian::compress(
    const ByVariable<const Sparsity*>& patterns) const {
  Compression result;
  const std::array<const Sparsity*, 3> given{patterns.position, patterns.velocity, patterns.rate};
  const std::array<std::vector<int>*, 3> places{&result.places.position, &result.places.velocity,
                                                &result.places.rate};
  for (std::size_t k = 0; k < 3; ++k)
    if (given[k]) places[k]->resize(given[k]->column_index.size());
  const int n = system_.layout().n;
  const std::vector<Column> columns = columns_of(given);
  const std::vector<int> groups = group(columns, rows_);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Column& column = columns[k];
    const int pass = groups[k] / kLanes, lane = groups[k] % kLanes;
    while (static_cast<int>(result.seeds.size()) <= pass) result.seeds.push_back(no_directions());
    const bool is_s = column.variable == 0 && column.index >= n;
    const std::size_t part = is_s ? 2 : column.variable == 2 ? 3 : to_index(column.variable);
    result.seeds[to_index(pass)][part]
                [to_index((is_s ? column.index - n : column.index) * kLanes + lane)] = 1.0;
    for (std::size_t i = 0; i < column.rows.size(); ++i)
      (*places[to_index(column.variable)])[to_index(column.entries[i])] =
          (pass * rows_ + column.rows[i]) * kLanes + lane;
  }
  return result;
}

void CompressedJacobian::set_design(const std::vector<double>& parameters) {
  parameters_.assign(parameters.begin(), parameters.end());
  tangents_.set_design(parameters_);
}

void CompressedJacobian::add_passes(Compression* compression) {
  const std::ptrdiff_t of_G = std::ptrdiff_t{kLanes} * (rows_ - 1);
  double* first = results_.data();
  for (const auto& [q, v, s, z] : compression->seeds) {
    compression->passes.push_back(
        {{q, v, s, z}, {Out<double>(first, of_G), Out<double>(first + of_G, kLanes), {}, {}}});
    first += of_G + kLanes;
  }
}

void CompressedJacobian::gather(const std::vector<int>& places, std::vector<double>* values) const {
  for (std::size_t e = 0; e < places.size(); ++e) (*values)[e] = results_[to_index(places[e])];
}

void CompressedJacobian::linearize(const State<double>& state, Linearization<double>* derivatives) {
  const bool depends_on_time = tangents_.residual_tangents(state, all_.passes, &time_);
  const double* const by_time = time_.results[0].data();
  for (int row = 0; row < rows_; ++row)
    derivatives->time[row] = depends_on_time ? by_time[std::ptrdiff_t{kLanes} * row] : 0.0;
  gather(all_.places.position, &derivatives->position);
  gather(all_.places.velocity, &derivatives->velocity);
  gather(all_.places.rate, &derivatives->rate);
}

void CompressedJacobian::rates(const State<double>& state, Linearization<double>* derivatives) {
  tangents_.residual_tangents(state, rates_.passes, nullptr);
  gather(rates_.places.rate, &derivatives->rate);
}

}  // namespace codesign
