// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/json.h"

#include "description/study.h"
#include "mechanism_codesign/version.h"
#include "problem/load_problem.h"

namespace codesign {

Json by_name(const std::vector<std::string>& names, const std::vector<double>& values) {
  Json object = Json::object();
  for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) object[names[i]] = values[i];
  return object;
}

Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values) {
  return by_name(names, std::vector<double>(values.data(), values.data() + values.size()));
}

Json rows_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(Json::array());
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows.back().push_back(matrix(i, j));
  }
  return rows;
}

Json parameters_json(const Problem& problem, const std::vector<double>& values) {
  std::vector<std::string> names;
  for (const Parameter& parameter : study_of(problem).parameters) names.push_back(parameter.name);
  return by_name(names, values);
}

std::string to_text(const Json& object) {
  Json whole = {{"version", version()}};
  whole.update(object);
  return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace codesign
