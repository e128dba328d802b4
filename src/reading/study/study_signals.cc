// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <cmath>

#include "mechanism/signal_catalog.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kPlacesOfEndTime =
    "end_time in objective.terminal, objective.maximum, final, and constraints with maximum";

/// A signal whose names exist; an expression may contain parameters of the table.
SignalDescription read_signal_of(const YamlValue& value, const EntryContext& in, bool at_end) {
  if (value.text() == kEndTime) {
    if (!at_end || in.study.postures > 0)
      value.fail("the end of a run is known at its end only", kPlacesOfEndTime);
    return end_time_signal(value.where());
  }
  SignalDescription signal = parse_signal(value.text(), value.where(), value.path());
  check_signal(signal, in.robot, in.study.controllers, value.path());
  use_parameters(signal, in.table);
  return signal;
}

template <class Entry>
EntryKey<Entry> reference_key() {
  return optional_key<Entry>("reference",
                             [](const YamlValue& value, const EntryContext& in, Entry* of) {
                               of->reference = read_target(value, in.table, in.loader, in.study);
                             });
}

/// The names of the losses for which a property holds: "huber or soft_l1".
template <class Property>
std::string losses_with(const Laws& laws, const Property& holds) {
  std::string list;
  for (const LossKind& kind : laws.losses)
    if (holds(*kind)) list += (list.empty() ? "" : " or ") + std::string(kind->name);
  return list;
}

void read_scale(const YamlValue& value, const EntryContext& in, ObjectiveTerm* term) {
  if (!term->loss->has_scale)
    value.fail(
        "this loss has no scale",
        "loss: " + losses_with(in.robot.laws, [](const LossLaw& law) { return law.has_scale; }));
  term->scale = read_quantity(value, in.table);
  if (!(term->scale.nominal() > 0.0))
    value.fail("the scale of a loss must be positive", "more than 0, in the unit of the signal");
}

/// @param at_end whether the term is one of the end of the run.
EntryKeys<ObjectiveTerm> term_keys(bool at_end) {
  using Term = ObjectiveTerm;
  return {required_key<Term>("signal",
                             [at_end](const YamlValue& value, const EntryContext& in, Term* term) {
                               term->signal = read_signal_of(value, in, at_end);
                             }),
          reference_key<Term>(),
          optional_key<Term>("weight",
                             [](const YamlValue& value, const EntryContext& in, Term* term) {
                               term->weight = read_quantity(value, in.table);
                             }),
          optional_key<Term>("loss",
                             [](const YamlValue& value, const EntryContext& in, Term* term) {
                               const std::vector<LossKind>& laws = in.robot.laws.losses;
                               const std::string name = value.choice("loss", names_of(laws));
                               for (const LossKind& kind : laws)
                                 if (name == kind->name) term->loss = kind;
                             }),
          optional_key<Term>("scale", read_scale)};
}

std::vector<ObjectiveTerm> read_terms(const YamlValue& objective, const std::string& key,
                                      const EntryContext& in) {
  std::vector<ObjectiveTerm> terms;
  const auto list = objective.find(key);
  if (!list) return terms;
  const EntryKeys<ObjectiveTerm> keys = term_keys(key == "terminal");
  for (const YamlValue& item : list->items()) {
    ObjectiveTerm& term = terms.emplace_back();
    term.where = item.where();
    read_entry(item, keys, in, &term);
    if (term.loss->has_scale) item.at("scale");
  }
  return terms;
}

}  // namespace

std::vector<EntryForm> forms_of_terms() { return {{"objective.integral[]", term_keys(false)}}; }

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
  const EntryContext in{robot, table, loader, *study};
  study->integral = read_terms(*objective, has_postures ? "sum" : "integral", in);
  study->terminal = read_terms(*objective, "terminal", in);
}

namespace {

using Role = WatchedSignal::Role;

using Measure = WatchedSignal::Measure;

/// The measure that a key names; kNone of `peak` and `signal`.
Measure measure_of(const std::string& key) {
  const auto found = std::find(kMeasureNames.begin(), kMeasureNames.end(), key);
  return found == kMeasureNames.end() ? Measure::kNone
                                      : static_cast<Measure>(found - kMeasureNames.begin() + 1);
}

bool has_band(Measure measure) { return measure >= Measure::kArrival; }

void read_band(const YamlValue& value, const EntryContext& in, WatchedSignal* watched) {
  const std::vector<YamlValue> edges = value.items();
  if (edges.size() != 2)
    value.fail("a band has two edges, found " + std::to_string(edges.size()), "[lower, upper]");
  watched->band_lower = read_quantity(edges[0], in.table);
  watched->band_upper = read_quantity(edges[1], in.table);
  if (!(watched->band_lower.nominal() < watched->band_upper.nominal()))
    value.fail("the lower edge of the band must be less than the upper one", "lower < upper");
}

/// A bound on the magnitude, which is a bound on both sides.
void read_bound_of_peak(const YamlValue& value, const EntryContext& in, WatchedSignal* watched) {
  const Quantity bound = read_quantity(value, in.table);
  if (!(bound.nominal() > 0.0))
    value.fail("a peak is the largest magnitude of a signal, so its bound must be positive",
               "more than 0");
  watched->upper = bound;
  watched->lower =
      bound.is_constant()
          ? Quantity(-bound.nominal())
          : Quantity(-bound.nominal(), in.table.parse("-(" + bound.expression()->text() + ")"));
}

void read_weight_of_peak(const YamlValue& value, const EntryContext&, WatchedSignal* watched) {
  watched->weight = value.number();
  if (!(watched->weight > 0.0)) value.fail("the weight of a peak must be positive", "more than 0");
}

EntryKey<WatchedSignal> number_key(const char* name, double WatchedSignal::*member) {
  return optional_key<WatchedSignal>(
      name, [member](const YamlValue& value, const EntryContext&, WatchedSignal* watched) {
        watched->*member = value.number();
      });
}

/// The keys of all forms: the signal under `key`, its reference and, but for the end, the interval.
WatchedKeys signal_keys(const char* key, Role role) {
  const bool at_end = role != Role::kPath && role != Role::kPeak;
  WatchedKeys keys{
      required_key<WatchedSignal>(
          key,
          [at_end](const YamlValue& value, const EntryContext& in, WatchedSignal* watched) {
            watched->signal = read_signal_of(value, in, at_end);
          }),
      reference_key<WatchedSignal>()};
  if (role == Role::kFinal) return keys;
  return with(keys, WatchedKeys{number_key("after", &WatchedSignal::after),
                                number_key("before", &WatchedSignal::before)});
}

/// Of path, final and constraints: `key` is `signal`, a measure or `peak`.
WatchedKeys bounded_keys(const char* key, Role role) {
  const WatchedKeys signal = with(signal_keys(key, role), WatchedKeys{tolerance_key()});
  if (key == std::string("peak"))
    return with(signal, WatchedKeys{required_key<WatchedSignal>("at_most", read_bound_of_peak)});
  const WatchedKeys bounded = with(signal, bound_keys<WatchedSignal>());
  if (!has_band(measure_of(key))) return bounded;
  return with(bounded, WatchedKeys{required_key<WatchedSignal>("band", read_band)});
}

WatchedKeys term_keys(Measure measure) {
  if (measure == Measure::kNone)
    return with(signal_keys("signal", Role::kPeak),
                WatchedKeys{optional_key<WatchedSignal>("weight", read_weight_of_peak)});
  const WatchedKeys keys = with(signal_keys("signal", Role::kTerm), WatchedKeys{term_weight_key()});
  if (!has_band(measure)) return keys;
  return with(keys, WatchedKeys{required_key<WatchedSignal>("band", read_band)});
}

/// Times, or numbers of postures.
void check_interval(const YamlValue& value, const Study& study, const WatchedSignal& watched) {
  const bool has_postures = study.postures > 0;
  const double first = has_postures ? std::ceil(watched.after) : watched.after;
  const bool is_ordered = has_postures ? first <= watched.before : watched.after < watched.before;
  if (watched.role == Role::kFinal ||
      (watched.after >= 0.0 && is_ordered && watched.before <= study.duration))
    return;
  const std::string unit = has_postures ? "" : " s";
  value.fail("the interval from " + to_decimal(watched.after) + unit + " to " +
                 to_decimal(watched.before) + unit + " is not part of the study",
             std::string("0 <= after ") + (has_postures ? "<=" : "<") + " before <= " +
                 to_decimal(study.duration) + (has_postures ? ", numbers of postures" : unit));
}

WatchedSignal read_watched_entry(const YamlValue& value, const WatchedKeys& keys, Role role,
                                 Measure measure, const EntryContext& in) {
  if (has_band(measure) && in.study.postures > 0)
    value.fail("postures have no times at which a signal enters a band",
               "stroke, maximum, minimum, peak");
  WatchedSignal watched;
  watched.role = role;
  watched.measure = measure;
  watched.where = value.where();
  watched.element = value.path();
  watched.before = in.study.duration;
  if (role == Role::kFinal) watched.after = in.study.duration;
  read_entry(value, keys, in, &watched);
  check_interval(value, in.study, watched);
  if (measure != Measure::kNone && measure != Measure::kMaximum && watched.signal.text == kEndTime)
    value.at(keys.front().name).fail("the end of a run is one number", kPlacesOfEndTime);
  return watched;
}

/// An entry with bounds, found under `key`.
WatchedSignal read_bounded(const YamlValue& value, const char* key, Role role,
                           const EntryContext& in) {
  const Measure measure = measure_of(key);
  WatchedSignal watched = read_watched_entry(value, bounded_keys(key, role), role, measure, in);
  if (key == std::string("peak")) return watched;
  require_bounds(value);
  require_ordered_bounds(watched, in.table.values);
  const bool is_difference =
      measure != Measure::kNone && measure != Measure::kMaximum && measure != Measure::kMinimum;
  if (is_difference && watched.upper && !(watched.upper->nominal() > 0.0))
    value.fail("the " + std::string(key) +
                   " of a signal is not negative, so its upper bound must be positive",
               "more than 0");
  return watched;
}

/// Adds what `read` makes of the items of a list; null: of none.
template <class Read>
void add_items(const YamlValue& parent, const char* key, std::vector<WatchedSignal>* list,
               const Read& read) {
  if (const auto items = parent.find(key))
    for (const YamlValue& item : items->items())
      if (std::optional<WatchedSignal> watched = read(item)) list->push_back(*std::move(watched));
}

}  // namespace

EntryKey<WatchedSignal> tolerance_key() {
  return optional_key<WatchedSignal>(
      "tolerance", [](const YamlValue& value, const EntryContext&, WatchedSignal* watched) {
        watched->tolerance = value.number();
        if (!(*watched->tolerance > 0.0))
          value.fail("a bound cannot be kept without any error",
                     "more than 0, in the unit of the signal");
      });
}

EntryKey<WatchedSignal> term_weight_key() {
  return optional_key<WatchedSignal>(
      "weight", [](const YamlValue& value, const EntryContext&, WatchedSignal* watched) {
        watched->weight = value.number();
        if (watched->weight == 0.0)
          value.fail("a term with the weight 0 has no effect",
                     "more than 0 to minimize, less than 0 to maximize");
      });
}

std::vector<EntryForm> forms_of_watched_signals() {
  std::vector<EntryForm> forms{{"path[]", bounded_keys("signal", Role::kPath)},
                               {"path[]", bounded_keys("signal", Role::kFinal)},
                               {"constraints[]", bounded_keys("peak", Role::kPath)},
                               {"objective.peak[]", term_keys(Measure::kNone)}};
  for (const char* measure : kMeasureNames) {
    forms.emplace_back("constraints[]", bounded_keys(measure, Role::kBounded));
    forms.emplace_back(std::string("objective.") + measure + "[]", term_keys(measure_of(measure)));
  }
  return forms;
}

void read_watched(const YamlValue& study_value, const RobotDescription& robot,
                  const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  using Found = std::optional<WatchedSignal>;
  const EntryContext in{robot, table, loader, *study};
  std::vector<WatchedSignal> watched;
  add_items(study_value, "path", &watched, [&](const YamlValue& item) -> Found {
    return read_bounded(item, "signal", Role::kPath, in);
  });
  add_items(study_value, "final", &watched, [&](const YamlValue& item) -> Found {
    return read_bounded(item, "signal", Role::kFinal, in);
  });
  add_items(study_value, "constraints", &watched, [&](const YamlValue& item) -> Found {
    const char* const key = bounded_measure(item);
    if (key == nullptr) return std::nullopt;
    const bool is_peak = key == std::string("peak");
    return read_bounded(item, key, is_peak ? Role::kPath : Role::kBounded, in);
  });
  if (const auto objective = study_value.find("objective")) {
    add_items(*objective, "peak", &watched, [&](const YamlValue& item) -> Found {
      return read_watched_entry(item, term_keys(Measure::kNone), Role::kPeak, Measure::kNone, in);
    });
    for (const char* key : kMeasureNames)
      add_items(*objective, key, &watched, [&](const YamlValue& item) -> Found {
        const Measure measure = measure_of(key);
        return read_watched_entry(item, term_keys(measure), Role::kTerm, measure, in);
      });
  }
  study->watched = std::move(watched);
  read_linear(study_value, robot, table, loader, study);
}

}  // namespace codesign
