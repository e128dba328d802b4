// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// References: an independent solution of the same data at tolerances down to 1e-12 (psi converged
// to 4e-10 relative).
#include "cases/shipped.h"

namespace codesign {
namespace {

TEST(SliderCrank, CountsAreThePapers) {
  for (const char* name : {"slider_crank", "slider_crank_haug"})
    expect_counts(Shipped(name), {21, 42, 1, 20, 62, 5, 310, 372});
}

// Objective and gradient are checked with both integrators in test/allocation/evaluation_test.cc.
TEST(SliderCrank, SeriesMeetTheReference) {
  expect_series(
      Shipped("slider_crank"),
      {{"crank_joint/velocity",
        {-9.643493154114662, -9.89449793226016, -9.989750713067032, -10.062140298460701},
        0.481576118683126},
       {"crank_joint/position",
        {-4.964667891522788, -9.93318806926948, -14.872032614269042, -19.80659467055607},
        19.80659467055607},
       {"slider/position/x",
        {0.2878376269817577, 0.2996332761914889, 0.2792871522649849, 0.25579489280072776},
        0.04503350209709234},
       {"slider_joint/velocity",
        {-0.18917627274217635, 0.03822268894722169, 0.22331034960000457, 0.06373250440777527},
        0.4436938114140815},
       {"slider_joint/normal_force",
        {21.016006723605965, 23.005364976095525, 25.13199065570025, 35.195386113163146},
        20.08765669339265},
       {"slider_joint/friction",
        {6.309686508477159, -7.355305004928929, -7.543165079618016, -10.74725367148935},
        24.497488361400602},
       {"crank_speed/output",
        {-0.3565068458853382, -0.10550206773983994, -0.010249286932968005, 0.062140298460700905},
        0.481576118683126}});
}

}  // namespace
}  // namespace codesign
