// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_INTEGRATOR_H_
#define MECHANISM_CODESIGN_INTEGRATION_INTEGRATOR_H_

#include <atomic>
#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// Integrates one design of a mechanism step by step. Reusable: start() begins anew, in the same memory. Not thread-safe.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Assembles the start of a design. @param parameters all named parameters.
  virtual Status start(const std::vector<double>& parameters) = 0;
  /// Takes one accepted step, not beyond `limit` [s].
  virtual Status advance(double limit) = 0;

  /// At the end of the last step.
  virtual const State<double>& state() const = 0;
  /// Integral of the objective's integrand so far.
  virtual double psi() const = 0;
  /// Dense output at `time` [s] within the last step; `state->z` of the lower order that it comes with.
  virtual void interpolate(double time, State<double>* state, double* psi) = 0;

  virtual Equations<double>& equations() = 0;
  virtual Assembly& assembly() = 0;
  /// Whether singular positions that the run passes are found, for warnings(); from the next start() on.
  virtual void watch_singularities(bool watch) = 0;
  virtual const Statistics& statistics() const = 0;
  /// What the run since start() gives reason to doubt.
  virtual Warnings warnings() const = 0;

  /// From now on start() and advance() end with kCancelled soon after `cancel` is set (from any thread), also while a step is tried again
  /// and again. Null: never.
  void obey(const std::atomic<bool>* cancel) {
    cancel_ = cancel;
    assembly().obey(cancel);
  }

 protected:
  bool cancelled() const { return cancel_ != nullptr && *cancel_; }

 private:
  const std::atomic<bool>* cancel_ = nullptr;
};

/// The integrator that the study asks for.
std::unique_ptr<Integrator> make_integrator(const CompiledSystem& system);

/// The common beginning of every integration: constants of the design, then a consistent state at t = 0.
Status assemble_start(const CompiledSystem& system, const std::vector<double>& parameters, Assembly* assembly, Equations<double>* equations,
                      State<double>* initial);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_INTEGRATOR_H_
