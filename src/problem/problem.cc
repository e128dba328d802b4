// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/problem.h"

#include <cmath>

#include "assembly/make_system.h"
#include "equations/compiled_system.h"
#include "math/cpu_timer.h"
#include "problem/margins.h"
#include "problem/unused_parameters.h"
#include "reading/study/study_reader.h"
#include "text/decimal.h"
#include "text/unknown_name.h"

namespace codesign {
namespace {

constexpr const char* kSettings = "parameter settings";

std::string range_of(const Parameter& parameter) { return "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]"; }

Parameter& find_parameter(Study* study, const std::string& name) {
  for (Parameter& parameter : study->parameters)
    if (parameter.name == name) return parameter;
  std::vector<std::string> known;
  for (const Parameter& parameter : study->parameters) known.push_back(parameter.name);
  throw unknown_name({kSettings, 0}, name, "parameter", name, known);
}

void apply_settings(const ParameterSettings& settings, Study* study) {
  for (const auto& [name, value] : settings) {
    Parameter& parameter = find_parameter(study, name);
    if (!std::isfinite(value) || value < parameter.lower || value > parameter.upper)
      throw InputError({{kSettings, 0}, name, "value outside the parameter's bounds", to_decimal(value), range_of(parameter)});
    parameter.value = value;
  }
}

std::vector<double> parameter_values(const Study& study) {
  std::vector<double> values;
  values.reserve(study.parameters.size());
  for (const Parameter& parameter : study.parameters) values.push_back(parameter.value);
  return values;
}

}  // namespace

std::vector<double> Problem::parameters() const { return system->parameters(); }

Eigen::VectorXd Problem::start() const {
  Eigen::VectorXd rho(static_cast<Eigen::Index>(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] = study.parameters[static_cast<std::size_t>(study.tuned[k])].value;
  return rho;
}

std::vector<double> Problem::parameters(const Eigen::VectorXd& rho) const { return system->parameters(rho); }

std::vector<std::string> Problem::tuned_names() const {
  std::vector<std::string> names;
  names.reserve(study.tuned.size());
  for (int index : study.tuned) names.push_back(study.parameters[static_cast<std::size_t>(index)].name);
  return names;
}

Problem compile(Problem problem, const ParameterSettings& settings) {
  apply_settings(settings, &problem.study);
  const CpuTimer timer;
  require_numbers_at_start(problem.study, parameter_values(problem.study));
  append(unused_parameters(problem), &problem.warnings);
  problem.system = make_system(problem.robot, problem.study, &problem.warnings);
  problem.setup_seconds += timer.seconds();
  return problem;
}

Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays, const SourceText& study,
                     const ParameterSettings& settings, const TrajectoryLoader& loader) {
  const CpuTimer timer;
  Problem problem;
  problem.urdf = urdf;
  problem.overlays = overlays;
  problem.study_text = study;
  problem.robot = read_urdf(urdf, overlays);
  problem.study = read_study(study, problem.robot, loader);
  append(problem.robot.warnings, &problem.warnings);
  problem.setup_seconds = timer.seconds();
  return compile(std::move(problem), settings);
}

void require_objective(const Study& study) {
  if (study.integral.empty() && study.terminal.empty())
    throw InputError({{study.file, 1},
                      "objective",
                      "the study has no objective: it can be simulated and checked, but there is nothing to optimize",
                      "",
                      "at least one term under objective.integral or objective.terminal"});
}

Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays, const ParameterSettings& settings) {
  const CpuTimer timer;
  Problem problem;
  problem.urdf = urdf;
  problem.overlays = overlays;
  problem.robot = read_urdf(urdf, overlays);
  append(problem.robot.warnings, &problem.warnings);
  problem.setup_seconds = timer.seconds();
  problem.study.parameters = problem.robot.parameters;
  problem.study.file = urdf.name;
  return compile(std::move(problem), settings);
}

}  // namespace codesign
