// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/sensitivity_scale.h"

#include "sensitivity/gradient_cases.h"
#include "sensitivity/lane_directions.h"

namespace codesign {
namespace {

GradientCase scaled_slide(const std::string& more) {
  return from_texts(
      "slide",
      robot("<link name='mass'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
            "iyz='0' izz='1'/></inertial></link><joint name='slide' type='prismatic'><parent "
            "link='ground'/><child link='mass'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' "
            "effort='0' velocity='0'/></joint>"),
      std::string(
          "duration: 1.0\ninitial_state: {slide: {position: \"${a}\", velocity: \"${b}\"}}\n"
          "parameters: {a: {initial: 1, lower: 0, upper: 10}, b: {initial: 0, lower: -50, upper: "
          "50}}\nobjective: {integral: [{signal: slide/position}]}\nsolver: {coordinates: "
          "joint}\n") +
          more);
}

/// One joint, so that x, v and psi' have one entry each besides z; parameters with values 1 and 0.
class SensitivityScaleTest : public ::testing::Test {
 protected:
  SensitivityScaleTest() {
    parameters.assign(2, Lanes<4>(1.0));
    parameters[1] = Lanes<4>(0.0);
    parameters[0].v[0] = 1.0;
    parameters[1].v[1] = 1.0;
    state.resize(system->layout());
    scale.start(*system, parameters);
  }

  /// The error of estimates of 1e-6 along one direction, which is as large as `sizes` at the end.
  double error(int lane, double size, double psi = 0.0, double objective = 0.0) {
    Directions<4> y(at.size()), e(at.size());
    y.col(at.x())[lane] = y.col(at.v())[lane] = size;
    e.col(at.x())[lane] = 1e-6;
    Eigen::Array4d psi_end = Eigen::Array4d::Zero();
    psi_end[lane] = psi;
    return scale.error(at, {state, y, e, psi_end, objective}, 1e-4);
  }

  const GradientCase test = scaled_slide("");
  const std::shared_ptr<const CompiledSystem> system = test.compile("auto", "direct");
  const IncrementLayout at{system->layout()};
  std::vector<Lanes<4>> parameters;
  State<double> state;
  SensitivityScale<4> scale;
};

TEST_F(SensitivityScaleTest, IsTheSizeOfEachDirection) {
  EXPECT_NEAR(error(0, 1.0), 1e-2, 1e-9);
  EXPECT_NEAR(error(1, 0.1), 1e-1, 1e-9);
}

TEST_F(SensitivityScaleTest, KeepsTheLargestSizeSoFar) {
  Directions<4> y(at.size());
  y.col(at.x())[1] = 5.0;
  scale.measure(at, state, y);
  EXPECT_NEAR(error(1, 0.1), 2e-3, 1e-9);
  EXPECT_NEAR(error(0, 0.1), 1e-1, 1e-9) << "of the direction itself";
}

// A thousandth of a motion of 100 over a range of 10 is 0.01.
TEST_F(SensitivityScaleTest, IsAtLeastAThousandthOfTheMotionOverTheRange) {
  state.q[0] = 100.0;
  scale.measure(at, state, Directions<4>(at.size()));
  EXPECT_NEAR(error(0, 1e-6), 1.0, 1e-6);
  EXPECT_NEAR(error(1, 1e-6), 10.0, 1e-5) << "over a range of 100";
}

// Errors over the range of less than a thousandth of the absolute tolerance 1e-7 do not count.
TEST_F(SensitivityScaleTest, IsNotRounding) {
  EXPECT_NEAR(error(0, 0.0), 1e-6 / 1e-11, 1e-3 / 1e-11);
  EXPECT_NEAR(error(1, 0.0), 1e-6 / 1e-12, 1e-3 / 1e-12);
}

TEST_F(SensitivityScaleTest, JudgesTheDerivativeOfTheIntegral) {
  Directions<4> y(at.size()), e(at.size());
  y.col(at.x()).setOnes();
  e.col(at.psi())[0] = 1e-6;
  const auto judge = [&](double psi, double objective) {
    return scale.error(at, {state, y, e, Eigen::Array4d::Constant(psi), objective}, 1e-4);
  };
  EXPECT_NEAR(judge(2.0, 0.0), 5e-3, 1e-9);
  EXPECT_NEAR(judge(0.0, 500.0), 1e-6 / 0.05 / 1e-4, 1e-6);
}

// A contact turns a velocity of 2 m/s round within 2 ms of a second: the sensitivity of 500 in
// between vanishes with it. Without the contact it would be the size of later errors.
TEST_F(SensitivityScaleTest, LeavesOutWhatAShortContactRaises) {
  const auto with_stops = scaled_slide("limits: {position: true}\n").compile("auto", "direct");
  Directions<4> y(at.size()), e(at.size());
  e.col(at.v())[0] = 1e-6;
  const auto reach = [&](double t, double v, double a, double sensitivity) {
    state.t = t;
    state.v[0] = v;
    state.z[0] = a;
    y.col(at.v())[0] = sensitivity;
    scale.measure(at, state, y);
    return scale.error(at, {state, y, e, Eigen::Array4d::Zero(), 0.0}, 1e-4);
  };
  scale.start(*with_stops, parameters);
  EXPECT_NEAR(reach(0.0, 2.0, 1.0, 1.0), 1e-2, 1e-9);
  EXPECT_NEAR(reach(0.5, 2.0, 1.0, 1.0), 1e-2, 1e-9);
  // The mean is (0.5 + 0.5 * 501 * 1e-3) / 0.501 = 1.498.
  EXPECT_NEAR(reach(0.501, 0.0, -2e3, 500.0), 1e-2 / ((0.5 + 0.2505) / 0.501), 1e-5);
  EXPECT_NEAR(reach(0.9, -2.0, 1.0, 20.0), 5e-4, 1e-9) << "what stays counts";
  // Without switches there is no contact.
  scale.start(*system, parameters);
  reach(0.0, 2.0, 1.0, 1.0);
  reach(0.5, 2.0, 1.0, 1.0);
  EXPECT_NEAR(reach(0.501, 0.0, -2e3, 500.0), 2e-5, 1e-9);
}

// Bristles are micrometres beside a joint that turns: an error of the size of their own
// sensitivity counts whole.
TEST(SensitivityScale, JudgesExtraStatesApartFromPositions) {
  const GradientCase brush = from_texts(
      "brush",
      robot("<link name='mass'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
            "iyz='0' izz='1'/></inertial></link><joint name='turn' type='continuous'><parent "
            "link='ground'/><child link='mass'/><axis xyz='0 0 1'/><codesign:friction "
            "model='lugre' mu_static='0.3' mu_dynamic='0.3' transition_velocity='0.0005' "
            "joint_length='0.05' pin_radius='0.01'/></joint>"),
      "duration: 1.0\ninitial_state: {turn: {velocity: \"${a}\"}}\nparameters: {a: {initial: 1, "
      "lower: 0, upper: 10}}\nobjective: {terminal: [{signal: turn/position}]}\n");
  const auto system = brush.compile("auto", "direct");
  const IncrementLayout at(system->layout());
  ASSERT_GT(at.states, 0);
  std::vector<Lanes<4>> parameters(1, Lanes<4>(1.0));
  parameters[0].v[0] = 1.0;
  SensitivityScale<4> scale;
  State<double> state;
  state.resize(system->layout());
  scale.start(*system, parameters);
  Directions<4> y(at.size()), e(at.size());
  y.col(at.x())[0] = 100.0;
  y.col(at.s())[0] = 1e-4;
  e.col(at.s())[0] = 1e-7;
  EXPECT_NEAR(scale.error(at, {state, y, e, Eigen::Array4d::Zero(), 0.0}, 1e-3), 1.0, 1e-9);
}

TEST(SensitivityTolerance, FollowsTheRelativeOneToFiveDigits) {
  SolverOptions options;
  const auto at = [&options](double relative) {
    options.relative_tolerance = relative;
    return sensitivity_tolerance(options);
  };
  EXPECT_DOUBLE_EQ(at(1e-6), 1e-5);
  EXPECT_DOUBLE_EQ(at(1e-7), 1e-5);
  EXPECT_DOUBLE_EQ(at(1e-9), 1e-7);
  EXPECT_DOUBLE_EQ(at(1e-5), 1e-4);
  EXPECT_DOUBLE_EQ(at(1e-2), 1e-3);
  options.sensitivity_tolerance = 0.02;
  EXPECT_EQ(at(1e-6), 0.02);
}

}  // namespace
}  // namespace codesign
