// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "integration/integrator.h"

namespace codesign {

/// The derivatives that IdasIntegrator needs to integrate sensitivities, doc/theory.md (27).
/// Implemented by IdasTangent in src/sensitivity, so that integration does not depend on
/// derivatives by parameters.
class IdasSensitivities {
 public:
  virtual ~IdasSensitivities() = default;

  /// Number of tuned parameters p.
  virtual int count() const = 0;
  /// Begins the integration of a design. @param initial its assembled start.
  /// @param sensitivities receives the initial sensitivities (q, v, s, z)_rho, one per parameter;
  /// sized by the caller.
  /// @param scales receives the size of each parameter, never zero: the absolute tolerance of its
  /// sensitivities is the absolute tolerance of the state divided by this size.
  virtual void start(const std::vector<double>& parameters, const State<double>& initial,
                     Integrator* integrator, std::vector<State<double>>* sensitivities,
                     std::vector<double>* scales) = 0;
  /// Computes the derivatives at a state for the calls of derivative() that follow. @param kappa
  /// rate of stabilization [1/s], (25).
  /// @returns the derivatives of (G, g) by the state, without stabilization; valid until the next
  /// call.
  virtual const Linearization<double>& linearize(const State<double>& state, double kappa,
                                                 Equations<double>* equations) = 0;
  /// The derivative of (G, g) by rho_k along a direction (q, v, s, z)_rho at the last linearize(),
  /// with stabilized constraint rows: Layout::columns() + 1 entries.
  virtual void derivative(int k, const State<double>& direction, VectorX<double>* result) = 0;
  /// Carries directions over the events of sampled controllers, theory (51), and solves for their
  /// z. @param behind the state after the events. False if the augmented matrix is singular.
  virtual bool jump(const std::vector<ControlEvent>& events, const State<double>& before,
                    const State<double>& behind, Equations<double>* equations,
                    std::vector<State<double>>* directions) = 0;
  /// Projects directions (q, v)_rho onto the tangent of the constraints at a state and solves for
  /// their z; one direction per parameter. False if the augmented matrix is singular.
  virtual bool project(const State<double>& state, Equations<double>* equations,
                       std::vector<State<double>>* directions) = 0;
};

/// Variable-order BDF by SUNDIALS IDAS on q' = v, 0 = G(q, v, s; v', lambda, s'), psi' = g;
/// doc/theory.md (25)-(27).
///
/// The unknowns are (q, v, s, lambda); a and sigma are the derivatives of v and s. Newton's linear
/// systems are reduced to the size of (a, lambda, sigma). lambda is not part of the error test. A
/// multistep method cannot be projected after each step without a restart at order one, so the
/// constraint rows are stabilized instead; where the drift (17a) grows too large nevertheless, (q,
/// v) and the sensitivities are projected and the method restarts. A failure of IDAS is returned as
/// a Status with time and cause.
class IdasIntegrator final : public Integrator {
 public:
  explicit IdasIntegrator(const CompiledSystem& system);
  ~IdasIntegrator() override;

  /// Sets the sensitivities to integrate from the next start() on, by the staggered corrector and
  /// with error test; nullptr for none. `sensitivities` must outlive the integration.
  void carry(IdasSensitivities* sensitivities);

  Status start(const std::vector<double>& parameters) override;
  Status advance(double limit) override;
  Status go_on(double time, const std::vector<double>& parameters) override;
  const State<double>& state() const override;
  double psi() const override;
  void interpolate(double time, State<double>* state, double* psi) override;
  void interpolate_rates(double time, State<double>* rates) override;
  Equations<double>& equations() override;
  Assembly& assembly() override;
  void watch_singularities(bool watch) override;
  const Statistics& statistics() const override;
  Warnings warnings() const override;

  /// (q, v, s, z)_rho of tuned parameter k at the end of the last step.
  void sensitivity(int k, State<double>* direction) const;
  /// (q, v, s)_rho of all tuned parameters at `time` [s] within the last step, by the dense output;
  /// z is meaningless.
  void interpolate_sensitivities(double time, std::vector<State<double>>* directions);
  /// Derivative of psi() by tuned parameter k.
  double psi_sensitivity(int k) const;
  /// Largest entry of |Phi(q)| at the end of a step since start().
  double largest_drift() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign
