// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_ROSENBROCK_INTEGRATOR_H_
#define MECHANISM_CODESIGN_INTEGRATION_ROSENBROCK_INTEGRATOR_H_

#include <functional>
#include <vector>

#include "mechanism_codesign/dynamics/assembly.h"
#include "mechanism_codesign/integration/rosenbrock_step.h"
#include "mechanism_codesign/integration/simulation.h"
#include "mechanism_codesign/integration/step_controller.h"

namespace codesign {

/// Integrates one design with an adaptive Rosenbrock-Wanner method. Reusable: start() begins anew without allocating once warm.
class RosenbrockIntegrator {
 public:
  explicit RosenbrockIntegrator(const System& system);

  /// Assembles the start of a design.
  Status start(const std::vector<double>& parameters);

  /// Called when a step's error has been accepted, before it is taken: the tangent of its stages is due.
  using BeforeAccept = std::function<void(const RosenbrockStep<double>&)>;

  /// Takes one accepted step, not beyond `limit` [s].
  Status advance(double limit, const BeforeAccept& before_accept = {});

  const RosenbrockStep<double>& step() const { return step_; }
  RosenbrockStep<double>& step() { return step_; }
  Assembly& assembly() { return assembly_; }
  const State<double>& initial_state() const { return initial_; }
  const Statistics& statistics() const { return statistics_; }

 private:
  double first_step() const;

  const System& system_;
  const SolverOptions& options_;
  RosenbrockStep<double> step_;
  Assembly assembly_;
  State<double> initial_;
  StepController controller_;
  double proposal_ = 0.0;
  Statistics statistics_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_ROSENBROCK_INTEGRATOR_H_
