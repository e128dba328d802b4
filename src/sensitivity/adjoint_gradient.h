// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "assembly/assembly.h"
#include "integration/rosenbrock_integrator.h"
#include "sensitivity/adjoint_jump.h"
#include "sensitivity/adjoint_step.h"
#include "sensitivity/control_directions.h"
#include "sensitivity/end_motion.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/one_sided.h"
#include "sensitivity/step_replay.h"

namespace codesign {

/// Gradient by the discrete adjoint of the Rosenbrock steps and of the jumps between them,
/// doc/theory.md (18a)-(18d), (18h): advance() integrates forward, with the tangent along
/// control_directions() in the error test, and stores the path, gradient() goes back along its
/// steps. Equal to the gradient of RosenbrockGradient up to rounding.
class AdjointGradient final : public GradientEngine {
 public:
  /// @param most_points stored points of the path, see StepPath; 0: what fits into 32 MB.
  explicit AdjointGradient(const CompiledSystem& system, int most_points = 0);

  Status start(const std::vector<double>& parameters, Derivatives derivatives) override;
  Status advance(double limit) override;
  const Integrator& integrator() const override { return integrator_; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  /// Empty: an evaluation that needs the root uses the direct method.
  void jacobian_root(Eigen::MatrixXd* root) override { root->resize(0, 0); }
  /// Empty: the gradient of a study with watched signals is computed by the direct method.
  const Extremes& extremes() const override { return none_; }
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override {
    Warnings all = integrator_.warnings();
    append(one_sided_.warnings(), &all);
    return all;
  }
  const EventLog* events() const override { return &integrator_.events(); }
  void obey(const std::atomic<bool>* cancel) override {
    integrator_.obey(cancel);
    cancel_ = cancel;
  }

 private:
  /// Workspace of the backward pass, allocated by the first start() with gradient.
  struct Backward {
    Backward(const CompiledSystem& system, const RosenbrockTableau& tableau, int most_points);
    StepReplay replay;
    AdjointStep adjoint;
    AdjointJump jumps;
    Equations<Lanes<8>> boundary;
    std::vector<Lanes<8>> boundary_parameters;  ///< with the directions of eight of them
    ExtensionWorkspace<Lanes<8>> boundary_extension;
    State<Lanes<8>> boundary_state;
    State<double> initial;
    SparseGradient<double> terminal;
    VectorX<double> final_adjoint;
  };

  /// Integrator::jump() with the tangent of the error test; stores what happened.
  Status jump();
  /// Finds out how the end of the run moves, if it has ended. False if that cannot be computed.
  bool look_at_end();
  /// The backward pass over all steps from what final_adjoint and the jumps hold. False if
  /// cancelled or if a step cannot be repeated.
  bool go_back();
  /// Sets final_adjoint to the gradient of the terminal terms at an end of the run, and the jumps
  /// to none.
  void take_terminal(const State<double>& end);
  void prepare();
  bool step_back(int k);
  bool jump_back(const RunJump& jump, int k);
  /// After go_back(): adds the derivatives of all steps, of the start and of the terminal terms.
  void add_derivatives(const State<double>& end, Eigen::VectorXd* gradient);
  /// Adds adjoint^T y_rho(0), and with `end` the terminal terms' own derivatives there.
  void add_boundaries(const VectorX<double>& adjoint, const State<double>* end,
                      Eigen::VectorXd* gradient);
  /// The derivatives of a guard by the tuned parameters at the start.
  void differentiate_guard(int guard, Eigen::VectorXd* derivatives);
  /// Compares with the gradient of runs that end behind a guard on which this one ends.
  void look_beyond_end(const Eigen::VectorXd& gradient);

  const CompiledSystem& system_;
  const int most_points_;
  RosenbrockIntegrator integrator_;
  std::optional<Backward> back_;
  std::unique_ptr<ControlTangent> control_;  ///< of runs with gradient
  RosenbrockIntegrator::BeforeAccept judge_;
  EndMotion end_;
  OneSidedGradient one_sided_;
  const Extremes none_;
  bool with_gradient_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign
