// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/recorded_equations.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "equations/equation_code.h"
#include "math/to_index.h"
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
std::vector<JacobianInput> inputs_of(Recording* recording, const Columns& columns, bool rates_only = false) {
  std::vector<JacobianInput> inputs;
  for (int n = 0, size = recording->size(); n < size; ++n) {
    const Recording::Node node = recording->node(n);
    if (node.operation != Operation::kLeaf || (rates_only && node.a != Arrays::kZ)) continue;
    if (node.a == Arrays::kQ) inputs.push_back({n, node.b, 1.0});
    if (node.a == Arrays::kS) inputs.push_back({n, columns.velocities + node.b, 1.0});
    if (node.a == Arrays::kV) inputs.push_back({n, columns.velocity() + node.b, 1.0});
    if (node.a == Arrays::kZ) inputs.push_back({n, columns.rate() + node.b, 1.0});
    // The derivative of a function of time is the next order of the same function.
    if (node.a == Recording::kTimed && node.b % Recording::kFunctionOrders + 1 < Recording::kFunctionOrders)
      inputs.push_back({n, columns.time(), Traced(recording, recording->leaf(Recording::kTimed, node.b + 1, true))});
  }
  return inputs;
}

void put(const Sparsity& pattern, int row, int column, const Traced& value, std::vector<Traced>* values) {
  const auto first = pattern.column_index.begin() + pattern.first(row), last = pattern.column_index.begin() + pattern.first(row + 1);
  const auto entry = std::lower_bound(first, last, column);
  if (entry == last || *entry != column)
    throw std::logic_error("derivative (" + std::to_string(row) + ", " + std::to_string(column) + ") is outside the pattern");
  (*values)[static_cast<std::size_t>(entry - pattern.column_index.begin())] = value;
}

}  // namespace

RecordedEquations::RecordedEquations(const System& system, Recording* to) : recording(to), formulas(system) {
  // One parameter more than there are: with a model without parameters nothing else would refer to the recording.
  const int parameter = recording->leaf(Recording::kSupplied, -1, false);
  std::vector<Traced> parameters;
  for (double value : system.parameters()) parameters.emplace_back(recording, parameter, value);
  parameters.emplace_back(recording, parameter, 0.0);
  formulas.set_design(parameters);
  state.resize(system.layout());
  for (std::size_t k = 0; k < state.turns.size(); ++k)
    state.turns[k] = Traced(recording, recording->leaf(kTurns, static_cast<int>(k), true));
  // Results must depend on time through functions of time alone: a NaN that is used refuses the recording.
  state.t = std::numeric_limits<double>::quiet_NaN();
  make_leaves(Arrays::kQ, recording, &state.q), make_leaves(Arrays::kV, recording, &state.v);
  make_leaves(Arrays::kS, recording, &state.s), make_leaves(Arrays::kZ, recording, &state.z);
}

void RecordedEquations::record_placement(VectorX<Traced>* q, VectorX<Traced>* v) {
  const StateView<Traced>& view = formulas.view();
  const TreeLayout tree(view.system.robot());
  VectorX<Traced> theta(tree.size), rate(tree.size);
  make_leaves(Arrays::kQ, recording, &theta), make_leaves(Arrays::kV, recording, &rate);
  state_coordinates(view.system, tree, view.design.constants, link_motions(view.system.robot(), tree, view.design.parameters, theta, rate),
                    theta, rate, q, v);
}

std::vector<JacobianEntry> derive_gradients(const System& system, const std::vector<Traced>& values, EliminationOrder order,
                                            Recording* recording) {
  std::vector<int> outputs;
  for (const Traced& value : values) outputs.push_back(value.node_in(recording));
  const Layout& layout = system.layout();
  return derive_jacobian(recording, outputs, inputs_of(recording, {layout.positions(), layout.n, layout.columns()}), order);
}

Linearization<Traced> derive_linearization(const ByVariable<Sparsity>& patterns, EliminationOrder order, bool rates_only,
                                           RecordedEquations* recorded) {
  Recording* const recording = recorded->recording;
  const Columns columns{patterns.position.columns, patterns.velocity.columns, patterns.rate.columns};
  std::vector<int> outputs;
  for (const Traced& row : recorded->G) outputs.push_back(row.node_in(recording));
  outputs.push_back(recorded->g.node_in(recording));
  Linearization<Traced> derivatives;
  derivatives.resize(patterns);
  for (const JacobianEntry& entry : derive_jacobian(recording, outputs, inputs_of(recording, columns, rates_only), order)) {
    if (entry.column < columns.velocity())
      put(patterns.position, entry.row, entry.column, entry.value, &derivatives.position);
    else if (entry.column < columns.rate())
      put(patterns.velocity, entry.row, entry.column - columns.velocity(), entry.value, &derivatives.velocity);
    else if (entry.column < columns.time())
      put(patterns.rate, entry.row, entry.column - columns.rate(), entry.value, &derivatives.rate);
    else
      derivatives.time[entry.row] = entry.value;
  }
  return derivatives;
}

}  // namespace codesign
