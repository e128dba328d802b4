// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Loads that are functions of time and of signals, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"

namespace codesign {
namespace {

const char* const kWeightless = "gravity: [0, 0, 0]\n";

class VaryingLoad : public ::testing::TestWithParam<const char*> {
 protected:
  std::string solver() const {
    return std::string("solver: {") + GetParam() +
           ", relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n";
  }
  /// A mass of 2 kg on a slide with this load.
  std::vector<double> slide(const std::string& load, double time,
                            const std::vector<std::string>& signals,
                            const std::string& start = "") const {
    return end_of(
        robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)),
        "duration: 2.0\n" + std::string(kWeightless) + start + "loads: [" + load + "]\n" + solver(),
        time, signals);
  }
};

TEST_P(VaryingLoad, OfTimePushesBySineExpressionAndWayPoints) {
  const double t = 1.3, w = 5.0, v = 3.0 / (2.0 * w) * (1.0 - std::cos(w * t));
  for (const char* load : {"{joint: slide, effort: \"${3*sin(5*t)}\"}",
                           "{link: piston, force: [0, 0, \"${3*sin(5*t)}\"]}",
                           "{link: piston, force: [0, 0, \"${3*sin(5*t)}\"], frame: link}"}) {
    const std::vector<double> s = slide(load, t, {"slide/velocity", "mechanism/load_power"});
    EXPECT_NEAR(s[0], v, 1e-8) << load;
    EXPECT_NEAR(s[1], 3.0 * std::sin(w * t) * v, 1e-7) << load;
  }
}

// idas follows polynomials in steps too long for the integral of the work that checks its energy.
class PiecewiseLoad : public VaryingLoad {};

TEST_P(PiecewiseLoad, IsARampOrAStep) {
  const double t = 1.3;
  // A ramp from 0 to 4 N within a second, then 4 N: v = (2 + 4 (t - 1))/2.
  EXPECT_NEAR(slide("{joint: slide, effort: {type: waypoints, times: [0, 1], positions: [0, 4], "
                    "interpolation: linear}}",
                    t, {"slide/velocity"})[0],
              0.5 * (2.0 + 4.0 * (t - 1.0)), 1e-9);
  // 6 N from t = 0.5 on.
  EXPECT_NEAR(slide("{joint: slide, effort: \"${t < 0.5 ? 0 : 6}\"}", t, {"slide/velocity"})[0],
              3.0 * (t - 0.5), 1e-5);
}

// The study itself reads no time here.
TEST_P(VaryingLoad, ARecordedExpressionMayReadTheTime) {
  EXPECT_NEAR(slide("{joint: slide, effort: 1.0}", 1.3, {"${2*t + slide/load_power*0}"})[0], 2.6,
              1e-12);
}

TEST_P(VaryingLoad, OfAGasSpringKeepsItsEnergy) {
  // F = p (l/(l + x))^n does the work p l/(1 - n) ((1 + x/l)^(1 - n) - 1).
  const double p = 40.0, l = 0.5, n = 1.3;
  const std::vector<double> s =
      slide("{joint: slide, effort: \"${40*(0.5/(0.5 + slide/position))^1.3}\"}", 0.3,
            {"slide/position", "slide/velocity", "${40*(0.5/(0.5 + slide/position))^1.3}",
             "slide/load_power"});
  const double work = p * l / (1.0 - n) * (std::pow(1.0 + s[0] / l, 1.0 - n) - 1.0);
  EXPECT_GT(s[0], 0.3);
  EXPECT_NEAR(s[1] * s[1], work, 1e-8 * work);
  EXPECT_NEAR(s[2], p * std::pow(l / (l + s[0]), n), 1e-9);
  EXPECT_NEAR(s[3], s[2] * s[1], 1e-8);
}

TEST_P(VaryingLoad, OfTheSpeedBrakesLikeDragOnBothSidesOfZero) {
  // m v' = -c v |v|: v = v0/(1 + c |v0| t/m).
  for (const double v0 : {3.0, -3.0})
    EXPECT_NEAR(
        slide("{link: piston, force: [0, 0, \"${-0.8*piston/velocity/z*abs(piston/velocity/z)}\"]}",
              1.0, {"slide/velocity"},
              "initial_state: {slide: {velocity: " + std::to_string(v0) + "}}\n")[0],
        v0 / (1.0 + 0.8 * 3.0 * 1.0 / 2.0), 1e-8);
}

// The natural cubic spline through (0, 0), (1, 2), (2, 0) has f'' = -6 at 1 and the slopes 3 and -3
// at its ends.
TEST_P(VaryingLoad, OfATableFollowsItsSplineAndGoesOnAlongItsTangents) {
  const std::string table =
      "{joint: slide, effort: {type: table, signal: slide/position, at: [0, 1, 2], values: [0, 2, "
      "0]";
  const auto at = [&](double position, const std::string& interpolation) {
    return slide(table + interpolation + "}}", 1e-6, {"${slide/acceleration*2}"},
                 "initial_state: {slide: {position: " + std::to_string(position) + "}}\n")[0];
  };
  EXPECT_NEAR(at(0.5, ""), 1.375, 1e-8);
  EXPECT_NEAR(at(1.0, ""), 2.0, 1e-8);
  EXPECT_NEAR(at(-1.0, ""), -3.0, 1e-8);
  EXPECT_NEAR(at(3.0, ""), -3.0, 1e-8);
  EXPECT_NEAR(at(0.5, ", interpolation: linear"), 1.0, 1e-8);
  EXPECT_NEAR(at(3.0, ", interpolation: linear"), -2.0, 1e-8);
}

TEST_P(VaryingLoad, MayContainTheTimeAndSignals) {
  // m v' = -2 t v: v = v0 exp(-t^2/2).
  EXPECT_NEAR(slide("{joint: slide, effort: \"${-2*t*slide/velocity}\"}", 1.2, {"slide/velocity"},
                    "initial_state: {slide: {velocity: 1.5}}\n")[0],
              1.5 * std::exp(-0.72), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Solvers, VaryingLoad,
                         ::testing::Values("coordinates: absolute, method: rodas5p",
                                           "coordinates: joint, method: dopri5",
                                           "coordinates: joint, method: rodas5p",
                                           "coordinates: absolute, integrator: idas"));

INSTANTIATE_TEST_SUITE_P(Solvers, PiecewiseLoad,
                         ::testing::Values("coordinates: absolute, method: rodas5p",
                                           "coordinates: joint, method: dopri5"));

TEST(MotorSignals, AreOnTheMotorsSideOfTheGear) {
  const std::vector<double> s = end_of(
      robot(mass("piston", 2.0) +
            lift("slide", "piston", 0.0,
                 "<codesign:actuator gear_ratio='50' rotor_inertia='0.001'/>")),
      "duration: 1.0\ngravity: [0, 0, 0]\nmotion: {slide: {position: \"${0.1*t^2}\"}}\n", 0.5,
      {"slide/effort", "slide/velocity", "slide/motor_torque", "slide/motor_speed",
       "${slide/motor_torque*slide/motor_speed - slide/actuator_power}"});
  EXPECT_NEAR(s[0], (2.0 + 50.0 * 50.0 * 0.001) * 0.2, 1e-9);
  EXPECT_NEAR(s[1], 0.1, 1e-12);
  EXPECT_NEAR(s[2], s[0] / 50.0, 1e-12);
  EXPECT_NEAR(s[3], 5.0, 1e-10);
  EXPECT_NEAR(s[4], 0.0, 1e-12);
}

TEST(LoadSignals, OfWhatDependsOnLoadsAreRefused) {
  for (const char* signal : {"slide/acceleration", "slide/effort", "slide/load_power",
                             "slide/reaction_force/x", "hold/output"}) {
    try {
      compile(robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)),
              "duration: 1.0\ncontrollers: {hold: {type: pid, input: slide/position, setpoint: 0, "
              "output: slide, gains: {p: 1}}}\nloads: [{joint: slide, effort: \"${2*" +
                  std::string(signal) + "}\"}]\n");
      ADD_FAILURE() << signal;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().element, "loads") << error.what();
      EXPECT_NE(error.fault().message.find("cannot depend on"), std::string::npos) << error.what();
    }
  }
}

TEST(LoadSignals, AJointMayHaveTheNameOfTheTime) {
  EXPECT_NEAR(end_of(robot(mass("piston", 2.0) + lift("t", "piston", 0.0)),
                     "duration: 1.0\ngravity: [0, 0, 0]\nloads: [{joint: t, effort: "
                     "\"${t/2}\"}]\nsolver: {relative_tolerance: 1e-9}\n",
                     1.0, {"t/velocity"})[0],
              0.125, 1e-7);
}

TEST(LoadSignals, AMisspeltQuantityIsNamedAsOne) {
  try {
    compile(robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)),
            "duration: 1.0\nloads: [{joint: slide, effort: \"${2*slide/positon}\"}]\n");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "loads[0].effort") << error.what();
    EXPECT_NE(error.fault().message.find("did you mean \"position\"?"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
