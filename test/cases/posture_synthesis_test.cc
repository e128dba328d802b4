// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Synthesis by postures against closed forms: transmission angle, guidance, Grashof, workspace.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "integration/mechanisms.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/postures.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kPi = 3.141592653589793;
using Complex = std::complex<double>;

std::string parameter(const std::string& name, double value) {
  return "<codesign:parameter name='" + name + "' value='" + to_decimal(value) +
         "' lower='0.05' upper='3'/>";
}

/// A hinge about y at the end of a link whose length along -z is a parameter, `value` at first.
std::string hinge_at_end(const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& length, double value) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='0 0 " + to_decimal(-value) +
         "' codesign:xyz='0 0 ${-" + length + "}'/><axis xyz='0 1 0'/></joint>";
}

/// Crank a, coupler b and rocker c in a row, whose end is held by a pin of the ground 1 m from the
/// crank's. All hinges count from a stretched chain, so that the angle between coupler and rocker
/// is pi less than that of their joint.
std::string crank_rocker() {
  return robot(
      parameter("a", 0.2) + parameter("b", 0.9) + parameter("c", 0.7) + bar("crank") +
      bar("coupler") + bar("rocker") + "<link name='tip'/>" +
      hinge("crank_joint", "ground", "crank", "0 0 0") +
      hinge_at_end("coupler_joint", "crank", "coupler", "a", 0.2) +
      hinge_at_end("rocker_joint", "coupler", "rocker", "b", 0.9) +
      "<joint name='tip_joint' type='fixed'><parent link='crank'/><child link='tip'/><origin "
      "xyz='0 0 -0.2' codesign:xyz='0 0 ${-a}'/></joint>" +
      "<loop name='pivot' type='continuous' codesign:out_of_plane='zero'><predecessor "
      "link='ground'><origin xyz='0 0 -1'/></predecessor><successor link='rocker'><origin xyz='0 0 "
      "-0.7' codesign:xyz='0 0 ${-c}'/></successor><axis xyz='0 1 0'/></loop>");
}

Problem posed(const std::string& urdf, const std::string& study) {
  return load_problem({"linkage.urdf", urdf}, {}, {"study.yaml", study});
}

/// The transmission angle of a four-bar with pivots 1 m apart by the cosine law.
double transmission_angle(double a, double b, double c, double crank) {
  const double square = 1.0 + a * a - 2.0 * a * std::cos(crank);
  return std::acos((b * b + c * c - square) / (2.0 * b * c));
}

/// Signals in all postures.
std::vector<std::vector<double>> listed(const Problem& problem,
                                        const std::vector<std::string>& signals) {
  std::vector<std::vector<double>> rows;
  Simulation simulation(problem, problem.parameters(), signals);
  const Status status = simulate(&simulation, problem.duration(),
                                 static_cast<int>(problem.duration()) + 1, [&](const Frame& frame) {
                                   rows.push_back(frame.signals);
                                   return true;
                                 });
  EXPECT_TRUE(status.ok()) << status.cause;
  return rows;
}

const char* const kTurn =
    "positions: {crank_joint: {from: 0, to: \"${2*pi}\", count: 37}}\n"
    "initial_state: {coupler_joint: {guess: -1.2}, rocker_joint: {guess: 2.0}}\n";

TEST(TransmissionAngle, IsThatOfTheCosineLaw) {
  const auto rows = listed(posed(crank_rocker(), kTurn),
                           {"crank_joint/position", "${pi - abs(rocker_joint/position)}"});
  ASSERT_EQ(rows.size(), 37U);
  for (const std::vector<double>& row : rows)
    EXPECT_NEAR(row[1], transmission_angle(0.2, 0.9, 0.7, row[0]), 1e-10);
}

// With a crank a the worst angle is best for b = c = sqrt((1 + a^2)/2), where its cosine is
// 2 a/(1 + a^2): with 45 degrees at least, the longest crank is tan(pi/8).
TEST(TransmissionAngle, BoundsTheLongestCrank) {
  const Problem problem =
      posed(crank_rocker(), std::string(kTurn) +
                                "parameters: {a: {}, b: {}, c: {}}\n"
                                "objective: {stroke: [{signal: tip/position/z, weight: -1}]}\n"
                                "path: [{signal: rocker_joint/position, between: [\"${pi/4}\", "
                                "\"${3*pi/4}\"]}]\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double a = std::tan(kPi / 8.0), b = std::sqrt(0.5 * (1.0 + a * a));
  EXPECT_NEAR(result.best.objective, -2.0 * a, 1e-6);
  EXPECT_NEAR(result.best.rho[0], a, 1e-6);
  // The optimum is flat in their ratio.
  EXPECT_NEAR(result.best.rho[1], b, 1e-3);
  EXPECT_NEAR(result.best.rho[2], b, 1e-3);
  ASSERT_EQ(result.constraints.watched.size(), 2U);
  EXPECT_NEAR(result.constraints.watched[0].smallest, kPi / 4.0, 1e-6);
  EXPECT_NEAR(result.constraints.watched[0].largest, 3.0 * kPi / 4.0, 1e-6);
}

/// The centre of the circle through three points.
Complex centre(const Complex& p, const Complex& q, const Complex& r) {
  const Complex u = q - p, v = r - p;
  return p + (std::norm(u) * v - std::norm(v) * u) / (std::conj(u) * v - u * std::conj(v));
}

// Three poses of the coupler and both pins on it are given: the pivots are the centres of the
// circles through the three places of each pin.
TEST(Guidance, ThroughThreePosesHasThePivotsOfTheCircles) {
  const Complex place[] = {{0.0, 1.0}, {0.4, 1.2}, {0.9, 1.1}};
  const double angle[] = {0.3, 0.1, -0.3};
  const Complex pin(0.8, 0.0);
  Complex crank_pin[3], rocker_pin[3];
  for (int k = 0; k < 3; ++k) {
    crank_pin[k] = place[k];
    rocker_pin[k] = place[k] + std::polar(1.0, angle[k]) * pin;
  }
  const Complex first = centre(crank_pin[0], crank_pin[1], crank_pin[2]),
                second = centre(rocker_pin[0], rocker_pin[1], rocker_pin[2]);
  const auto numbers = [](double x, double y, double z) {
    return "[" + to_decimal(x) + ", " + to_decimal(y) + ", " + to_decimal(z) + "]";
  };
  const Problem problem = postures(
      "four_bar_path",
      "gravity: [0, 0, 0]\npositions: {crank_joint: [\"${t0}\", \"${t1}\", \"${t2}\"]}\n"
      "initial_state: {coupler_joint: {guess: -1.5}}\n"
      "parameters: {r1: {initial: 1.0}, r2: {initial: 1.0}, r3: {initial: 0.8, tune: false}, r4: "
      "{initial: 1.0}, pen_x: {initial: 0.0, tune: false}, pen_y: {initial: 0.0, tune: false}, "
      "pivot_x: {initial: 0.3}, pivot_y: {initial: 0.1}, frame_angle: {initial: 0.0}, t0: "
      "{initial: "
      "1.9, lower: -9, upper: 9}, t1: {initial: 1.5, lower: -9, upper: 9}, t2: {initial: 0.9, "
      "lower: -9, upper: 9}}\n"
      "objective: {sum: [{signal: pen/position/x, reference: " +
          numbers(place[0].real(), place[1].real(), place[2].real()) +
          "}, {signal: pen/position/y, reference: " +
          numbers(place[0].imag(), place[1].imag(), place[2].imag()) +
          "}, {signal: \"${frame_angle + crank_joint/position + coupler_joint/position}\", "
          "reference: " +
          numbers(angle[0], angle[1], angle[2]) +
          "}]}\noptimizer: {relative_tolerance: 1.0e-14, max_evaluations: 200}\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LT(result.best.objective, 1e-16);
  const std::vector<double> found = problem.parameters(result.best.rho);
  const auto at = [&](const std::string& name) {
    const auto& all = problem.all_parameters();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].name == name) return found[k];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(at("pivot_x"), first.real(), 1e-6);
  EXPECT_NEAR(at("pivot_y"), first.imag(), 1e-6);
  EXPECT_NEAR(at("r2"), std::abs(crank_pin[0] - first), 1e-6);
  EXPECT_NEAR(at("r4"), std::abs(rocker_pin[0] - second), 1e-6);
  EXPECT_NEAR(at("r1"), std::abs(second - first), 1e-6);
  EXPECT_NEAR(at("frame_angle"), std::arg(second - first), 1e-6);
}

// A crank that turns fully is at most b + c - 1 long; the postures would allow a longer one.
TEST(Grashof, IsActiveAtTheLongestCrank) {
  const Problem problem = posed(
      crank_rocker(),
      "positions: {crank_joint: {from: -2.5, to: 2.5, count: 9}}\n"
      "initial_state: {coupler_joint: {guess: -1.2}, rocker_joint: {guess: 2.0}}\n"
      "parameters: {a: {}, b: {upper: 0.9}, c: {upper: 0.5, initial: 0.45}}\n"
      "objective: {maximum: [{signal: \"${sqrt(tip/position/x^2 + tip/position/z^2)}\", weight: "
      "-1}]}\nconstraints: [\"b + c >= a + 1\", \"1 + c >= a + b\", \"1 + b >= a + c\"]\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.rho[0], 0.4, 1e-6);
  EXPECT_NEAR(result.best.rho[1], 0.9, 1e-6);
  EXPECT_NEAR(result.best.rho[2], 0.5, 1e-6);
  ASSERT_EQ(result.constraints.margins.size(), 3U);
  EXPECT_NEAR(result.constraints.margins[0], 0.0, 1e-6);
  EXPECT_GT(result.constraints.margins[1], 0.1);
}

/// An arm of two links a and b, with its tool at the end.
std::string two_links() {
  return robot(parameter("a", 0.8) + parameter("b", 0.4) + bar("upper") + bar("lower") +
               "<link name='tool'/>" + hinge("shoulder", "ground", "upper", "0 0 0") +
               hinge_at_end("elbow", "upper", "lower", "a", 0.8) +
               "<joint name='tool_joint' type='fixed'><parent link='lower'/><child "
               "link='tool'/><origin xyz='0 0 -0.4' codesign:xyz='0 0 ${-b}'/></joint>");
}

const char* const kGrid =
    "positions: {shoulder: [0, 0, 0, 1, 1, 1], elbow: [0.4, 1.4, 2.4, 0.4, 1.4, 2.4]}\n";

TEST(Workspace, ListsThePointsOfTheGrid) {
  const auto rows = listed(posed(two_links(), kGrid), {"shoulder/position", "elbow/position",
                                                       "tool/position/x", "tool/position/z"});
  ASSERT_EQ(rows.size(), 6U);
  for (const std::vector<double>& row : rows) {
    // About y, from -z: x = -l sin, z = -l cos.
    const Complex tip = 0.8 * std::polar(1.0, row[0]) + 0.4 * std::polar(1.0, row[0] + row[1]);
    EXPECT_NEAR(row[2], -tip.imag(), 1e-12);
    EXPECT_NEAR(row[3], -tip.real(), 1e-12);
  }
}

// The elbow bends up to 2.4 rad: r^2 = a^2 + b^2 + 2 a b cos 2.4 is least there.
TEST(Workspace, TheShortestArmThatKeepsItsDistance) {
  const Problem problem =
      posed(two_links(),
            std::string(kGrid) +
                "parameters: {a: {}}\nobjective: {sum: [{signal: tool/position/z}, {signal: "
                "tool/position/x}]}\npath: [{signal: \"${tool/position/x^2 + tool/position/z^2}\", "
                "at_least: 0.09}]\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double half = -0.4 * std::cos(2.4);
  EXPECT_NEAR(result.best.rho[0], half + std::sqrt(half * half - 0.16 + 0.09), 1e-6);
  EXPECT_NEAR(result.constraints.watched.at(0).smallest, 0.09, 1e-7);
}

}  // namespace
}  // namespace codesign
