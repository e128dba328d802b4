// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/linearize.h"

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "integration/integrator.h"
#include "linear/equilibrium.h"
#include "text/number_text.h"

namespace codesign {

LinearModel linearize_at_rest(const CompiledSystem& system, const std::vector<double>& parameters,
                              const LinearQuestion& question, const std::atomic<bool>* cancel) {
  Equilibrium found = find_equilibrium(system, parameters, {}, cancel, question);
  found.linear.status = found.status;
  return std::move(found.linear);
}

LinearModel linearize_in_motion(const CompiledSystem& system, const std::vector<double>& parameters,
                                const LinearQuestion& question, double t,
                                const std::atomic<bool>* cancel) {
  const MotionStudy& study = system.study();
  if (study.postures > 0 || t > study.duration)
    throw InputError({{study.file, 1},
                      study.postures > 0 ? "positions" : "duration",
                      study.postures > 0 ? "an instant of a run is asked for, and the study has "
                                           "postures in place of a run"
                                         : "an instant after the end of the run is asked for",
                      study.postures > 0 ? "" : to_decimal(t),
                      study.postures > 0 ? "a study with duration and initial_state"
                                         : "at most " + to_decimal(study.duration) + " s"});
  if (question.friction == LinearFriction::kGivenSpeed)
    throw InputError({{study.file, 1},
                      "initial_state",
                      "friction at a given speed is one about rest, and an instant of a run is "
                      "asked for, where friction counts with its speeds",
                      "",
                      "one of the two"});
  const std::unique_ptr<Integrator> run = make_integrator(system);
  run->obey(cancel);
  LinearModel failed;
  failed.status = run->start(parameters);
  while (failed.status.ok() && run->state().t < t) failed.status = run->advance(t);
  if (!failed.status.ok()) return failed;
  return linear_model({&system, parameters, question, false}, run->state(),
                      run->assembly().theta());
}

}  // namespace codesign
