// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/variants.h"

#include <algorithm>

#include "assembly/make_system.h"
#include "description/robot.h"
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "sampling/sampler.h"

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

bool is_tuned(const Study& study, const std::string& name) {
  return std::any_of(study.tuned.begin(), study.tuned.end(),
                     [&](int index) { return study.parameters[to_index(index)].name == name; });
}

/// The points of the Sobol sequence have a largest dimension. @param quantities that are drawn, in
/// words.
void require_dimension(SamplerKind sampler, std::size_t count, const SourceLocation& where,
                       const std::string& block, const std::string& quantities) {
  if (sampler != SamplerKind::kSobol || count <= to_index(kMaxSobolDimension)) return;
  throw InputError({where, block + ".sampler",
                    "the sampler sobol draws fewer quantities than there are " + quantities,
                    std::to_string(count) + " " + quantities,
                    "at most " + std::to_string(kMaxSobolDimension) +
                        ", or sampler: latin_hypercube or random"});
}

}  // namespace

void require_compatible(const Study& study) {
  const EnsembleDescription& ensemble = study.ensemble;
  const RobustOptions robust = ensemble.robust_options();
  require_dimension(robust.sampler, ensemble.uncertain.size(), robust.where, "robust",
                    "uncertain parameters");
  if (ensemble.multistart.starts > 0)
    require_dimension(ensemble.multistart.sampler, study.tuned.size(), ensemble.multistart.where,
                      "multistart", "tuned parameters");
  for (const RunDescription& run : study.ensemble.runs)
    for (const auto& [name, value] : run.set)
      if (is_tuned(study, name))
        throw tuned_error(run.where, "runs." + run.name + ".set." + name, name);
  for (const UncertainQuantity& quantity : study.ensemble.uncertain)
    if (quantity.parameter >= 0 && is_tuned(study, quantity.name))
      throw tuned_error(quantity.where, "uncertain." + quantity.name, quantity.name);
  for (const ParameterChoice& choice : study.choices) static_cast<void>(places_of(choice, study));
  if (study.ensemble.multistart.starts == 0) return;
  for (int index : study.tuned)
    if (const auto fault = find_missing_bounds(study.parameters[to_index(index)]))
      throw InputError(*fault);
}

int count_laws(const Study& study) {
  const UncertainQuantity* const law = uncertain_law(study);
  return law ? static_cast<int>(law->laws.size()) : 0;
}

std::vector<std::shared_ptr<const CompiledSystem>> make_variants(
    const RobotDescription& robot, const Study& study,
    const std::shared_ptr<const CompiledSystem>& own, Warnings* warnings) {
  const UncertainQuantity* const law = uncertain_law(study);
  if (study.ensemble.runs.empty() && !law) return {};
  std::vector<std::shared_ptr<const CompiledSystem>> variants;
  const std::size_t runs = std::max<std::size_t>(1, study.ensemble.runs.size());
  for (std::size_t r = 0; r < runs; ++r) {
    const Study* const changed =
        study.ensemble.runs.empty() ? nullptr : study.ensemble.runs[r].study.get();
    Warnings found;
    variants.push_back(changed ? make_system(robot, *changed, &found) : own);
    for (std::size_t k = 0; law && k < law->laws.size(); ++k)
      variants.push_back(make_system(with_law(robot, *find_friction(robot.laws, law->laws[k])),
                                     changed ? *changed : study, &found));
    append(found, warnings);
  }
  return variants;
}

std::shared_ptr<const CompiledSystem> variant_of(const Problem& problem, int run, int law) {
  const auto& variants = contents_of(problem).variants;
  if (variants.empty()) return system_of(problem);
  const auto laws = to_index(count_laws(study_of(problem)));
  return variants[to_index(run) * (1 + laws) + to_index(1 + law)];
}

std::vector<std::shared_ptr<const CompiledSystem>> distinct_systems(const Problem& problem) {
  std::vector<std::shared_ptr<const CompiledSystem>> systems{system_of(problem)};
  for (const auto& system : contents_of(problem).variants)
    if (std::find(systems.begin(), systems.end(), system) == systems.end())
      systems.push_back(system);
  return systems;
}

}  // namespace codesign
