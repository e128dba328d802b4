// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/one_sided.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "description/tuned_parameters.h"
#include "integration/event_names.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {

std::optional<EndCrossing> cross_end(RosenbrockIntegrator* integrator) {
  if (integrator->is_ended() || integrator->guard() < 0) return {};
  ModeWatch& watch = integrator->mode_watch();
  Equations<double>& equations = integrator->equations();
  EndCrossing crossing{
      watch.mode(),
      equations.compiled().switch_origin(watch.mode(), to_index(integrator->guard())),
      {}};
  const Status status =
      watch.cross(integrator->state(), &integrator->assembly(), &equations, &crossing.change);
  if (!status.ok()) return {};
  return crossing;
}

void OneSidedGradient::look_at_start(RosenbrockIntegrator* integrator,
                                     const GuardDerivatives& derivatives) {
  ModeWatch& watch = integrator->mode_watch();
  const State<double>& state = integrator->initial_state();
  Equations<double>& equations = integrator->equations();
  std::vector<int> zeros;
  watch.find_zeros(state, &equations, &zeros);
  for (int guard : zeros) {
    Eigen::VectorXd change;
    derivatives(guard, &change);
    if (change.isZero(0.0) ||
        !watch.jumps_beyond(guard, state, &integrator->assembly(), &equations))
      continue;
    add(equations.compiled().switch_origin(watch.mode(), to_index(guard)),
        "the run starts exactly where this switches: the derivatives, such as that by \"" +
            tuned_parameter(system_->study(), largest(change)).name +
            "\", are those of designs on the side to which the motion leads, and do not hold on "
            "the other side");
  }
}

void OneSidedGradient::compare(const SwitchOrigin* origin, const Eigen::VectorXd& before,
                               const Eigen::VectorXd& behind, bool moves) {
  constexpr double kSame = 1e-6;
  const Eigen::VectorXd difference = behind - before;
  const Eigen::Index worst = largest(difference);
  double size = 0.0;
  for (Eigen::Index k = 0; k < before.size(); ++k)
    size = std::max({size, std::abs(before[k]) * range(k), std::abs(behind[k]) * range(k)});
  const bool differs = std::abs(difference[worst]) * range(worst) > kSame * size;
  if (!differs && !moves) return;
  add(origin, "the run ends exactly where this switches: the derivative by \"" +
                  tuned_parameter(system_->study(), worst).name + "\" is " +
                  readable(before[worst]) +
                  " for runs that end before the switch, as it is given here, and " +
                  readable(behind[worst]) + " for runs that pass it");
}

Eigen::Index OneSidedGradient::largest(const Eigen::VectorXd& derivatives) const {
  Eigen::Index worst = 0;
  for (Eigen::Index k = 1; k < derivatives.size(); ++k)
    if (std::abs(derivatives[k]) * range(k) > std::abs(derivatives[worst]) * range(worst))
      worst = k;
  return worst;
}

double OneSidedGradient::range(Eigen::Index tuned) const {
  const Parameter& parameter = tuned_parameter(system_->study(), tuned);
  const double extent = codesign::extent(parameter, parameter.value);
  return extent > 0.0 ? extent : 1.0;
}

void OneSidedGradient::add(const SwitchOrigin* origin, const std::string& text) {
  warnings_.push_back(
      warn("one_sided_gradient", {{system_->study().file, 0},
                                  describe_switch(*system_, origin),
                                  text,
                                  "",
                                  "a start and an end beside the instants of switches"}));
}

}  // namespace codesign
