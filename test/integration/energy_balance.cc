// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/energy_balance.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace codesign {

Balance balance(const std::string& urdf, const std::string& study_text) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml", study_text}, description);
  const auto system = make_system(description, study);
  RosenbrockIntegrator integrator(*system);
  Balance result;
  result.status = integrator.start(system->parameters());
  OneStep<double>& step = integrator.step();
  const auto energy = [&] {
    step.equations().formulas().load(step.state());
    return mechanical_energy(step.equations()).total();
  };
  result.start = energy();
  State<double> inner;
  inner.resize(system->layout());
  while (result.status.ok() && step.state().t < study.duration) {
    result.status = integrator.advance(study.duration);
    for (double node : {-0.7745966692414834, 0.0, 0.7745966692414834}) {
      double psi = 0.0;
      step.interpolate(0.5 * (1.0 + node), &inner, &psi);
      step.equations().formulas().load(inner);
      const Power power = mechanical_power(&step.equations());
      const double weight = step.step_size() * (node == 0.0 ? 8.0 : 5.0) / 18.0;
      result.friction_work -= weight * power.friction;
      result.work += weight * power.total();
    }
    result.largest_drift = std::max(result.largest_drift, std::abs(energy() - result.start));
  }
  result.end = energy();
  return result;
}

}  // namespace codesign
