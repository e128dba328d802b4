// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Every study in config/ with its model: loaded, simulated, and its gradient checked.
#include <algorithm>
#include <filesystem>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "description/study.h"
#include "integration/simulation_of.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/config"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A shorter run, with the intervals of bounds on signals inside it. A list of postures stays.
void shorten(Study* study, double duration) {
  if (study->postures > 0) return;
  study->duration = std::min(study->duration, duration);
  for (WatchedSignal& watched : study->watched)
    watched.before = std::min(watched.before, study->duration);
}

class ShippedStudies : public ::testing::TestWithParam<std::string> {
 protected:
  ShippedStudies() : shipped(GetParam()) {
    shorten(&shipped.study, 0.2);
    shipped.study.solver.relative_tolerance = 1e-6;
    shipped.study.solver.absolute_tolerance = 1e-7;
  }
  Shipped shipped;
};

TEST_P(ShippedStudies, Simulate) {
  std::vector<SignalDescription> signals;
  for (const std::string& text : default_signals(shipped.robot, shipped.study.controllers))
    signals.push_back(parse_signal(text, {"test", 0}, "signal"));
  Simulation simulation =
      simulation_of(make_system(shipped.robot, shipped.study), shipped.parameters(), signals);
  int frames = 0;
  const int count = shipped.study.postures > 0 ? shipped.study.postures : 11;
  const auto look = [&](const Frame& frame) {
    for (double value : frame.signals) EXPECT_TRUE(std::isfinite(value));
    for (double error : frame.loop_errors) EXPECT_LT(error, 1e-6);
    for (const FrictionSample& sample : frame.frictions)
      EXPECT_LE(sample.friction * sample.sliding_velocity, 1e-15);
    ++frames;
    return true;
  };
  const Status status = simulate(&simulation, shipped.study.duration, count, look);
  EXPECT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(frames, count);
}

TEST_P(ShippedStudies, GradientIsThatOfTheStepsTaken) {
  const GradientCheck check = check_gradient(make_system(shipped.robot, shipped.study),
                                             shipped.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, shipped.study.postures > 0 ? 1e-8 : 1e-9);
}

// The two integrators check each other. Errors of steps add up, over one second to some ten times
// the tolerance.
TEST_P(ShippedStudies, BothIntegratorsAgree) {
  constexpr double kTolerance = 1e-7;
  if (shipped.study.postures > 0) GTEST_SKIP() << "postures are not integrated";
  shipped.study = Shipped(GetParam()).study;
  SolverOptions& solver = shipped.study.solver;
  shorten(&shipped.study, 1.0);
  solver.relative_tolerance = kTolerance;
  solver.absolute_tolerance = 0.1 * kTolerance;
  solver.maximum_steps = 200000;
  const Evaluation rosenbrock =
      evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(shipped.start(), false);
  solver.integrator = IntegratorKind::kIdas;
  // Its errors of steps add up to more, by the release of SUNDIALS up to five hundred times the
  // tolerance.
  solver.relative_tolerance *= 0.01;
  solver.absolute_tolerance *= 0.01;
  const Evaluation idas =
      evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(shipped.start(), false);
  ASSERT_TRUE(rosenbrock.status.ok() && idas.status.ok())
      << rosenbrock.status.cause << idas.status.cause;
  EXPECT_NEAR(idas.objective, rosenbrock.objective,
              200.0 * kTolerance * std::abs(rosenbrock.objective));
}

INSTANTIATE_TEST_SUITE_P(Config, ShippedStudies, ::testing::ValuesIn(shipped_names()),
                         [](const auto& study) { return study.param; });

TEST(ShippedList, HoldsThePapersCases) {
  const std::vector<std::string> names = shipped_names();
  for (const char* name : {"slider_crank", "slider_crank_haug", "inverted_pendulum",
                           "inverted_pendulum_frictionless", "governor"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

}  // namespace
}  // namespace codesign
