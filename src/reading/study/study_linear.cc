// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "description/linear_measure.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using Role = WatchedSignal::Role;

struct LinearReader {
  const ParameterTable& table;
  const Study& study;

  /// A measure of loops or of poles.
  LinearMeasure read_measure(const YamlValue& value, bool of_poles) const {
    const auto names = kLinearMeasureNames.begin();
    const auto first = names + (of_poles ? 0 : kPoleMeasures),
               last = of_poles ? names + kPoleMeasures : kLinearMeasureNames.end();
    const std::string name = value.choice("measure", std::vector<std::string>(first, last));
    LinearMeasure measure;
    measure.kind = static_cast<LinearMeasure::Kind>(std::find(first, last, name) -
                                                    kLinearMeasureNames.begin());
    const auto is_sampled = [](const ControllerDescription& controller) {
      return controller.realization.is_sampled();
    };
    if (measure.kind == LinearMeasure::Kind::kRadius &&
        std::none_of(study.controllers.begin(), study.controllers.end(), is_sampled))
      value.fail("no controller of the study is sampled, so that poles have no radius",
                 "growth, damping_ratio, or a controller with sample_time");
    return measure;
  }

  /// A controller that drives a joint.
  std::string read_controller(const YamlValue& value) const {
    std::vector<std::string> known;
    for (const ControllerDescription& controller : study.controllers) {
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
    return value.text();
  }

  WatchedSignal watched(const YamlValue& value, const LinearMeasure& measure, Role role) const {
    if (study.postures > 0)
      value.fail(
          "poles and loops are those about the rest of a motion, and positions are many "
          "postures",
          "a study with duration; runs that set other starts or set-points");
    WatchedSignal watched;
    watched.role = role;
    watched.measure = measure.counts_smallest() ? WatchedSignal::Measure::kMinimum
                                                : WatchedSignal::Measure::kMaximum;
    watched.where = value.where();
    watched.element = value.path();
    watched.before = study.duration;
    watched.signal.where = value.where();
    watched.signal.text = (measure.is_of_poles() ? "poles" : "loop " + measure.controller) +
                          std::string(", ") +
                          kLinearMeasureNames[static_cast<std::size_t>(measure.kind)];
    watched.linear = std::make_shared<const LinearMeasure>(measure);
    return watched;
  }

  /// `{loop: CONTROLLER, measure: NAME, at_least: Q}` or `{poles: NAME, at_most: Q}`.
  WatchedSignal read_bounded(const YamlValue& item) const {
    const bool of_poles = item.find("poles").has_value();
    if (of_poles)
      item.require_keys({"poles"}, {"between", "at_least", "at_most", "tolerance"});
    else
      item.require_keys({"loop", "measure"}, {"between", "at_least", "at_most", "tolerance"});
    LinearMeasure measure = read_measure(item.at(of_poles ? "poles" : "measure"), of_poles);
    if (!of_poles) measure.controller = read_controller(item.at("loop"));
    WatchedSignal result = watched(item, measure, Role::kBounded);
    const Between bounds = read_between(item, table);
    result.lower = bounds.lower;
    result.upper = bounds.upper;
    require_ordered_bounds(result, table.values);
    if (const auto tolerance = item.find("tolerance")) {
      result.tolerance = tolerance->number();
      if (!(*result.tolerance > 0.0))
        tolerance->fail("a bound cannot be kept without any error", "more than 0");
    }
    return result;
  }

  WatchedSignal read_term(const YamlValue& item, bool of_poles) const {
    item.require_keys(of_poles ? std::vector<std::string>{"measure"}
                               : std::vector<std::string>{"loop", "measure"},
                      {"weight"});
    LinearMeasure measure = read_measure(item.at("measure"), of_poles);
    if (!of_poles) measure.controller = read_controller(item.at("loop"));
    WatchedSignal result = watched(item, measure, Role::kTerm);
    if (const auto weight = item.find("weight")) {
      result.weight = weight->number();
      if (result.weight == 0.0)
        weight->fail("a term with the weight 0 has no effect",
                     "more than 0 to minimize, less than 0 to maximize");
    }
    return result;
  }
};

}  // namespace

bool is_linear_item(const YamlValue& item) {
  return item.is_map() && (item.find("loop") || item.find("poles"));
}

void read_linear(const YamlValue& study_value, const ParameterTable& table, Study* study) {
  const LinearReader reader{table, *study};
  std::vector<WatchedSignal> found;
  if (const auto items = study_value.find("constraints"))
    for (const YamlValue& item : items->items())
      if (is_linear_item(item)) found.push_back(reader.read_bounded(item));
  if (const auto objective = study_value.find("objective"))
    for (const char* key : {"loop", "poles"})
      if (const auto items = objective->find(key))
        for (const YamlValue& item : items->items())
          found.push_back(reader.read_term(item, std::string(key) == "poles"));
  study->watched.insert(study->watched.end(), found.begin(), found.end());
}

}  // namespace codesign
