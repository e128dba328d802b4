// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/record_assembly.h"

#include "equations/formulas.h"

namespace codesign {

AssemblyPlan record_assembly(const System& system) {
  const Layout& layout = system.layout();
  Formulas<double> formulas(system);
  formulas.set_design(system.parameters());
  State<double> state;
  state.resize(layout);
  formulas.load(state);
  PatternRecorder recorder;
  formulas.assemble(&recorder);
  const int rows = layout.columns() + 1;
  AssemblyPlan plan;
  plan.patterns.position = PatternRecorder::build(recorder.calls().position, rows, layout.positions(), &plan.slots.position);
  plan.patterns.velocity = PatternRecorder::build(recorder.calls().velocity, rows, layout.n, &plan.slots.velocity);
  plan.patterns.rate = PatternRecorder::build(recorder.calls().rate, rows, layout.columns(), &plan.slots.rate);
  return plan;
}

}  // namespace codesign
