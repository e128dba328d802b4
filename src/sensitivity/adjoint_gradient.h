// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_GRADIENT_H_
#define MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_GRADIENT_H_

#include <optional>
#include <vector>

#include "integration/rosenbrock_integrator.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/parameter_lanes.h"
#include "sensitivity/step_path.h"

namespace codesign {

/// Gradient by the discrete adjoint of the Rosenbrock steps: the motion forward, then back along its steps; doc/theory.md (18a)-(18d).
/// To rounding the same as RosenbrockGradient's.
class AdjointGradient final : public GradientEngine {
 public:
  /// @param most_points of the way that are kept, see StepPath.
  AdjointGradient(const CompiledSystem& system, LanePlan plan, int most_points = 0);

  Status start(const std::vector<double>& parameters, bool with_gradient) override;
  Status advance(double limit) override;
  double time() const override { return integrator_.state().t; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override { return integrator_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override {
    integrator_.obey(cancel);
    cancel_ = cancel;
  }

 private:
  /// What only a gradient needs.
  struct Backward {
    Backward(const CompiledSystem& system, const RosenbrockTableau& tableau, int most_points);
    RosenbrockStep<double> replay;
    AdjointStep adjoint;
    std::optional<LaneGroups<ParameterLanes>> parameters;
    Equations<Lanes<8>> boundary;
    State<Lanes<8>> boundary_state;
    StepPath path;
    PathPoint point;
    std::vector<std::vector<double>> initial_turns;
    SparseGradient<double> terminal;
    VectorX<double> final_adjoint;
  };

  void share(LanePlan plan);
  /// All the steps back, with the explicit parts summed. False if a step cannot be made again.
  bool go_back();
  bool plan_holds();
  void prepare();
  bool step_back(int k);
  bool reach(int k);
  bool take_up(int k);
  bool replay(int k);
  void add_boundaries(Eigen::VectorXd* gradient);

  const CompiledSystem& system_;
  const int most_points_;
  LanePlan plan_;
  RosenbrockIntegrator integrator_;
  std::optional<Backward> back_;
  bool with_gradient_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_ADJOINT_GRADIENT_H_
