// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/evaluation_record.h"

#include <cmath>
#include <stdexcept>

#include "jobs/json.h"
#include "jobs/json_records.h"
#include "text/decimal.h"
#include "text/fingerprint.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A double without loss; JSON has no numbers for infinity and NaN.
Json exact(double value) { return std::isfinite(value) ? Json(value) : Json(to_decimal(value)); }

double number_of(const Json& value) {
  if (!value.is_string()) return value.get<double>();
  const std::optional<double> number = parse_number(value.get<std::string>());
  if (!number) throw std::invalid_argument("not a number: " + value.get<std::string>());
  return *number;
}

template <class Values>
Json numbers_json(const Values& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(exact(value));
  return array;
}

std::vector<double> numbers_of(const Json& array) {
  std::vector<double> values;
  for (const Json& value : array) values.push_back(number_of(value));
  return values;
}

Eigen::VectorXd vector_of(const Json& array) {
  const std::vector<double> values = numbers_of(array);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Json extremes_json(const Extremes& extremes) {
  const auto& [values, times, gradients] = extremes;
  return {{"values", numbers_json(values)}, {"times", numbers_json(times)}, {"gradients", numbers_json(gradients.reshaped())}};
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
  if (numbers.size() != size * (size + 1) / 2) throw std::invalid_argument("a root of another size than the gradient");
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
    if (code == StatusCode::kNotIdentifiable) throw std::invalid_argument("unknown status: " + name);
  }
}

Json statistics_json(const Statistics& statistics) {
  const auto& [steps, rejected, seconds, drift, energy, explicit_steps] = statistics;
  return Json::array({steps, rejected, exact(seconds), exact(drift), exact(energy), explicit_steps});
}

// The first journals with a checksum per line have no explicit steps.
Statistics statistics_of(const Json& array) {
  constexpr std::size_t kOldSize = 5;
  return {array.at(0).get<std::int64_t>(), array.at(1).get<std::int64_t>(),
          number_of(array.at(2)),          number_of(array.at(3)),
          number_of(array.at(4)),          array.size() > kOldSize ? array.at(kOldSize).get<std::int64_t>() : 0};
}

Warnings warnings_of(const Json& array) {
  Warnings warnings;
  for (const Json& one : array)
    warnings.push_back({one.at("code").get<std::string>(),
                        one.at("message").get<std::string>(),
                        {one.at("file").get<std::string>(), one.at("line").get<int>()}});
  return warnings;
}

}  // namespace

std::string to_line(const EvaluationRecord& record) {
  // All members by name, so that a new member of Evaluation does not compile before it is written here and read in read_line().
  const auto& [status, objective, gradient, root, extremes, statistics, warnings] = record.evaluation;
  const bool with_gradient = record.derivatives != Derivatives::kNone, with_root = record.derivatives == Derivatives::kGaussNewton;
  Json line = {{"system", record.system}, {"parameters", numbers_json(record.parameters)}, {"with_gradient", with_gradient}};
  if (with_root) line["with_root"] = true;
  line["status"] = name_of(status.code);
  line["time"] = exact(status.time);
  if (!status.cause.empty()) line["message"] = status.cause;
  if (status.ok()) line["objective"] = exact(objective);
  if (status.ok() && with_gradient) line["gradient"] = numbers_json(gradient);
  if (status.ok() && with_root) line["root"] = root_json(root);
  if (status.ok() && extremes.values.size() > 0) line["extremes"] = extremes_json(extremes);
  line["statistics"] = statistics_json(statistics);
  if (!warnings.empty()) line["warnings"] = to_json(warnings);
  return with_checksum(line.dump(-1, ' ', false, Json::error_handler_t::replace));
}

EvaluationRecord read_line(const std::string& line) {
  if (!has_right_checksum(line)) throw std::invalid_argument("its checksum is not that of its text");
  const Json object = Json::parse(line);
  EvaluationRecord record;
  record.system = object.at("system").get<int>();
  record.parameters = numbers_of(object.at("parameters"));
  const bool with_gradient = object.at("with_gradient").get<bool>(), with_root = object.value("with_root", false);
  record.derivatives = with_root ? Derivatives::kGaussNewton : gradient_if(with_gradient);
  Evaluation& evaluation = record.evaluation;
  evaluation.status = {code_of(object.at("status").get<std::string>()), number_of(object.at("time")),
                       object.value("message", std::string())};
  if (evaluation.status.ok()) evaluation.objective = number_of(object.at("objective"));
  if (evaluation.status.ok() && with_gradient) evaluation.gradient = vector_of(object.at("gradient"));
  if (evaluation.status.ok() && with_root) evaluation.jacobian_root = root_of(object.at("root"), evaluation.gradient.size());
  if (object.contains("extremes")) evaluation.extremes = extremes_of(object.at("extremes"));
  evaluation.statistics = statistics_of(object.at("statistics"));
  if (object.contains("warnings")) evaluation.warnings = warnings_of(object.at("warnings"));
  return record;
}

}  // namespace codesign
