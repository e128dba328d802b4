// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/identification_records.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "description/expression.h"
#include "description/robot.h"
#include "description/study.h"
#include "jobs/csv_writer.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "mechanism_codesign/version.h"
#include "problem/load_problem.h"
#include "reading/urdf/overlay.h"
#include "reading/urdf/urdf_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kWhiteBelow = 0.01;  // probability below which residuals do not count as white
constexpr std::size_t kShownOptima = 10, kToldSentences = 5;

Json number_json(const IdentifiedNumber& number) {
  Json object = record_json(number);
  object["interval"] = number.is_on_bound ? Json() : Json::array({number.low, number.high});
  return object;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd deviations = covariance.diagonal().cwiseSqrt();
  return covariance.cwiseQuotient(deviations * deviations.transpose());
}

Json outputs_json(const std::vector<OutputFit>& fits, Eigen::Index samples) {
  Json joints = Json::object();
  for (const OutputFit& fit : fits) {
    joints[fit.joint] = record_json(fit);
    joints[fit.joint]["whiteness"] = record_json(fit.whiteness);
  }
  return {{"samples", samples}, {"joints", std::move(joints)}};
}

void add_rows(const std::string& set, const FittedSeries& series,
              std::vector<std::vector<std::string>>* rows) {
  Eigen::Index row = 0;
  for (std::size_t recording = 0; recording < series.lengths.size(); ++recording)
    for (const Eigen::Index end = row + series.lengths[recording]; row < end; ++row) {
      std::vector<std::string> cells = {set, std::to_string(recording + 1),
                                        to_decimal(series.times[to_index(row)])};
      for (Eigen::Index k = 0; k < series.recorded.cols(); ++k) {
        cells.push_back(to_decimal(series.recorded(row, k)));
        cells.push_back(to_decimal(series.computed(row, k)));
      }
      rows->push_back(std::move(cells));
    }
}

std::string sentence_of(const std::string& set, const OutputFit& fit, bool is_fitted) {
  return set + ", " + fit.joint + ": root mean square of the residuals " +
         (is_fitted ? readable(fit.start) + " -> " : "") + readable(fit.rms) + " of " +
         readable(fit.recorded) + " recorded, " +
         readable(100.0 * std::max(0.0, fit.explained), 3) + " % explained" +
         (fit.counted < 1.0
              ? " of the " + readable(100.0 * fit.counted, 3) + " % of the samples that count"
              : "") +
         (fit.whiteness.probability < kWhiteBelow ? "; not white, correlation of neighbours " +
                                                        readable(fit.whiteness.first_correlation, 2)
                                                  : "");
}

Json searches_json(const FitSearches& searches, const std::vector<IdentifiedNumber>& numbers) {
  Json optima = Json::array();
  for (const Optimum& optimum : searches.optima) {
    Json values = Json::object();
    for (std::size_t k = 0; k < numbers.size(); ++k)
      values[numbers[k].name] = optimum.rho[to_signed(k)];
    optima.push_back({{"mean_spread", optimum.objective},
                      {"found", optimum.found},
                      {"values", std::move(values)}});
  }
  Json object = record_json(searches);
  object["optima"] = std::move(optima);
  return object;
}

std::string residuals_text(const IdentificationResult& result) {
  std::ostringstream text;
  CsvWriter csv(text, residual_columns(result), "residuals.csv");
  for (const std::vector<std::string>& row : residual_rows(result)) csv.write(row);
  return text.str();
}

std::string identified_urdf(const Problem& problem, const IdentificationResult& result) {
  return write_tuned_urdf(problem.urdf(), problem.overlays(), result.parameters, std::nullopt,
                          robot_of(problem).laws);
}

constexpr int kDigits = 6;

std::string interval_text(const IdentifiedNumber& number) {
  if (number.is_on_bound) return "on its bound, without an interval";
  if (!number.is_determined) return "not identifiable: the recordings do not determine it";
  std::string text = readable(number.low, kDigits) + " to " + readable(number.high, kDigits) +
                     ", standard deviation " + readable(number.deviation, kDigits);
  if (const auto& profile = number.profile)
    text += "; by its profile " + readable(profile->lower, kDigits) + " to " +
            readable(profile->upper, kDigits);
  return text;
}

std::string heading(const Problem& problem) {
  return "Identified by codesign identify, version " + std::string(version()) + ", from " +
         problem.study_text().name + "; intervals of " +
         readable(100.0 * study_of(problem).identification->intervals.level) +
         " %. Give this file after the other overlays of the model.";
}

/// A line for each number that only the study can take.
std::string of_the_study(const IdentificationResult& result,
                         const std::map<std::string, const IdentifiedNumber*>& left) {
  std::string lines;
  for (const IdentifiedNumber& number : result.numbers) {
    if (left.count(number.name) == 0) continue;
    const std::size_t slash = number.name.rfind('/');
    const std::string value = to_decimal(number.value);
    std::string place = "identify." + number.name + ": " + value;
    if (identifier_fault(number.name).empty())
      place = "parameters: {" + number.name + ": {initial: " + value + "}}";
    if (slash != std::string::npos)
      place = "identify: {joints: {" + number.name.substr(0, slash) + ": {" +
              number.name.substr(slash + 1) + ": " + value + "}}}";
    lines += "\n       " + place + "   " + interval_text(number);
  }
  return lines.empty() ? "" : "Not of the model; a study takes them so:" + lines;
}

/// The fitted numbers, and how well they are known.
void add_numbers(const Problem& problem, const IdentificationResult& result, Json* object) {
  Json& to = *object;
  Json names = Json::array();
  for (const IdentifiedNumber& number : result.numbers) {
    to["identified"][number.name] = number_json(number);
    names.push_back(number.name);
  }
  const IntervalOptions& intervals = study_of(problem).identification->intervals;
  to["level"] = intervals.level;
  to["noise"] = kNoiseNames[to_index(intervals.noise)];
  to["lag"] = result.lag;
  to["rank"] = result.rank;
  to["undetermined"] = result.undetermined;
  to["combinations"] = records_json(result.combinations);
  to["names"] = std::move(names);
  to["covariance"] = rows_json(result.covariance);
  to["correlation"] = rows_json(correlation_of(result.covariance));
}

bool has_rest_bounds(const IdentificationDescription& of) {
  return std::any_of(of.data.begin(), of.data.end(), [](const RecordingDescription& recording) {
    return recording.rest == RestRule::kBounds;
  });
}

}  // namespace

Json identification_json(const Problem& problem, const IdentificationResult& result) {
  Json object = record_json(result);
  if (result.outputs().empty()) return object;
  object["parameters"] = parameters_json(problem, result.parameters);
  if (!result.numbers.empty()) add_numbers(problem, result, &object);
  object["loss"] = study_of(problem).identification->loss.kind->name;
  if (has_rest_bounds(*study_of(problem).identification)) object["rest_bounds"] = true;
  object["inflation"] = result.inflation;
  if (!result.data.empty()) object["data"] = outputs_json(result.data, result.samples);
  if (!result.searches.starts.empty())
    object["multistart"] = searches_json(result.searches, result.numbers);
  if (!result.holdout.empty())
    object["holdout"] = outputs_json(result.holdout, result.holdout_samples);
  return object;
}

void append_first(const std::string& what, const std::vector<std::string>& whole,
                  const std::string& rest, std::vector<std::string>* sentences) {
  constexpr std::size_t kLongest = 160;
  for (std::size_t k = 0; k < std::min(kToldSentences, whole.size()); ++k)
    sentences->push_back(what + (whole[k].size() <= kLongest
                                     ? whole[k]
                                     : whole[k].substr(0, kLongest - 4) + " ..."));
  if (whole.size() > kToldSentences)
    sentences->push_back("and " + std::to_string(whole.size() - kToldSentences) + " more; " + rest);
}

namespace {

/// With a prior that decides the rest, one line; else the first sentences. Long ones stand in the
/// JSON.
void append_undetermined(const IdentificationResult& result, std::vector<std::string>* sentences) {
  if (result.undetermined.empty()) return;
  if (result.status.ok()) {
    const auto on_bound = std::count_if(
        result.numbers.begin(), result.numbers.end(),
        [](const IdentifiedNumber& number) { return number.is_on_bound && number.is_determined; });
    const auto free = static_cast<int>(result.numbers.size()) - static_cast<int>(on_bound);
    sentences->push_back("the data determine " + std::to_string(result.rank) +
                         " numbers or combinations of " + std::to_string(free) +
                         " numbers; the prior decides the other " +
                         std::to_string(free - result.rank));
    return;
  }
  append_first("not identifiable: ", result.undetermined, "what is known stands below", sentences);
}

}  // namespace

std::vector<std::string> identification_sentences(const IdentificationResult& result) {
  std::vector<std::string> sentences;
  const bool is_fitted = result.termination != kEvaluated;
  for (const OutputFit& fit : result.holdout)
    sentences.push_back(sentence_of("holdout", fit, is_fitted));
  for (const OutputFit& fit : result.data)
    sentences.push_back(sentence_of(is_fitted ? "fitted data" : "data", fit, is_fitted));
  append_undetermined(result, &sentences);
  const std::vector<Optimum>& optima = result.searches.optima;
  for (std::size_t k = 0; k < std::min(kShownOptima, optima.size()); ++k)
    sentences.push_back("optimum " + std::to_string(k + 1) + ": mean spread of the residuals " +
                        readable(optima[k].objective) + ", found by " +
                        std::to_string(optima[k].found) + " of " +
                        std::to_string(result.searches.starts.size()) + " fits");
  return sentences;
}

std::string identification_report(const Problem& problem, const IdentificationResult& result,
                                  const Warnings& of_run) {
  Json object = identification_json(problem, result);
  add_outcome(problem, of_run, result.status, &object);
  return to_text(object);
}

std::vector<std::string> residual_columns(const IdentificationResult& result) {
  std::vector<std::string> columns = {"set", "recording", "time"};
  for (const OutputFit& fit : result.outputs()) {
    columns.push_back(fit.joint + "/recorded");
    columns.push_back(fit.joint + "/computed");
  }
  return columns;
}

std::vector<std::vector<std::string>> residual_rows(const IdentificationResult& result) {
  std::vector<std::vector<std::string>> rows;
  add_rows("data", result.data_series, &rows);
  add_rows("holdout", result.holdout_series, &rows);
  return rows;
}

std::vector<IdentificationFile> identification_files(const Problem& problem,
                                                     const IdentificationResult& result,
                                                     const std::string& json) {
  std::vector<IdentificationFile> files = {{"identification.json", [&json] { return json; }}};
  if (result.termination != kEvaluated) {
    files.push_back({"identified_overlay.urdf",
                     [&problem, &result] { return identified_overlay(problem, result); }});
    files.push_back(
        {"identified.urdf", [&problem, &result] { return identified_urdf(problem, result); }});
  }
  files.push_back({"residuals.csv", [&result] { return residuals_text(result); }});
  files.push_back({"job_study.yaml", [&problem] { return problem.study_text().text; }});
  return files;
}

IdentificationShow identification_show(const Problem& problem, const IdentificationResult& result,
                                       const std::string& json, ComparedMotion motion) {
  IdentificationShow show{problem.study_text().text,
                          json,
                          identified_urdf(problem, result),
                          std::move(motion),
                          result.data_series,
                          result.holdout_series,
                          {}};
  for (const OutputFit& fit : result.outputs()) show.joints.push_back(fit.joint);
  return show;
}

std::string identified_overlay(const Problem& problem, const IdentificationResult& result) {
  std::map<std::string, const IdentifiedNumber*> numbers;
  for (const IdentifiedNumber& number : result.numbers) numbers[number.name] = &number;
  const std::vector<Parameter>& declared = robot_of(problem).parameters;
  std::vector<SetValue> values;
  for (std::size_t k = 0; k < declared.size(); ++k) {
    const auto found = numbers.find(declared[k].name);
    if (found == numbers.end() && result.parameters[k] == declared[k].value) continue;
    SetValue set{declared[k], result.parameters[k], "not identified: as the study has it"};
    if (found != numbers.end()) {
      set.comment = interval_text(*found->second) +
                    (declared[k].unit.empty() ? "" : " [" + declared[k].unit + "]");
      numbers.erase(found);
    }
    values.push_back(set);
  }
  return write_set_overlay(robot_of(problem).name, heading(problem), values,
                           of_the_study(result, numbers));
}

}  // namespace codesign
