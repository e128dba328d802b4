// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equation_recorder.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "equations/equation_variant.h"
#include "math/arrays.h"
#include "system/tree_kinematics.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

void make_leaves(int array, Recording* recording, VectorX<Traced>* x) {
  for (int k = 0; k < x->size(); ++k) (*x)[k] = Traced(recording, recording->leaf(array, k, true));
}

/// The columns of all derivatives side by side: (q, s), v, z, t.
struct Columns {
  int positions, velocities, rates;

  int velocity() const { return positions; }
  int rate() const { return positions + velocities; }
  int time() const { return positions + velocities + rates; }
};

/// @param rates_only whether z is the only variable.
std::vector<JacobianInput> inputs_of(Recording* recording, const Columns& columns,
                                     bool rates_only = false) {
  std::vector<JacobianInput> inputs;
  for (int n = 0, size = recording->size(); n < size; ++n) {
    const Recording::Node node = recording->node(n);
    if (node.operation != Operation::kLeaf || (rates_only && node.a != Arrays::kZ)) continue;
    if (node.a == Arrays::kQ) inputs.push_back({n, node.b, 1.0});
    if (node.a == Arrays::kS) inputs.push_back({n, columns.velocities + node.b, 1.0});
    if (node.a == Arrays::kV) inputs.push_back({n, columns.velocity() + node.b, 1.0});
    if (node.a == Arrays::kZ) inputs.push_back({n, columns.rate() + node.b, 1.0});
    // The derivative of a function of time is the next order of the same function.
    if (node.a == Recording::kTimed &&
        node.b % Recording::kFunctionOrders + 1 < Recording::kFunctionOrders)
      inputs.push_back({n, columns.time(),
                        Traced(recording, recording->leaf(Recording::kTimed, node.b + 1, true))});
  }
  return inputs;
}

void put(const Sparsity& pattern, int row, int column, const Traced& value,
         std::vector<Traced>* values) {
  const auto first = pattern.column_index.begin() + pattern.first(row),
             last = pattern.column_index.begin() + pattern.first(row + 1);
  const auto entry = std::lower_bound(first, last, column);
  if (entry == last || *entry != column)
    throw std::logic_error("derivative (" + std::to_string(row) + ", " + std::to_string(column) +
                           ") is outside the pattern");
  (*values)[to_index(entry - pattern.column_index.begin())] = value;
}

using Arrays = EquationArrays;
using ColumnSet = std::vector<int>;

ColumnSet merged(const ColumnSet& x, const ColumnSet& y) {
  ColumnSet both;
  both.reserve(x.size() + y.size());
  std::set_union(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
  return both;
}

/// The columns of (q, s), v and z side by side that each node depends on. Most nodes share their
/// sets with others.
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
    const auto [known, is_new] = united_.try_emplace(
        (static_cast<std::uint64_t>(x) << 32U) | static_cast<std::uint64_t>(y), kEmpty);
    if (is_new) {
      ColumnSet both = merged(sets_[to_index(x)], sets_[to_index(y)]);
      const bool is_x = both.size() == sets_[to_index(x)].size(),
                 is_y = both.size() == sets_[to_index(y)].size();
      known->second = is_x ? x : is_y ? y : add(std::move(both));
    }
    return known->second;
  }

  std::vector<ColumnSet> sets_;
  std::vector<int> set_of_;  ///< per node: index among sets_
  std::unordered_map<std::uint64_t, int> united_;
};

Dependencies::Dependencies(const Recording& recording, const Layout& layout)
    : sets_(1), set_of_(to_index(recording.size()), kEmpty) {
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
      set = node.b < 0 ? set_of_[to_index(node.a)]
                       : unite(set_of_[to_index(node.a)], set_of_[to_index(node.b)]);
    }
  }
}

using Turned = std::function<bool(unsigned)>;

/// Adds the columns that each row depends on in one recording of the residual.
void add_rows(const System& system, const EquationRecorder& equations,
              std::vector<ColumnSet>* rows) {
  const Dependencies dependencies(*equations.recording, system.layout());
  const auto add = [&](std::size_t row, const Traced& value) {
    if (!value.is_literal()) (*rows)[row] = merged((*rows)[row], dependencies.of(value.node()));
  };
  for (Eigen::Index row = 0; row < equations.G.size(); ++row) add(to_index(row), equations.G[row]);
  add(rows->size() - 1, equations.g);
}

// Turned round: all, each place alone, all but each place. So every combination of up to three
// places that follow one another in one law is seen, and every joint takes part at once.
// Expressions, in which any number may follow one another, show all of theirs in each recording.
void add_all_branches(const System& system, const ResidualRecording& expected,
                      std::vector<ColumnSet>* rows) {
  add_rows(system, expected.equations, rows);
  std::vector<unsigned> places = expected.recording.places();
  if (places.empty()) return;
  const auto find_more = [&](Turned turned) {
    Recording recording;
    recording.turn(std::move(turned));
    recording.take_all_branches();
    EquationRecorder equations(system, &recording);
    equations.record_residual();
    add_rows(system, equations, rows);
    for (unsigned place : recording.places())
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

EquationRecorder::EquationRecorder(const System& system, Recording* to)
    : recording(to), formulas(system) {
  // One parameter more than there are: with a model without parameters nothing else would refer to
  // the recording.
  const int parameter = recording->leaf(Recording::kSupplied, -1, false);
  std::vector<Traced> parameters;
  for (double value : system.parameters()) parameters.emplace_back(recording, parameter, value);
  parameters.emplace_back(recording, parameter, 0.0);
  formulas.set_design(parameters);
  state.resize(system.layout());
  for (std::size_t k = 0; k < state.turns.size(); ++k)
    state.turns[k] = Traced(recording, recording->leaf(kTurns, static_cast<int>(k), true));
  // Results must depend on time through functions of time alone: a NaN that is used refuses the
  // recording.
  state.t = std::numeric_limits<double>::quiet_NaN();
  make_leaves(Arrays::kQ, recording, &state.q), make_leaves(Arrays::kV, recording, &state.v);
  make_leaves(Arrays::kS, recording, &state.s), make_leaves(Arrays::kZ, recording, &state.z);
}

ResidualRecording::ResidualRecording(const System& system, std::vector<bool> outcomes,
                                     std::vector<bool> mode)
    : equations(system, (recording.follow(std::move(outcomes)), recording.hold(std::move(mode)),
                         &recording)),
      of_design(recording.decisions().size()) {
  recording.record_switches(true);
  // First, so that its comparisons are switches also where a law decides the same thing.
  ends_run = equations.formulas.until(equations.state).is(1.0);
  equations.formulas.watch_switches(equations.state);
  equations.record_residual();
  recording.record_switches(false);
}

std::vector<VectorX<Traced>> EquationRecorder::record_stuck_slips() {
  std::vector<VectorX<Traced>> slips(2);
  formulas.load(state);
  formulas.stuck_slips(&slips[0], &slips[1]);
  return slips;
}

// The formulas go on reading `state`, so its references are put back.
std::vector<VectorX<Traced>> EquationRecorder::record_turns() {
  const auto references = state.turns;
  formulas.track_turns(&state);
  const auto positions = std::exchange(state.turns, references);
  const Layout& layout = formulas.view().layout;
  return {Eigen::Map<const VectorX<Traced>>(positions.data(), layout.drop_slot)};
}

std::vector<VectorX<Traced>> EquationRecorder::record_placement() {
  std::vector<VectorX<Traced>> motion(2);
  const StateView<Traced>& view = formulas.view();
  const TreeLayout tree(view.system.robot());
  VectorX<Traced> theta(tree.size), rate(tree.size);
  make_leaves(Arrays::kQ, recording, &theta), make_leaves(Arrays::kV, recording, &rate);
  state_coordinates(view.system, tree, view.design.constants,
                    link_motions(view.system.robot(), tree, view.design.parameters, theta, rate),
                    theta, rate, &motion[0], &motion[1]);
  return motion;
}

std::vector<JacobianEntry> derive_gradients(const System& system, const std::vector<Traced>& values,
                                            EliminationOrder order, Recording* recording) {
  std::vector<int> outputs;
  for (const Traced& value : values) outputs.push_back(value.node_in(recording));
  const Layout& layout = system.layout();
  return derive_jacobian(recording, outputs,
                         inputs_of(recording, {layout.positions(), layout.n, layout.columns()}),
                         order);
}

Linearization<Traced> derive_linearization(const ByVariable<Sparsity>& patterns,
                                           EliminationOrder order, bool rates_only,
                                           EquationRecorder* recorded) {
  Recording* const recording = recorded->recording;
  const Columns columns{patterns.position.columns, patterns.velocity.columns,
                        patterns.rate.columns};
  std::vector<int> outputs;
  for (const Traced& row : recorded->G) outputs.push_back(row.node_in(recording));
  outputs.push_back(recorded->g.node_in(recording));
  Linearization<Traced> derivatives;
  derivatives.resize(patterns);
  for (const JacobianEntry& entry :
       derive_jacobian(recording, outputs, inputs_of(recording, columns, rates_only), order)) {
    if (entry.column < columns.velocity())
      put(patterns.position, entry.row, entry.column, entry.value, &derivatives.position);
    else if (entry.column < columns.rate())
      put(patterns.velocity, entry.row, entry.column - columns.velocity(), entry.value,
          &derivatives.velocity);
    else if (entry.column < columns.time())
      put(patterns.rate, entry.row, entry.column - columns.rate(), entry.value, &derivatives.rate);
    else
      derivatives.time[entry.row] = entry.value;
  }
  return derivatives;
}

ByVariable<Sparsity> record_patterns(const System& system, const ResidualRecording& expected) {
  const Layout& layout = system.layout();
  std::vector<ColumnSet> rows(to_index(layout.columns()) + 1);
  add_all_branches(system, expected, &rows);
  const int positions = layout.positions();
  return {part_of(rows, 0, positions), part_of(rows, positions, layout.n),
          part_of(rows, positions + layout.n, layout.columns())};
}

}  // namespace codesign
