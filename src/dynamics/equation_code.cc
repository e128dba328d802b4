// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/equation_code.h"

#include <algorithm>
#include <limits>

#include "mechanism_codesign/dynamics/equations.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

// Beyond these, code is longer than caches, and takes seconds to make.
constexpr int kMostColumns = 4000;
constexpr std::size_t kMostBytes = 16 * 1024 * 1024;

constexpr int kTurns = 102;  // array of the leaves that count turns, beside those of Recording

std::size_t at(int k) { return static_cast<std::size_t>(k); }

void leaves(int array, Recording* recording, VectorX<Traced>* x) {
  for (int k = 0; k < x->size(); ++k) (*x)[k] = Traced(recording, recording->leaf(array, k, true));
}

/// A place of the arrays as doubles: Lanes lie lanes + 1 numbers apart.
Place spread(const Place& place, int lanes) {
  if (place.array < 0 || place.array >= Arrays::kSlots) return place;
  return {place.array, place.index * (lanes + 1)};
}

}  // namespace

EquationCode::EquationCode(const System& system) {
  if (!ValueCode::is_available() || system.layout().columns() > kMostColumns) {
    recording_.refuse();
    return;
  }
  record(system);
  if (recording_.refused()) return;
  differentiate();
  number_nodes();
}

void EquationCode::record(const System& system) {
  Equations<Traced> equations(system);
  // One more than there are, so that a model without parameters finds the recording too.
  const int parameter = recording_.leaf(Recording::kSupplied, -1, false);
  std::vector<Traced> parameters;
  for (double value : system.parameters()) parameters.emplace_back(&recording_, parameter, value);
  parameters.emplace_back(&recording_, parameter, 0.0);
  equations.set_design(parameters);
  std::vector<std::vector<Traced>>& turns = equations.turn_references();
  for (std::size_t pair = 0; pair < turns.size(); ++pair)
    for (std::size_t element = 0; element < turns[pair].size(); ++element) {
      turns[pair][element] = Traced(&recording_, recording_.leaf(kTurns, static_cast<int>(turn_owners_.size()), true));
      turn_owners_.push_back({static_cast<int>(pair), static_cast<int>(element)});
    }
  State<Traced> state;
  state.resize(system.layout());
  state.t = std::numeric_limits<double>::quiet_NaN();  // only functions of time may depend on it
  leaves(Arrays::kQ, &recording_, &state.q), leaves(Arrays::kV, &recording_, &state.v);
  leaves(Arrays::kS, &recording_, &state.s), leaves(Arrays::kZ, &recording_, &state.z);

  Recorded design;
  take_guards(0, &design);

  std::size_t guards = recording_.guards().size();
  VectorX<Traced> G, Phi, Phi_rate, g(1);
  equations.residual(state, &G, g.data());
  take(EquationFunction::kResidual, {&G, &g}, &guards);
  Linearization<Traced> derivatives;
  derivatives.resize(system.patterns());
  equations.linearize(state, &derivatives);
  const auto vector = [](const std::vector<Traced>& x) -> VectorX<Traced> {
    return Eigen::Map<const VectorX<Traced>>(x.data(), static_cast<Eigen::Index>(x.size()));
  };
  const VectorX<Traced> by_position = vector(derivatives.position), by_velocity = vector(derivatives.velocity),
                        by_rate = vector(derivatives.rate);
  take(EquationFunction::kLinearization, {&by_position, &by_velocity, &by_rate, &derivatives.time}, &guards);
  equations.constraint_errors(state.q, state.v, &Phi, &Phi_rate);
  take(EquationFunction::kConstraintErrors, {&Phi, &Phi_rate}, &guards);
}

void EquationCode::take(EquationFunction function, const std::vector<const VectorX<Traced>*>& results, std::size_t* guards) {
  Recorded& recorded = functions_[static_cast<std::size_t>(function)];
  take_guards(*guards, &recorded);
  *guards = recording_.guards().size();
  for (std::size_t k = 0; k < results.size(); ++k)
    for (Eigen::Index i = 0; i < results[k]->size(); ++i)
      recorded.outputs.push_back({(*results[k])[i].node_in(&recording_), {Arrays::kResults + static_cast<int>(k), static_cast<int>(i)}});
}

void EquationCode::take_guards(std::size_t first, Recorded* function) {
  for (std::size_t k = first; k < recording_.guards().size(); ++k) {
    const Recording::Guard& guard = recording_.guards()[k];
    const bool varies = recording_.node(guard.a).varies || recording_.node(guard.b).varies;
    (varies ? function->guards : design_guards_).push_back(guard);
  }
}

// What does not vary is a leaf to the tangents: its derivative is found with the design.
void EquationCode::differentiate() {
  for (Recorded& function : functions_) {
    std::vector<bool> is_leaf(at(recording_.size()));
    for (int n = 0; n < recording_.size(); ++n) {
      const Recording::Node& node = recording_.node(n);
      const bool given = node.operation == Operation::kLeaf && node.a != kTurns;
      is_leaf[at(n)] = given || (!node.varies && node.operation != Operation::kLiteral);
    }
    function.tangent = std::make_unique<TangentProgram>(&recording_, function.outputs, is_leaf);
  }
}

bool EquationCode::is_number(int n) const {
  const Recording::Node& node = recording_.node(n);
  return !node.varies || (node.operation == Operation::kLeaf && node.a >= Recording::kSupplied);
}

void EquationCode::number_nodes() {
  instant_.functions.resize(recording_.timed_origins().size());
  for (auto& orders : instant_.functions) orders.fill(-1);
  homes_.resize(at(recording_.size()));
  std::vector<bool> used(homes_.size());
  for (int n = 0; n < recording_.size(); ++n) {
    const Recording::Node& node = recording_.node(n);
    if (node.operation == Operation::kLeaf) continue;
    for (int operand : {node.a, node.b})
      if (operand >= 0) used[at(operand)] = true;
  }
  for (int n = 0; n < recording_.size(); ++n) {
    const Recording::Node& node = recording_.node(n);
    if (!is_number(n)) {
      if (node.operation == Operation::kLeaf) homes_[at(n)] = {node.a, node.b};
      continue;
    }
    const auto entry = static_cast<int>(numbers_.size());
    homes_[at(n)] = {Arrays::kNumbers, entry};
    numbers_.push_back(n);
    if (node.operation != Operation::kLeaf) continue;
    if (node.a == Recording::kTimed)
      instant_.functions[at(node.b / Recording::kFunctionOrders)][at(node.b % Recording::kFunctionOrders)] = entry;
    if (node.a == kTurns && used[at(n)]) instant_.turns.push_back({turn_owners_[at(node.b)][0], turn_owners_[at(node.b)][1], entry});
  }
}

const CompiledFunction* EquationCode::function(EquationFunction function, const Scalar& scalar) const {
  const auto f = static_cast<std::size_t>(function);
  Known& known = known_[f][at(scalar.lanes / 4 + (scalar.split ? 2 : 0))];
  if (!known.tried.load(std::memory_order_acquire)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!known.tried.load(std::memory_order_relaxed)) known.code = compile(functions_[f], scalar);
    known.tried.store(true, std::memory_order_release);
  }
  return known.code.get();
}

// Factors that are read off the state are copied where the sums find them too.
ValueTask EquationCode::value_task(const Recorded& recorded, const Scalar& scalar, std::vector<Place>* value_places) const {
  ValueTask task;
  const int state_lanes = scalar.split ? 0 : scalar.lanes;
  for (const Place& home : homes_) task.homes.push_back(spread(home, home.array == Arrays::kNumbers ? scalar.lanes : state_lanes));
  task.guards = recorded.guards;
  if (!scalar.split)
    for (const ValueTask::Output& output : recorded.outputs) task.outputs.push_back({output.node, spread(output.place, scalar.lanes)});
  *value_places = task.homes;
  if (scalar.lanes == 0) return task;
  for (int n : recorded.tangent->factors) {
    Place& place = (*value_places)[at(n)];
    if (place.array < 0) {
      task.kept.push_back(n);
    } else if (scalar.split && place.array != Arrays::kNumbers) {
      place = {Arrays::kSlots, task.reserved_slots++};
      task.outputs.push_back({n, place});
    }
  }
  return task;
}

std::unique_ptr<CompiledFunction> EquationCode::compile(const Recorded& recorded, const Scalar& scalar) const {
  std::vector<Place> value_places;
  const ValueTask task = value_task(recorded, scalar, &value_places);
  const ValueProgram program(recording_, task);
  auto function = std::make_unique<CompiledFunction>();
  function->slots = at(program.slots);
  function->values = ValueCode::compile(recording_, task, program, Arrays::kSlots);
  if (!function->values) return nullptr;
  if (scalar.lanes == 0) return function;
  for (int n : task.kept) value_places[at(n)] = {Arrays::kSlots, program.slot[at(n)]};
  const TangentProgram& tangent = *recorded.tangent;
  const auto row_place = [&](int n) {
    const bool has_sum = at(n) < tangent.row.size() && tangent.row[at(n)] >= 0;
    return has_sum ? Place{Arrays::kRows, tangent.row[at(n)]} : homes_[at(n)];
  };
  std::vector<Sum> sums;
  for (const TangentProgram::Sum& from : tangent.sums) {
    Sum& sum = sums.emplace_back();
    sum.target = from.node < 0 ? from.output.place : row_place(from.node);
    for (const TangentProgram::Term& term : from.terms)
      sum.products.push_back({row_place(term.row), term.factor < 0 ? Place{} : value_places[at(term.factor)], term.added});
  }
  StraightLine::RowLayouts layouts;
  layouts.fill(scalar.split ? StraightLine::RowLayout{scalar.lanes, 0} : StraightLine::RowLayout{scalar.lanes + 1, 1});
  layouts[at(Arrays::kNumbers)] = {scalar.lanes + 1, 1};
  layouts[at(Arrays::kRows)] = {scalar.lanes, 0};
  function->rows = at(tangent.rows * scalar.lanes);
  function->tangents = StraightLine::compile(sums, scalar.lanes, layouts, kMostBytes);
  return function->tangents ? std::move(function) : nullptr;
}

}  // namespace codesign
