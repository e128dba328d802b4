// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The loop over time steps allocates no memory after a first run, which brings every workspace to
// its size.
#include "allocation/count.h"
#include "integration/integrator.h"
#include "sensitivity/gradient_cases.h"

namespace codesign {
namespace {

using Parameter = std::tuple<std::size_t, const char*>;

class StepLoop : public ::testing::TestWithParam<Parameter> {
 protected:
  const GradientCase test = gradient_cases().at(std::get<0>(GetParam()));
  const char* const method = std::get<1>(GetParam());
};

/// Steps to the end and returns the number of allocations.
template <class Stepper, class Time>
std::int64_t allocations_of_steps(Stepper* stepper, double duration, const Time& time) {
  Status status;
  const std::int64_t before = allocations();
  while (status.ok() && time() < duration) status = stepper->advance(duration);
  const std::int64_t count = allocations() - before;
  EXPECT_TRUE(status.ok()) << status.cause;
  return count;
}

TEST_P(StepLoop, OfASimulationAsksForNoMemory) {
  const auto system = test.compile(method, "direct");
  const auto integrator = make_integrator(*system);
  for (const bool warm : {false, true}) {
    ASSERT_TRUE(integrator->start(system->parameters()).ok());
    const std::int64_t count = allocations_of_steps(integrator.get(), test.study.duration,
                                                    [&] { return integrator->state().t; });
    if (warm) {
      EXPECT_EQ(count, 0);
    }
  }
}

/// The number of allocations in the steps of a second run.
std::int64_t allocations_once_warm(const CompiledSystem& system, Derivatives derivatives) {
  const auto engine = make_gradient_engine(system, derivatives);
  Eigen::VectorXd gradient;
  Eigen::MatrixXd root;
  std::int64_t count = 0;
  for (int run = 0; run < 2; ++run) {
    EXPECT_TRUE(engine->start(system.parameters(), derivatives).ok());
    count =
        allocations_of_steps(engine.get(), system.study().duration, [&] { return engine->time(); });
    engine->gradient(&gradient);
    if (derivatives == Derivatives::kGaussNewton) engine->jacobian_root(&root);
  }
  return count;
}

TEST_P(StepLoop, OfAGradientAsksForNoMemory) {
  for (const char* gradient : {"direct", "adjoint"})
    EXPECT_EQ(allocations_once_warm(*test.compile(method, gradient), Derivatives::kGradient), 0)
        << gradient;
}

TEST_P(StepLoop, OfTheJacobianOfResidualsAsksForNoMemory) {
  EXPECT_EQ(allocations_once_warm(*test.compile(method, "direct"), Derivatives::kGaussNewton), 0);
}

/// The number of allocations in gradient() after a run that ended at `time`.
std::int64_t allocations_of_way_back(GradientEngine* engine, const CompiledSystem& system,
                                     double time) {
  Eigen::VectorXd result;
  EXPECT_TRUE(engine->start(system.parameters(), Derivatives::kGradient).ok());
  allocations_of_steps(engine, time, [&] { return engine->time(); });
  const std::int64_t before = allocations();
  engine->gradient(&result);
  return allocations() - before;
}

TEST_P(StepLoop, BackwardsAsksForTheGradientOnly) {
  const auto system = test.compile(method, "adjoint");
  const auto engine = make_gradient_engine(*system);
  // Twice: the second way back begins with the variant of the recording that the first one found
  // last, and makes its code.
  for (int k = 0; k < 2; ++k) allocations_of_way_back(engine.get(), *system, test.study.duration);
  for (double share : {1.0, 0.25})
    EXPECT_EQ(allocations_of_way_back(engine.get(), *system, share * test.study.duration), 1)
        << share;
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, StepLoop,
                         ::testing::Combine(::testing::Range(std::size_t{0},
                                                             gradient_cases().size()),
                                            ::testing::Values("rodas4", "rodas5p", "dopri5")),
                         [](const auto& instance) {
                           return gradient_cases().at(std::get<0>(instance.param)).name + "_" +
                                  std::get<1>(instance.param);
                         });

}  // namespace
}  // namespace codesign
