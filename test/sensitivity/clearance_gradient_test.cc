// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Motions and gradients of a slider-crank with clearance in a loop or in a joint of the tree. The
// references are those of an own model with three coordinates on scipy's DOP853, with events at
// touch and release, and of differences of its objective, extrapolated twice.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integration/playing.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

struct PlayingReference {
  const char* name;
  std::string urdf;
  double objective, crank, slider;  ///< turn/position and slider/position/x at the end
  std::vector<double> gradient;
  std::size_t events;
};

PlayingReference in_the_loop() {
  return {"in the loop",
          playing_slider_crank("", kPlayingPin),
          0.5665033211640,
          1.2546134079483,
          0.1261294915802,
          {-98.909152945, 0.0116347009663, 0.64181659051},
          6};
}

PlayingReference in_the_tree() {
  return {"in the tree",
          playing_slider_crank(kPlayingPin, ""),
          0.5140370261030,
          1.2415603742756,
          0.1260160332962,
          {-1921.1815632, 0.10435834272, -8.5072536660},
          5};
}

constexpr const char* kTight =
    "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-13, sensitivity_tolerance: "
    "1.0e-8, maximum_steps: 1000000";

TEST(ClearanceGradient, IsThatOfAnIndependentModel) {
  for (const PlayingReference& of : {in_the_loop(), in_the_tree()})
    for (const char* kind : {"", ", coordinates: absolute", ", gradient: adjoint"}) {
      const Problem problem =
          playing_problem(of.urdf, playing_study(kTight + std::string(kind) + "}\n"));
      Evaluator evaluator(problem);
      const Evaluation run = evaluator.evaluate(problem.start(), true);
      ASSERT_TRUE(run.status.ok()) << of.name << kind << run.status.cause;
      EXPECT_NEAR(run.objective, of.objective, 1e-6 * of.objective) << of.name << kind;
      for (std::size_t k = 0; k < of.gradient.size(); ++k)
        EXPECT_NEAR(run.gradient[static_cast<Eigen::Index>(k)], of.gradient[k],
                    1e-5 * std::abs(of.gradient[k]))
            << of.name << kind << " parameter " << k;
      EXPECT_EQ(run.events.list.size(), of.events) << of.name << kind;
    }
}

TEST(ClearanceGradient, TheMotionIsThatOfAnIndependentModel) {
  for (const PlayingReference& of : {in_the_loop(), in_the_tree()}) {
    const Problem problem = playing_problem(of.urdf, playing_study(kTight + std::string("}\n")));
    Simulation simulation(problem, problem.parameters(), {"turn/position", "slider/position/x"});
    ASSERT_TRUE(simulation.start().ok()) << of.name;
    const Status status = simulation.advance_to(0.03);
    ASSERT_TRUE(status.ok()) << of.name << status.cause;
    Frame frame;
    simulation.sample(0.03, &frame);
    EXPECT_NEAR(frame.signals[0], of.crank, 1e-6) << of.name;
    EXPECT_NEAR(frame.signals[1], of.slider, 1e-7) << of.name;
  }
}

TEST(ClearanceGradient, AgreesWithTheComplexStepThroughTheSameSteps) {
  const Problem problem = playing_problem(in_the_loop().urdf, playing_study(""));
  const GradientCheck check = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-8);
}

}  // namespace
}  // namespace codesign
