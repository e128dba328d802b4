// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_IDAS_EQUATIONS_H_
#define MECHANISM_CODESIGN_INTEGRATION_IDAS_EQUATIONS_H_

#include <string>
#include <vector>

#include "equations/equations.h"
#include "integration/applied_work.h"
#include "integration/idas_integrator.h"
#include "integration/idas_newton.h"

namespace codesign {

/// The equations in IDAS's terms: y = (q, v, s, lambda), F(t, y, y') = (q' - v, G(q, v, s; v', lambda, s')); doc/theory.md (25).
///
/// The constraints' rows are stabilized, Phi'' + 2 kappa Phi' + kappa^2 Phi, which changes neither the solution nor its sensitivities.
/// The static functions are IDAS's callbacks; their user data is an IdasEquations. No exception leaves them.
class IdasEquations {
 public:
  IdasEquations(const CompiledSystem& system, IdasNewton* newton);

  int size() const { return 2 * layout_.n + layout_.states + layout_.m; }
  Equations<double>& equations() { return equations_; }
  void set_sensitivities(IdasSensitivities* sensitivities) { sensitivities_ = sensitivities; }
  /// What tells the power of everything but gravity; must outlive the integration.
  void set_motion(const BodyMotion* motion) { motion_ = motion; }
  /// Forgets the last solution and failure.
  void start();

  /// State from y and y', and back.
  void unpack(double t, const double* y, const double* y_dot, State<double>* state) const;
  void pack(const State<double>& state, double* y, double* y_dot) const;

  /// What went wrong inside a callback, if anything.
  const std::string& failure() const { return failure_; }

  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector F, void* self);
  static int jacobian(sunrealtype t, sunrealtype c_j, N_Vector y, N_Vector y_dot, N_Vector F, SUNMatrix J, void* self, N_Vector, N_Vector,
                      N_Vector);
  static int integrand(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector g, void* self);
  static int sensitivity_residual(int count, sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector F, N_Vector* y_rho, N_Vector* y_dot_rho,
                                  N_Vector* F_rho, void* self, N_Vector, N_Vector, N_Vector);
  static int sensitivity_integrand(int count, sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector* y_rho, N_Vector* y_dot_rho, N_Vector g,
                                   N_Vector* g_rho, void* self, N_Vector, N_Vector, N_Vector);

 private:
  int residual(double t, const double* y, const double* y_dot, double* F);
  int jacobian(double t, double c_j, const double* y, const double* y_dot);
  int integrand(double t, const double* y, const double* y_dot, double* g);
  /// Derivatives at a point, unless they are there already: the corrector of the sensitivities calls again and again at one point.
  void visit(double t, const double* y, const double* y_dot);
  void derivative(int k, const double* y_rho, const double* y_dot_rho);

  const Layout& layout_;
  IdasNewton& newton_;
  Equations<double> equations_;
  IdasSensitivities* sensitivities_ = nullptr;
  const BodyMotion* motion_ = nullptr;
  State<double> state_, direction_;
  VectorX<double> G_, dG_, Phi_, Phi_rate_;
  double kappa_;                 ///< [1/s]
  std::vector<double> visited_;  ///< t, y, y' of the point whose derivatives are present
  std::string failure_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_IDAS_EQUATIONS_H_
