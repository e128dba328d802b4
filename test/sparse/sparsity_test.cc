// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparsity.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// Touches (2, 1), (0, 3), (2, 1) again and (2, 0).
template <class Sink>
void assemble(Sink* sink) {
  sink->position(2, 1, 1.0);
  sink->position(0, 3, 2.0);
  sink->position(2, 1, 4.0);
  sink->position(2, 0, 8.0);
  sink->rate(1, 1, 16.0);
  sink->time(1, 32.0);
}

AssemblyPlan record() {
  PatternRecorder recorder;
  assemble(&recorder);
  AssemblyPlan plan;
  plan.patterns.position = PatternRecorder::build(recorder.calls().position, 3, 4, &plan.slots.position);
  plan.patterns.velocity = PatternRecorder::build(recorder.calls().velocity, 3, 4, &plan.slots.velocity);
  plan.patterns.rate = PatternRecorder::build(recorder.calls().rate, 3, 4, &plan.slots.rate);
  return plan;
}

TEST(Sparsity, RecordsAPatternAndAddsToItsSlots) {
  const AssemblyPlan plan = record();
  EXPECT_EQ(plan.patterns.position.row_start, (std::vector<int>{0, 1, 1, 3}));
  EXPECT_EQ(plan.patterns.position.column_index, (std::vector<int>{3, 0, 1}));
  EXPECT_EQ(plan.patterns.velocity.nonzeros(), 0);

  Linearization<double> values;
  values.resize(plan.patterns);
  for (int repeated = 0; repeated < 2; ++repeated) {
    AssemblySink<double> sink(plan, &values);
    assemble(&sink);
  }
  EXPECT_EQ(values.position, (std::vector<double>{2.0, 8.0, 5.0}));
  EXPECT_EQ(values.rate, std::vector<double>{16.0});
  EXPECT_EQ(values.time, Eigen::Vector3d(0.0, 32.0, 0.0));
}

TEST(Sparsity, ACheckedAssemblyCatchesEachDeviation) {
  const AssemblyPlan plan = record();
  Linearization<double> values;
  values.resize(plan.patterns);
  using Checked = AssemblySink<double, true>;
  Checked whole(plan, &values), other(plan, &values), longer(plan, &values), shorter(plan, &values);
  assemble(&whole);
  EXPECT_NO_THROW(whole.finish());
  EXPECT_THROW(other.position(2, 0, 1.0), std::logic_error) << "(2, 1) was recorded first";
  EXPECT_THROW(other.rate(1, 2, 1.0), std::logic_error);
  EXPECT_THROW(other.velocity(0, 0, 1.0), std::logic_error) << "no velocity was recorded";
  assemble(&longer);
  EXPECT_THROW(longer.position(2, 0, 1.0), std::logic_error);
  shorter.position(2, 1, 1.0);
  EXPECT_THROW(shorter.finish(), std::logic_error);
}

TEST(Sparsity, GradientsAreScaledFromAMark) {
  SparseGradient<double> gradient;
  gradient.position.push_back({0, 1.0});
  gradient.time = 1.0;
  const auto mark = gradient.mark();
  gradient.position.push_back({1, 2.0});
  gradient.rate.push_back({2, 3.0});
  gradient.time += 2.0;
  gradient.scale_from(mark, -2.0);
  EXPECT_EQ(gradient.position[0].value, 1.0);
  EXPECT_EQ(gradient.position[1].value, -4.0);
  EXPECT_EQ(gradient.rate[0].value, -6.0);
  EXPECT_EQ(gradient.time, -3.0);
}

}  // namespace
}  // namespace codesign
