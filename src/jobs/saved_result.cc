// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/saved_result.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "description/study.h"
#include "ensemble/ensemble.h"
#include "jobs/json.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "jobs/robot_gains.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kAllowed =
    "what codesign optimize writes: {\"parameters\": {NAME: number, ...}, ...}";

int line_at(const std::string& text, std::size_t offset) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + to_signed(std::min(offset, text.size())), '\n'));
}

/// Where a JSON text has its first number beyond the range of double, for which the parser tells no
/// place.
std::size_t first_overflow(const std::string& text) {
  bool is_in_text = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') {
      is_in_text = !is_in_text;
    } else if (is_in_text) {
      k += text[k] == '\\' ? 1 : 0;
    } else if (text[k] >= '0' && text[k] <= '9') {
      char* end = nullptr;
      if (std::isinf(std::strtod(text.c_str() + k, &end))) return k;
      k = to_index(end - text.c_str()) - 1;
    }
  }
  return 0;
}

Json parse(const SourceText& source) {
  try {
    return Json::parse(source.text);
  } catch (const Json::parse_error& error) {
    throw InputError(
        {{source.name, line_at(source.text, error.byte)}, "result", "not JSON", "", kAllowed});
  } catch (const Json::out_of_range&) {
    const std::size_t place = first_overflow(source.text),
                      end = source.text.find_first_of(",]} \t\r\n", place);
    throw InputError({{source.name, line_at(source.text, place)},
                      "result",
                      "a number is beyond the range of double",
                      source.text.substr(place, end - place),
                      "magnitudes up to 1.8e308"});
  }
}

/// Number of columns before the tuned parameters; older folders have no `events`.
std::ptrdiff_t first_parameter(const std::vector<std::string>& header) {
  constexpr std::size_t kEventsColumn = 6;
  const bool has_events = header.size() > kEventsColumn && header[kEventsColumn] == "events";
  return to_signed(kEventsColumn) + (has_events ? 1 : 0);
}

constexpr std::size_t kStatusColumn = 2;

using Cells = std::vector<std::string>;

Cells cells_of(const std::string& line) {
  Cells cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

[[noreturn]] void fail_changed(const std::string& file, const std::string& what, double value,
                               const std::string& other_file, double other) {
  throw NeverSimulated(file + ": " + what + " is " + to_decimal(value) + ", but " +
                       to_decimal(other) + " in " + other_file +
                       ": the values were changed after the optimization; tune again, or simulate "
                       "and optimize from the changed values");
}

/// The check of one folder.
class Examination {
 public:
  explicit Examination(std::string folder) : folder_(std::move(folder)) {}

  FinishedJob examine(const TrajectoryLoader& loader, const std::atomic<bool>* cancel) {
    const SourceText result = read_source(in_folder("result.json"));
    const ParameterSettings design = read_result(result);
    object_ = Json::parse(result.text);
    require_success();
    Problem problem = load_problem(read_source(in_folder("tuned.urdf")), {},
                                   read_source(in_folder("job_study.yaml")), design, loader);
    const std::vector<double> parameters = problem.parameters();
    FinishedJob job{
        folder_, std::move(problem), parameters, {}, object_["objective"].get<double>()};
    check_model(job);
    check_trial(&job);
    check_fixed(job);
    check_gains(job);
    check_objective(job, cancel);
    return job;
  }

 private:
  std::string in_folder(const std::string& name) const {
    return (std::filesystem::path(folder_) / name).string();
  }

  void require_success() const {
    const auto error = object_.find("error");
    if (error != object_.end())
      throw NeverSimulated(in_folder("result.json") + ": the optimization did not finish (" +
                           error->value("code", "") + ": " + error->value("message", "") + ")");
    for (const char* key : {"objective", "initial_objective"})
      if (!object_.contains(key) || !object_[key].is_number())
        throw NeverSimulated(in_folder("result.json") + ": it has no " + key +
                             ", so it is not the result of a finished optimization");
    if (!std::filesystem::exists(in_folder("details.json")))
      throw NeverSimulated(
          in_folder("details.json") +
          ": it is missing, so the optimization was cancelled or its folder is incomplete");
  }

  /// The values of the model's parameters, written into tuned.urdf.
  void check_model(const FinishedJob& job) const {
    const std::vector<Parameter>& all = job.problem.all_parameters();
    for (const Parameter& in_model : robot_of(job.problem).parameters)
      for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].name == in_model.name && job.parameters[k] != in_model.value)
          fail_changed(in_folder("result.json"), in_model.name, job.parameters[k],
                       in_folder("tuned.urdf"), in_model.value);
  }

  /// Checks that a row of convergence.csv has this design. For a job of a node with very many trial
  /// points the table is thinned out and has fewer rows than the search had evaluations; then only
  /// the simulation can prove the design.
  void check_trial(FinishedJob* job) const {
    std::istringstream table(read_source(in_folder("convergence.csv")).text);
    std::string line;
    std::getline(table, line);
    const Cells header = cells_of(line);
    const std::ptrdiff_t first = first_parameter(header);
    if (to_signed(header.size()) <= first)
      throw InputError({{in_folder("convergence.csv"), 1},
                        "header",
                        "no tuned parameters",
                        line,
                        "the table of codesign optimize"});
    job->tuned.assign(header.begin() + first, header.end());
    Cells wanted;
    for (const std::string& name : job->tuned) wanted.push_back(to_decimal(value_of(*job, name)));
    int rows = 0;
    for (; std::getline(table, line); ++rows) {
      const Cells row = cells_of(line);
      if (row.size() != header.size() || row[kStatusColumn] != name_of(StatusCode::kSuccess))
        continue;
      if (std::equal(wanted.begin(), wanted.end(), row.begin() + first)) return;
    }
    if (object_.value("evaluations", rows) > rows) return;
    std::string design;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      design += (k > 0 ? ", " : "") + job->tuned[k] + " = " + wanted[k];
    throw NeverSimulated(in_folder("result.json") + ": no trial point of convergence.csv has " +
                         design + ": the values were changed after the optimization");
  }

  double value_of(const FinishedJob& job, const std::string& name) const {
    const std::vector<Parameter>& all = job.problem.all_parameters();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].name == name) return job.parameters[k];
    throw InputError({{in_folder("convergence.csv"), 1},
                      name,
                      "the model and the study have no such parameter",
                      "",
                      "the model, the study and the overlays of the optimization"});
  }

  /// Checks that the parameters that were not tuned have the values at the begin of the search.
  void check_fixed(const FinishedJob& job) const {
    for (const auto& [name, initial] : read_result(read_source(in_folder("initial.json")))) {
      if (std::count(job.tuned.begin(), job.tuned.end(), name) > 0) continue;
      const double value = value_of(job, name);
      if (value != initial)
        fail_changed(in_folder("result.json"), name, value, in_folder("initial.json"), initial);
    }
  }

  void check_gains(const FinishedJob& job) const {
    if (study_of(job.problem).hardware.empty()) return;
    const std::string expected = gains_yaml(job.problem, job.parameters),
                      found = read_source(in_folder("gains.yaml")).text;
    if (expected == found) return;
    std::istringstream wanted_lines(expected), found_lines(found);
    std::string wanted, line;
    int number = 0;
    do {
      ++number;
      if (!std::getline(wanted_lines, wanted)) wanted.clear();
      if (!std::getline(found_lines, line)) line.clear();
    } while (wanted == line);
    throw NeverSimulated(in_folder("gains.yaml") + ":" + std::to_string(number) + ": \"" + line +
                         "\" is not what the design of result.json gives, \"" + wanted +
                         "\": the gains were changed after the optimization");
  }

  void check_objective(const FinishedJob& job, const std::atomic<bool>* cancel) const {
    const Problem& problem = job.problem;
    const bool with_gradient = !study_of(problem).tuned.empty();
    const Evaluation again =
        Ensemble(problem, 1).evaluate(problem.start(), with_gradient, cancel).total;
    if (!again.status.ok())
      throw NeverSimulated(in_folder("result.json") +
                           ": its design cannot be simulated again: " + describe(again.status));
    const double tolerance = 1e-6 * std::abs(job.objective) +
                             1e-9 * std::abs(object_["initial_objective"].get<double>());
    if (!(std::abs(again.objective - job.objective) <= tolerance))
      fail_changed(in_folder("result.json"), "the objective", job.objective,
                   "a simulation of its design", again.objective);
  }

  std::string folder_;
  Json object_;
};

}  // namespace

ParameterSettings read_result(const SourceText& json) {
  const Json object = parse(json);
  const auto parameters = object.is_object() ? object.find("parameters") : object.end();
  if (parameters == object.end() || !parameters->is_object())
    throw InputError({{json.name, 1}, "parameters", "the result has no design", "", kAllowed});
  ParameterSettings settings;
  for (const auto& [name, value] : parameters->items()) {
    if (!value.is_number()) {
      const int line =
          line_at(json.text, json.text.find(Json(name).dump(), json.text.find("\"parameters\"")));
      throw InputError(
          {{json.name, line}, "parameters." + name, "not a number", value.type_name(), "a number"});
    }
    settings.emplace_back(name, value.get<double>());
  }
  return settings;
}

std::string apply_text(const ApplyRecord& record) {
  Json object;
  object["success"] = record.success;
  object["changes"] = records_json(record.changes);
  object["rollback_seconds"] = record.rollback_seconds;
  if (record.success)
    object["message"] = record.message;
  else
    object["error"] = {{"code", record.code}, {"message", record.message}};
  return to_text(object);
}

std::string folder_of_job(const std::string& path) {
  const std::filesystem::path given(path);
  if (given.extension() == ".bag") return (given.parent_path() / given.stem()).string();
  return given.has_filename() ? path : given.parent_path().string();
}

FinishedJob read_finished_job(const std::string& path, const TrajectoryLoader& loader,
                              const std::atomic<bool>* cancel) {
  const std::string folder = folder_of_job(path);
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder, unknown))
    throw InputError({{folder, 0},
                      "",
                      "no such folder",
                      path,
                      "the folder of codesign optimize --output, or the bag of an optimization"});
  try {
    return Examination(folder).examine(loader, cancel);
  } catch (const Json::exception& error) {
    const std::string file = (std::filesystem::path(folder) / "result.json").string();
    throw InputError({{file, 0},
                      "",
                      std::string("a value has another type: ") + error.what(),
                      "",
                      "what codesign optimize writes"});
  }
}

}  // namespace codesign
