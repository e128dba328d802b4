// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/variants.h"

#include <algorithm>
#include <cmath>

#include "assembly/make_system.h"
#include "description/friction.h"
#include "equations/compiled_system.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const UncertainQuantity* uncertain_law(const Study& study) {
  for (const UncertainQuantity& quantity : study.ensemble.uncertain)
    if (quantity.parameter < 0) return &quantity;
  return nullptr;
}

RobotDescription with_law(RobotDescription robot, FrictionModel model) {
  for (JointDescription& joint : robot.joints)
    if (joint.friction) joint.friction->model = model;
  return robot;
}

void add_new(const Warnings& warnings, Warnings* all) {
  for (const Warning& warning : warnings)
    if (std::none_of(all->begin(), all->end(), [&warning](const Warning& known) { return known.message == warning.message; }))
      all->push_back(warning);
}

bool is_tuned(const Study& study, const std::string& name) {
  return std::any_of(study.tuned.begin(), study.tuned.end(),
                     [&](int index) { return study.parameters[static_cast<std::size_t>(index)].name == name; });
}

[[noreturn]] void refuse_tuned(const SourceLocation& where, const std::string& block, const std::string& name) {
  throw InputError(
      {where, block + "." + name, "this parameter is tuned, so its value is the search's", name, "a parameter that is not tuned"});
}

}  // namespace

void require_compatible(const Study& study) {
  for (const RunDescription& run : study.ensemble.runs)
    for (const auto& [name, value] : run.set)
      if (is_tuned(study, name)) refuse_tuned(run.where, "runs." + run.name + ".set", name);
  for (const UncertainQuantity& quantity : study.ensemble.uncertain)
    if (quantity.parameter >= 0 && is_tuned(study, quantity.name)) refuse_tuned(quantity.where, "uncertain", quantity.name);
  if (study.ensemble.multistart.starts == 0) return;
  for (int index : study.tuned) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(index)];
    if (!std::isfinite(parameter.lower) || !std::isfinite(parameter.upper))
      throw InputError(
          {parameter.where, "parameters." + parameter.name, "many starts need bounds to start in", "", "a lower and an upper bound"});
  }
}

int count_laws(const Study& study) {
  const UncertainQuantity* const law = uncertain_law(study);
  return law ? static_cast<int>(law->laws.size()) : 0;
}

std::vector<std::shared_ptr<const CompiledSystem>> make_variants(const RobotDescription& robot, const Study& study,
                                                                 const std::shared_ptr<const CompiledSystem>& own, Warnings* warnings) {
  const UncertainQuantity* const law = uncertain_law(study);
  if (study.ensemble.runs.empty() && !law) return {};
  std::vector<std::shared_ptr<const CompiledSystem>> variants;
  const std::size_t runs = std::max<std::size_t>(1, study.ensemble.runs.size());
  for (std::size_t r = 0; r < runs; ++r) {
    const Study* const changed = study.ensemble.runs.empty() ? nullptr : study.ensemble.runs[r].study.get();
    Warnings found;
    variants.push_back(changed ? make_system(robot, *changed, &found) : own);
    for (std::size_t k = 0; law && k < law->laws.size(); ++k)
      variants.push_back(make_system(with_law(robot, friction_model(law->laws[k]).value()), changed ? *changed : study, &found));
    add_new(found, warnings);
  }
  return variants;
}

std::shared_ptr<const CompiledSystem> variant_of(const Problem& problem, int run, int law) {
  const auto& variants = problem.contents().variants;
  if (variants.empty()) return problem.system();
  const auto laws = static_cast<std::size_t>(count_laws(problem.study()));
  return variants[static_cast<std::size_t>(run) * (1 + laws) + static_cast<std::size_t>(1 + law)];
}

}  // namespace codesign
