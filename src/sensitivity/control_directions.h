// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "integration/rosenbrock_integrator.h"

namespace codesign {

/// The directions of the tuned parameters whose sensitivities take part in the error test of a run
/// with gradient, doc/theory.md (18f): p rows, one column per direction. Up to eight parameters are
/// directions themselves; of more, eight combinations with fixed pseudo-random coefficients in
/// units of the ranges; two where the adjoint is preferred, which needs no others. They depend on
/// the system alone, so that all ways to compute its gradient take the same steps.
Eigen::MatrixXd control_directions(const CompiledSystem& system);

/// The tangent along control_directions(), for the error test alone.
class ControlTangent {
 public:
  virtual ~ControlTangent() = default;
  /// To be called after the integrator's start.
  virtual void start(const std::vector<double>& parameters, RosenbrockIntegrator* integrator) = 0;
  /// Carries it over the last jump of the integrator, TangentStep::jump().
  virtual void jump(RosenbrockIntegrator* integrator) = 0;
  /// Computes the stages of the last attempt. @returns their scaled error, acceptable up to 1.
  virtual double attempt(OneStep<double>* step) = 0;
  /// Accepts the last attempt; to be called after OneStep::accept().
  virtual void accept(const OneStep<double>& step) = 0;
};

/// @param system must outlive it; it has at least one tuned parameter.
std::unique_ptr<ControlTangent> make_control_tangent(const CompiledSystem& system);

}  // namespace codesign
