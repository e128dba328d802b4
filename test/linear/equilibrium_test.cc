// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/equilibrium.h"

#include <cmath>

#include "description/study.h"
#include "problem/load_problem.h"
#include "statics/statics_cases.h"

namespace codesign {
namespace {

Equilibrium equilibrium_of(const Problem& problem) {
  return find_equilibrium(*system_of(problem), problem.parameters(), {});
}

double position_of(const Equilibrium& found, const std::string& joint) {
  for (std::size_t k = 0; k < found.names.joints.size(); ++k)
    if (found.names.joints[k] == joint) return found.frame.joints[k].position;
  ADD_FAILURE() << joint;
  return 0.0;
}

std::string start_at(double hinge, const std::string& more = "") {
  return "duration: 10\ninitial_state: {hinge: {position: " + std::to_string(hinge) + "}}\n" + more;
}

// A pendulum of 2 kg with its centre 0.5 m below its hinge, 0.1 kg m^2 about that centre, and a
// damping of 0.3 N m s: theta'' + 2 kDecay theta' + kSquare theta = 0.
constexpr double kSquare = 2.0 * kGravity * 0.5 / (0.1 + 2.0 * 0.25), kDecay = 0.25;

// From level, where no small motion feels a change of its torque, and from a little beside the top.
TEST(Equilibrium, APendulumComesToHang) {
  for (const double start : {kPi / 2.0, -1.0, 3.14, -3.0}) {
    const Equilibrium found = equilibrium_of(loaded(pendulum_urdf(), start_at(start)));
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    EXPECT_NEAR(position_of(found, "hinge"), 0.0, 1e-10);
    EXPECT_EQ(found.linear.stability, Stability::kStable);
    ASSERT_EQ(found.linear.modes.size(), 1U);
    const Pole& pole = found.linear.modes[0].pole;
    EXPECT_NEAR(pole.growth(), -kDecay, 1e-9);
    EXPECT_NEAR(pole.frequency(), std::sqrt(kSquare - kDecay * kDecay) / (2.0 * kPi), 1e-9);
    EXPECT_EQ(found.linear.verdict,
              "stable: slowest pole -0.25 1/s; damping and controllers counted, friction not");
    EXPECT_EQ(found.linear.modes[0].rates, std::vector<double>{1.0});
  }
}

TEST(Equilibrium, APendulumAtItsTopIsUnstable) {
  const Equilibrium found = equilibrium_of(loaded(pendulum_urdf(),
                                                  "duration: 10\ninitial_state: {hinge: {position: "
                                                  "3.141592653589793, velocity: 0.3}}\n"));
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(position_of(found, "hinge"), kPi, 1e-12);
  EXPECT_EQ(found.linear.stability, Stability::kUnstable);
  EXPECT_NEAR(found.linear.modes[0].pole.growth(), -kDecay + std::sqrt(kSquare + kDecay * kDecay),
              1e-9);
}

// p (r - theta) = m g l sin(theta): a servo without an integral sags; delays, samples and lags do
// not count.
TEST(Equilibrium, AServoSags) {
  for (const std::string more :
       {"", ", sample_time: 0.01, delay: 0.01", ", time_constant: 0.1, derivative_filter: 0.01"}) {
    const Equilibrium found = equilibrium_of(
        loaded(pendulum_urdf(),
               start_at(0.0,
                        "controllers: {servo: {type: pid, input: hinge/position, output: hinge, "
                        "setpoint: {type: sine, amplitude: 0.5, offset: 0.7, frequency: 1}, gains: "
                        "{p: 20, d: 1}" +
                            more + "}}\n")));
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    const double angle = position_of(found, "hinge");
    EXPECT_GT(angle, 0.3);
    EXPECT_NEAR(20.0 * (0.7 - angle), 2.0 * kGravity * 0.5 * std::sin(angle), 1e-10) << more;
    if (!more.empty()) continue;
    // 0.6 theta'' + (1 + 0.3) theta' + (20 + m g l cos) theta = 0
    const double stiffness = 20.0 + 2.0 * kGravity * 0.5 * std::cos(angle);
    EXPECT_NEAR(found.linear.modes[0].pole.growth(), -1.3 / 1.2, 1e-9);
    EXPECT_NEAR(std::norm(found.linear.modes[0].pole.value), stiffness / 0.6, 1e-8);
  }
}

// The spring pulls the arm up with the torque k a b sin(theta), gravity down with m g l sin(theta),
// theta from the top.
TEST(Equilibrium, ASpringBalancesAnArm) {
  const double balance = 2.0 * kGravity * 0.5 / (0.4 * 0.25);  // k = m g l/(a b)
  const Equilibrium weak = equilibrium_of(loaded(balanced_arm(2.0, 0.5 * balance), start_at(1.0)));
  EXPECT_NEAR(position_of(weak, "hinge"), kPi, 1e-9);
  EXPECT_EQ(weak.linear.stability, Stability::kStable);
  const Equilibrium strong =
      equilibrium_of(loaded(balanced_arm(2.0, 2.0 * balance), start_at(1.0)));
  EXPECT_NEAR(position_of(strong, "hinge"), 0.0, 1e-9);
  EXPECT_NEAR(-std::norm(strong.linear.modes[0].pole.value),
              -2.0 * kGravity * 0.5 / (0.01 + 2.0 * 0.25), 1e-8);
  const Equilibrium even = equilibrium_of(loaded(balanced_arm(2.0, balance), start_at(1.0)));
  ASSERT_TRUE(even.status.ok()) << even.status.cause;
  EXPECT_NEAR(position_of(even, "hinge"), 1.0, 1e-9) << "it rests where it is put";
  EXPECT_EQ(even.linear.stability, Stability::kNeutral);
}

// A spring in the guide of a slider-crank carries a load: F = k x, and the crank follows the loop.
TEST(Equilibrium, ClosesLoops) {
  const std::string spring =
      R"(<codesign:torsion_spring stiffness="200" damping="0" free_position="0.3"/>)";
  const Problem problem =
      loaded(planar_slider_crank(spring),
             "duration: 10\ngravity: [0, 0, 0]\ninitial_state: {crank_joint: {position: 0.7}, "
             "slider_joint: {guess: 0.35}}\nloads: [{joint: slider_joint, effort: 8}]\n");
  for (const char* coordinates : {"joint", "absolute"}) {
    Study study = study_of(problem);
    study.solver.coordinates =
        *coordinates == 'j' ? CoordinatesKind::kJoint : CoordinatesKind::kAbsolute;
    const Equilibrium found = equilibrium_of(with_study(problem, study));
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    const double slider = position_of(found, "slider_joint"),
                 crank = position_of(found, "crank_joint");
    EXPECT_NEAR(slider, 0.3 + 8.0 / 200.0, 1e-10) << coordinates;
    EXPECT_NEAR(slider,
                0.1 * std::cos(crank) + std::sqrt(0.09 - std::pow(0.1 * std::sin(crank), 2)),
                1e-10);
    ASSERT_EQ(found.linear.modes.size(), 1U);
    EXPECT_EQ(found.linear.stability, Stability::kStable);
  }
}

// A free body on a vertical spring from above, and two sideways: six motions, three of them against
// gravity and springs alone.
TEST(Equilibrium, HangsABodyOnSprings) {
  std::string springs;
  const char* ends[] = {"0 0 1", "1 0 -0.5", "-0.6 0.9 -0.5", "-0.6 -0.9 -0.5"};
  for (int k = 0; k < 4; ++k)
    springs += "<codesign:spring_damper name=\"s" + std::to_string(k) +
               "\" stiffness=\"100\"><predecessor link=\"base\"><origin xyz=\"" + ends[k] +
               "\"/></predecessor><successor link=\"bar\"/></codesign:spring_damper>";
  const Equilibrium found = equilibrium_of(loaded(
      "<robot name=\"p\" xmlns:codesign=\"urn:mechanism_codesign\"><link name=\"base\"/>" +
          body("bar", 2.0) +
          R"(<joint name="free" type="floating"><parent link="base"/><child link="bar"/></joint>)" +
          springs + "</robot>",
      "duration: 1\ninitial_state: {free: {translation: [0.3, 0.2, 0.4]}}\n"));
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  // Springs of no free length pull as one to the mean of their ends.
  const Eigen::Vector3d expected(-0.05, 0.0, -0.125 - 2.0 * kGravity / 400.0);
  EXPECT_LT((found.frame.links[1].position - expected).norm(), 1e-9);
  EXPECT_EQ(found.linear.stability, Stability::kNeutral) << "the body turns without a force";
  int swings = 0;
  for (const LinearMode& mode : found.linear.modes) {
    if (mode.pole.is_zero(found.linear.duration)) continue;
    EXPECT_NEAR(std::norm(mode.pole.value), 200.0, 1e-6);
    ++swings;
  }
  EXPECT_EQ(swings, 3);
}

// A stop is a stiff spring that begins to act at its edge.
TEST(Equilibrium, RestsOnAStop) {
  const Equilibrium found = equilibrium_of(
      loaded(pendulum_urdf(), start_at(-1.0,
                                       "gravity: [20, 0, 0]\nlimits: {position: true, "
                                       "stiffness: 1.0e4, width: 1.0e-3}\n")));
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  // com = -0.5 sin(theta) along x: the load turns the bar towards -pi/2, to the stop at -1.2.
  const double beyond = -1.2 - position_of(found, "hinge");
  EXPECT_NEAR(1e4 * (beyond - 0.5e-3), 20.0 * std::cos(-1.2 - beyond), 1e-6);
  EXPECT_EQ(found.linear.stability, Stability::kStable);
}

TEST(Equilibrium, FindsNoneWhereALoadMovesForEver) {
  const Equilibrium found = equilibrium_of(
      loaded(pendulum_urdf("0 0 1"), start_at(0.0, "loads: [{joint: hinge, effort: 1}]\n")));
  EXPECT_EQ(found.status.code, StatusCode::kNoEquilibrium);
  EXPECT_NE(found.status.cause.find("no posture at rest was found near the start"),
            std::string::npos)
      << found.status.cause;
  EXPECT_NE(found.status.cause.find(
                "the largest effort that nothing balances 1 N or N m, of hinge/position"),
            std::string::npos)
      << found.status.cause;
}

// p e + i s + d e' with e = 0: the integral carries m g l sin(0.7).
TEST(Equilibrium, AnIntegralLeavesNoError) {
  for (const std::string more :
       {"", ", i_clamp: 50", ", sample_time: 0.001", ", antiwindup: true, i_clamp: 50"}) {
    const Problem problem =
        loaded(pendulum_urdf(),
               start_at(0.0,
                        "controllers: {servo: {type: pid, input: hinge/position, output: hinge, "
                        "setpoint: 0.7, gains: {p: 20, i: 4, d: 1}" +
                            more + "}}\n"));
    const Equilibrium found = equilibrium_of(problem);
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    EXPECT_NEAR(position_of(found, "hinge"), 0.7, 1e-9);
    EXPECT_NEAR(found.frame.joints[0].effort, 2.0 * kGravity * 0.5 * std::sin(0.7), 1e-8);
    EXPECT_EQ(found.linear.stability, Stability::kStable) << found.linear.verdict;
    if (!more.empty()) continue;
    // 0.6 s^3 + 1.3 s^2 + (20 + m g l cos) s + 4
    for (const LinearMode& mode : found.linear.modes) {
      const std::complex<double> s = mode.pole.value;
      EXPECT_LT(std::abs(s * (s * (0.6 * s + 1.3) + 20.0 + kGravity * std::cos(0.7)) + 4.0), 1e-7);
    }
  }
}

// The difference of samples needs no rate of its signal: an inner loop of the speed reads what an
// outer one wants.
TEST(Equilibrium, OfASampledCascadeWithADerivative) {
  const Problem problem =
      loaded(pendulum_urdf(),
             start_at(0.0,
                      "controllers: {outer: {type: pid, input: hinge/position, setpoint: 0.7, "
                      "gains: {p: 4}, sample_time: 0.01}, inner: {type: pid, input: hinge/velocity "
                      "- outer/output, setpoint: 0, output: hinge, gains: {p: 20, i: 4, d: 0.01}, "
                      "sample_time: 0.01, derivative: measurement}}\n"));
  const Equilibrium found = equilibrium_of(problem);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(position_of(found, "hinge"), 0.7, 1e-9);
  EXPECT_EQ(found.linear.stability, Stability::kStable) << found.linear.verdict;
}

// Above i < 1.3 (20 + m g l cos)/0.6 it is unstable, by Routh.
TEST(Equilibrium, TooMuchOfAnIntegralIsUnstable) {
  const double limit = 1.3 * (20.0 + kGravity * std::cos(0.7)) / 0.6;
  for (const double factor : {0.999, 1.001}) {
    const Equilibrium found = equilibrium_of(loaded(
        pendulum_urdf(), start_at(0.0,
                                  "controllers: {servo: {type: pid, input: hinge/position, output: "
                                  "hinge, setpoint: 0.7, gains: {p: 20, d: 1, i: " +
                                      std::to_string(factor * limit) + "}}}\n")));
    EXPECT_EQ(found.linear.stability, factor < 1.0 ? Stability::kStable : Stability::kUnstable);
  }
}

TEST(Equilibrium, AnIntegralMayNotSuffice) {
  const Equilibrium found = equilibrium_of(loaded(
      pendulum_urdf(),
      start_at(0.0,
               "controllers: {servo: {type: pid, input: hinge/position, output: "
               "hinge, setpoint: 0.7, gains: {p: 20, i: 4}, i_clamp: 2, antiwindup: true}}\n")));
  EXPECT_EQ(found.status.code, StatusCode::kNoEquilibrium);
  EXPECT_NE(found.status.cause.find("i_clamp allows 2"), std::string::npos) << found.status.cause;
  const Equilibrium moving = equilibrium_of(loaded(
      pendulum_urdf(), start_at(0.0,
                                "controllers: {servo: {type: pid, input: hinge/velocity, output: "
                                "hinge, setpoint: 3, gains: {p: 20, i: 4}}}\n")));
  EXPECT_EQ(moving.status.code, StatusCode::kNoEquilibrium);
  EXPECT_NE(moving.status.cause.find("the largest error left is 3"), std::string::npos)
      << moving.status.cause;
}

// A motion that is given rests where it starts; otherwise the bar would swing outwards.
TEST(Equilibrium, HoldsAMotionThatIsGiven) {
  std::string urdf = arm_urdf();
  const Equilibrium found =
      equilibrium_of(loaded(urdf,
                            "duration: 10\ninitial_state: {shoulder: {position: 0.3}}\n"
                            "motion: {shoulder: {velocity: 3.0}}\n"));
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(position_of(found, "shoulder"), 0.3, 1e-10);
  EXPECT_NEAR(position_of(found, "elbow"), -0.3, 1e-9) << "it hangs";
}

TEST(Equilibrium, RefusesPostures) {
  const std::string message =
      refused([] { equilibrium_of(loaded(pendulum_urdf(), "positions: {hinge: [0.1, 0.2]}\n")); });
  EXPECT_NE(message.find("an equilibrium is sought from one start"), std::string::npos) << message;
}

TEST(Equilibrium, EndsWhenCancelled) {
  const std::atomic<bool> cancel{true};
  const Problem problem = loaded(pendulum_urdf(), start_at(1.0));
  EXPECT_EQ(find_equilibrium(*system_of(problem), problem.parameters(), {}, &cancel).status.code,
            StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
