// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equations/equations.h"
#include "equations/turn_follower.h"
#include "integration/idas_newton.h"
#include "integration/idas_order.h"
#include "integration/integrator.h"
#include "integration/run_watch.h"

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

/// The equations of motion in the form of IDAS: y = (q, v, s, lambda), F(t, y, y') = (q' - v, G(q,
/// v, s; v', lambda, s')) = 0; doc/theory.md (25).
///
/// The constraint rows are stabilized, Phi'' + 2 kappa Phi' + kappa^2 Phi, which changes neither
/// the solution nor its sensitivities. The static functions are the callbacks of IDAS, with an
/// IdasEquations as user data. They catch exceptions (see failure()) and return 0 for success, a
/// positive number to request a smaller step, a negative one to stop.
class IdasEquations {
 public:
  IdasEquations(const CompiledSystem& system, IdasNewton* newton);

  int size() const { return 2 * layout_.n + layout_.states + layout_.m; }
  Equations<double>& equations() { return equations_; }
  void set_sensitivities(IdasSensitivities* sensitivities) { sensitivities_ = sensitivities; }
  /// Of the motion's errors; active only beside sensitivities.
  OrderFloor& order_floor() { return order_floor_; }
  /// For the quadrature of the work of all forces but gravity; must outlive the integration.
  void set_motion(const BodyMotion* motion) { motion_ = motion; }
  /// Discards stored derivatives, pivots and the last failure.
  void start();

  /// Counts the whole turns of joints from `state` on, TurnFollower; it has been tracked.
  void count_turns_from(const State<double>& state) { counted_ = state; }
  /// Sets the turn references of a state of the step that begins, or ends, at the state of
  /// count_turns_from().
  void count_turns(State<double>* state) {
    if (counted_) turns_.follow(*counted_, &equations_, state);
  }
  /// Conversion of (y, y'), size() entries each, to a state, and back.
  void unpack(double t, In<double> y, In<double> y_dot, State<double>* state) const;
  void pack(const State<double>& state, Out<double> y, Out<double> y_dot) const;

  /// Message of an exception inside a callback; empty if there was none.
  const std::string& failure() const { return failure_; }

  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector F, void* self);
  static int jacobian(sunrealtype t, sunrealtype c_j, N_Vector y, N_Vector y_dot, N_Vector F,
                      SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector);
  static int integrand(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector g, void* self);
  static int sensitivity_residual(int count, sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector F,
                                  N_Vector* y_rho, N_Vector* y_dot_rho, N_Vector* F_rho, void* self,
                                  N_Vector, N_Vector, N_Vector);
  static int sensitivity_integrand(int count, sunrealtype t, N_Vector y, N_Vector y_dot,
                                   N_Vector* y_rho, N_Vector* y_dot_rho, N_Vector g,
                                   N_Vector* g_rho, void* self, N_Vector, N_Vector, N_Vector);

 private:
  int residual(double t, In<double> y, In<double> y_dot, Out<double> F);
  int jacobian(double t, double c_j, In<double> y, In<double> y_dot);
  int integrand(double t, In<double> y, In<double> y_dot, Out<double> g);
  /// Computes the derivatives at a point unless they are stored: the sensitivity corrector calls
  /// repeatedly at the same point.
  /// @returns null if they are stored.
  const Linearization<double>* visit(double t, In<double> y, In<double> y_dot);
  /// The same, and factors the matrix of Newton's method there. False if it is singular.
  bool visit_to_solve(double t, In<double> y, In<double> y_dot);
  void derivative(int k, In<double> y_rho, In<double> y_dot_rho);
  /// Sets state_, its turn references included.
  void load(double t, In<double> y, In<double> y_dot);

  const Layout& layout_;
  IdasNewton& newton_;
  Equations<double> equations_;
  IdasSensitivities* sensitivities_ = nullptr;
  const BodyMotion* motion_ = nullptr;
  TurnFollower<double> turns_;
  OrderFloor order_floor_;
  State<double> state_, direction_;
  std::optional<State<double>> counted_;
  VectorX<double> G_, dG_, Phi_, Phi_rate_;
  double kappa_;                 ///< rate of stabilization [1/s]
  std::vector<double> visited_;  ///< t, y, y' of the point whose derivatives are stored
  std::string failure_;
};

}  // namespace codesign
