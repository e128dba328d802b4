// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <memory>

#include "math/arrays.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

constexpr std::size_t kMostRuns = 1000;

void check_name(const std::string& name, const YamlValue& value) {
  constexpr const char* kSigns =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  constexpr std::size_t kLongest = 100;
  const bool is_good = !name.empty() && name.size() <= kLongest &&
                       name.find_first_not_of(kSigns) == std::string::npos;
  if (!is_good || name[0] == '.' || name[0] == '-')
    throw InputError({value.where(), value.path(), "not a name for a run", name,
                      "up to 100 letters, digits, underscores, hyphens and dots, beginning with a "
                      "letter, digit or underscore"});
}

std::vector<std::pair<std::string, double>> read_set(const YamlValue& set, const Study& study) {
  std::vector<std::pair<std::string, double>> values;
  for (const auto& [name, value] : set.entries()) {
    const int index = untuned_parameter(name, study, value);
    values.emplace_back(name, read_within_bounds(value, study.parameters[to_index(index)]));
  }
  return values;
}

/// A controller that the study does not have is most likely misspelt.
void check_controllers(const YamlValue& run, const Study& study) {
  const auto controllers = run.find("controllers");
  if (!controllers) return;
  std::vector<std::string> known;
  for (const ControllerDescription& controller : study.controllers)
    known.push_back(controller.name);
  for (const auto& [name, value] : controllers->entries()) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw unknown_name(controllers->key_place(name), value.path(), "controller of the study",
                         name, known);
    if (!value.is_map())
      value.fail("the change of a controller must be a map",
                 "{setpoint: 1.0}, or other keys of the controller");
  }
}

bool is_same(const Parameter& a, const Parameter& b) {
  return a.name == b.name && a.value == b.value && a.lower == b.lower && a.upper == b.upper;
}

/// A run must not change what `basis` controllers declare.
void require_same_parameters(const YamlValue& run, const Study& changed, const Study& study) {
  const bool same = changed.tuned == study.tuned &&
                    std::equal(changed.parameters.begin(), changed.parameters.end(),
                               study.parameters.begin(), study.parameters.end(), is_same);
  if (!same)
    run.at("controllers")
        .fail(
            "a run has the parameters of the study, so it must not change the coefficients that a "
            "controller declares",
            "`set` for values of parameters that are not tuned");
}

/// The study with the changes of a run. A fault at a place outside the run says that the run's
/// changes have caused it.
std::shared_ptr<const Study> read_changed(const YamlValue& study_value, const std::string& name,
                                          const YamlValue& run, const Study& study,
                                          const RunReader& read_run) {
  try {
    auto changed = std::make_shared<const Study>(read_run(study_value.merged(run)));
    require_same_parameters(run, *changed, study);
    return changed;
  } catch (const InputError& error) {
    InputFault fault = error.fault();
    if (fault.element.compare(0, run.path().size(), run.path()) != 0)
      fault.message += ", with the changes of the run \"" + name + "\"";
    throw InputError(fault);
  }
}

RunDescription read_run_entry(const YamlValue& study_value, const std::string& name,
                              const YamlValue& value, const Study& study,
                              const RunReader& read_run) {
  const std::vector<std::string> changes{"initial_state", "controllers", "loads", "motion",
                                         "gravity"};
  check_name(name, value);
  value.require_keys(
      {}, {"set", "weight", "initial_state", "controllers", "loads", "motion", "gravity"});
  RunDescription run;
  run.name = name;
  run.where = value.where();
  if (const auto set = value.find("set")) run.set = read_set(*set, study);
  if (const auto weight = value.find("weight")) {
    run.weight = weight->number();
    if (!(run.weight > 0.0))
      weight->fail("the weight of a run must be positive",
                   "more than 0, relative to the other runs");
  }
  check_controllers(value, study);
  if (std::any_of(changes.begin(), changes.end(),
                  [&value](const std::string& key) { return value.find(key).has_value(); }))
    run.study = read_changed(study_value, name, value, study, read_run);
  return run;
}

}  // namespace

std::vector<RunDescription> read_runs(const YamlValue& study_value, const Study& study,
                                      const RunReader& read_run) {
  const YamlValue runs = study_value.at("runs");
  const auto entries = runs.entries();
  if (entries.empty() || entries.size() > kMostRuns)
    runs.fail("found " + std::to_string(entries.size()) + " runs",
              "1 to " + std::to_string(kMostRuns) + ", each NAME: {set: {...}, ...}");
  std::vector<RunDescription> result;
  result.reserve(entries.size());
  for (const auto& [name, value] : entries)
    result.push_back(read_run_entry(study_value, name, value, study, read_run));
  return result;
}

}  // namespace codesign
