// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "sensitivity/gradient_engine.h"
#include "sensitivity/idas_tangent.h"
#include "sensitivity/residual_rows.h"
#include "sensitivity/signal_watch.h"

namespace codesign {

/// Gradient by the staggered forward sensitivities of IDAS; doc/theory.md (27).
class IdasGradient final : public GradientEngine {
 public:
  explicit IdasGradient(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters, Derivatives derivatives) override;
  Status advance(double limit) override;
  double time() const override { return integrator_.state().t; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  void jacobian_root(Eigen::MatrixXd* root) override;
  const Extremes& extremes() const override { return watch_.extremes(); }
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override { return integrator_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override { integrator_.obey(cancel); }

 private:
  /// The state at the end of the last step with accelerations and multipliers solved from G = 0, so that terminal terms do not depend on
  /// the derivatives of BDF.
  const State<double>& consistent_state();
  Status start_watches(bool with_gradient);
  /// Sets directions_ to the directions at the end of the last step.
  void take_directions();

  const CompiledSystem& system_;
  IdasIntegrator integrator_;
  std::unique_ptr<IdasTangent> tangent_;
  State<double> end_;
  std::vector<State<double>> directions_;
  SignalWatch watch_;
  ResidualRows residuals_;
  bool with_root_ = false;
};

}  // namespace codesign
