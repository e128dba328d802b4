// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/scenario.h"

#include <algorithm>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "sampling/samples.h"

namespace codesign {
namespace {

/// The study's runs; the study itself if it has none.
std::vector<RunDescription> runs_of(const Study& study) {
  if (!study.ensemble.runs.empty()) return study.ensemble.runs;
  return {RunDescription{}};
}

int index_of(const Study& study, const std::string& name) {
  const auto found = std::find_if(study.parameters.begin(), study.parameters.end(),
                                  [&name](const Parameter& p) { return p.name == name; });
  return static_cast<int>(found - study.parameters.begin());
}

/// Applies the sample `row`, one value per uncertain quantity, to a scenario. @param law receives
/// the friction law, an index of the quantity's laws.
void take_sample(const std::vector<UncertainQuantity>& uncertain, const std::vector<double>& row,
                 Scenario* scenario, int* law) {
  for (std::size_t k = 0; k < uncertain.size(); ++k) {
    if (uncertain[k].parameter < 0) {
      *law = static_cast<int>(row[k]);
      scenario->friction_law = uncertain[k].laws[to_index(*law)];
    } else {
      scenario->values.emplace_back(uncertain[k].parameter, row[k]);
    }
  }
}

std::vector<Scenario> combine(const Problem& problem,
                              const std::vector<std::vector<double>>& samples) {
  const Study& study = study_of(problem);
  const std::vector<RunDescription> runs = runs_of(study);
  double sum = 0.0;
  for (const RunDescription& run : runs) sum += run.weight;
  std::vector<Scenario> scenarios;
  const std::size_t count = std::max<std::size_t>(1, samples.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Scenario run;
    run.run = runs[r].name;
    run.weight = runs[r].weight / sum / static_cast<double>(count);
    for (const auto& [name, value] : runs[r].set)
      run.values.emplace_back(index_of(study, name), value);
    for (std::size_t s = 0; s < count; ++s) {
      Scenario scenario = run;
      int law = -1;
      if (!samples.empty()) {
        scenario.sample = static_cast<int>(s);
        take_sample(study.ensemble.uncertain, samples[s], &scenario, &law);
      }
      scenario.system = variant_of(problem, static_cast<int>(r), law);
      scenarios.push_back(std::move(scenario));
    }
  }
  return scenarios;
}

// An arbitrary constant; two seeds that users choose are unlikely to differ by it.
constexpr std::uint32_t kFresh = 0x9e3779b9u;

}  // namespace

std::vector<double> Scenario::parameters(const Eigen::VectorXd& rho) const {
  std::vector<double> parameters = system->parameters(rho);
  for (const auto& [index, value] : values) parameters[to_index(index)] = value;
  return parameters;
}

std::string scenario_name(const std::string& run, int sample) {
  std::string text;
  if (!run.empty()) text = "run \"" + run + "\"";
  if (sample >= 0) text += (text.empty() ? "sample " : ", sample ") + std::to_string(sample + 1);
  return text;
}

std::vector<Scenario> make_scenarios(const Problem& problem) {
  const EnsembleDescription& ensemble = study_of(problem).ensemble;
  const RobustOptions options = ensemble.robust_options();
  // A single sample is the nominal one.
  if (ensemble.uncertain.empty() || options.samples == 1) return combine(problem, {});
  std::vector<std::vector<double>> samples =
      draw(ensemble.uncertain, options.sampler, options.samples, options.seed);
  if (options.measure == RobustMeasure::kWorst)
    for (std::vector<double>& corner : corners(ensemble.uncertain))
      samples.push_back(std::move(corner));
  return combine(problem, samples);
}

std::vector<Scenario> make_validation_scenarios(const Problem& problem, int count) {
  const EnsembleDescription& ensemble = study_of(problem).ensemble;
  const RobustOptions options = ensemble.robust_options();
  if (ensemble.uncertain.empty()) return combine(problem, {});
  return combine(problem, draw(ensemble.uncertain, options.sampler, count, options.seed + kFresh));
}

}  // namespace codesign
