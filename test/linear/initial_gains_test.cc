// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/initial_gains.h"

#include <gtest/gtest.h>

#include "statics/linear_cases.h"

namespace codesign {
namespace {

std::string cart_pole() {
  return R"(<robot name="cart_pole"><link name="ground"/>)" + body("cart", 1.0) +
         body("pole", 0.2, "0 0 0.5") +
         joint("x", "prismatic", "ground", "cart", "0 0 0", "1 0 0",
               R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)") +
         joint("tilt", "continuous", "cart", "pole", "0 0 0", "0 1 0") + "</robot>";
}

std::string double_pendulum() {
  return R"(<robot name="double_pendulum"><link name="ground"/>)" + body("lower", 1.0, "0 0 0.3") +
         body("upper", 0.5, "0 0 0.25") +
         joint("hip", "continuous", "ground", "lower", "0 0 0", "0 1 0") +
         joint("knee", "continuous", "lower", "upper", "0 0 0.6", "0 1 0") + "</robot>";
}

/// A state feedback of two joints. @param more of its keys.
std::string balanced(const std::string& one, const std::string& other, const std::string& gains,
                     const std::string& more = "") {
  std::string signals;
  for (const std::string& joint : {one, other})
    for (const char* const quantity : {"/position", "/velocity"})
      signals += (signals.empty() ? "{signal: " : ", {signal: ") + joint + quantity + "}";
  return "duration: 1\ncontrollers: {balance: {type: state_feedback, output: " + one +
         ", feedback: [" + signals + "], gains: " + gains + more + "}}\n";
}

void expect_gains(const Problem& problem, const std::vector<double>& expected) {
  const std::vector<double> parameters = problem.parameters();
  ASSERT_EQ(parameters.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(problem.all_parameters()[k].name, "balance_k" + std::to_string(k));
    EXPECT_NEAR(parameters[k], expected[k], 1e-9 * std::abs(expected[k]));
  }
  EXPECT_EQ(problem.tuned_names().size(), expected.size());
}

// Equations of motion by hand, gains by scipy.linalg.solve_continuous_are (SciPy 1.10).
TEST(InitialGains, ByLqrMeetRiccatiOfAnotherProgram) {
  expect_gains(loaded(cart_pole(),
                      balanced("x", "tilt", "{from: lqr, weights: [10, 1, 100, 1], effort: 0.1}")),
               {-10.0, -11.9847194454887, -77.3192318417599, -17.2921111646531});
  expect_gains(loaded(double_pendulum(),
                      balanced("hip", "knee", "{from: lqr, weights: [5, 1, 2, 0.5], effort: 0.5}")),
               {-35.9518654454878, -11.7551052165944, -34.8632689697052, -6.04339035738324});
}

// By scipy.signal.place_poles.
TEST(InitialGains, ByPoles) {
  const std::string gains = "{from: poles, poles: [-1, -2, [-3, 1]]}";
  expect_gains(loaded(cart_pole(), balanced("x", "tilt", gains)),
               {-1.26401630988787, -2.65443425076453, -31.1304097859327, -7.17266055045871});
  const std::string study = balanced("hip", "knee", gains);
  expect_gains(loaded(double_pendulum(), study),
               {-1.21178593272172, -1.0255504587156, -7.00114984709481, -0.822614678899083});
  expect_poles(model_of(double_pendulum(), study), {{-1, 0}, {-2, 0}, {-3, 1}}, 1e-8);
}

// The start of the run is another posture, limits and samples are those of the run.
TEST(InitialGains, AreThoseOfThePostureOfTheReferences) {
  const std::string gains = "{from: lqr, weights: [10, 1, 100, 1], effort: 0.1}";
  expect_gains(
      loaded(cart_pole(), balanced("x", "tilt", gains, ", output_limit: 40, sample_time: 0.01") +
                              "initial_state: {tilt: {position: 0.2}}\n"),
      {-10.0, -11.9847194454887, -77.3192318417599, -17.2921111646531});
}

TEST(InitialGains, AreStarts) {
  const std::string study =
      balanced("x", "tilt", "{from: lqr, weights: [10, 1, 100, 1], effort: 0.1, upper: 0}");
  const Problem problem =
      load_problem({"model.urdf", cart_pole()}, {}, {"study.yaml", study}, {{"balance_k0", -3.0}});
  EXPECT_EQ(problem.parameters()[0], -3.0);
  EXPECT_NEAR(problem.parameters()[1], -11.9847194454887, 1e-8);
}

TEST(InitialGains, TellWhatThereIsNot) {
  const auto message = [](const std::string& urdf, const std::string& study) {
    return refused([&] { loaded(urdf, study); });
  };
  const std::string lqr = "{from: lqr, weights: [10, 1, 100, 1]}";
  std::string tilted = balanced("x", "tilt", lqr);
  tilted.replace(tilted.find("{signal: tilt/position}"), 23,
                 "{signal: tilt/position, reference: 0.3}");
  EXPECT_NE(
      message(cart_pole(), tilted).find("none at rest: without feedback a coordinate accelerates"),
      std::string::npos);
  EXPECT_NE(message(cart_pole(), balanced("x", "tilt", "{from: lqr, weights: [1, 1]}"))
                .find("found 2 weights for 4 signals"),
            std::string::npos);
  EXPECT_NE(message(cart_pole(), balanced("x", "tilt", "{from: poles, poles: [-1]}"))
                .find("found 1 poles for 4 states"),
            std::string::npos);
  EXPECT_NE(message(cart_pole(), balanced("x", "x", lqr)).find("do not determine the states"),
            std::string::npos);
  EXPECT_NE(
      message(cart_pole(), balanced("x", "tilt", "{from: lqr, weights: [10, 1, 100, 1], lower: 0}"))
          .find("lies outside its bounds"),
      std::string::npos);
  // The cart is not seen.
  EXPECT_NE(message(cart_pole(), balanced("x", "tilt", "{from: lqr, weights: [0, 0, 1, 1]}"))
                .find("no gains give this"),
            std::string::npos);
}

}  // namespace
}  // namespace codesign
