// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/request.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "identification/identify.h"
#include "jobs/job_files.h"
#include "math/arrays.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "reading/study/study_values.h"
#include "ros/bags/bag_contents.h"
#include "ros/common/parameters.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kRequest = "request";

[[noreturn]] void fail(const std::string& field, const std::string& message,
                       const std::string& value, const std::string& allowed) {
  throw InputError({{kRequest, 0}, field, message, value, allowed});
}

/// Refuses very long names, since the search for the nearest known name takes time proportional to
/// their length.
void check_length(const std::string& field, const std::string& text) {
  constexpr std::size_t kLongestName = 1000;
  if (text.size() > kLongestName)
    fail(field, "too long for a name", text.substr(0, 20) + "...",
         "at most " + std::to_string(kLongestName) + " letters");
}

/// Refuses lists of names that are longer than the list of parameters, and very long names.
void check_names(const std::vector<std::string>& names, std::size_t known) {
  if (names.size() > known)
    fail("parameters", "more names than there are parameters",
         std::to_string(names.size()) + " names", "at most " + std::to_string(known) + " names");
  for (const std::string& name : names) check_length("parameters", name);
}

std::size_t index_of(const std::string& name, const std::vector<std::string>& known) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end())
    throw unknown_name({kRequest, 0}, "parameters", "parameter", name, known);
  return to_index(found - known.begin());
}

/// Pairs names with values. Both lists must have the same length, and no name may occur twice.
ParameterSettings pair_up(const std::vector<std::string>& names, const std::vector<double>& values,
                          const std::string& field) {
  if (values.size() != names.size())
    fail(field, "one value for each parameter is needed", std::to_string(values.size()) + " values",
         std::to_string(names.size()) + " values");
  ParameterSettings settings;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      fail("parameters", "parameter named twice", names[i], "each name once");
    settings.emplace_back(names[i], values[i]);
  }
  return settings;
}

void choose_tuned(const std::vector<std::string>& names, Study* study) {
  const std::vector<std::string> known = names_of(study->parameters);
  study->tuned.clear();
  for (const std::string& name : names)
    study->tuned.push_back(static_cast<int>(index_of(name, known)));
}

template <class Request>
void choose_limits(const Request& request, OptimizerOptions* options) {
  if (request.max_evaluations > static_cast<unsigned>(std::numeric_limits<int>::max()))
    fail("max_evaluations", "count out of range", std::to_string(request.max_evaluations),
         "0 (take the study's value) to 2147483647");
  if (request.max_evaluations > 0)
    options->max_evaluations = static_cast<int>(request.max_evaluations);
  if (!(request.relative_tolerance >= 0.0 && request.relative_tolerance < 1.0))
    fail("relative_tolerance", "tolerance out of range", to_decimal(request.relative_tolerance),
         "0 (take the study's value) or more, less than 1");
  if (request.relative_tolerance > 0.0) options->relative_tolerance = request.relative_tolerance;
}

void choose_options(const mechanism_codesign::OptimizeGoal& request, OptimizerOptions* options) {
  check_length("algorithm", request.algorithm);
  if (!request.algorithm.empty()) {
    options->algorithm = request.algorithm;
    options->where = {kRequest, 0};
  }
  choose_limits(request, options);
}

/// Sets the tuned parameters of the study. @returns the start values that the request gives.
template <class Request>
ParameterSettings choose_parameters(const Request& request, Study* study) {
  if (!request.parameters.empty()) {
    pair_up(request.parameters, std::vector<double>(request.parameters.size()), "parameters");
    choose_tuned(request.parameters, study);
  }
  if (request.start.empty()) return {};
  return pair_up(tuned_names(*study), request.start, "start");
}

}  // namespace

void check_size(const Problem& problem, const std::vector<std::string>& names,
                const std::vector<double>& values, const std::string& values_field) {
  const std::size_t known = study_of(problem).parameters.size();
  check_names(names, known);
  if (values.size() > known)
    fail(values_field, "more values than there are parameters",
         std::to_string(values.size()) + " values", "at most " + std::to_string(known) + " values");
}

std::string path_in(const std::string& directory, const std::string& result) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::weakly_canonical(directory), given(expand_home(result));
  const fs::path path = fs::weakly_canonical(given.is_absolute() ? given : folder / given);
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  if (end != folder.end() || rest == path.end())
    fail("result", "not a job of the output directory", result,
         "a name or a path in " + folder.string());
  return path.string();
}

OptimizationRequest apply_request(const Problem& problem,
                                  const mechanism_codesign::OptimizeGoal& request) {
  require_objective(problem);
  OptimizerOptions options = problem.optimizer_options();
  choose_options(request, &options);
  check_size(problem, request.parameters, request.start, "start");
  if (request.parameters.empty() && request.start.empty()) return {problem, options};
  Study study = study_of(problem);
  const ParameterSettings starts = choose_parameters(request, &study);
  return {with_study(problem, std::move(study), starts), options};
}

Problem apply_request(const Problem& problem, const mechanism_codesign::IdentifyGoal& request) {
  require_identification(problem);
  check_size(problem, request.parameters, request.start, "start");
  Study study = study_of(problem);
  choose_limits(request, &study.optimizer);
  const ParameterSettings starts = choose_parameters(request, &study);
  return with_study(problem, std::move(study), starts);
}

std::optional<Failure> failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return Failure{"bad_input", error.what()};
  } catch (const JobIsRunning& error) {
    return Failure{"busy", error.what()};
  } catch (const ReadingCancelled& error) {
    return Failure{"cancelled", error.what()};
  } catch (const OutputError& error) {
    return Failure{"output_failed", error.what()};
  } catch (const std::exception& error) {
    return Failure{"internal_error", error.what()};
  }
  return std::nullopt;
}

Eigen::VectorXd design_of(const Problem& problem,
                          const mechanism_codesign::EvaluateRequest& request) {
  require_objective(problem);
  require_differentiable(study_of(problem));
  const std::vector<std::string> tuned = problem.tuned_names();
  check_length("check", request.check);
  check_size(problem, request.parameters, request.values, "values");
  Eigen::VectorXd rho = problem.start();
  for (const auto& [name, value] : pair_up(request.parameters, request.values, "values")) {
    const std::size_t k = index_of(name, tuned);
    require_within_bounds(value, tuned_parameter(study_of(problem), to_signed(k)), {kRequest, 0},
                          name);
    rho[to_signed(k)] = value;
  }
  return rho;
}

}  // namespace codesign
