// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <cmath>

#include "mechanism/signal_catalog.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kPlacesOfEndTime =
    "end_time in objective.terminal, objective.maximum, final, and constraints with maximum";

/// A signal whose names exist; an expression may contain parameters of the table.
SignalDescription read_signal_of(const YamlValue& value, const RobotDescription& robot,
                                 const ParameterTable& table, const Study& study, bool at_end) {
  if (value.text() == kEndTime) {
    if (!at_end || study.postures > 0)
      value.fail("the end of a run is known at its end only", kPlacesOfEndTime);
    return end_time_signal(value.where());
  }
  SignalDescription signal = parse_signal(value.text(), value.where(), value.path());
  check_signal(signal, robot, study.controllers, value.path());
  use_parameters(signal, table);
  return signal;
}

/// The names of the losses for which a property holds: "huber or soft_l1".
template <class Property>
std::string losses_with(const Laws& laws, const Property& holds) {
  std::string list;
  for (const LossKind& kind : laws.losses)
    if (holds(*kind)) list += (list.empty() ? "" : " or ") + std::string(kind->name);
  return list;
}

/// The loss of a term, with its scale.
void read_loss(const YamlValue& value, const Laws& laws, const ParameterTable& table,
               ObjectiveTerm* term) {
  if (const auto loss = value.find("loss")) {
    const std::string name = loss->choice("loss", names_of(laws.losses));
    for (const LossKind& kind : laws.losses)
      if (name == kind->name) term->loss = kind;
  }
  if (!term->loss->has_scale) {
    if (const auto scale = value.find("scale"))
      scale->fail("this loss has no scale",
                  "loss: " + losses_with(laws, [](const LossLaw& law) { return law.has_scale; }));
    return;
  }
  const YamlValue scale = value.at("scale");
  term->scale = read_quantity(scale, table);
  if (!(term->scale.nominal() > 0.0))
    scale.fail("the scale of a loss must be positive", "more than 0, in the unit of the signal");
}

ObjectiveTerm read_term(const YamlValue& value, const RobotDescription& robot,
                        const ParameterTable& table, const TrajectoryLoader& loader,
                        const Study& study, bool at_end) {
  value.require_keys({"signal"}, {"reference", "weight", "loss", "scale"});
  ObjectiveTerm term;
  term.where = value.where();
  term.signal = read_signal_of(value.at("signal"), robot, table, study, at_end);
  if (const auto reference = value.find("reference"))
    term.reference = read_target(*reference, table, loader, study);
  if (const auto weight = value.find("weight")) term.weight = read_quantity(*weight, table);
  read_loss(value, robot.laws, table, &term);
  return term;
}

std::vector<ObjectiveTerm> read_terms(const YamlValue& objective, const std::string& key,
                                      const RobotDescription& robot, const ParameterTable& table,
                                      const TrajectoryLoader& loader, const Study& study) {
  std::vector<ObjectiveTerm> terms;
  if (const auto list = objective.find(key))
    for (const YamlValue& item : list->items())
      terms.push_back(read_term(item, robot, table, loader, study, key == "terminal"));
  return terms;
}

}  // namespace

void read_objective(const YamlValue& study_value, const RobotDescription& robot,
                    const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto objective = study_value.find("objective");
  if (!objective) return;
  objective->require_keys({}, {"integral", "sum", "terminal", "peak", "stroke", "maximum",
                               "minimum", "arrival", "dwell", "loop", "poles"});
  const bool has_postures = study->postures > 0;
  if (const auto other = objective->find(has_postures ? "integral" : "sum"))
    other->fail(has_postures ? "postures have no integral" : "a motion has no postures",
                has_postures ? "sum, over the postures" : "integral, over time");
  study->integral =
      read_terms(*objective, has_postures ? "sum" : "integral", robot, table, loader, *study);
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

  /// Times, or numbers of postures.
  void read_interval(const YamlValue& value, WatchedSignal* watched) const {
    watched->before = study.duration;
    if (const auto after = value.find("after")) watched->after = after->number();
    if (const auto before = value.find("before")) watched->before = before->number();
    const bool has_postures = study.postures > 0;
    const double first = has_postures ? std::ceil(watched->after) : watched->after;
    const bool is_ordered =
        has_postures ? first <= watched->before : watched->after < watched->before;
    if (watched->after >= 0.0 && is_ordered && watched->before <= study.duration) return;
    const std::string unit = has_postures ? "" : " s";
    value.fail("the interval from " + to_decimal(watched->after) + unit + " to " +
                   to_decimal(watched->before) + unit + " is not part of the study",
               std::string("0 <= after ") + (has_postures ? "<=" : "<") + " before <= " +
                   to_decimal(study.duration) + (has_postures ? ", numbers of postures" : unit));
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
    const bool at_end = role != Role::kPath && role != Role::kPeak;
    watched.signal = read_signal_of(value.at(key), robot, table, study, at_end);
    if (const auto reference = value.find("reference"))
      watched.reference = read_target(*reference, table, loader, study);
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

  /// The measure that a key names.
  static WatchedSignal::Measure measure_of(const std::string& key) {
    const auto found = std::find(kMeasureNames.begin(), kMeasureNames.end(), key);
    return static_cast<WatchedSignal::Measure>(found - kMeasureNames.begin() + 1);
  }

  void read_band(const YamlValue& value, WatchedSignal* watched) const {
    const YamlValue band = value.at("band");
    const std::vector<YamlValue> edges = band.items();
    if (edges.size() != 2)
      band.fail("a band has two edges, found " + std::to_string(edges.size()), "[lower, upper]");
    watched->band_lower = read_quantity(edges[0], table);
    watched->band_upper = read_quantity(edges[1], table);
    if (!(watched->band_lower.nominal() < watched->band_upper.nominal()))
      band.fail("the lower edge of the band must be less than the upper one", "lower < upper");
  }

  WatchedSignal read_measured(const YamlValue& value, const char* key, const char* measure,
                              Role role, std::vector<std::string> optional) const {
    const bool with_band = measure_of(measure) >= WatchedSignal::Measure::kArrival;
    if (with_band && study.postures > 0)
      value.fail("postures have no times at which a signal enters a band",
                 "stroke, maximum, minimum, peak");
    if (with_band) optional.emplace_back("band");
    WatchedSignal watched = read_signal(value, key, role, std::move(optional));
    watched.measure = measure_of(measure);
    if (watched.signal.text == kEndTime && watched.measure != WatchedSignal::Measure::kMaximum)
      value.at(key).fail("the end of a run is one number", kPlacesOfEndTime);
    if (with_band) read_band(value, &watched);
    return watched;
  }

  /// `{stroke: signal, at_most: bound}` and the like.
  WatchedSignal read_bounded_measure(const YamlValue& value, const char* measure) const {
    WatchedSignal watched = read_measured(value, measure, measure, Role::kBounded,
                                          {"between", "at_least", "at_most", "tolerance"});
    read_bounds(value, &watched);
    read_tolerance(value, &watched);
    const bool is_difference = watched.measure != WatchedSignal::Measure::kMaximum &&
                               watched.measure != WatchedSignal::Measure::kMinimum;
    if (is_difference && watched.upper && !(watched.upper->nominal() > 0.0))
      value.fail("the " + std::string(measure) +
                     " of a signal is not negative, so its upper bound " + "must be positive",
                 "more than 0");
    return watched;
  }

  WatchedSignal read_objective_measure(const YamlValue& value, const char* measure) const {
    WatchedSignal watched = read_measured(value, "signal", measure, Role::kTerm, {"weight"});
    if (const auto weight = value.find("weight")) {
      watched.weight = weight->number();
      if (watched.weight == 0.0)
        weight->fail("a term with the weight 0 has no effect",
                     "more than 0 to minimize, less than 0 to maximize");
    }
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
      [&](const YamlValue& item) {
        const char* const measure = bounded_measure(item);
        return std::string(measure) == "peak" ? reader.read_bounded_peak(item)
                                              : reader.read_bounded_measure(item, measure);
      },
      bounded_measure);
  if (const auto objective = study_value.find("objective")) {
    Reader::add_items(
        *objective, "peak", &watched,
        [&](const YamlValue& item) { return reader.read_objective_peak(item); }, every);
    for (const char* measure : kMeasureNames)
      Reader::add_items(
          *objective, measure, &watched,
          [&](const YamlValue& item) { return reader.read_objective_measure(item, measure); },
          every);
  }
  study->watched = std::move(watched);
  read_linear(study_value, table, study);
}

}  // namespace codesign
