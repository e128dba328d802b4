// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_IDAS_INTEGRATOR_H_
#define MECHANISM_CODESIGN_INTEGRATION_IDAS_INTEGRATOR_H_

#include <memory>
#include <vector>

#include "integration/integrator.h"

namespace codesign {

/// What IDAS must know of the equations' derivatives to carry sensitivities along; implemented where derivatives by parameters are made.
class IdasSensitivities {
 public:
  virtual ~IdasSensitivities() = default;

  /// How many parameters.
  virtual int count() const = 0;
  /// Takes a design over. @param initial its assembled start. @param sensitivities one direction (q, v, s, z)_rho of the start for each
  /// parameter.
  /// @param scales the size of each parameter, never zero: sensitivities are as accurate relative to 1/scale as the state is to 1.
  virtual void start(const std::vector<double>& parameters, const State<double>& initial, Integrator* integrator,
                     std::vector<State<double>>* sensitivities, std::vector<double>* scales) = 0;
  /// Makes the derivatives at a state the present ones. @param kappa rate of stabilization [1/s] of the constraints' rows.
  virtual void linearize(const State<double>& state, double kappa, Equations<double>* equations) = 0;
  /// d(G, g)/d(rho_k), stabilized, along a direction (q, v, s, z)_rho at the present point: columns() + 1 entries.
  virtual void derivative(int k, const State<double>& direction, VectorX<double>* result) = 0;
  /// Takes the drift of directions (q, v)_rho off the tangent of the constraints at a state, and solves for their z. False if the augmented
  /// matrix is singular.
  virtual bool project(const State<double>& state, Equations<double>* equations, std::vector<State<double>>* directions) = 0;
};

/// Variable-order BDF by SUNDIALS IDAS on q' = v, 0 = G(q, v, s; v', lambda, s'), psi' = g; doc/theory.md (25)-(27).
///
/// The unknowns are (q, v, s, lambda); a and sigma are derivatives, not unknowns. Newton's systems are reduced to the size of (a, lambda,
/// sigma). lambda stays out of the error test. A multistep method has no place for a projection, so the constraints' rows are stabilized;
/// where that is not enough, (q, v) and the sensitivities are projected and the method starts again. Failures of IDAS come back as a Status
/// with time and cause.
class IdasIntegrator final : public Integrator {
 public:
  explicit IdasIntegrator(const CompiledSystem& system);
  ~IdasIntegrator() override;

  /// Sensitivities to integrate from the next start() on, staggered and in the error test; nullptr for none. Must outlive the integration.
  void carry(IdasSensitivities* sensitivities);

  Status start(const std::vector<double>& parameters) override;
  Status advance(double limit) override;
  const State<double>& state() const override;
  double psi() const override;
  void interpolate(double time, State<double>* state, double* psi) override;
  Equations<double>& equations() override;
  Assembly& assembly() override;
  void watch_singularities(bool watch) override;
  const Statistics& statistics() const override;
  Warnings warnings() const override;

  /// (q, v, s, z)_rho of parameter k at the end of the last step.
  void sensitivity(int k, State<double>* direction) const;
  /// d psi / d rho_k so far.
  double psi_sensitivity(int k) const;
  /// Largest |Phi(q)| met at the end of a step since start().
  double largest_drift() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_IDAS_INTEGRATOR_H_
