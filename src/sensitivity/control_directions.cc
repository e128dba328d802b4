// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/control_directions.h"

#include <random>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/sensitivity_scale.h"
#include "sensitivity/tangent_step.h"

namespace codesign {
namespace {

constexpr int kMost = 8, kOfAdjoint = 2;

template <int N>
class Tangent final : public ControlTangent {
 public:
  Tangent(const CompiledSystem& system, Eigen::MatrixXd directions)
      : system_(system),
        directions_(std::move(directions)),
        step_(system, rosenbrock_tableau(system.study().solver.method)),
        tolerance_(sensitivity_tolerance(system.study().solver)) {}

  void start(const std::vector<double>& parameters, RosenbrockIntegrator* integrator) override {
    parameters_.assign(parameters.begin(), parameters.end());
    for (Eigen::Index k = 0; k < directions_.rows(); ++k) {
      Lanes<N>& lanes = parameters_[to_index(system_.study().tuned[to_index(k)])];
      lanes.directions().head(directions_.cols()) = directions_.row(k).transpose();
    }
    step_.start(parameters_, integrator->assembly(), integrator->initial_state(),
                integrator->mode());
  }
  void jump(RosenbrockIntegrator* integrator) override { step_.jump(integrator); }
  double attempt(OneStep<double>* step) override {
    step_.attempt(step);
    return step_.error(*step, tolerance_);
  }
  void accept(const OneStep<double>& step) override { step_.accept(step); }

 private:
  const CompiledSystem& system_;
  const Eigen::MatrixXd directions_;
  TangentStep<N> step_;
  const double tolerance_;
  std::vector<Lanes<N>> parameters_;
};

}  // namespace

Eigen::MatrixXd control_directions(const CompiledSystem& system) {
  const MotionStudy& study = system.study();
  const auto count = to_signed(study.tuned.size());
  const bool for_adjoint = prefers_adjoint(system) && count > kOfAdjoint;
  if (count <= kMost && !for_adjoint) return Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixXd directions(count, for_adjoint ? kOfAdjoint : kMost);
  // Signs and sizes from 0.5 to 1.5, from the generator's own numbers: distributions differ between
  // libraries.
  std::mt19937 generator(1);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Parameter& parameter = tuned_parameter(study, k);
    for (double& entry : directions.row(k)) {
      const auto number = generator();
      const double size = 0.5 + static_cast<double>(number >> 1) / 2147483648.0;
      entry = (number % 2 == 0 ? size : -size) * extent(parameter, parameter.value);
    }
  }
  return directions;
}

std::unique_ptr<ControlTangent> make_control_tangent(const CompiledSystem& system) {
  Eigen::MatrixXd directions = control_directions(system);
  if (directions.cols() > 4) return std::make_unique<Tangent<8>>(system, std::move(directions));
  return std::make_unique<Tangent<4>>(system, std::move(directions));
}

}  // namespace codesign
