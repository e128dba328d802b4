// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "description/linear_measure.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using Role = WatchedSignal::Role;

/// Changes the number of the linearization that a signal stands for.
template <class Change>
void set_measure(WatchedSignal* watched, const Change& change) {
  LinearMeasure measure = watched->linear ? *watched->linear : LinearMeasure();
  change(&measure);
  watched->linear = std::make_shared<const LinearMeasure>(measure);
}

/// A measure of loops or of poles.
void read_kind(const YamlValue& value, const Study& study, bool of_poles, WatchedSignal* watched) {
  const auto names = kLinearMeasureNames.begin();
  const auto first = names + (of_poles ? 0 : kPoleMeasures),
             last = of_poles ? names + kPoleMeasures : kLinearMeasureNames.end();
  const std::string name = value.choice("measure", std::vector<std::string>(first, last));
  const auto kind =
      static_cast<LinearMeasure::Kind>(std::find(first, last, name) - kLinearMeasureNames.begin());
  const auto is_sampled = [](const ControllerDescription& controller) {
    return controller.realization.is_sampled();
  };
  if (kind == LinearMeasure::Kind::kRadius &&
      std::none_of(study.controllers.begin(), study.controllers.end(), is_sampled))
    value.fail("no controller of the study is sampled, so that poles have no radius",
               "growth, damping_ratio, or a controller with sample_time");
  set_measure(watched, [kind](LinearMeasure* measure) { measure->kind = kind; });
}

/// A controller that drives a joint.
void read_loop(const YamlValue& value, const EntryContext& in, WatchedSignal* watched) {
  std::vector<std::string> known;
  for (const ControllerDescription& controller : in.study.controllers) {
    if (!controller.output.empty())
      known.push_back(controller.name);
    else if (controller.name == value.text())
      value.fail(
          "this controller drives no joint, so that its loop is that of the controller "
          "that reads it",
          "a controller with an output");
  }
  if (known.empty()) value.fail("no controller of the study drives a joint", "controllers");
  if (std::find(known.begin(), known.end(), value.text()) == known.end())
    throw unknown_name(value.where(), value.path(), "controller", value.text(), known);
  set_measure(watched, [&value](LinearMeasure* measure) { measure->controller = value.text(); });
}

EntryKey<WatchedSignal> kind_key(const char* name, bool of_poles) {
  return required_key<WatchedSignal>(
      name, [of_poles](const YamlValue& value, const EntryContext& in, WatchedSignal* watched) {
        read_kind(value, in.study, of_poles, watched);
      });
}

/// The keys of a bound on, or of a term of poles or a loop. The kind comes first, since a message
/// about it is more help than one about the controller.
WatchedKeys linear_keys(bool of_poles, bool is_bound) {
  WatchedKeys keys{kind_key(of_poles && is_bound ? "poles" : "measure", of_poles)};
  if (!of_poles) keys.push_back(required_key<WatchedSignal>("loop", read_loop));
  if (!is_bound) return with(keys, WatchedKeys{term_weight_key()});
  return with(with(keys, bound_keys<WatchedSignal>()), WatchedKeys{tolerance_key()});
}

WatchedSignal read_number(const YamlValue& value, bool of_poles, Role role,
                          const EntryContext& in) {
  WatchedSignal watched;
  watched.role = role;
  watched.where = watched.signal.where = value.where();
  watched.element = value.path();
  watched.before = in.study.duration;
  read_entry(value, linear_keys(of_poles, role == Role::kBounded), in, &watched);
  if (in.study.postures > 0)
    value.fail(
        "poles and loops are those about the rest of a motion, and positions are many "
        "postures",
        "a study with duration; runs that set other starts or set-points");
  const LinearMeasure& measure = *watched.linear;
  watched.measure = measure.counts_smallest() ? WatchedSignal::Measure::kMinimum
                                              : WatchedSignal::Measure::kMaximum;
  watched.signal.text = (measure.is_of_poles() ? "poles" : "loop " + measure.controller) +
                        std::string(", ") +
                        kLinearMeasureNames[static_cast<std::size_t>(measure.kind)];
  if (role != Role::kBounded) return watched;
  require_bounds(value);
  require_ordered_bounds(watched, in.table.values);
  return watched;
}

}  // namespace

bool is_linear_item(const YamlValue& item) {
  return item.is_map() && (item.find("loop") || item.find("poles"));
}

std::vector<EntryForm> forms_of_linear_numbers() {
  return {{"constraints[]", linear_keys(true, true)},
          {"constraints[]", linear_keys(false, true)},
          {"objective.poles[]", linear_keys(true, false)},
          {"objective.loop[]", linear_keys(false, false)}};
}

void read_linear(const YamlValue& study_value, const RobotDescription& robot,
                 const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const EntryContext in{robot, table, loader, *study};
  std::vector<WatchedSignal> found;
  if (const auto items = study_value.find("constraints"))
    for (const YamlValue& item : items->items())
      if (is_linear_item(item))
        found.push_back(read_number(item, item.find("poles").has_value(), Role::kBounded, in));
  if (const auto objective = study_value.find("objective"))
    for (const char* key : {"loop", "poles"})
      if (const auto items = objective->find(key))
        for (const YamlValue& item : items->items())
          found.push_back(read_number(item, std::string(key) == "poles", Role::kTerm, in));
  study->watched.insert(study->watched.end(), found.begin(), found.end());
}

}  // namespace codesign
