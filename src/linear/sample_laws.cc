// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sample_laws.h"

#include <algorithm>
#include <array>

#include "codegen/interpreter.h"
#include "codegen/traced.h"
#include "control/controller.h"
#include "control/sampled_pid.h"
#include "elements/sampled_control.h"
#include "linear/linear_coordinates.h"
#include "math/arrays.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

/// A number with its derivatives by the error, what the derivative acts on, and the memory of a
/// PID.
struct SampleNumber {
  static constexpr int kVariables = 5;
  using Row = Eigen::Matrix<Complex, 1, kVariables>;
  Complex a;
  Row by;

  SampleNumber(Complex value = 0.0) : a(value), by(Row::Zero()) {}  // NOLINT: numbers mix
  SampleNumber(double value) : SampleNumber(Complex(value)) {}      // NOLINT: numbers mix
  SampleNumber(Complex value, Row derivatives) : a(value), by(std::move(derivatives)) {}
  static SampleNumber variable(Complex value, int place) { return {value, Row::Unit(place)}; }
  SampleNumber& operator+=(const SampleNumber& y) { return *this = {a + y.a, by + y.by}; }
  SampleNumber& operator-=(const SampleNumber& y) { return *this = {a - y.a, by - y.by}; }
  friend SampleNumber operator-(const SampleNumber& x) { return {-x.a, -x.by}; }
  friend SampleNumber operator+(const SampleNumber& x, const SampleNumber& y) {
    return {x.a + y.a, x.by + y.by};
  }
  friend SampleNumber operator-(const SampleNumber& x, const SampleNumber& y) {
    return {x.a - y.a, x.by - y.by};
  }
  friend SampleNumber operator*(const SampleNumber& x, const SampleNumber& y) {
    return {x.a * y.a, x.a * y.by + y.a * x.by};
  }
  friend SampleNumber operator/(const SampleNumber& x, const SampleNumber& y) {
    return {x.a / y.a, (x.by - (x.a / y.a) * y.by) / y.a};
  }
  friend double value_of(const SampleNumber& x) { return x.a.real(); }
};

Bounds<SampleNumber> numbers_of(const Bounds<Complex>& bounds) {
  return {bounds.lower, bounds.upper, bounds.is_symmetric};
}

/// The shape of a filter at numbers with derivatives, from the recording of its law.
FilterShape<Complex> shape_of(const FilterLaw& law, const FilterNumbers<Complex>& numbers) {
  Recording recording;
  FilterNumbers<Traced> leaves;
  for (std::size_t k = 0; k < leaves.size(); ++k)
    leaves[k] = Traced(&recording, recording.leaf(0, static_cast<int>(k), true));
  const FilterShape<Traced> shape = law.shape.of<Traced>(leaves);
  std::vector<Complex> values;
  for (int k = 0; k < recording.size(); ++k) {
    const Recording::Node& node = recording.node(k);
    const auto operand = [&](int of) { return of < 0 ? Complex(0.0) : values[to_index(of)]; };
    if (node.operation == Operation::kLeaf)
      values.push_back(numbers[to_index(node.b)]);
    else if (node.operation == Operation::kLiteral)
      values.emplace_back(node.literal);
    else
      values.push_back(operate(node.operation, operand(node.a), operand(node.b)));
  }
  const auto value = [&](const Traced& x) {
    return x.is_literal() ? Complex(x.value()) : values[to_index(x.node())];
  };
  return {value(shape.rate), value(shape.lead), value(shape.middle), value(shape.damping)};
}

/// section_of() with derivatives.
FilterSection<Complex> complex_section(const FilterDescription& filter, double sample_time,
                                       const std::vector<Complex>& design) {
  FilterNumbers<Complex> numbers{};
  for (std::size_t k = 0; k < filter.numbers.size(); ++k) numbers[k] = filter.numbers[k].at(design);
  const FilterShape<Complex> shape = shape_of(*filter.kind, numbers);
  const Complex half = 0.5 * sample_time * shape.rate;
  return sampled_section(shape, filter.kind->order,
                         filter.kind->is_prewarped ? std::cos(half) / std::sin(half) : 1.0 / half);
}

const SignalDescription& signal_of(const ControllerDescription& controller, std::size_t input) {
  return controller.kind->has_error() ? controller.input : controller.feedback[input].signal;
}

/// A study in which one controller is continuous. Watched signals are its law, of a PID its error,
/// and its inputs before their filters. A filter whose output is a state takes the place of those
/// of each input, so that the law's derivatives by the filtered inputs are those by these states.
Study law_study(const LinearStudy& of, std::size_t c) {
  Study study = of.study;
  ControllerDescription& controller = study.controllers[c];
  controller.realization = {};
  if (controller.kind->is_pid) {
    controller.p = Quantity(1.0);
    controller.i = controller.d = Quantity(0.0);
  }
  const auto stand_in = [](std::vector<FilterDescription>* filters) {
    if (!filters->empty())
      *filters = {FilterDescription{FilterKind::kLowPass, {Quantity(1.0)}, filters->front().where}};
  };
  stand_in(&controller.filters);
  for (FeedbackTerm& term : controller.feedback) stand_in(&term.filters);
  const std::string name = controller.name + "/output";
  study.watched.erase(
      std::remove_if(study.watched.begin(), study.watched.end(),
                     [&](const WatchedSignal& watched) { return watched.signal.text != name; }),
      study.watched.end());
  for (std::size_t input = 0; input < filtered_inputs(controller); ++input) {
    WatchedSignal before = study.watched.front();
    before.signal = signal_of(controller, input);
    study.watched.push_back(before);
  }
  return study;
}

}  // namespace

struct SampleLaws::Law {
  CompiledSystem system;
  Equations<Complex> equations;
  std::vector<int> states;  ///< of the whole system, per state of this one; -1: a filtered input
  /// per state of this one: the input of which it is the filtered one, or -1
  std::vector<int> inputs;
  State<Complex> state{};
  SparseGradient<Complex> gradient{};
  std::vector<Eigen::RowVectorXcd> filtered{};  ///< how each filtered input moves at this sample

  Law(const CompiledSystem& of, const LinearStudy& study, std::size_t c,
      const std::vector<std::string>& names)
      : system(of.robot(), law_study(study, c), of.sharing()), equations(system) {
    equations.compiled().allow(false);
    for (const std::string& name : linear_state_names(system, {}))
      states.push_back(
          static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
    inputs.assign(states.size(), -1);
    const std::vector<std::vector<FilterPlace>>& chains = system.controllers()[c].states.inputs;
    for (std::size_t input = 0; input < chains.size(); ++input)
      for (const FilterPlace& place : chains[input]) {
        states[to_index(place.state)] = -1;
        inputs[to_index(place.state)] = static_cast<int>(input);
      }
    filtered.resize(chains.size());
  }
  /// Of the whole system the rate of the same kind; -1: of a filtered input.
  int column_of(int column) const {
    const int first = system.layout().columns() - system.layout().states;
    if (column < first) return column;
    const int known = states[to_index(column - first)];
    return known < 0 ? -1 : first + known;
  }
};

SampleLaws::SampleLaws(const CompiledSystem& system, const LinearStudy& study)
    : system_(system), study_(study), names_(linear_state_names(system, {})) {
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const bool is_asked =
        c < study.disturbances.size() && study.study.controllers[c].realization.is_sampled();
    laws_.push_back(is_asked ? std::make_unique<Law>(system, study, c, names_) : nullptr);
  }
}

SampleLaws::~SampleLaws() = default;

/// Sets the state of a law. At rest the output of a filter is its input.
void SampleLaws::load(int controller, const ComplexMotion& motion) {
  Law& law = *laws_[to_index(controller)];
  const Layout& layout = law.system.layout();
  law.state = motion.state;
  law.state.s.setZero(layout.states);
  for (std::size_t k = 0; k < law.states.size(); ++k)
    if (law.states[k] >= 0) law.state.s[to_signed(k)] = motion.state.s[law.states[k]];
  law.state.z.setZero(layout.columns());
  for (int k = 0; k < layout.columns(); ++k)
    if (const int column = law.column_of(k); column >= 0) law.state.z[k] = motion.state.z[column];
  law.equations.set_design(motion.parameters);
  for (std::size_t k = 0; k < law.states.size(); ++k)
    if (law.inputs[k] >= 0)
      law.state.s[to_signed(k)] =
          law.equations.watched_gradient(1 + to_index(law.inputs[k]), law.state, &law.gradient);
}

/// The derivatives of a watched signal of a law's study by x, after the jump so far.
Eigen::RowVectorXcd SampleLaws::row_of(int controller, std::size_t watched,
                                       const ComplexMotion& motion, const Eigen::MatrixXcd& s,
                                       Complex* value) {
  Law& law = *laws_[to_index(controller)];
  const int n = law.system.layout().n;
  *value = law.equations.watched_gradient(watched, law.state, &law.gradient);
  Eigen::RowVectorXcd row = Eigen::RowVectorXcd::Zero(motion.q.cols());
  for (const auto& entry : law.gradient.position) {
    if (entry.column < n) {
      row += entry.value * motion.q.row(entry.column);
      continue;
    }
    const auto state = to_index(entry.column - n);
    if (law.inputs[state] >= 0)
      row += entry.value * law.filtered[to_index(law.inputs[state])];
    else
      row += entry.value * s.row(law.states[state]);
  }
  for (const auto& entry : law.gradient.velocity) row += entry.value * motion.v.row(entry.column);
  // Only outputs of continuous controllers let a law read rates.
  for (const auto& entry : law.gradient.rate)
    if (const int column = law.column_of(entry.column); column >= 0)
      row += entry.value * motion.z.row(column);
  return row;
}

/// Carries the filters of a sampled controller over a sample. They are linear: their states move as
/// they do. The law reads what they give at the sample.
void SampleLaws::advance_filters(int controller, const ComplexMotion& motion, Eigen::MatrixXcd* s) {
  const auto c = to_index(controller);
  const ControllerDescription& description = study_.study.controllers[c];
  const std::vector<std::vector<FilterPlace>>& inputs = system_.controllers()[c].states.inputs;
  for (std::size_t input = 0; input < inputs.size(); ++input) {
    if (inputs[input].empty()) continue;
    Complex value;
    Eigen::RowVectorXcd u = row_of(controller, 1 + input, motion, *s, &value);
    for (std::size_t k = 0; k < inputs[input].size(); ++k) {
      const FilterPlace& place = inputs[input][k];
      const FilterSection<Complex> section =
          complex_section(filters_of(description, input)[k], description.realization.sample_time,
                          motion.parameters);
      const Eigen::RowVectorXcd y = section.direct * u + s->row(place.state);
      s->row(place.state) = section.in1 * u - section.back1 * y;
      if (place.order == 2) {
        s->row(place.state) += s->row(place.state + 1);
        s->row(place.state + 1) = section.in2 * u - section.back2 * y;
      }
      u = y;
    }
    laws_[c]->filtered[input] = u;
  }
}

/// At rest the innovation of a sampled observer, its law, is zero.
void SampleLaws::correct_estimates(const ControlEvent& event, const std::vector<Complex>& design,
                                   const Eigen::RowVectorXcd& law, Eigen::MatrixXcd* s) {
  const auto c = to_index(event.controller);
  const ControllerDescription& description = study_.study.controllers[c];
  const ControllerStates& states = system_.controllers()[c].states;
  const JointObserver<Complex> observer =
      joint_observer(description.observer, description.realization.sample_time, design);
  for (int k = 0; k < states.estimates; ++k)
    s->row(states.estimate + k) +=
        (k == 2 ? observer.inertia : Complex(1.0)) * observer.gains[to_index(k)] * law;
  s->row(output_state(system_, event)) = law;
}

void SampleLaws::sample(const ControlEvent& event, const ComplexMotion& motion,
                        Eigen::MatrixXcd* s) {
  const auto c = to_index(event.controller);
  const ControllerDescription& description = study_.study.controllers[c];
  const ControlRealization& realization = description.realization;
  const Controller& controller = system_.controllers()[c];
  const std::vector<Complex>& design = motion.parameters;
  Bounds<SampleNumber> clamped, limit;
  if (realization.i_clamp) clamped = numbers_of(bounds_at(*realization.i_clamp, design));
  if (realization.output_limit) limit = numbers_of(bounds_at(*realization.output_limit, design));
  Complex value;
  load(event.controller, motion);
  advance_filters(event.controller, motion, s);
  // The law reads what earlier events of the instant have written.
  const Eigen::RowVectorXcd law = row_of(event.controller, 0, motion, *s, &value);
  if (controller.states.estimate >= 0) return correct_estimates(event, design, law, s);
  SampleNumber output = SampleNumber::variable(value, 0);
  Eigen::MatrixXcd variables = Eigen::MatrixXcd::Zero(SampleNumber::kVariables, law.size());
  variables.row(0) = law;
  const std::array<int, 3> places{controller.state, controller.states.last,
                                  controller.states.filter};
  if (controller.kind->is_pid) {
    const SampleNumber error = output;
    SampleNumber rated = SampleNumber::variable(value, 1);
    variables.row(1) = law;
    std::array<SampleNumber, 3> memory;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (places[k] < 0) continue;
      memory[k] = SampleNumber::variable(motion.state.s[places[k]], static_cast<int>(k) + 2);
      variables.row(to_signed(k) + 2) = s->row(places[k]);
    }
    const SampledPidNumbers<SampleNumber> numbers{
        {description.p.at(design), description.i.at(design), description.d.at(design)},
        realization.sample_time,
        realization.derivative_filter ? realization.derivative_filter->at(design) : Complex(0.0),
        realization.i_clamp ? &clamped : nullptr,
        realization.antiwindup,
        realization.output_limit ? &limit : nullptr,
        tracking_at(description, design)};
    if (realization.rates_input) rated.a = memory[1].a;
    SampledPidMemory<SampleNumber> kept{memory[0], memory[1], memory[2]};
    output = sample_pid(numbers, error, rated, false, &kept);
    const std::array<const SampleNumber*, 3> behind{&kept.integral, &kept.last_error,
                                                    &kept.error_rate};
    for (std::size_t k = 0; k < places.size(); ++k)
      if (places[k] >= 0) s->row(places[k]) = product(behind[k]->by, variables);
  }
  if (realization.output_limit) output = clamp(output, limit);
  // About rest no rate is near its limit.
  s->row(output_state(system_, event)) = product(output.by, variables);
  if (controller.states.computed >= 0)
    s->row(controller.states.computed) = s->row(output_state(system_, event)).eval();
}

Eigen::MatrixXcd SampleLaws::jump(const std::vector<ControlEvent>& events,
                                  const ComplexMotion& motion) {
  const Eigen::Index states = system_.layout().states;
  Eigen::MatrixXcd s = Eigen::MatrixXcd::Zero(states, motion.q.cols());
  s.rightCols(states).setIdentity();
  for (const ControlEvent& event : events) {
    if (event.kind == ControlEvent::Kind::kApply)
      s.row(system_.controllers()[to_index(event.controller)].states.held) =
          s.row(output_state(system_, event)).eval();
    else
      sample(event, motion, &s);
  }
  return s;
}

}  // namespace codesign
