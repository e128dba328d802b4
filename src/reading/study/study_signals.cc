// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "mechanism/signal_catalog.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A signal whose names exist; an expression may contain parameters of the table.
SignalDescription read_signal_of(const YamlValue& value, const RobotDescription& robot,
                                 const ParameterTable& table, const Study& study) {
  SignalDescription signal = parse_signal(value.text(), value.where(), value.path());
  check_signal(signal, robot, study.controllers, value.path());
  use_parameters(signal, table);
  return signal;
}

ObjectiveTerm read_term(const YamlValue& value, const RobotDescription& robot,
                        const ParameterTable& table, const TrajectoryLoader& loader,
                        const Study& study) {
  value.require_keys({"signal"}, {"reference", "weight"});
  ObjectiveTerm term;
  term.where = value.where();
  term.signal = read_signal_of(value.at("signal"), robot, table, study);
  if (const auto reference = value.find("reference"))
    term.reference = read_reference(*reference, table, loader);
  if (const auto weight = value.find("weight")) term.weight = read_quantity(*weight, table);
  return term;
}

std::vector<ObjectiveTerm> read_terms(const YamlValue& objective, const std::string& key,
                                      const RobotDescription& robot, const ParameterTable& table,
                                      const TrajectoryLoader& loader, const Study& study) {
  std::vector<ObjectiveTerm> terms;
  if (const auto list = objective.find(key))
    for (const YamlValue& item : list->items())
      terms.push_back(read_term(item, robot, table, loader, study));
  return terms;
}

}  // namespace

void read_objective(const YamlValue& study_value, const RobotDescription& robot,
                    const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto objective = study_value.find("objective");
  if (!objective) return;
  objective->require_keys({}, {"integral", "terminal", "peak"});
  study->integral = read_terms(*objective, "integral", robot, table, loader, *study);
  study->terminal = read_terms(*objective, "terminal", robot, table, loader, *study);
}

namespace {

using Role = WatchedSignal::Role;

struct Reader {
  const RobotDescription& robot;
  const ParameterTable& table;
  const TrajectoryLoader& loader;
  const Study& study;

  void read_bounds(const YamlValue& value, WatchedSignal* watched) const {
    const Between bounds = read_between(value, table);
    watched->lower = bounds.lower;
    watched->upper = bounds.upper;
    require_ordered_bounds(*watched, table.values);
  }

  static void read_tolerance(const YamlValue& value, WatchedSignal* watched) {
    const auto tolerance = value.find("tolerance");
    if (!tolerance) return;
    watched->tolerance = tolerance->number();
    if (!(*watched->tolerance > 0.0))
      tolerance->fail("a bound cannot be kept without any error",
                      "more than 0, in the unit of the signal");
  }

  void read_interval(const YamlValue& value, WatchedSignal* watched) const {
    watched->before = study.duration;
    if (const auto after = value.find("after")) watched->after = after->number();
    if (const auto before = value.find("before")) watched->before = before->number();
    if (watched->after < 0.0 || !(watched->after < watched->before) ||
        watched->before > study.duration)
      value.fail("the interval from " + to_decimal(watched->after) + " s to " +
                     to_decimal(watched->before) + " s is not part of the study",
                 "0 <= after < before <= " + to_decimal(study.duration) + " s");
  }

  /// A signal, found under `key`, and its reference. @param optional further keys.
  WatchedSignal read_signal(const YamlValue& value, const char* key, Role role,
                            std::vector<std::string> optional) const {
    optional.emplace_back("reference");
    if (role != Role::kFinal) optional.insert(optional.end(), {"after", "before"});
    value.require_keys({key}, optional);
    WatchedSignal watched;
    watched.role = role;
    watched.where = value.where();
    watched.element = value.path();
    watched.signal = read_signal_of(value.at(key), robot, table, study);
    if (const auto reference = value.find("reference"))
      watched.reference = read_reference(*reference, table, loader);
    if (role == Role::kFinal) {
      watched.after = watched.before = study.duration;
    } else {
      read_interval(value, &watched);
    }
    return watched;
  }

  WatchedSignal read_bounded(const YamlValue& value, Role role) const {
    WatchedSignal watched =
        read_signal(value, "signal", role, {"between", "at_least", "at_most", "tolerance"});
    read_bounds(value, &watched);
    read_tolerance(value, &watched);
    return watched;
  }

  WatchedSignal read_objective_peak(const YamlValue& value) const {
    WatchedSignal watched = read_signal(value, "signal", Role::kPeak, {"weight"});
    if (const auto weight = value.find("weight")) {
      watched.weight = weight->number();
      if (!(watched.weight > 0.0))
        weight->fail("the weight of a peak must be positive", "more than 0");
    }
    return watched;
  }

  /// `{peak: signal, at_most: bound}` is |signal - reference| <= bound at all times, which is a
  /// bound on both sides.
  WatchedSignal read_bounded_peak(const YamlValue& value) const {
    WatchedSignal watched = read_signal(value, "peak", Role::kPath, {"at_most", "tolerance"});
    read_tolerance(value, &watched);
    const YamlValue at_most = value.at("at_most");
    const Quantity bound = read_quantity(at_most, table);
    if (!(bound.nominal() > 0.0))
      at_most.fail("a peak is the largest magnitude of a signal, so its bound must be positive",
                   "more than 0");
    watched.upper = bound;
    watched.lower =
        bound.is_constant()
            ? Quantity(-bound.nominal())
            : Quantity(-bound.nominal(), table.parse("-(" + bound.expression()->text() + ")"));
    return watched;
  }

  /// Adds what `read` makes of the items of a list that `is_meant`.
  template <class Read, class IsMeant>
  static void add_items(const YamlValue& parent, const char* key, std::vector<WatchedSignal>* list,
                        const Read& read, const IsMeant& is_meant) {
    if (const auto items = parent.find(key))
      for (const YamlValue& item : items->items())
        if (is_meant(item)) list->push_back(read(item));
  }
};

}  // namespace

void read_watched(const YamlValue& study_value, const RobotDescription& robot,
                  const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const Reader reader{robot, table, loader, *study};
  std::vector<WatchedSignal> watched;
  const auto every = [](const YamlValue&) { return true; };
  Reader::add_items(
      study_value, "path", &watched,
      [&](const YamlValue& item) { return reader.read_bounded(item, Role::kPath); }, every);
  Reader::add_items(
      study_value, "final", &watched,
      [&](const YamlValue& item) { return reader.read_bounded(item, Role::kFinal); }, every);
  Reader::add_items(
      study_value, "constraints", &watched,
      [&](const YamlValue& item) { return reader.read_bounded_peak(item); }, bounds_a_peak);
  if (const auto objective = study_value.find("objective"))
    Reader::add_items(
        *objective, "peak", &watched,
        [&](const YamlValue& item) { return reader.read_objective_peak(item); }, every);
  study->watched = std::move(watched);
}

}  // namespace codesign
