// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SRC_SENSITIVITY_ROSENBROCK_GRADIENT_H_
#define MECHANISM_CODESIGN_SRC_SENSITIVITY_ROSENBROCK_GRADIENT_H_

#include <optional>

#include "mechanism_codesign/integration/rosenbrock_integrator.h"
#include "mechanism_codesign/sensitivity/gradient_engine.h"
#include "mechanism_codesign/sensitivity/lane_groups.h"
#include "mechanism_codesign/sensitivity/tangent_step.h"

namespace codesign {

/// Gradient by the exact tangent of the Rosenbrock steps; doc/theory.md (18), (22).
class RosenbrockGradient final : public GradientEngine {
 public:
  explicit RosenbrockGradient(const System& system);

  Status start(const std::vector<double>& parameters, bool with_gradient) override;
  Status advance(double limit) override;
  /// Size of the last step [s].
  double step_size() const { return integrator_.step().step_size(); }
  double time() const override { return integrator_.state().t; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override { return integrator_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override { integrator_.obey(cancel); }

 private:
  template <int N>
  struct Group {
    Group(const System& system, LaneRange<N> lanes, const RosenbrockTableau& tableau) : range(lanes), step(system, tableau) {}
    LaneRange<N> range;
    TangentStep<N> step;
  };

  const System& system_;
  RosenbrockIntegrator integrator_;
  std::optional<LaneGroups<Group>> groups_;
  RosenbrockIntegrator::BeforeAccept stages_;
  bool with_gradient_ = false;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SRC_SENSITIVITY_ROSENBROCK_GRADIENT_H_
