// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEST_INTEGRATION_ENERGY_BALANCE_H_
#define MECHANISM_CODESIGN_TEST_INTEGRATION_ENERGY_BALANCE_H_

#include <algorithm>
#include <cmath>
#include <string>

#include "integration/mechanisms.h"
#include "mechanism_codesign/dynamics/energy.h"
#include "mechanism_codesign/forces/joint_stop.h"
#include "mechanism_codesign/integration/rosenbrock_integrator.h"

namespace codesign {

struct Balance {
  double start = 0.0, largest_drift = 0.0, end = 0.0, friction_work = 0.0;
  Status status;
};

/// Power lost to friction at one instant [W].
inline double friction_power(const System& system, Equations<double>* equations, const State<double>& state) {
  equations->load(state);
  double power = 0.0;
  for (const JointLoad& load : system.loads()) {
    if (!load.reaction_friction && !load.constant_friction) continue;
    const FrictionState<double> friction = equations->friction(load.pair, load.element);
    power += friction.load * friction.velocity;
  }
  for (int pair : system.contacts()) power += equations->contact(pair).power();
  return power;
}

/// Elastic energy of the stops at one instant [J].
inline double stop_energy(const System& system, Equations<double>* equations, const State<double>& state) {
  equations->load(state);
  const LimitOptions& stop = system.study().limits;
  double energy = 0.0;
  for (const JointLoad& load : system.loads()) {
    if (!load.stop) continue;
    const auto& limit = equations->constants().pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
    const double position = equations->coordinate(load.pair, load.element).position;
    for (double excess : {limit.lower - position, position - limit.upper}) energy += stop_energy(excess, stop.stiffness, stop.width);
  }
  return energy;
}

/// Runs a study, adding up friction's work by Gauss quadrature within each step.
inline Balance balance(const std::string& urdf, const std::string& study_text) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml", study_text}, description);
  const auto system = make_system(description, study);
  RosenbrockIntegrator integrator(*system);
  Balance result;
  result.status = integrator.start(system->parameters());
  RosenbrockStep<double>& step = integrator.step();
  const auto energy = [&] {
    return mechanical_energy(*system, step.equations().constants(), step.state()).total() +
           stop_energy(*system, &step.equations(), step.state());
  };
  result.start = energy();
  State<double> inner;
  inner.resize(system->layout());
  while (result.status.ok() && step.state().t < study.duration) {
    result.status = integrator.advance(study.duration);
    for (double node : {-0.7745966692414834, 0.0, 0.7745966692414834}) {
      double psi = 0.0;
      step.interpolate(0.5 * (1.0 + node), &inner, &psi);
      result.friction_work += step.step_size() * (node == 0.0 ? 8.0 : 5.0) / 18.0 * friction_power(*system, &step.equations(), inner);
    }
    result.largest_drift = std::max(result.largest_drift, std::abs(energy() - result.start));
  }
  result.end = energy();
  return result;
}

/// Tolerances for motions without friction, and with it.
inline const char* const kTight = "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-12}";
inline const char* const kFriction = "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}";

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_TEST_INTEGRATION_ENERGY_BALANCE_H_
