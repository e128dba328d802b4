// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/run_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/make_system.h"
#include "description/study.h"
#include "integration/mechanisms.h"

namespace codesign {
namespace {

using Method = RunSteps::Method;

std::shared_ptr<const CompiledSystem> make(const std::string& solver,
                                           const std::string& load = "0") {
  const RobotDescription robot = read_urdf({"test.urdf", pendulum()});
  const std::string study = "duration: 2.0\nloads: [{joint: hinge, effort: \"" + load +
                            "\"}]\nobjective: {terminal: [{signal: hinge/position}]}\n"
                            "solver: {" +
                            solver + "}\n";
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

TEST(RunSteps, AreShorterAndFinerInBothSets) {
  const auto system = make("relative_tolerance: 1.0e-5, absolute_tolerance: 1.0e-12");
  const SolverOptions first = with_steps(*system, {Method::kRodas5P, false, 5000})->study().solver,
                      second = with_steps(*system, {Method::kDopri5, true, 700})->study().solver;
  EXPECT_EQ(first.method, RosenbrockMethod::kRodas5P);
  EXPECT_EQ(second.method, RosenbrockMethod::kDopri5);
  EXPECT_DOUBLE_EQ(first.relative_tolerance, 1e-7);
  EXPECT_DOUBLE_EQ(first.absolute_tolerance, 1e-13) << "a floor";
  EXPECT_DOUBLE_EQ(second.relative_tolerance, 1e-6);
  EXPECT_DOUBLE_EQ(first.maximum_step, 0.01);
  EXPECT_LT(second.maximum_step, 0.01);
  EXPECT_EQ(first.maximum_steps, 5000);
  EXPECT_EQ(second.maximum_steps, 700);
  EXPECT_EQ(with_steps(*make("maximum_step: 1.0e-3"), {Method::kRodas5P, false, 9})
                ->study()
                .solver.maximum_step,
            1e-3);
}

TEST(RunSteps, AreOfTheOtherClassOfMethod) {
  Statistics explicit_run, implicit_run;
  explicit_run.steps = explicit_run.explicit_steps = implicit_run.steps = 100;
  const auto automatic = make("method: auto");
  EXPECT_EQ(other_method(*automatic, explicit_run), Method::kRodas5P);
  EXPECT_EQ(other_method(*automatic, implicit_run), Method::kDopri5);
  EXPECT_EQ(other_method(*make("integrator: idas"), implicit_run), Method::kRodas5P);
  EXPECT_EQ(fallback_method(*automatic, Method::kDopri5), Method::kRodas4P2)
      << "auto takes rodas5p itself";
  EXPECT_EQ(fallback_method(*make("method: rodas4p2"), Method::kDopri5), Method::kRodas5P);
  EXPECT_EQ(fallback_method(*automatic, Method::kRodas5P), Method::kRodas4P2);
}

TEST(RunSteps, DivideAPulseAsTheyDivideTheStudy) {
  const auto system = make("method: auto", "${100*exp(-((t - 1)/0.002)^2)}");
  const std::vector<double>&own = system->study().excursions,
        divided = with_steps(*system, {Method::kRodas5P, false, 9})->study().excursions;
  ASSERT_GE(own.size(), 2u) << "the pulse has break times";
  const double begin = own.front(), end = own.back();
  const auto within = std::count_if(divided.begin(), divided.end(),
                                    [&](double time) { return time >= begin && time <= end; });
  EXPECT_GE(within, 200);
  EXPECT_TRUE(std::is_sorted(divided.begin(), divided.end()));
}

}  // namespace
}  // namespace codesign
