// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sample_laws.h"

#include <algorithm>
#include <array>

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

/// A study in which one controller is continuous, its law the only watched signal: of a PID its
/// error.
Study law_study(const LinearStudy& of, std::size_t c) {
  Study study = of.study;
  ControllerDescription& controller = study.controllers[c];
  controller.realization = {};
  if (controller.kind->is_pid) {
    controller.p = Quantity(1.0);
    controller.i = controller.d = Quantity(0.0);
  }
  const std::string name = controller.name + "/output";
  study.watched.erase(
      std::remove_if(study.watched.begin(), study.watched.end(),
                     [&](const WatchedSignal& watched) { return watched.signal.text != name; }),
      study.watched.end());
  return study;
}

}  // namespace

struct SampleLaws::Law {
  CompiledSystem system;
  Equations<Complex> equations;
  std::vector<int> states;  ///< of the whole system, per state of this one
  State<Complex> state{};
  SparseGradient<Complex> gradient{};

  Law(const CompiledSystem& of, const LinearStudy& study, std::size_t c,
      const std::vector<std::string>& names)
      : system(of.robot(), law_study(study, c), of.sharing()), equations(system) {
    equations.compiled().allow(false);
    for (const std::string& name : linear_state_names(system, {}))
      states.push_back(
          static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
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

/// The derivatives of a law by (x's motions, then s), not those of the jump so far.
Eigen::RowVectorXcd SampleLaws::row_of(int controller, const ComplexMotion& motion,
                                       Complex* value) {
  Law& law = *laws_[to_index(controller)];
  const Layout& layout = law.system.layout();
  law.state = motion.state;
  law.state.s.resize(layout.states);
  for (std::size_t k = 0; k < law.states.size(); ++k)
    law.state.s[to_signed(k)] = motion.state.s[law.states[k]];
  law.state.z.setZero(layout.columns());
  law.equations.set_design(motion.parameters);
  *value = law.equations.watched_gradient(0, law.state, &law.gradient);
  Eigen::RowVectorXcd row = Eigen::RowVectorXcd::Zero(motion.q.cols());
  for (const auto& entry : law.gradient.position) {
    if (entry.column < layout.n)
      row += entry.value * motion.q.row(entry.column);
    else
      row[motion.motions + law.states[to_index(entry.column - layout.n)]] += entry.value;
  }
  for (const auto& entry : law.gradient.velocity) row += entry.value * motion.v.row(entry.column);
  return row;
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
  const Eigen::RowVectorXcd own = row_of(event.controller, motion, &value);
  // The law reads what earlier events of the instant have written.
  Eigen::RowVectorXcd law = own;
  law.tail(s->rows()).setZero();
  for (Eigen::Index k = 0; k < s->rows(); ++k) law += own[motion.motions + k] * s->row(k);
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
