// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/optimization/problem.h"

#include <cmath>
#include <sstream>

#include "mechanism_codesign/model/error.h"
#include "mechanism_codesign/model/nearest_name.h"
#include "mechanism_codesign/model/study_reader.h"

namespace codesign {
namespace {

std::string text_of(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

[[noreturn]] void fail(const std::string& name, double value, const std::string& message, const std::string& allowed) {
  throw InputError({{"settings", 0}, name, message, text_of(value), allowed});
}

Parameter& find_parameter(Study* study, const std::string& name, double value) {
  std::vector<std::string> known;
  for (Parameter& parameter : study->parameters) {
    if (parameter.name == name) return parameter;
    known.push_back(parameter.name);
  }
  const std::string near = nearest_name(name, known);
  std::string allowed;
  for (const std::string& candidate : known) allowed += (allowed.empty() ? "" : ", ") + candidate;
  fail(name, value, near.empty() ? "no such parameter" : "no such parameter, did you mean \"" + near + "\"?",
       known.empty() ? "none, the model has no parameters" : allowed);
}

void apply_settings(const ParameterSettings& settings, Study* study) {
  for (const auto& [name, value] : settings) {
    Parameter& parameter = find_parameter(study, name, value);
    if (!std::isfinite(value) || value < parameter.lower || value > parameter.upper)
      fail(name, value, "value outside the parameter's bounds", "[" + text_of(parameter.lower) + ", " + text_of(parameter.upper) + "]");
    parameter.value = value;
  }
}

Problem compile(Problem problem, const ParameterSettings& settings) {
  apply_settings(settings, &problem.study);
  problem.system = make_system(problem.robot, problem.study);
  return problem;
}

}  // namespace

std::vector<double> Problem::parameters() const {
  std::vector<double> values;
  values.reserve(study.parameters.size());
  for (const Parameter& parameter : study.parameters) values.push_back(parameter.value);
  return values;
}

Eigen::VectorXd Problem::start() const {
  Eigen::VectorXd rho(static_cast<Eigen::Index>(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] = study.parameters[static_cast<std::size_t>(study.tuned[k])].value;
  return rho;
}

std::vector<double> Problem::parameters(const Eigen::VectorXd& rho) const {
  std::vector<double> values = parameters();
  for (std::size_t k = 0; k < study.tuned.size(); ++k) values[static_cast<std::size_t>(study.tuned[k])] = rho[static_cast<Eigen::Index>(k)];
  return values;
}

std::vector<std::string> Problem::tuned_names() const {
  std::vector<std::string> names;
  names.reserve(study.tuned.size());
  for (int index : study.tuned) names.push_back(study.parameters[static_cast<std::size_t>(index)].name);
  return names;
}

Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays, const SourceText& study,
                     const ParameterSettings& settings) {
  Problem problem;
  problem.urdf = urdf;
  problem.overlays = overlays;
  problem.robot = read_urdf(urdf, overlays);
  problem.study = read_study(study, problem.robot);
  return compile(std::move(problem), settings);
}

Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays, const ParameterSettings& settings) {
  Problem problem;
  problem.urdf = urdf;
  problem.overlays = overlays;
  problem.robot = read_urdf(urdf, overlays);
  problem.study.parameters = problem.robot.parameters;
  problem.study.file = urdf.name;
  return compile(std::move(problem), settings);
}

}  // namespace codesign
