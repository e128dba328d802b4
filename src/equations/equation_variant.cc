// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equation_variant.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "codegen/traced.h"
#include "elements/energy.h"
#include "equations/equation_recorder.h"
#include "equations/transposed_code.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

// Larger systems are not compiled: their code exceeds the processor's caches and takes seconds to
// make.
constexpr int kMostColumns = 4000;
constexpr std::size_t kMostBytes = std::size_t{16} << 20U;

constexpr int kTurns = EquationRecorder::kTurns;

/// The place of an entry in an array of Lanes, as an index of doubles: each entry takes lanes + 1
/// of them. The code's own workspaces are counted in doubles already.
Place spread(const Place& place, int lanes) {
  if (place.array < 0 || place.array >= Arrays::kSlots) return place;
  return {place.array, place.index * (lanes + 1)};
}

VectorX<Traced> vector(const std::vector<Traced>& x) {
  return Eigen::Map<const VectorX<Traced>>(x.data(), to_signed(x.size()));
}

std::size_t count_functions(const System& system, EquationPart part) {
  if (part == EquationPart::kSignals) return to_index(watched_function(system.watched().size()));
  if (part != EquationPart::kStart) return to_index(EquationFunction::kMotionEnd);
  return to_index(controller_function(static_cast<int>(system.controllers().size()),
                                      ControllerFunction::kFirstSample));
}

/// Whether the derivative of a node is an input of the tangent code. Entries of the state and
/// functions of time are, and so are nodes that depend on the design alone: their derivatives are
/// computed with the design. Turn references and literals have no derivative.
bool is_tangent_leaf(const Recording::Node& node) {
  return node.operation == Operation::kLeaf ? node.a != kTurns
                                            : !node.varies && node.operation != Operation::kLiteral;
}

}  // namespace

EquationVariant::EquationVariant(const CompiledSystem& system, EquationPart part,
                                 std::vector<bool> outcomes, std::vector<bool> mode,
                                 std::unique_ptr<ResidualRecording> begun)
    : system_(system),
      long_(system.layout().columns() > kMostColumns),
      functions_(count_functions(system, part)),
      known_(functions_.size()) {
  if (part == EquationPart::kSignals || part == EquationPart::kStart) {
    values_.recording.follow(std::move(outcomes));
    EquationRecorder equations(system, &values_.recording);
    take_design_guards(values_.recording.decisions().size());
    part == EquationPart::kSignals ? record_signals(&equations) : record_start(&equations);
  } else {
    if (!begun)
      begun = std::make_unique<ResidualRecording>(system, std::move(outcomes), std::move(mode));
    recording_ = &begun->recording;
    ends_run_ = begun->ends_run;
    record_motion(part, begun.get());
    values_.recording = std::move(*std::exchange(recording_, nullptr));
  }
  if (values_.recording.refused())
    throw std::logic_error("the formulas decide something without is_less()");
  for (const Recording::Guard& guard : values_.recording.guards()) {
    outcomes_.push_back(guard.outcome);
    if (guard.is_switch) mode_.push_back(guard.outcome);
  }
  values_.number_nodes();
}

template <class Compute>
void EquationVariant::record(EquationFunction function, const Compute& compute) {
  const std::size_t decisions = recording_->decisions().size();
  const std::vector<VectorX<Traced>> results = compute();
  take_guards(decisions, recording_->decisions().size(), &at(function).guards);
  take_outputs(function, results);
}

void EquationVariant::record_motion(EquationPart part, ResidualRecording* begun) {
  EquationRecorder* const equations = &begun->equations;
  for (EquationFunction function :
       {EquationFunction::kResidual, EquationFunction::kLinearization,
        EquationFunction::kConstraintErrors, EquationFunction::kSwitches})
    at(function).has_products = true;
  take_design_guards(begun->of_design);
  take_guards(begun->of_design, recording_->decisions().size(),
              &at(EquationFunction::kResidual).guards);
  take_outputs(EquationFunction::kResidual,
               {equations->G, VectorX<Traced>::Constant(1, equations->g)});
  record(EquationFunction::kConstraintErrors, [&] {
    std::vector<VectorX<Traced>> errors(2);
    equations->formulas.constraint_errors(equations->state, &errors[0], &errors[1]);
    return errors;
  });
  if (part == EquationPart::kMotion) record_switches(equations->g);
  at(EquationFunction::kEnergies).has_derivatives = false;
  if (part == EquationPart::kMotion && system_.layout().has_forest())
    record(EquationFunction::kEnergies, [&] {
      std::vector<VectorX<Traced>> results(2);
      equations->formulas.load(equations->state);
      results[0] = body_energies(equations->formulas.view(), &results[1]);
      return results;
    });
  at(EquationFunction::kTurns).has_derivatives = false;
  if (part == EquationPart::kMotion && system_.layout().has_cuts()) record_turns(equations);
  if (part == EquationPart::kMotion && system_.compresses_jacobian()) return;
  const bool rates_only =
      part == EquationPart::kRates || (part == EquationPart::kMotion && system_.has_rates_apart());
  const Linearization<Traced> d =
      derive_linearization(system_.patterns(), EliminationOrder::kForward, rates_only, equations);
  if (!rates_only)
    take_outputs(EquationFunction::kLinearization,
                 {vector(d.position), vector(d.velocity), vector(d.rate), d.time});
  take_outputs(EquationFunction::kRates,
               {equations->G, VectorX<Traced>::Constant(1, equations->g), vector(d.rate)});
  at(EquationFunction::kRates).has_derivatives = false;
  at(EquationFunction::kAccelerations).has_derivatives = false;
  // The derivatives decide nothing: they hold where the residual holds.
  for (EquationFunction function : {EquationFunction::kLinearization, EquationFunction::kRates,
                                    EquationFunction::kAccelerations})
    at(function).guards = at(EquationFunction::kResidual).guards;
  if (rates_only && system_.layout().m == 0 &&
      is_affine(*recording_, at(EquationFunction::kRates).guards, d.rate, equations->g))
    record_accelerations(d.rate, equations);
}

void EquationVariant::record_turns(EquationRecorder* equations) {
  record(EquationFunction::kTurns, [&] { return equations->record_turns(); });
  // Those of the forest's pairs stay, and are no results.
  const auto stays = [this](const ValueTask::Output& output) {
    const Recording::Node& node = recording_->node(output.node);
    return node.operation == Operation::kLeaf && node.a == kTurns;
  };
  std::vector<ValueTask::Output>& outputs = at(EquationFunction::kTurns).outputs;
  outputs.erase(std::remove_if(outputs.begin(), outputs.end(), stays), outputs.end());
}

void EquationVariant::record_switches(const Traced& g) {
  std::vector<Traced> differences, right;
  const std::vector<Recording::Guard> guards = recording_->guards();
  for (const Recording::Guard& guard : guards)
    if (guard.is_switch) {
      right.emplace_back(recording_, guard.b);
      differences.push_back(right.back() - Traced(recording_, guard.a));
    }
  take_outputs(EquationFunction::kSwitches, {vector(differences), vector(right)});
  VectorX<Traced> expressions(to_signed(recording_->noted().size()) + 1);
  for (std::size_t k = 0; k < recording_->noted().size(); ++k)
    expressions[to_signed(k)] = Traced(recording_, recording_->noted()[k]);
  expressions[expressions.size() - 1] = g;
  take_outputs(EquationFunction::kExpressions, {expressions});
  at(EquationFunction::kExpressions).has_derivatives = false;
  for (EquationFunction function : {EquationFunction::kSwitches, EquationFunction::kExpressions})
    at(function).guards = at(EquationFunction::kResidual).guards;
}

// G at z = 0 is short: it holds no accelerations.
void EquationVariant::record_accelerations(const std::vector<Traced>& G_z,
                                           EquationRecorder* equations) {
  const Sparsity& pattern = system_.patterns().rate;
  // A long chain's matrix is dense, and its program would take longer to make than most runs.
  constexpr int kMostUnknowns = 200;
  if (pattern.columns > kMostUnknowns || !is_mass_matrix(system_, *recording_, pattern, G_z))
    return;
  VectorX<Traced>& z = equations->state.z;
  const VectorX<Traced> trial = z;
  z.setConstant(Traced(0.0));
  equations->record_residual();
  z = trial;
  MassSolution solution = record_mass_solution(pattern, G_z, -equations->G);
  take_outputs(EquationFunction::kAccelerations,
               {solution.x, VectorX<Traced>::Constant(1, equations->g), vector(solution.values)});
  mass_factor_ = std::move(solution.factor);
}

void EquationVariant::record_signals(EquationRecorder* equations) {
  std::vector<EquationFunction> functions{EquationFunction::kTerminal};
  for (std::size_t k = 0; k < system_.watched().size(); ++k)
    functions.push_back(watched_function(k));
  std::vector<Traced> values;
  for (EquationFunction function : functions)
    record(function, [&] {
      values.push_back(values.empty()
                           ? equations->formulas.terminal(equations->state)
                           : equations->formulas.watched(values.size() - 1, equations->state));
      return std::vector<VectorX<Traced>>{VectorX<Traced>::Constant(1, values.back())};
    });
  std::vector<std::vector<Traced>> gradients(values.size());
  for (const JacobianEntry& entry :
       derive_gradients(system_, values, EliminationOrder::kReverse, recording_)) {
    gradients[to_index(entry.row)].push_back(entry.value);
    at(with_gradient(functions[to_index(entry.row)])).columns.push_back(entry.column);
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    take_outputs(with_gradient(functions[k]),
                 {VectorX<Traced>::Constant(1, values[k]), vector(gradients[k])});
    at(with_gradient(functions[k])).guards = at(functions[k]).guards;
  }
  const auto residuals = [&](EquationFunction function, ObjectivePart part) {
    record(function, [&] {
      std::vector<VectorX<Traced>> result(1);
      equations->formulas.residuals(part, equations->state, &result[0]);
      return result;
    });
  };
  residuals(EquationFunction::kIntegralResiduals, ObjectivePart::kIntegral);
  residuals(EquationFunction::kTerminalResiduals, ObjectivePart::kTerminal);
}

void EquationVariant::record_start(EquationRecorder* equations) {
  Formulas<Traced>& formulas = equations->formulas;
  const State<Traced>& state = equations->state;
  record(EquationFunction::kPlacement, [&] { return equations->record_placement(); });
  if (!system_.stuck().empty())
    record(EquationFunction::kStuckSlips, [&] { return equations->record_stuck_slips(); });
  if (system_.begins_bristles())
    record(EquationFunction::kBristles, [&] {
      VectorX<Traced> s = state.s;
      formulas.load(state);
      formulas.begin_bristles(&s);
      return std::vector<VectorX<Traced>>{s};
    });
  for (std::size_t k = 0; k < system_.controllers().size(); ++k) {
    const auto controller = static_cast<int>(k);
    const bool is_sampled = system_.study().controllers[k].realization.is_sampled();
    if (!system_.controllers()[k].has_start()) continue;
    for (const auto which : {ControllerFunction::kFirstSample, ControllerFunction::kSample}) {
      if (!is_sampled && which == ControllerFunction::kSample) continue;
      at(controller_function(controller, which)).has_products = is_sampled;
      record(controller_function(controller, which), [&] {
        State<Traced> sampled = state;
        formulas.load(sampled);
        const Traced output =
            formulas.sample(controller, which == ControllerFunction::kFirstSample, &sampled.s);
        return std::vector<VectorX<Traced>>{VectorX<Traced>::Constant(1, output), sampled.s};
      });
    }
  }
}

void EquationVariant::take_outputs(EquationFunction function,
                                   const std::vector<VectorX<Traced>>& results) {
  for (std::size_t k = 0; k < results.size(); ++k)
    for (Eigen::Index i = 0; i < results[k].size(); ++i)
      at(function).outputs.push_back(
          {results[k][i].node_in(recording_),
           {Arrays::kResults + static_cast<int>(k), static_cast<int>(i)}});
}

void EquationVariant::take_design_guards(std::size_t last) {
  std::vector<Recording::Guard> none;
  take_guards(0, last, &none);
}

void EquationVariant::take_guards(std::size_t first, std::size_t last,
                                  std::vector<Recording::Guard>* guards) {
  const auto all = recording_->decisions().begin();
  std::vector<int> decisions(all + to_signed(first), all + to_signed(last));
  std::sort(decisions.begin(), decisions.end());
  decisions.erase(std::unique(decisions.begin(), decisions.end()), decisions.end());
  for (int decision : decisions) {
    const Recording::Guard& guard = recording_->guards()[to_index(decision)];
    const bool varies = recording_->node(guard.a).varies || recording_->node(guard.b).varies;
    (varies ? *guards : design_guards_).push_back(guard);
  }
}

void EquationVariant::differentiate() const {
  Recording& recording = derivatives_.recording;
  recording = values_.recording;
  derivatives_.tangents.resize(functions_.size());
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    if (!functions_[f].has_derivatives) continue;
    std::vector<bool> is_leaf(to_index(recording.size()));
    for (int n = 0; n < recording.size(); ++n)
      is_leaf[to_index(n)] = is_tangent_leaf(recording.node(n));
    derivatives_.tangents[f] =
        std::make_unique<TangentProgram>(&recording, functions_[f].outputs, is_leaf);
  }
  derivatives_.number_nodes();
}

const NumberedRecording& EquationVariant::numbered(bool with_derivatives) const {
  if (!with_derivatives) return values_;
  std::call_once(differentiated_, [this] { differentiate(); });
  return derivatives_;
}

EquationVariant::~EquationVariant() = default;

const TransposedCode& EquationVariant::transposed() const {
  std::call_once(transposed_once_, [this] {
    transposed_ = std::make_unique<TransposedCode>(system_, values_.recording, functions_, long_);
  });
  return *transposed_;
}

const CompiledFunction& EquationVariant::function(EquationFunction function,
                                                  const Scalar& scalar) const {
  const auto f = to_index(function);
  const bool held = scalar.held && !mode_.empty();
  Known& known = known_[f][to_index(scalar.lanes / 4 + (scalar.separate ? 2 : 0) +
                                    (scalar.interpreted ? 5 : 0) + (held ? 10 : 0))];
  if (!known.made.load(std::memory_order_acquire)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!known.made.load(std::memory_order_relaxed)) known.code = compile(f, scalar);
    known.made.store(true, std::memory_order_release);
  }
  return *known.code;
}

// Tangents are sums of products, factor times derivative. Of a scalar with separate directions the
// state's arrays hold directions while the tangents run, so factors that are entries of the state
// are copied to slots before.
ValueTask EquationVariant::value_task(std::size_t function, const Scalar& scalar,
                                      std::vector<Place>* value_places) const {
  const NumberedRecording& from = numbered(scalar.lanes > 0);
  ValueTask task;
  task.homes.reserve(from.homes.size());
  const int state_lanes = scalar.separate ? 0 : scalar.lanes;
  for (const Place& home : from.homes)
    task.homes.push_back(spread(home, home.array == Arrays::kNumbers ? scalar.lanes : state_lanes));
  task.guards = checked(functions_[function].guards, scalar.held);
  if (!scalar.separate)
    for (const ValueTask::Output& output : functions_[function].outputs)
      task.outputs.push_back({output.node, spread(output.place, scalar.lanes)});
  if (scalar.lanes == 0) return task;
  *value_places = task.homes;
  for (int n : from.tangents[function]->factors) {
    Place& place = (*value_places)[to_index(n)];
    if (place.array < 0) {
      task.kept.push_back(n);
    } else if (scalar.separate && place.array != Arrays::kNumbers) {
      place = {Arrays::kSlots, task.reserved_slots++};
      task.outputs.push_back({n, place});
    }
  }
  return task;
}

std::vector<Sum> EquationVariant::tangent_sums(std::size_t function,
                                               const std::vector<Place>& value_places) const {
  const TangentProgram& tangent = *derivatives_.tangents[function];
  const auto row_place = [&](int n) {
    const bool has_sum = to_index(n) < tangent.row.size() && tangent.row[to_index(n)] >= 0;
    return has_sum ? Place{Arrays::kRows, tangent.row[to_index(n)]}
                   : derivatives_.homes[to_index(n)];
  };
  std::vector<Sum> sums;
  for (const TangentProgram::Sum& from : tangent.sums) {
    Sum& sum = sums.emplace_back();
    sum.target = from.node < 0 ? from.output.place : row_place(from.node);
    for (const TangentProgram::Term& term : from.terms)
      sum.products.push_back({row_place(term.row),
                              term.factor < 0 ? Place{} : value_places[to_index(term.factor)],
                              term.added});
  }
  return sums;
}

std::unique_ptr<CompiledFunction> EquationVariant::compile(std::size_t function,
                                                           const Scalar& scalar) const {
  const NumberedRecording& from = numbered(scalar.lanes > 0);
  std::vector<Place> value_places;
  const ValueTask task = value_task(function, scalar, &value_places);
  const ValueProgram program(from.recording, task);
  const bool interpreted = scalar.interpreted || long_;
  auto compiled = compile_values(from.recording, task, program, interpreted);
  if (scalar.lanes == 0) return compiled;
  for (int n : task.kept) value_places[to_index(n)] = {Arrays::kSlots, program.slot[to_index(n)]};
  StraightLine::RowLayouts layouts;
  layouts.fill(scalar.separate ? StraightLine::RowLayout{scalar.lanes, 0}
                               : StraightLine::RowLayout{scalar.lanes + 1, 1});
  layouts[to_index(Arrays::kNumbers)] = {scalar.lanes + 1, 1};
  layouts[to_index(Arrays::kRows)] = {scalar.lanes, 0};
  compiled->rows = to_index(from.tangents[function]->rows * scalar.lanes);
  const std::vector<Sum> sums = tangent_sums(function, value_places);
  if (!interpreted)
    compiled->tangents = StraightLine::compile(sums, scalar.lanes, layouts, kMostBytes);
  if (!compiled->tangents) compiled->tangents = interpret_sums(sums, scalar.lanes, layouts);
  return compiled;
}

}  // namespace codesign
