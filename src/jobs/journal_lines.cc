// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal_lines.h"

#include <cmath>
#include <stdexcept>

#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "mechanism_codesign/version.h"
#include "problem/load_problem.h"
#include "text/fingerprint.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// 2: each line has its checksum. 3: statistics and events have the names of their fields.
constexpr int kFormat = 3;
constexpr const char* kBegin = "{\"journal\":";

/// A key of the header with its name in messages.
struct Part {
  const char* key;
  const char* name;
};
constexpr Part kParts[] = {
    {"model", "the model differs"},
    {"overlays", "the overlays differ"},
    {"study", "the study differs"},
    {"start",
     "the values of the parameters at the start (--set, ~set or a request's start) differ"},
    {"tuned", "the tuned parameters differ"},
    {"optimizer", "the options of the optimizer differ"},
    {"trajectories", "the recorded trajectories that the study names differ"},
    {"files", "the contents of the files that the study names differ"}};

bool is_whole(const std::string& text) {
  return !text.empty() && text.size() < 10 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

std::string overlay_texts(const Problem& problem) {
  std::string text;
  for (const SourceText& overlay : problem.overlays()) text += fingerprint(overlay.text);
  return text;
}

std::string trajectory_numbers(const Problem& problem) {
  std::string text;
  for (const LoadedTrajectory& loaded : contents_of(problem).trajectories) {
    const RecordedTrajectory& recorded = loaded.trajectory;
    for (const auto* column :
         {&recorded.times, &recorded.positions, &recorded.velocities, &recorded.accelerations})
      text += format_numbers(*column) + "\n";
  }
  return text;
}

std::string file_texts(const Problem& problem) {
  std::string text;
  for (const LoadedFile& loaded : contents_of(problem).files)
    text += fingerprint(loaded.source.text);
  return text;
}

/// A double without loss.
Json exact(double value) { return number_to_json<NonFinite::kText>(value); }

template <class Values>
Json numbers_json(const Values& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(exact(value));
  return array;
}

std::vector<double> numbers_of(const Json& array) {
  std::vector<double> values;
  for (const Json& value : array) values.push_back(to_number(value));
  return values;
}

Eigen::VectorXd vector_of(const Json& array) {
  const std::vector<double> values = numbers_of(array);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), to_signed(values.size()));
}

Json extremes_json(const Extremes& extremes) {
  const auto& [values, times, gradients] = extremes;
  return {{"values", numbers_json(values)},
          {"times", numbers_json(times)},
          {"gradients", numbers_json(gradients.reshaped())}};
}

Extremes extremes_of(const Json& object) {
  Extremes extremes{vector_of(object.at("values")), vector_of(object.at("times")), {}};
  const Eigen::VectorXd gradients = vector_of(object.at("gradients"));
  const Eigen::Index count = extremes.values.size();
  if (extremes.times.size() != count || count == 0 || gradients.size() % count != 0)
    throw std::invalid_argument("extremes of unequal size");
  extremes.gradients = gradients.reshaped(gradients.size() / count, count);
  return extremes;
}

/// The upper triangle of R, column by column.
Json root_json(const Eigen::MatrixXd& root) {
  Json array = Json::array();
  for (Eigen::Index column = 0; column < root.cols(); ++column)
    for (Eigen::Index row = 0; row <= column; ++row) array.push_back(exact(root(row, column)));
  return array;
}

Eigen::MatrixXd root_of(const Json& array, Eigen::Index size) {
  const Eigen::VectorXd numbers = vector_of(array);
  if (numbers.size() != size * (size + 1) / 2)
    throw std::invalid_argument("a root of another size than the gradient");
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(size, size);
  Eigen::Index next = 0;
  for (Eigen::Index column = 0; column < size; ++column)
    for (Eigen::Index row = 0; row <= column; ++row) root(row, column) = numbers[next++];
  return root;
}

StatusCode code_of(const std::string& name) {
  for (int k = 0;; ++k) {
    const auto code = static_cast<StatusCode>(k);
    if (name == name_of(code)) return code;
    if (code == StatusCode::kSwitchHolds) throw std::invalid_argument("unknown status: " + name);
  }
}

Json events_json(const Events& events) {
  return {{"list", records_json<NonFinite::kText>(events.list)},
          {"count", events.count},
          {"order", events.order}};
}

Events events_of(const Json& object) {
  return {read_records<Event>(object.at("list")), object.at("count").get<std::int64_t>(),
          object.at("order").get<std::string>()};
}

}  // namespace

std::string journal_header(const Problem& problem, const OptimizerOptions& options) {
  std::string tuned;
  for (const std::string& name : problem.tuned_names()) tuned += name + "\n";
  const std::string optimizer = options.algorithm + " " + std::to_string(options.max_evaluations) +
                                " " + to_decimal(options.relative_tolerance);
  Json header = {{"journal", kFormat},
                 {"version", version()},
                 {"model", fingerprint(problem.urdf().text)},
                 {"overlays", fingerprint(overlay_texts(problem))},
                 {"study", fingerprint(problem.study_text().text)},
                 {"start", fingerprint(format_numbers(problem.parameters()))},
                 {"tuned", fingerprint(tuned)},
                 {"optimizer", fingerprint(optimizer)}};
  if (const std::string numbers = trajectory_numbers(problem); !numbers.empty())
    header["trajectories"] = fingerprint(numbers);
  if (const std::string texts = file_texts(problem); !texts.empty())
    header["files"] = fingerprint(texts);
  return with_checksum(header.dump());
}

std::string header_difference(const std::string& found, const std::string& expected) {
  const std::string begin = kBegin, own_format = std::to_string(kFormat);
  if (found.rfind(begin, 0) != 0) return "this is not the journal of an optimization";
  const std::string format = found.substr(begin.size(), found.find(',') - begin.size());
  if (format != own_format && is_whole(format))
    return "the journal has format " + format +
           ", written by another version of this program, which writes format " + own_format;
  const Json theirs = Json::parse(has_right_checksum(found) ? found : "", nullptr, false),
             ours = Json::parse(expected);
  if (!theirs.is_object())
    return "line 1 is damaged, and only this line says to which job the journal belongs";
  const Json version = theirs.value("version", Json());
  if (version != ours["version"])
    return "the journal is of version " + version.dump() + " of this program, which is version " +
           ours["version"].dump() + "; the bits of results may differ between versions";
  for (const Part& part : kParts)
    if (theirs.value(part.key, Json()) != ours.value(part.key, Json()))
      return std::string(part.name) + " from the journal, which belongs to another job";
  return theirs == ours ? "" : "the journal has a header that this program does not know";
}

std::string to_line(const EvaluationRecord& record) {
  // All members by name, so that a new member of Evaluation does not compile before it is written
  // here and read in read_line().
  const auto& [status, objective, gradient, root, extremes, statistics, warnings, events] =
      record.evaluation;
  const bool with_gradient = record.derivatives != Derivatives::kNone,
             with_root = record.derivatives == Derivatives::kGaussNewton;
  Json line = {{"system", record.system},
               {"parameters", numbers_json(record.parameters)},
               {"with_gradient", with_gradient}};
  if (with_root) line["with_root"] = true;
  line["status"] = name_of(status.code);
  line["time"] = exact(status.time);
  if (!status.cause.empty()) line["message"] = status.cause;
  if (status.ok()) line["objective"] = exact(objective);
  if (status.ok() && with_gradient) line["gradient"] = numbers_json(gradient);
  if (status.ok() && with_root) line["root"] = root_json(root);
  if (status.ok() && extremes.values.size() > 0) line["extremes"] = extremes_json(extremes);
  line["statistics"] = record_json<NonFinite::kText>(statistics);
  if (!warnings.empty()) line["warnings"] = to_json(warnings);
  if (events.count > 0) line["events"] = events_json(events);
  return with_checksum(line.dump(-1, ' ', false, Json::error_handler_t::replace));
}

EvaluationRecord read_line(const std::string& line) {
  if (!has_right_checksum(line))
    throw std::invalid_argument("its checksum is not that of its text");
  const Json object = Json::parse(line);
  EvaluationRecord record;
  record.system = object.at("system").get<int>();
  record.parameters = numbers_of(object.at("parameters"));
  const bool with_gradient = object.at("with_gradient").get<bool>(),
             with_root = object.value("with_root", false);
  record.derivatives = with_root ? Derivatives::kGaussNewton : gradient_if(with_gradient);
  Evaluation& evaluation = record.evaluation;
  evaluation.status = {code_of(object.at("status").get<std::string>()),
                       to_number(object.at("time")), object.value("message", std::string())};
  if (evaluation.status.ok()) evaluation.objective = to_number(object.at("objective"));
  if (evaluation.status.ok() && with_gradient)
    evaluation.gradient = vector_of(object.at("gradient"));
  if (evaluation.status.ok() && with_root)
    evaluation.jacobian_root = root_of(object.at("root"), evaluation.gradient.size());
  if (object.contains("extremes")) evaluation.extremes = extremes_of(object.at("extremes"));
  evaluation.statistics = read_record<Statistics>(object.at("statistics"));
  if (object.contains("warnings"))
    evaluation.warnings = read_records<Warning>(object.at("warnings"));
  if (object.contains("events")) evaluation.events = events_of(object.at("events"));
  return record;
}

}  // namespace codesign
