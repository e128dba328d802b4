// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/rest_numbers.h"

#include <algorithm>
#include <cmath>

#include "description/tuned_parameters.h"
#include "linear/measure_derivatives.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

const ControllerLoop* loop_of(const LinearModel& model, const std::string& controller) {
  for (const ControllerLoop& loop : model.loops)
    if (loop.controller == controller) return &loop;
  return nullptr;
}

std::size_t place_of(const Study& study, const std::string& controller) {
  std::size_t place = 0;
  while (study.controllers[place].name != controller) ++place;
  return place;
}

std::vector<Pole> poles_of(const LinearModel& model) {
  std::vector<Pole> poles;
  for (const LinearMode& mode : model.modes) poles.push_back(mode.pole);
  return poles;
}

template <class Visit>
Status for_each_measure(const Study& study, const Visit& visit) {
  std::size_t entry = 0;
  for (const WatchedSignal& watched : study.watched)
    if (watched.linear)
      if (Status status = visit(watched, entry++); !status.ok()) return status;
  return {};
}

}  // namespace

Status RestNumbers::set_poles(const LinearMeasure& measure, const Equilibrium& rest,
                              Entry* entry) const {
  const double duration = system_.whole_study().duration;
  const std::vector<PoleCluster> places = ranked(poles_of(rest.linear), measure.kind, duration);
  if (places.empty())
    return {StatusCode::kNonFinite, 0.0, "at rest there is no motion that has a pole"};
  for (std::size_t k = 0; k < places.size(); ++k)
    entry->values[to_signed(k)] = value_of(places[k], measure.kind, rest.linear.system.period);
  return {};
}

Status RestNumbers::set_margin(const LinearMeasure& measure, const Equilibrium& rest,
                               Entry* entry) const {
  const std::string of = "the loop of controller \"" + measure.controller + "\" ";
  const ControllerLoop* const loop = loop_of(rest.linear, measure.controller);
  const std::vector<AtFrequency> margins = margins_of(loop->margins, measure.kind);
  if (!margins.empty()) {
    for (Eigen::Index k = 0; k < entry->values.size(); ++k)
      entry->values[k] = margins[std::min(to_index(k), margins.size() - 1)].value;
    return {};
  }
  if (!loop->margins.is_stable)
    return {StatusCode::kUnstableMotion, 0.0,
            of + "is unstable, so that it has no margins: " + rest.linear.verdict};
  return {StatusCode::kNonFinite, 0.0,
          of + "has no " + kLinearMeasureNames[to_index(measure.kind)] +
              ": its frequency response has no such crossing, so that it is infinite"};
}

/// The derivatives have the structure of a design: an integral without gain is no state.
Status RestNumbers::prepare(const std::vector<double>& parameters, const Equilibrium& rest) {
  const Study& study = system_.whole_study();
  std::vector<bool> without_gain;
  for (const ControllerDescription& controller : study.controllers) {
    without_gain.push_back(controller.i.at(parameters) == 0.0);
    if (!without_gain.back() || controller.i.is_constant()) continue;
    const std::vector<int>& used = controller.i.expression()->dependencies();
    if (std::any_of(used.begin(), used.end(), [&](int parameter) {
          return std::find(study.tuned.begin(), study.tuned.end(), parameter) != study.tuned.end();
        }))
      return {StatusCode::kNonFiniteGradient, 0.0,
              "controllers." + controller.name +
                  ".gains.i is tuned and zero, where the pole of its integral appears; give it a "
                  "bound above zero"};
  }
  if (!derivatives_ || without_gain != without_gain_)
    derivatives_ =
        std::make_unique<LinearDerivatives>(LinearCase{&system_, parameters, {}, true, {}});
  without_gain_ = without_gain;
  return derivatives_->take(parameters, rest.state, rest.integrals);
}

/// Refuses a derivative that is none, and a number that moves with what nothing determines.
Status RestNumbers::check(const WatchedSignal& watched, const Entry& entry, double change,
                          std::size_t direction) const {
  constexpr double kRounding = 1e-6;
  const std::string of = watched.element + ", " + watched.signal.text + ", ";
  const bool by_parameter = direction < derivatives_->parameters();
  if (!std::isfinite(change))
    return {StatusCode::kNonFiniteGradient, 0.0,
            of + "has no derivative" +
                (by_parameter
                     ? " by \"" + tuned_parameter(system_.study(), to_signed(direction)).name + "\""
                     : "") +
                ": poles meet beside others, or a crossing of the loop is a touch"};
  if (by_parameter || std::abs(change) <= kRounding * (1.0 + std::abs(entry.values[0]))) return {};
  return {StatusCode::kNonFiniteGradient, 0.0,
          of + "depends on a position, or a reaction, that nothing determines at rest"};
}

Status RestNumbers::differentiate_along(std::size_t direction, const Equilibrium& rest) {
  constexpr double kPer = 1.0 / LinearDerivatives::kStep;
  const Study& study = system_.whole_study();
  const double period = derivatives_->period();
  const bool by_parameter = direction < derivatives_->parameters();
  const std::vector<Pole> poles = poles_of(rest.linear);
  const auto keep = [&](const WatchedSignal& watched, std::size_t entry, std::size_t k,
                        double change) {
    if (by_parameter) entries_[entry].gradients(to_signed(direction), to_signed(k)) = change;
    return check(watched, entries_[entry], change, direction);
  };
  Eigen::MatrixXd change;
  return for_each_measure(study, [&](const WatchedSignal& watched, std::size_t entry) -> Status {
    const LinearMeasure& measure = *watched.linear;
    if (!measure.is_of_poles()) {
      const LoopMargins& margins = loop_of(rest.linear, measure.controller)->margins;
      const std::vector<AtFrequency> all = margins_of(margins, measure.kind);
      const ComplexSpace loop = derivatives_->loop(place_of(study, measure.controller), direction);
      double moved = 0.0;
      for (std::size_t k = 0; k < to_index(measure.places()); ++k) {
        if (k < all.size()) moved = derivative_of(all[k], measure.kind, margins.rest, loop, period);
        if (Status status = keep(watched, entry, k, moved); !status.ok()) return status;
      }
      return {};
    }
    if (change.size() == 0) change = kPer * derivatives_->closed(direction).A.imag();
    const std::vector<PoleCluster> places = ranked(poles, measure.kind, study.duration);
    for (std::size_t k = 0; k < places.size(); ++k)
      if (Status status = keep(
              watched, entry, k,
              derivative_of(places[k], poles, measure.kind, period, rest.linear.system.A, change));
          !status.ok())
        return status;
    return {};
  });
}

Status RestNumbers::evaluate(const std::vector<double>& parameters, bool with_gradient,
                             const std::atomic<bool>* cancel) {
  const Study& study = system_.whole_study();
  LinearQuestion question;
  entries_.clear();
  for (const WatchedSignal& watched : study.watched) {
    if (!watched.linear) continue;
    question.with_loops = question.with_loops || !watched.linear->is_of_poles();
    const Eigen::Index places = watched.linear->places();
    entries_.push_back({Eigen::VectorXd(places), {}});
    if (with_gradient) entries_.back().gradients.setZero(to_signed(study.tuned.size()), places);
  }
  const Equilibrium rest = find_equilibrium(system_, parameters, {}, cancel, question);
  if (!rest.status.ok()) return rest.status;
  Status status =
      for_each_measure(study, [&](const WatchedSignal& watched, std::size_t entry) -> Status {
        return watched.linear->is_of_poles() ? set_poles(*watched.linear, rest, &entries_[entry])
                                             : set_margin(*watched.linear, rest, &entries_[entry]);
      });
  if (!status.ok() || !with_gradient) return status;
  status = prepare(parameters, rest);
  for (std::size_t k = 0; status.ok() && k < derivatives_->directions(); ++k)
    status = differentiate_along(k, rest);
  return status;
}

}  // namespace codesign
