// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/core_access.h"

#include "integration/rosenbrock_integrator.h"

namespace codesign {

struct StepProbe::Parts {
  Parts(std::shared_ptr<const CompiledSystem> given, double step_size)
      : system(std::move(given)),
        h(step_size),
        integrator(*system),
        step(*system, integrator.step().tableau()),
        matrix(*system),
        equations(*system),
        interpreted(*system) {
    interpreted.compiled().allow(false);
  }

  std::shared_ptr<const CompiledSystem> system;
  double h;
  RosenbrockIntegrator integrator;
  OneStep<double> step;
  StageMatrix<double> matrix;
  Equations<double> equations, interpreted;
  Linearization<double> derivatives;
  State<double> state;
  VectorX<double> residual, solution;
  double g = 0.0;
  Status status;
};

StepProbe::StepProbe(std::shared_ptr<const CompiledSystem> system, double time, double h)
    : parts_(std::make_unique<Parts>(std::move(system), h)) {
  Parts& p = *parts_;
  p.status = p.integrator.start(p.system->parameters());
  while (p.status.ok() && p.integrator.step().state().t < time)
    p.status = p.integrator.advance(time);
  if (!p.status.ok()) return;
  p.state = p.integrator.step().state();
  p.derivatives.resize(p.system->patterns());
  p.equations.set_design(p.system->parameters());
  p.interpreted.set_design(p.system->parameters());
  p.step.equations().set_design(p.system->parameters());
  rewind();
  linearize();
  factor();
  p.residual.setOnes(p.system->layout().columns());
}
StepProbe::~StepProbe() = default;

const Status& StepProbe::status() const { return parts_->status; }
const State<double>& StepProbe::state() const { return parts_->state; }
int StepProbe::matrix_size() const { return parts_->system->layout().columns(); }
int StepProbe::stages() const { return parts_->step.tableau().stages; }

void StepProbe::residual() {
  parts_->equations.residual(parts_->state, &parts_->residual, &parts_->g);
}
void StepProbe::linearize() { parts_->equations.linearize(parts_->state, &parts_->derivatives); }
void StepProbe::interpret_residual() {
  parts_->interpreted.residual(parts_->state, &parts_->residual, &parts_->g);
}
void StepProbe::interpret_linearize() {
  parts_->interpreted.linearize(parts_->state, &parts_->derivatives);
}
void StepProbe::factor() {
  const double hg = parts_->h * parts_->step.tableau().gamma;
  parts_->matrix.factor(parts_->derivatives, hg, hg * hg, hg);
}
void StepProbe::solve() {
  parts_->solution = parts_->residual;
  parts_->matrix.solve(&parts_->solution);
}
void StepProbe::attempt() { parts_->step.attempt(parts_->h); }
void StepProbe::step() {
  parts_->step.attempt(parts_->h);
  parts_->step.accept();
}
void StepProbe::rewind() { parts_->step.start(parts_->state); }

}  // namespace codesign
