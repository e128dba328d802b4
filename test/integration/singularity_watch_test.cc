// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/singularity_watch.h"

#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/integrator.h"
#include "integration/linkages.h"
#include "integration/servo.h"

namespace codesign {
namespace {

Warnings warnings_of(const std::string& urdf, const std::string& initial, const std::string& signal,
                     double duration, const std::string& solver, bool watch = true) {
  const auto system = compile(urdf, motion_study(duration, initial, signal, solver));
  const auto run = make_integrator(*system);
  run->watch_singularities(watch);
  Status status = run->start({});
  while (status.ok() && run->state().t < duration) status = run->advance(duration);
  EXPECT_TRUE(status.ok()) << status.cause;
  return run->warnings();
}

/// The time at which upright_row() has turned by a quarter.
double quarter_time(int count, double rate) {
  constexpr double kStep = 1e-5;
  double theta = 0.0, time = 0.0;
  for (; theta < 1.5707963267948966; time += kStep) {
    const double middle = theta + 0.5 * kStep * rate;
    rate += kStep * upright_row_acceleration(count, middle);
    theta = middle + 0.5 * kStep * rate;
  }
  return time;
}

TEST(SingularityWatch, TellsTimeAndRankWhereParallelogramsAreFlat) {
  for (const char* solver :
       {"{integrator: rosenbrock, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}",
        "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-8, absolute_tolerance: "
        "1.0e-9}"}) {
    const Warnings warnings = warnings_of(
        upright_row(2), "{hinge0: {position: 0.0, velocity: 1.0}}", "hinge0/velocity", 1.5, solver);
    ASSERT_EQ(warnings.size(), 1u) << solver;
    EXPECT_EQ(warnings[0].code, "singular_position_passed");
    const std::string& text = warnings[0].message;
    const std::size_t at = text.find("t = "), rank = text.find("rank ");
    ASSERT_NE(at, std::string::npos);
    ASSERT_NE(rank, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(at + 4)), quarter_time(2, 1.0), 1e-3) << text;
    // Five bodies with seven coordinates each and one degree of freedom; in the flat position the
    // rank drops by two.
    EXPECT_NE(text.find("rank 32 instead of 34"), std::string::npos) << text;
  }
}

// A coupler that is slightly too short: the linkage passes close to its flat position, where all
// constraints are still independent.
TEST(SingularityWatch, NamesNoRankThatIsNotLower) {
  std::string linkage = upright_row(1);
  const std::size_t hinge = linkage.find("xyz='1 0 0'", linkage.find("'hinge1'"));
  ASSERT_NE(hinge, std::string::npos);
  linkage.replace(hinge + 5, 1, "1.00001");
  const Warnings warnings =
      warnings_of(linkage, "{hinge0: {position: 0.0, velocity: 1.0}}", "hinge0/velocity", 1.5,
                  "{relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find(", where its constraints come close to losing rank: "),
            std::string::npos)
      << warnings[0].message;
}

TEST(SingularityWatch, IsSilentWhereNothingIsSingularOrNobodyAsks) {
  const char* const solver =
      "{integrator: rosenbrock, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}";
  EXPECT_TRUE(warnings_of(four_bar(pin_friction()), "{left_hinge: {position: 0.6, velocity: 1.0}}",
                          "left_hinge/velocity", 1.0, solver)
                  .empty());
  EXPECT_TRUE(
      warnings_of(double_pendulum(), "{shoulder: {position: 1.5}}", "elbow/velocity", 2.0, solver)
          .empty());
  EXPECT_TRUE(
      warnings_of(bricard(), bricard_start(1.2, 0.7), "turn1/velocity", 1.0, solver).empty());
  EXPECT_TRUE(warnings_of(upright_row(2), "{hinge0: {position: 0.0, velocity: 1.0}}",
                          "hinge0/velocity", 1.5, solver, false)
                  .empty());
}

}  // namespace
}  // namespace codesign
