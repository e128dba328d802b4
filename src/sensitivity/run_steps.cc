// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/run_steps.h"

#include <algorithm>
#include <array>
#include <vector>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kFinerShare = 1e-2, kSecondShare = 10.0, kLeastTolerance = 1e-13;
// Steps of a duration at least, in both sets, which have no common instants.
constexpr double kLeastSteps = 200.0, kLeastOfSecond = 320.0;
// A pulse lasts less than this share of a study (find_excursions()), which the steps above do not
// divide well; and the most instants by which all pulses are divided.
constexpr double kPulseShare = 0.2;
constexpr double kMostInstants = 2000.0;

/// Adds instants within the pulses.
void divide_pulses(double duration, double parts, std::vector<double>* breaks) {
  std::sort(breaks->begin(), breaks->end());
  std::vector<std::size_t> pulses;
  for (std::size_t k = 1; k < breaks->size(); ++k)
    if (const double width = (*breaks)[k] - (*breaks)[k - 1];
        width > 0.0 && width < kPulseShare * duration)
      pulses.push_back(k);
  if (pulses.empty()) return;
  const int each =
      static_cast<int>(std::min(parts, kMostInstants / static_cast<double>(pulses.size())));
  std::vector<double> instants;
  for (std::size_t k : pulses)
    for (int i = 1; i < each; ++i)
      instants.push_back((*breaks)[k - 1] + ((*breaks)[k] - (*breaks)[k - 1]) * i / each);
  breaks->insert(breaks->end(), instants.begin(), instants.end());
  std::sort(breaks->begin(), breaks->end());
}

}  // namespace

const char* name_of(RunSteps::Method method) {
  constexpr std::array<const char*, 4> kNames{"own", "dopri5", "rodas5p", "rodas4p2"};
  return kNames[to_index(method)];
}

RunSteps::Method other_method(const CompiledSystem& system, const Statistics& own) {
  const bool is_implicit = system.study().solver.integrator == IntegratorKind::kRosenbrock &&
                           2 * own.explicit_steps < own.steps;
  // Loops that share reactions are never integrated explicitly, theory (15c).
  if (is_implicit && system.compliance() > 0.0) return RunSteps::Method::kRodas5P;
  return is_implicit ? RunSteps::Method::kDopri5 : RunSteps::Method::kRodas5P;
}

RunSteps::Method fallback_method(const CompiledSystem& system, RunSteps::Method failed) {
  const bool has_rodas5p = failed == RunSteps::Method::kRodas5P ||
                           system.study().solver.method != RosenbrockMethod::kRodas4P2;
  return has_rodas5p ? RunSteps::Method::kRodas4P2 : RunSteps::Method::kRodas5P;
}

Study with_steps(const Study& study, const RunSteps& steps) {
  Study result = study;
  SolverOptions& solver = result.solver;
  constexpr std::array<RosenbrockMethod, 4> kMethods{
      RosenbrockMethod::kAuto, RosenbrockMethod::kDopri5, RosenbrockMethod::kRodas5P,
      RosenbrockMethod::kRodas4P2};
  if (steps.method == RunSteps::Method::kOwn || study.postures > 0) return result;
  solver.integrator = IntegratorKind::kRosenbrock;
  solver.method = kMethods[to_index(steps.method)];
  for (double* tolerance : {&solver.relative_tolerance, &solver.absolute_tolerance})
    *tolerance = std::max(kFinerShare * *tolerance, kLeastTolerance) *
                 (steps.is_second ? kSecondShare : 1.0);
  const double parts = steps.is_second ? kLeastOfSecond : kLeastSteps,
               longest = study.duration / parts;
  solver.maximum_step =
      solver.maximum_step > 0.0 ? std::min(solver.maximum_step, longest) : longest;
  solver.maximum_steps = steps.most;
  divide_pulses(study.duration, parts, &result.excursions);
  return result;
}

std::shared_ptr<const CompiledSystem> with_steps(const CompiledSystem& system,
                                                 const RunSteps& steps) {
  return std::make_shared<const CompiledSystem>(
      system.robot(), with_steps(system.whole_study(), steps), system.sharing());
}

}  // namespace codesign
