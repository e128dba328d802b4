// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Motions and gradients through contacts of bodies. The references are those of own models on
// scipy's DOP853, with events at touch and release and differences of their objectives; closed
// forms stand beside them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integration/touching.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct Reference {
  const char* name;
  std::string urdf, study;
  double objective;
  std::vector<double> gradient;
  std::size_t events;
};

constexpr double kGravity = 9.81;

/// A ball falls on a plane and bounces three times within 1 s.
Reference bouncing() {
  return {"bouncing",
          free_ball("", touching_ground("shape='plane'", kLossy)),
          "duration: 1.0\ninitial_state: {free: {translation: [0, 0, \"${height}\"]}}\nparameters: "
          "{height: {initial: 0.4}, radius: {}, loss: {}}\nobjective: {terminal: [{signal: "
          "ball/position/z, reference: 2.0}], integral: [{signal: ball/position/z}]}\n",
          3.654099599709,
          {-0.1427858176, -3.338633859, 0.902164593},
          6};
}

/// The same by the linear law, whose force jumps at the touch and falls to zero before the release.
Reference with_a_jump() {
  return {"with a jump",
          free_ball("<codesign:parameter name='k' value='1e5'/><codesign:parameter name='c' "
                    "value='50'/>",
                    "<codesign:contact name='touch' model='linear' stiffness='1e5' "
                    "codesign:stiffness='${k}' damping='50' codesign:damping='${c}'><predecessor "
                    "link='ground' shape='plane'/><successor link='ball' shape='sphere' "
                    "radius='0.05' codesign:radius='${radius}'/></codesign:contact>"),
          "duration: 1.0\ninitial_state: {free: {translation: [0, 0, \"${height}\"]}}\nparameters: "
          "{height: {initial: 0.4}, radius: {}, k: {}, c: {}}\nobjective: {terminal: [{signal: "
          "ball/position/z, reference: 2.0}], integral: [{signal: ball/position/z}]}\n",
          3.648090341241,
          {-7.006351994, 3.613936487, -5.98201532e-06, 0.02534692783},
          6};
}

const char* const kBeside =
    "initial_state: {free: {translation: [\"${x}\", 0, \"${z}\"]}}\nobjective: {terminal: "
    "[{signal: ball/position/x}, {signal: ball/position/z, reference: 0.3}]}\n";

/// It falls on a sphere beside its top, with friction, and begins to turn.
Reference on_a_sphere() {
  return {
      "on a sphere",
      free_ball("<codesign:parameter name='big' value='0.1'/>",
                touching_ground("shape='sphere' radius='0.1' codesign:radius='${big}'", kLossy,
                                kSlippery)),
      "duration: 0.4\nparameters: {x: {initial: 0.03}, z: {initial: 0.35, tune: false}, radius: "
      "{}, big: {}, mu: {}, loss: {}}\n" +
          std::string(kBeside),
      0.028463780780,
      {1.647991989, -0.09306826918, -0.3299951706, -0.005560091712, 0.0261422505},
      2};
}

/// It falls in a socket, off its middle, and bounces twice.
Reference in_a_socket() {
  return {"in a socket",
          free_ball("<codesign:parameter name='big' value='0.3'/>",
                    touching_ground("shape='socket' radius='0.3' codesign:radius='${big}'", kLossy,
                                    kSlippery)),
          "duration: 0.5\nparameters: {x: {initial: 0.1}, z: {initial: 0.0, tune: false}, radius: "
          "{}, big: {}, mu: {}, loss: {}}\n" +
              std::string(kBeside),
          0.223821433870,
          {-0.7227011738, -1.562193226, 1.428502402, 0.2050693034, 0.1033840853},
          4};
}

Problem problem_of(const Reference& of, const std::string& solver) {
  return load_problem({"ball.urdf", of.urdf}, {}, {"ball.yaml", of.study + solver}, {},
                      TrajectoryLoader(), FileLoader());
}

constexpr const char* kTightSolver =
    "relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-12, sensitivity_tolerance: 1.0e-8, "
    "maximum_steps: 1000000";

TEST(ContactGradient, IsThatOfIndependentModels) {
  for (const Reference& of : {bouncing(), with_a_jump(), on_a_sphere(), in_a_socket()})
    for (const char* kind :
         {"", ", coordinates: absolute", ", gradient: adjoint", ", method: rodas5p"}) {
      const Problem problem =
          problem_of(of, "solver: {" + std::string(kTightSolver) + kind + "}\n");
      Evaluator evaluator(problem);
      const Evaluation run = evaluator.evaluate(problem.start(), true);
      ASSERT_TRUE(run.status.ok()) << of.name << kind << run.status.cause;
      EXPECT_NEAR(run.objective, of.objective, 1e-7 * of.objective) << of.name << kind;
      for (std::size_t k = 0; k < of.gradient.size(); ++k)
        EXPECT_NEAR(run.gradient[static_cast<Eigen::Index>(k)], of.gradient[k],
                    1e-5 * std::abs(of.gradient[k]))
            << of.name << kind << " parameter " << k;
      EXPECT_EQ(run.events.list.size(), of.events) << of.name << kind;
    }
}

TEST(ContactGradient, AtTheDefaultTolerancesHasFourDigits) {
  for (const Reference& of : {bouncing(), on_a_sphere(), in_a_socket()}) {
    const Problem problem = problem_of(of, "");
    Evaluator evaluator(problem);
    const Evaluation run = evaluator.evaluate(problem.start(), true);
    ASSERT_TRUE(run.status.ok()) << of.name << run.status.cause;
    double largest = 0.0;
    for (double entry : of.gradient) largest = std::max(largest, std::abs(entry));
    for (std::size_t k = 0; k < of.gradient.size(); ++k)
      EXPECT_NEAR(run.gradient[static_cast<Eigen::Index>(k)], of.gradient[k], 1e-4 * largest)
          << of.name << " parameter " << k;
  }
}

// Rounding alone decides on which side of the touch a step begins; the derivatives do not depend on
// it, whatever the exponent.
TEST(ContactGradient, AgreesWithTheComplexStepThroughTheSameSteps) {
  const std::string plane = "shape='plane'";
  std::vector<Reference> all{bouncing(), on_a_sphere(), in_a_socket()};
  for (const char* exponent : {"1", "1.2", "2", "3"}) {
    Reference other = bouncing();
    other.name = exponent;
    other.urdf =
        free_ball("", touching_ground(plane, std::string(kLossy) + " exponent='" + exponent + "'"));
    all.push_back(other);
  }
  for (const Reference& of : all)
    for (const char* method : {"dopri5", "rodas5p"}) {
      const Problem problem = problem_of(of, "solver: {method: " + std::string(method) + "}\n");
      const GradientCheck check =
          check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
      ASSERT_TRUE(check.status.ok()) << of.name << check.status.cause;
      EXPECT_LT(check.largest_relative_difference, 1e-8) << of.name << " " << method;
    }
}

// The run ends at the touch: T = sqrt(2 (h - r)/g), psi = T^2.
TEST(ContactGradient, OfTheTimeOfFlightIsThatOfTheClosedForm) {
  const Problem problem = problem_of(
      {"flight",
       free_ball("", touching_ground("shape='plane'", kLossy)),
       "duration: 1.0\nuntil: \"${touch/gap < 0}\"\ninitial_state: {free: {translation: [0, 0, "
       "\"${height}\"]}}\nparameters: {height: {initial: 0.4}, radius: {}}\nobjective: {terminal: "
       "[{signal: end_time}]}\n",
       0.0,
       {},
       0},
      "");
  Evaluator evaluator(problem);
  const Evaluation run = evaluator.evaluate(problem.start(), true);
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  EXPECT_NEAR(run.objective, 2.0 * 0.35 / kGravity, 1e-10);
  EXPECT_NEAR(run.gradient[0], 2.0 / kGravity, 1e-8);
  EXPECT_NEAR(run.gradient[1], -2.0 / kGravity, 1e-8);
}

// z(t) of the flight after one bounce without loss is that of a ball which falls from the same
// height: the touch at t1 = sqrt(2 (h - r)/g), and in the limit of a stiff contact z = r + v1 (t -
// t1) - g (t - t1)^2/2 with v1 = g t1.
TEST(ContactGradient, OfAStiffBounceIsThatOfTheClosedForm) {
  const double h = 0.4, r = 0.05, duration = 0.45, touch = std::sqrt(2.0 * (h - r) / kGravity),
               later = duration - touch,
               z = r + kGravity * touch * later - 0.5 * kGravity * later * later,
               by_touch = kGravity * later - kGravity * touch + kGravity * later,
               touch_by_h = 1.0 / (kGravity * touch);
  const Problem problem = problem_of(
      {"stiff",
       free_ball("",
                 "<codesign:contact name='touch' stiffness='1e13'><predecessor link='ground' "
                 "shape='plane'/><successor link='ball' shape='sphere' radius='0.05' "
                 "codesign:radius='${radius}'/></codesign:contact>"),
       "duration: 0.45\ninitial_state: {free: {translation: [0, 0, \"${height}\"]}}\nparameters: "
       "{height: {initial: 0.4}, radius: {}}\nobjective: {terminal: [{signal: ball/position/z}]}\n",
       0.0,
       {},
       2},
      "");
  Evaluator evaluator(problem);
  const Evaluation run = evaluator.evaluate(problem.start(), true);
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  EXPECT_NEAR(run.objective, z * z, 2e-4 * z * z);
  EXPECT_NEAR(run.gradient[0], 2.0 * z * by_touch * touch_by_h, 1e-3);
  EXPECT_NEAR(run.gradient[1], 2.0 * z * (1.0 - by_touch * touch_by_h), 1e-3);
}

}  // namespace
}  // namespace codesign
