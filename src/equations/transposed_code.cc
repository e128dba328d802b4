// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/transposed_code.h"

#include <algorithm>

#include "description/reference.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

bool is_tuned(const System& system, const std::vector<int>& parameters) {
  const std::vector<int>& tuned = system.study().tuned;
  return std::any_of(parameters.begin(), parameters.end(), [&](int k) {
    return std::find(tuned.begin(), tuned.end(), k) != tuned.end();
  });
}

bool is_tuned(const System& system, const SourceId& source) {
  if (const auto* expression = source.as<Expression>())
    return is_tuned(system, expression->dependencies());
  if (const auto* basis = source.as<BasisDescription>())
    return is_tuned(system, dependencies(*basis));
  return is_tuned(system, dependencies(*source.as<ReferenceDescription>()));
}

/// The column of a leaf of the state in (q, s), v and z side by side; -1 for other nodes.
int state_column(const Layout& layout, const Recording::Node& node) {
  if (node.operation != Operation::kLeaf) return -1;
  if (node.a == Arrays::kQ) return node.b;
  if (node.a == Arrays::kS) return layout.n + node.b;
  if (node.a == Arrays::kV) return layout.positions() + node.b;
  return node.a == Arrays::kZ ? layout.positions() + layout.n + node.b : -1;
}

}  // namespace

TransposedCode::TransposedCode(const System& system, const Recording& recorded,
                               const std::vector<RecordedFunction>& functions, bool interpreted)
    : interpreted_(interpreted), functions_(functions.size()) {
  numbered_.recording = recorded;
  find_dependent(system);
  std::vector<int> sum_of(depends_.size(), -1);
  for (std::size_t f = 0; f < functions.size(); ++f)
    if (functions[f].has_products) transpose(system, functions[f], &sum_of, &functions_[f]);
  transpose_design(sum_of);
  numbered_.number_nodes();
  for (std::size_t f = 0; f < functions.size(); ++f)
    if (functions[f].has_products) functions_[f].task.homes = numbered_.homes;
  design_.task.homes = numbered_.homes;
}

void TransposedCode::find_dependent(const System& system) {
  const Recording& recording = numbered_.recording;
  depends_.resize(to_index(recording.size()));
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (node.operation == Operation::kLeaf) {
      if (node.a == Recording::kSupplied && node.b >= 0)
        depends_[to_index(n)] = is_tuned(system, recording.supplied_sources()[to_index(node.b)]);
      if (node.a == Recording::kTimed)
        depends_[to_index(n)] = is_tuned(
            system, recording.timed_sources()[to_index(node.b / Recording::kFunctionOrders)]);
    } else if (node.operation != Operation::kLiteral && node.operation != Operation::kRound) {
      depends_[to_index(n)] =
          depends_[to_index(node.a)] || (node.b >= 0 && depends_[to_index(node.b)]);
    }
  }
}

// Entries of the state, functions of time, and all numbers of the design: of these only those get
// something that are results or are used by nodes that vary.
std::vector<bool> TransposedCode::targets() const {
  const Recording& recording = numbered_.recording;
  std::vector<bool> is_target(depends_.size());
  for (std::size_t n = 0; n < is_target.size(); ++n) {
    const Recording::Node& node = recording.node(static_cast<int>(n));
    const bool is_state = node.operation == Operation::kLeaf && node.a <= Arrays::kZ;
    is_target[n] =
        is_state || (depends_[n] && (!node.varies || node.operation == Operation::kLeaf));
  }
  return is_target;
}

void TransposedCode::transpose(const System& system, const RecordedFunction& recorded,
                               std::vector<int>* sum_of, Transposed* transposed) {
  Recording* const recording = &numbered_.recording;
  std::vector<AdjointSeed> seeds;
  for (const ValueTask::Output& output : recorded.outputs)
    seeds.push_back({output.node, Traced(recording, recording->leaf(output.place.array,
                                                                    output.place.index, true))});
  const std::vector<Traced> adjoints = derive_adjoints(recording, seeds, targets());
  ValueTask& task = transposed->task;
  Results& results = transposed->results;
  task.guards = recorded.guards;
  const auto take = [&](const auto& index_of, std::vector<int>* indices) {
    for (std::size_t n = 0; n < adjoints.size(); ++n) {
      const int index =
          adjoints[n].is(0.0) ? -1 : index_of(n, recording->node(static_cast<int>(n)));
      if (index < 0) continue;
      task.outputs.push_back(
          {adjoints[n].node_in(recording), {Arrays::kAdjoints, static_cast<int>(results.size())}});
      indices->push_back(index);
    }
  };
  take(
      [&](std::size_t, const Recording::Node& node) { return state_column(system.layout(), node); },
      &results.columns);
  take(
      [](std::size_t, const Recording::Node& node) {
        return node.a == Recording::kTimed && node.varies ? node.b : -1;
      },
      &results.timed);
  take(
      [&](std::size_t n, const Recording::Node& node) {
        if (!node.varies && (*sum_of)[n] < 0) (*sum_of)[n] = static_cast<int>(sums_++);
        return node.varies ? -1 : (*sum_of)[n];
      },
      &results.numbers);
}

void TransposedCode::transpose_design(const std::vector<int>& sum_of) {
  Recording* const recording = &numbered_.recording;
  std::vector<AdjointSeed> seeds;
  std::vector<bool> is_target(sum_of.size());
  for (std::size_t n = 0; n < sum_of.size(); ++n) {
    const auto k = static_cast<int>(n);
    if (sum_of[n] >= 0)
      seeds.push_back({k, Traced(recording, recording->leaf(Arrays::kResults, sum_of[n], true))});
    is_target[n] = depends_[n] && recording->node(k).operation == Operation::kLeaf &&
                   recording->node(k).a == Recording::kSupplied;
  }
  const std::vector<Traced> adjoints = derive_adjoints(recording, seeds, is_target);
  for (std::size_t n = 0; n < adjoints.size(); ++n) {
    if (adjoints[n].is(0.0)) continue;
    design_.task.outputs.push_back({adjoints[n].node_in(recording),
                                    {Arrays::kAdjoints, static_cast<int>(expressions_.size())}});
    expressions_.push_back(recording->node(static_cast<int>(n)).b);
  }
}

const CompiledFunction& TransposedCode::code(const Transposed& which, bool interpreted,
                                             bool held) const {
  const std::vector<Recording::Guard>& guards = which.task.guards;
  const bool has_switches = std::any_of(
      guards.begin(), guards.end(), [](const Recording::Guard& guard) { return guard.is_switch; });
  const std::size_t kind = (interpreted ? 1U : 0U) + (held && has_switches ? 2U : 0U);
  std::call_once(which.made[kind], [&] {
    ValueTask task = which.task;
    task.guards = checked(task.guards, held);
    const ValueProgram program(numbered_.recording, task);
    which.code[kind] =
        compile_values(numbered_.recording, task, program, interpreted || interpreted_);
    which.code[kind]->rows = &which == &design_ ? expressions_.size() : which.results.size();
  });
  return *which.code[kind];
}

DesignProducts::DesignProducts(const System& system, const TransposedCode& code)
    : system_(system),
      code_(code),
      tuned_of_(system.study().parameters.size(), -1),
      sums_(code.sums()),
      timed_(system.study().tuned.size()),
      by_expression_(code.expressions().size()),
      slots_(code.design().slots) {
  const std::vector<int>& tuned = system.study().tuned;
  for (std::size_t k = 0; k < tuned.size(); ++k)
    tuned_of_[to_index(tuned[k])] = static_cast<int>(k);
  const std::vector<SourceId>& sources = code.numbered().recording.timed_sources();
  orders_.resize(sources.size());
  for (std::size_t f = 0; f < sources.size(); ++f) {
    const auto* basis = sources[f].as<BasisDescription>();
    std::vector<int> found;
    for (int parameter :
         basis ? dependencies(*basis) : dependencies(*sources[f].as<ReferenceDescription>()))
      if (tuned_of_[to_index(parameter)] >= 0) found.push_back(tuned_of_[to_index(parameter)]);
    for (std::size_t first = 0; first < found.size(); first += 8) {
      Lane& lane = lanes_.emplace_back();
      lane.function = static_cast<int>(f);
      lane.tuned.assign(found.begin() + to_signed(first),
                        found.begin() + to_signed(std::min(first + 8, found.size())));
      if (basis) lane.motion.emplace<ShapedInput<Lanes<8>>>();
    }
  }
}

void DesignProducts::start(const std::vector<double>& parameters) {
  parameters_ = parameters;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  std::fill(timed_.begin(), timed_.end(), 0.0);
  for (Lane& lane : lanes_) {
    seeded_.assign(parameters.begin(), parameters.end());
    for (std::size_t k = 0; k < lane.tuned.size(); ++k)
      seeded_[to_index(system_.study().tuned[to_index(lane.tuned[k])])].v[static_cast<int>(k)] =
          1.0;
    const SourceId& source = code_.numbered().recording.timed_sources()[to_index(lane.function)];
    if (auto* shaped = std::get_if<ShapedInput<Lanes<8>>>(&lane.motion))
      shaped->set(*source.as<BasisDescription>(), seeded_);
    else
      std::get<Reference<Lanes<8>>>(lane.motion).set(*source.as<ReferenceDescription>(), seeded_);
  }
}

void DesignProducts::add(EquationFunction function, double t, In<double> results,
                         Out<double> adjoint) {
  const TransposedCode::Results& of = code_.results(function);
  std::ptrdiff_t k = 0;
  for (int column : of.columns) adjoint[column] += results[k++];
  if (!of.timed.empty()) add_timed(of, t, results.subspan(k, to_signed(of.timed.size())));
  k += to_signed(of.timed.size());
  for (int number : of.numbers) sums_[to_index(number)] += results[k++];
}

void DesignProducts::add_timed(const TransposedCode::Results& of, double t, In<double> results) {
  for (auto& orders : orders_) orders.fill(0.0);
  for (std::size_t k = 0; k < of.timed.size(); ++k) {
    const int entry = of.timed[k];
    orders_[to_index(entry / Recording::kFunctionOrders)]
           [to_index(entry % Recording::kFunctionOrders)] = results[to_signed(k)];
  }
  for (const Lane& lane : lanes_) {
    const auto& [value, rate, acceleration, jerk] = orders_[to_index(lane.function)];
    if (value == 0.0 && rate == 0.0 && acceleration == 0.0 && jerk == 0.0) continue;
    const ReferenceMotion<Lanes<8>> motion =
        std::visit([t](const auto& function) { return function.at(t); }, lane.motion);
    const auto sum = value * motion.value.v + rate * motion.rate.v +
                     acceleration * motion.acceleration.v + jerk * motion.jerk.v;
    for (std::size_t k = 0; k < lane.tuned.size(); ++k)
      timed_[to_index(lane.tuned[k])] += sum[static_cast<int>(k)];
  }
}

void DesignProducts::add_to(const std::vector<double>& numbers, Out<double> gradient) {
  ValueCode::Arrays arrays{};
  arrays[EquationArrays::kNumbers] = numbers.data();
  arrays[EquationArrays::kResults] = sums_.data();
  arrays[EquationArrays::kSlots] = slots_.data();
  arrays[EquationArrays::kAdjoints] = by_expression_.data();
  code_.design().values->run(arrays);
  for (std::size_t e = 0; e < by_expression_.size(); ++e) {
    const auto& source =
        code_.numbered().recording.supplied_sources()[to_index(code_.expressions()[e])];
    const Expression& expression = *source.as<Expression>();
    const UsedNumbers<double> values =
        expression.used<double>(parameters_, [](double x) { return x; });
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const int tuned = tuned_of_[to_index(expression.dependencies()[k])]; tuned >= 0)
        gradient[tuned] += by_expression_[e] * expression.derivative_of(k, values);
  }
  for (std::size_t k = 0; k < timed_.size(); ++k) gradient[to_signed(k)] += timed_[k];
}

}  // namespace codesign
