// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "equations/compiled_system.h"
#include "integration/driven_slides.h"
#include "integration/idas_integrator.h"
#include "integration/integrator.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(Integrator, TheStudyChooses) {
  const auto rosenbrock = servo("{integrator: rosenbrock}"), idas = servo("{integrator: idas}");
  EXPECT_NE(dynamic_cast<RosenbrockIntegrator*>(make_integrator(*rosenbrock).get()), nullptr);
  EXPECT_NE(dynamic_cast<IdasIntegrator*>(make_integrator(*idas).get()), nullptr);
}

TEST(Integrator, BothBeginAtTheAssembledStart) {
  State<double> start[2];
  int k = 0;
  for (const char* solver : {"{integrator: rosenbrock}", "{integrator: idas}"}) {
    const auto system = servo(solver);
    const auto integrator = make_integrator(*system);
    ASSERT_TRUE(integrator->start(system->parameters()).ok());
    State<double> sample = start[k] = integrator->state();
    double psi = 1.0;
    integrator->interpolate(0.0, &sample, &psi);
    EXPECT_EQ(sample.q, integrator->state().q);
    EXPECT_EQ(sample.z, integrator->state().z);
    EXPECT_EQ(psi, 0.0);
    EXPECT_EQ(integrator->statistics().steps, 0);
    ++k;
  }
  EXPECT_EQ(start[0].q, start[1].q);
  EXPECT_EQ(start[0].z, start[1].z);
}

// The weights of a method may be negative, so that the integral of squares may be so by its error.
TEST(Integrator, ASumOfSquaresIsNotNegative) {
  for (const char* solver : {"{integrator: rosenbrock}", "{integrator: idas}"}) {
    const auto squares = servo(solver);
    const auto integrator = make_integrator(*squares);
    ASSERT_TRUE(integrator->start(squares->parameters()).ok());
    EXPECT_EQ(integrator->of_losses(-8e-13), 0.0) << solver;
    EXPECT_EQ(integrator->of_losses(-8e-13, 1e-12), 1e-12 - 8e-13);
    EXPECT_EQ(integrator->of_losses(3.0, 2.0), 5.0);
    EXPECT_TRUE(std::isnan(integrator->of_losses(std::nan(""))));
  }
  const auto signed_terms =
      compile(robot(mass("block", 2.0) + lift("slide", "block", 0.0)),
              "duration: 1.0\nobjective: {integral: [{signal: slide/position, weight: -1.0}]}\n");
  const auto integrator = make_integrator(*signed_terms);
  ASSERT_TRUE(integrator->start(signed_terms->parameters()).ok());
  EXPECT_EQ(integrator->of_losses(-8e-13), -8e-13);
}

struct Calls {
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  RepeatableStart start;
  /// how much the first parameter of each begin exceeds the study's, and "s" for each keep_pivots
  std::string seen;
  bool fails = false;

  Status run(double excess) {
    const double own = system->parameters().front();
    const auto begin = [this, own](const std::vector<double>& parameters) {
      seen += std::to_string(std::lround(parameters.front() - own));
      return fails ? Status{StatusCode::kSingularMatrix, 0.0, "as asked"} : Status{};
    };
    std::vector<double> parameters = system->parameters();
    parameters.front() += excess;
    return start.start(*system, parameters, begin, [this] { seen += "s"; });
  }
};

TEST(RepeatableStart, SettlesAtTheOwnStartOnce) {
  Calls calls;
  EXPECT_TRUE(calls.run(2.0).ok());
  calls.run(3.0);
  calls.run(0.0);
  EXPECT_EQ(calls.seen, "0s230");
}

TEST(RepeatableStart, BeginsTheOwnStartOnceIfItIsTheFirst) {
  Calls calls;
  calls.run(0.0);
  calls.run(2.0);
  EXPECT_EQ(calls.seen, "0s2");
}

TEST(RepeatableStart, AStartThatFailsSettlesNothing) {
  Calls calls;
  calls.fails = true;
  EXPECT_EQ(calls.run(2.0).code, StatusCode::kSingularMatrix);
  EXPECT_EQ(calls.seen, "02");
}

}  // namespace

}  // namespace codesign
