// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/jobs/best_record.h"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "mechanism_codesign/jobs/whole_file.h"

namespace codesign {
namespace {

using Json = nlohmann::ordered_json;

Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values) {
  Json object = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i) object[names[i]] = values[static_cast<Eigen::Index>(i)];
  return object;
}

Json all_by_name(const Problem& problem, const Eigen::VectorXd& rho) {
  Json object = Json::object();
  const std::vector<double> values = problem.parameters(rho);
  for (std::size_t i = 0; i < values.size(); ++i) object[problem.study.parameters[i].name] = values[i];
  return object;
}

}  // namespace

void BestRecord::note(const Trial& trial) {
  const bool better = trial.status.ok() && trial.iteration > iteration_;
  if (!better) return;
  if (iteration_ < 0) first_ = trial;
  iteration_ = trial.iteration;
  try {
    write_whole_file(prefix_ + "best.urdf", write_tuned_urdf(problem_.urdf, problem_.overlays, problem_.parameters(trial.rho)));
    write_whole_file(prefix_ + "best.json", json(trial));
    failure_.clear();
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

std::string BestRecord::json(const Trial& trial) const {
  Json object;
  object["model"] = problem_.robot.name;
  object["objective"] = trial.objective;
  object["initial_objective"] = first_.objective;
  object["parameters"] = all_by_name(problem_, trial.rho);
  object["initial_parameters"] = all_by_name(problem_, first_.rho);
  object["gradient"] = by_name(problem_.tuned_names(), trial.gradient);
  object["iterations"] = trial.iteration;
  object["evaluations"] = trial.evaluation;
  object["termination"] = "running";
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void BestRecord::remove() {
  for (const char* name : {"best.urdf", "best.json"}) unlink((prefix_ + name).c_str());
}

}  // namespace codesign
