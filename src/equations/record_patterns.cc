// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/record_patterns.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "equations/equation_code.h"
#include "equations/recorded_equations.h"
#include "math/to_index.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;
using ColumnSet = std::vector<int>;

ColumnSet merged(const ColumnSet& x, const ColumnSet& y) {
  ColumnSet both;
  std::set_union(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
  return both;
}

/// The columns of (q, s), v and z side by side that each node depends on. Most nodes share their sets with others.
class Dependencies {
 public:
  Dependencies(const Recording& recording, const Layout& layout);

  const ColumnSet& of(int node) const { return sets_[to_index(set_of_[to_index(node)])]; }

 private:
  static constexpr int kEmpty = 0;

  int add(ColumnSet set) {
    sets_.push_back(std::move(set));
    return static_cast<int>(sets_.size()) - 1;
  }
  int unite(int x, int y) {
    if (x > y) std::swap(x, y);
    if (x == y || x == kEmpty) return y;
    const auto [known, is_new] = united_.try_emplace((static_cast<std::uint64_t>(x) << 32U) | static_cast<std::uint64_t>(y), kEmpty);
    if (is_new) {
      ColumnSet both = merged(sets_[to_index(x)], sets_[to_index(y)]);
      const bool is_x = both.size() == sets_[to_index(x)].size(), is_y = both.size() == sets_[to_index(y)].size();
      known->second = is_x ? x : is_y ? y : add(std::move(both));
    }
    return known->second;
  }

  std::vector<ColumnSet> sets_;
  std::vector<int> set_of_;  ///< per node: index among sets_
  std::unordered_map<std::uint64_t, int> united_;
};

Dependencies::Dependencies(const Recording& recording, const Layout& layout) : sets_(1), set_of_(to_index(recording.size()), kEmpty) {
  const int positions = layout.positions();
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    int& set = set_of_[to_index(n)];
    if (node.operation == Operation::kLeaf) {
      if (node.a == Arrays::kQ) set = add({node.b});
      if (node.a == Arrays::kS) set = add({layout.n + node.b});
      if (node.a == Arrays::kV) set = add({positions + node.b});
      if (node.a == Arrays::kZ) set = add({positions + layout.n + node.b});
    } else if (node.varies && node.operation != Operation::kRound) {
      set = node.b < 0 ? set_of_[to_index(node.a)] : unite(set_of_[to_index(node.a)], set_of_[to_index(node.b)]);
    }
  }
}

using Turned = std::function<bool(unsigned)>;

/// Adds the columns that each row depends on if the decisions at some places are turned round. @return the places of all decisions.
std::vector<unsigned> add_rows(const System& system, Turned turned, std::vector<ColumnSet>* rows) {
  Recording recording;
  recording.turn(std::move(turned));
  RecordedEquations equations(system, &recording);
  equations.record_residual();
  const Dependencies dependencies(recording, system.layout());
  const auto add = [&](std::size_t row, const Traced& value) {
    if (!value.is_literal()) (*rows)[row] = merged((*rows)[row], dependencies.of(value.node()));
  };
  for (Eigen::Index row = 0; row < equations.G.size(); ++row) add(static_cast<std::size_t>(row), equations.G[row]);
  add(rows->size() - 1, equations.g);
  return recording.places();
}

// Turned round: none, all, each place alone, all but each place. So every combination of up to three places that follow one another in one
// law is seen, and every joint takes part at once.
void add_all_branches(const System& system, std::vector<ColumnSet>* rows) {
  std::vector<unsigned> places = add_rows(system, nullptr, rows);
  if (places.empty()) return;
  const auto find_more = [&](Turned turned) {
    for (unsigned place : add_rows(system, std::move(turned), rows))
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  };
  find_more([](unsigned) { return true; });
  for (std::size_t k = 0; k < places.size(); ++k) {
    const unsigned place = places[k];
    find_more([place](unsigned other) { return other == place; });
    find_more([place](unsigned other) { return other != place; });
  }
}

Sparsity part_of(const std::vector<ColumnSet>& rows, int first, int count) {
  Sparsity pattern{static_cast<int>(rows.size()), count, {0}, {}};
  for (const ColumnSet& row : rows) {
    for (int column : row)
      if (column >= first && column < first + count) pattern.column_index.push_back(column - first);
    pattern.row_start.push_back(pattern.nonzeros());
  }
  return pattern;
}

}  // namespace

ByVariable<Sparsity> record_patterns(const System& system) {
  const Layout& layout = system.layout();
  std::vector<ColumnSet> rows(to_index(layout.columns()) + 1);
  add_all_branches(system, &rows);
  const int positions = layout.positions();
  return {part_of(rows, 0, positions), part_of(rows, positions, layout.n), part_of(rows, positions + layout.n, layout.columns())};
}

}  // namespace codesign
