// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "integration/integrator.h"

namespace codesign {

/// The postures of a study as a run, doc/theory.md (21f): state k at the time k is the consistent
/// start of a motion with the given positions of posture k, found from posture k - 1. psi() is the
/// sum of g over the postures so far. Between two postures the dense output is the earlier one;
/// after the last one the mechanism stays there.
class PostureSequence final : public Integrator {
 public:
  explicit PostureSequence(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters) override;
  /// Goes to the next posture, whatever the limit.
  Status advance(double limit) override;
  /// Begins anew with other parameters, up to the posture at `time`.
  Status go_on(double time, const std::vector<double>& parameters) override;
  const State<double>& state() const override { return state_; }
  double psi() const override { return psi_; }
  void interpolate(double time, State<double>* state, double* psi) override;
  void interpolate_rates(double time, State<double>* rates) override;
  Equations<double>& equations() override { return equations_; }
  Assembly& assembly() override { return assembly_; }
  void watch_singularities(bool /*watch*/) override {}
  const Statistics& statistics() const override { return statistics_; }
  Warnings warnings() const override { return warnings_; }

 private:
  Status arrive(Status status);

  const CompiledSystem& system_;
  Equations<double> equations_;
  Assembly assembly_;
  RepeatableStart repeatable_start_;
  State<double> state_, previous_;
  double psi_ = 0.0, previous_psi_ = 0.0;
  VectorX<double> residual_;  ///< workspace
  Statistics statistics_;
  Warnings warnings_;
};

}  // namespace codesign
