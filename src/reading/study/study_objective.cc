// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_objective.h"

#include "mechanism/signal_catalog.h"
#include "reading/study/study_references.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

ObjectiveTerm read_term(const YamlValue& value, const RobotDescription& robot, const ParameterTable& table, const TrajectoryLoader& loader,
                        const Study& study) {
  value.require_keys({"signal"}, {"reference", "weight"});
  ObjectiveTerm term;
  term.where = value.where();
  const YamlValue signal = value.at("signal");
  term.signal = parse_signal(signal.text(), signal.where(), signal.path());
  check_signal(term.signal, robot, study.controllers, signal.path());
  if (const auto reference = value.find("reference")) term.reference = read_reference(*reference, table, loader);
  if (const auto weight = value.find("weight")) term.weight = read_quantity(*weight, table);
  return term;
}

std::vector<ObjectiveTerm> read_terms(const YamlValue& objective, const std::string& key, const RobotDescription& robot,
                                      const ParameterTable& table, const TrajectoryLoader& loader, const Study& study) {
  std::vector<ObjectiveTerm> terms;
  if (const auto list = objective.find(key))
    for (const YamlValue& item : list->items()) terms.push_back(read_term(item, robot, table, loader, study));
  return terms;
}

}  // namespace

void read_objective(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table,
                    const TrajectoryLoader& loader, Study* study) {
  const auto objective = study_value.find("objective");
  if (!objective) return;
  objective->require_keys({}, {"integral", "terminal", "peak"});
  study->integral = read_terms(*objective, "integral", robot, table, loader, *study);
  study->terminal = read_terms(*objective, "terminal", robot, table, loader, *study);
}

}  // namespace codesign
