// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_watched.h"

#include "mechanism/signal_catalog.h"
#include "reading/study/study_references.h"
#include "reading/study/study_values.h"
#include "text/decimal.h"

namespace codesign {
namespace {

using Role = WatchedSignal::Role;

struct Reader {
  const RobotDescription& robot;
  const ParameterTable& table;
  const TrajectoryLoader& loader;
  const Study& study;

  void read_bounds(const YamlValue& value, WatchedSignal* watched) const {
    const auto between = value.find("between"), at_least = value.find("at_least"), at_most = value.find("at_most");
    if (between ? at_least || at_most : !at_least && !at_most)
      value.fail("a constraint needs bounds, either by between or by at_least and at_most",
                 "between: [lower, upper]; or at_least, at_most or both");
    if (between) {
      const std::vector<YamlValue> bounds = between->items();
      if (bounds.size() != 2) between->fail("two bounds are needed, found " + std::to_string(bounds.size()), "[lower, upper]");
      watched->lower = read_quantity(bounds[0], table);
      watched->upper = read_quantity(bounds[1], table);
    }
    if (at_least) watched->lower = read_quantity(*at_least, table);
    if (at_most) watched->upper = read_quantity(*at_most, table);
    require_ordered_bounds(*watched, table.values);
  }

  void read_interval(const YamlValue& value, WatchedSignal* watched) const {
    watched->before = study.duration;
    if (const auto after = value.find("after")) watched->after = after->number();
    if (const auto before = value.find("before")) watched->before = before->number();
    if (watched->after < 0.0 || !(watched->after < watched->before) || watched->before > study.duration)
      value.fail("the interval from " + to_decimal(watched->after) + " s to " + to_decimal(watched->before) + " s is not part of the study",
                 "0 <= after < before <= " + to_decimal(study.duration) + " s");
  }

  WatchedSignal read(const YamlValue& value, Role role) const {
    std::vector<std::string> optional{"reference"};
    if (role == Role::kPeak) optional.emplace_back("weight");
    if (role != Role::kPeak) optional.insert(optional.end(), {"between", "at_least", "at_most"});
    if (role != Role::kFinal) optional.insert(optional.end(), {"after", "before"});
    value.require_keys({"signal"}, optional);
    WatchedSignal watched;
    watched.role = role;
    watched.where = value.where();
    watched.element = value.path();
    const YamlValue signal = value.at("signal");
    watched.signal = parse_signal(signal.text(), signal.where(), signal.path());
    check_signal(watched.signal, robot, study.controllers, signal.path());
    if (const auto reference = value.find("reference")) watched.reference = read_reference(*reference, table, loader);
    if (role != Role::kPeak) read_bounds(value, &watched);
    if (const auto weight = value.find("weight")) {
      watched.weight = weight->number();
      if (!(watched.weight > 0.0)) weight->fail("the weight of a peak must be positive", "more than 0");
    }
    if (role == Role::kFinal) {
      watched.after = watched.before = study.duration;
    } else {
      read_interval(value, &watched);
    }
    return watched;
  }

  void read_list(const YamlValue& parent, const char* key, Role role, std::vector<WatchedSignal>* list) const {
    if (const auto items = parent.find(key))
      for (const YamlValue& item : items->items()) list->push_back(read(item, role));
  }
};

}  // namespace

void read_watched(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table, const TrajectoryLoader& loader,
                  Study* study) {
  const Reader reader{robot, table, loader, *study};
  std::vector<WatchedSignal> watched;
  reader.read_list(study_value, "path", Role::kPath, &watched);
  reader.read_list(study_value, "final", Role::kFinal, &watched);
  if (const auto objective = study_value.find("objective")) reader.read_list(*objective, "peak", Role::kPeak, &watched);
  study->watched = std::move(watched);
}

void refuse_adjoint_of_watched(const YamlValue& study_value, const Study& study) {
  if (study.watched.empty() || study.solver.gradient != GradientMethod::kAdjoint) return;
  study_value.at("solver")
      .at("gradient")
      .fail("the adjoint has no derivatives of the extreme values that path, final and objective.peak need", "auto, direct");
}

}  // namespace codesign
