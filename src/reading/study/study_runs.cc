// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_values.h"
#include "recordings/number_table.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr std::size_t kMostRuns = 1000;

void check_name(const std::string& name, const SourceLocation& where, const std::string& element) {
  constexpr const char* kSigns =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  constexpr std::size_t kLongest = 100;
  const bool is_good = !name.empty() && name.size() <= kLongest &&
                       name.find_first_not_of(kSigns) == std::string::npos;
  if (!is_good || name[0] == '.' || name[0] == '-')
    throw InputError({where, element, "not a name for a run", name,
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

/// The keys of a run: what it sets, then the blocks of the study that it changes, which are read
/// with the study, read_changed().
const EntryKeys<RunDescription, Study>& run_keys() {
  using Run = RunDescription;
  static const EntryKeys<Run, Study> kKeys{{"set", false,
                                            [](const YamlValue& value, const Study& study,
                                               Run* run) { run->set = read_set(value, study); }},
                                           {"weight", false,
                                            [](const YamlValue& value, const Study&, Run* run) {
                                              run->weight = value.number();
                                              if (!(run->weight > 0.0))
                                                value.fail(
                                                    "the weight of a run must be positive",
                                                    "more than 0, relative to the other runs");
                                            }},
                                           {"initial_state", false, nullptr},
                                           {"controllers", false, nullptr},
                                           {"loads", false, nullptr},
                                           {"motion", false, nullptr},
                                           {"gravity", false, nullptr}};
  return kKeys;
}

RunDescription read_run_entry(const YamlValue& study_value, const std::string& name,
                              const YamlValue& value, const Study& study,
                              const RunReader& read_run) {
  check_name(name, value.where(), value.path());
  RunDescription run;
  run.name = name;
  run.where = value.where();
  read_entry(value, run_keys(), study, &run);
  check_controllers(value, study);
  if (std::any_of(run_keys().begin(), run_keys().end(),
                  [&value](const auto& key) { return !key.read && value.find(key.name); }))
    run.study = read_changed(study_value, name, value, study, read_run);
  return run;
}

void require_count(std::size_t count, const YamlValue& runs) {
  if (count == 0 || count > kMostRuns)
    runs.fail("found " + std::to_string(count) + " runs",
              "1 to " + std::to_string(kMostRuns) + ", each NAME: {set: {...}, ...}");
}

/// The numbers of a row of a table: one of its columns is a parameter, or `weight`.
void apply_cell(const std::string& column, double value, const Study& study, RunDescription* run) {
  const std::string element = "column \"" + column + "\"";
  if (column == "weight") {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError({run->where, element, "the weight of a run must be positive",
                        to_decimal(value), "more than 0, relative to the other runs"});
    run->weight = value;
    return;
  }
  const int index = untuned_parameter(column, study, run->where, element, {"run", "weight"});
  const Parameter& parameter = study.parameters[to_index(index)];
  require_within_bounds(value, parameter, run->where, element);
  run->set.emplace_back(column, value);
}

/// Runs that differ in parameters alone, one per row of a table.
std::vector<RunDescription> read_table_of_runs(const YamlValue& runs, const Study& study,
                                               const FileLoader& files) {
  if (!files) runs.fail("no file can be read here", "the runs themselves");
  const SourceText source = files({runs.text(), runs.where(), runs.path()});
  const NumberTable table(source.name, source.text, CellDelimiter::kAuto, false);
  const std::vector<std::string>& names = table.names();
  const auto of_names = std::find(names.begin(), names.end(), "run");
  if (of_names == names.end())
    throw InputError({{source.name, table.first_line()},
                      "runs",
                      "no column has the names of the runs",
                      "",
                      "a first row of names: run, parameters, and weight if runs differ in it"});
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw InputError({{source.name, table.first_line()},
                        "runs",
                        "two columns have the same name",
                        *name,
                        "each parameter once"});
  std::vector<int> columns;
  for (int k = 0; k < table.width(); ++k)
    if (names[to_index(k)] != "run") columns.push_back(k);
  const NumberTable::Columns cells = table.read(columns);
  std::vector<RunDescription> result;
  for (const std::string& name : table.texts(static_cast<int>(of_names - names.begin()))) {
    RunDescription& run = result.emplace_back();
    const std::size_t row = result.size() - 1;
    run.name = name;
    run.where = {source.name, static_cast<int>(cells.lines[row])};
    check_name(name, run.where, "column \"run\"");
    for (std::size_t other = 0; other < row; ++other)
      if (result[other].name == name)
        throw InputError({run.where, "column \"run\"", "two runs have the same name", name,
                          "another name in each row"});
    for (std::size_t k = 0; k < columns.size(); ++k)
      apply_cell(names[to_index(columns[k])], cells.values[k][row], study, &run);
  }
  require_count(result.size(), runs);
  return result;
}

}  // namespace

std::vector<EntryForm> forms_of_runs() { return {{"runs.NAME", run_keys()}}; }

std::vector<RunDescription> read_runs(const YamlValue& study_value, const Study& study,
                                      const RunReader& read_run, const FileLoader& files) {
  const YamlValue runs = study_value.at("runs");
  if (runs.is_scalar()) return read_table_of_runs(runs, study, files);
  const auto entries = runs.entries();
  require_count(entries.size(), runs);
  std::vector<RunDescription> result;
  result.reserve(entries.size());
  for (const auto& [name, value] : entries)
    result.push_back(read_run_entry(study_value, name, value, study, read_run));
  return result;
}

}  // namespace codesign
