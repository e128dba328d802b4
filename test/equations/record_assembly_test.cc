// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/record_assembly.h"

#include <gtest/gtest.h>

#include "equations/formulas.h"
#include "equations/generic_state.h"
#include "integration/servo.h"

namespace codesign {
namespace {

PatternRecorder::Calls calls_at(const System& system, const State<double>& state, ByVariable<PatternRecorder::Calls>* all) {
  Formulas<double> formulas(system);
  formulas.set_design(system.parameters());
  formulas.load(state);
  PatternRecorder recorder;
  formulas.assemble(&recorder);
  *all = recorder.calls();
  return all->position;
}

State<double> state_of(const System& system, double phase) {
  State<double> state;
  state.resize(system.layout());
  double shift = phase;
  for (VectorX<double>* part : {&state.q, &state.v, &state.s, &state.z}) *part = waves(part->size(), shift += 0.8);
  return state;
}

/// Slots are found once, so that the order of the calls may depend on the mechanism only.
TEST(RecordAssembly, TheOrderOfTheCallsDoesNotDependOnTheState) {
  const auto system = servo("{}");
  ByVariable<PatternRecorder::Calls> zero, one, other;
  State<double> rest;
  rest.resize(system->layout());
  calls_at(*system, rest, &zero);
  calls_at(*system, state_of(*system, 0.3), &one);
  calls_at(*system, state_of(*system, -2.1), &other);
  for (const auto* calls : {&one, &other}) {
    EXPECT_EQ(calls->position, zero.position);
    EXPECT_EQ(calls->velocity, zero.velocity);
    EXPECT_EQ(calls->rate, zero.rate);
  }
}

TEST(RecordAssembly, EveryCallHasItsSlotAndEveryEntryIsSetOnce) {
  const auto system = servo("{}");
  ByVariable<PatternRecorder::Calls> calls;
  calls_at(*system, state_of(*system, 0.3), &calls);
  const AssemblyPlan plan = record_assembly(*system);
  const auto check = [](const PatternRecorder::Calls& of, const std::vector<int>& slots, const Sparsity& pattern) {
    ASSERT_EQ(slots.size(), of.size());
    int first = 0;
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const int slot = slots[k] < 0 ? ~slots[k] : slots[k];
      first += slots[k] < 0 ? 1 : 0;
      EXPECT_EQ(pattern.column(slot), of[k].second);
      EXPECT_LE(pattern.first(of[k].first), slot);
      EXPECT_LT(slot, pattern.first(of[k].first + 1));
    }
    EXPECT_EQ(first, pattern.nonzeros());
  };
  check(calls.position, plan.slots.position, plan.patterns.position);
  check(calls.velocity, plan.slots.velocity, plan.patterns.velocity);
  check(calls.rate, plan.slots.rate, plan.patterns.rate);
  EXPECT_EQ(plan.patterns.rate.rows, system->layout().columns() + 1);
  EXPECT_EQ(plan.patterns.velocity.columns, system->layout().n);
}

}  // namespace
}  // namespace codesign
