// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_IDAS_GRADIENT_H_
#define MECHANISM_CODESIGN_SENSITIVITY_IDAS_GRADIENT_H_

#include <memory>
#include <vector>

#include "sensitivity/gradient_engine.h"
#include "sensitivity/idas_tangent.h"
#include "sensitivity/signal_watch.h"

namespace codesign {

/// Gradient by the staggered forward sensitivities of IDAS; doc/theory.md (27).
class IdasGradient final : public GradientEngine {
 public:
  explicit IdasGradient(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters, bool with_gradient) override;
  Status advance(double limit) override;
  double time() const override { return integrator_.state().t; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  const Extremes& extremes() const override { return watch_.extremes(); }
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override { return integrator_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override { integrator_.obey(cancel); }

 private:
  /// The state at the end of the last step with accelerations and multipliers solved from G = 0, so that terminal terms do not depend on
  /// the derivatives of BDF.
  const State<double>& consistent_state();

  const CompiledSystem& system_;
  IdasIntegrator integrator_;
  std::unique_ptr<IdasTangent> tangent_;
  State<double> end_;
  std::vector<State<double>> directions_;
  SignalWatch watch_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_IDAS_GRADIENT_H_
