// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Loops that are held in the plane of their motion only, theory (23c).
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/count_equations.h"
#include "edited_text.h"
#include "integration/driven_slides.h"
#include "integration/planar_linkages.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr char kAccurate[] =
    "{method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-11}";

std::shared_ptr<const CompiledSystem> made(const std::string& urdf, const std::string& study,
                                           Warnings* warnings = nullptr) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study}, robot), warnings);
}

/// Signals at some instants of a run.
std::vector<std::vector<double>> run(const std::string& urdf, const std::string& study,
                                     const std::vector<std::string>& signals) {
  std::vector<std::vector<double>> all;
  const auto system = made(urdf, study);
  Simulation simulation = simulation_of(system, system->parameters(), parsed_signals(signals));
  const Status status = simulate(&simulation, system->study().duration, 6, [&](const Frame& frame) {
    all.push_back(frame.signals);
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(all.size(), 6U);
  return all;
}

void expect_same(const std::vector<std::vector<double>>& a,
                 const std::vector<std::vector<double>>& b, double tolerance,
                 const std::vector<std::string>& names) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t time = 0; time < a.size(); ++time)
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_NEAR(a[time][k], b[time][k], tolerance * (1.0 + std::abs(b[time][k])))
          << names[k] << " at sample " << time;
}

struct Linkage {
  const char* name;
  std::string urdf, initial;
  std::vector<std::string> joints;  ///< the loop last
};

std::vector<Linkage> linkages() {
  return {{"revolute",
           four_bar(),
           "{left_hinge: {position: 0.6, velocity: 1.0}}",
           {"left_hinge", "right_hinge", "left_pin", "right_pin"}},
          {"prismatic",
           block_on_a_loop(),
           block_start(),
           {"crank_joint", "rod_joint", "block_joint", "slide"}},
          {"fixed",
           welded_four_bar(),
           welded_start(),
           {"left_hinge", "right_hinge", "left_pin", "right_pin", "weld"}}};
}

TEST(PlanarLoops, MotionsAndReactionsInThePlaneAreThoseOfSharedLoops) {
  for (const Linkage& linkage : linkages()) {
    std::vector<std::string> signals;
    for (const std::string& joint : linkage.joints)
      for (const char* part : {"/reaction_force/x", "/reaction_force/z", "/reaction_torque/y"})
        signals.push_back(joint + part);
    signals.push_back(linkage.joints[0] + "/position");
    signals.push_back("mechanism/kinetic_energy");
    const std::string study =
        motion_study(0.8, linkage.initial, linkage.joints[0] + "/velocity", kAccurate);
    expect_same(run(held_in_plane(linkage.urdf), study, signals), run(linkage.urdf, study, signals),
                2e-8, signals);
    if (HasFailure()) FAIL() << linkage.name;
  }
}

TEST(PlanarLoops, TheLoopCarriesNothingOutOfThePlane) {
  for (const Linkage& linkage : linkages()) {
    std::vector<std::string> signals;
    for (const char* part : {"/reaction_force/y", "/reaction_torque/x", "/reaction_torque/z"})
      signals.push_back(linkage.joints.back() + part);
    const std::string study =
        motion_study(0.3, linkage.initial, linkage.joints[0] + "/velocity", kAccurate) +
        "gravity: [0, 3, -9.81]\n";
    for (const auto& at : run(held_in_plane(linkage.urdf), study, signals))
      for (double reaction : at) EXPECT_NEAR(reaction, 0.0, 1e-12) << linkage.name;
  }
}

TEST(PlanarLoops, NothingIsRedundantAndJointCoordinatesSuffice) {
  const char* const start = "{left_hinge: {position: 0.6, velocity: 1.0}}";
  const std::string study = motion_study(0.3, start, "left_hinge/velocity", "{}");
  for (const bool held : {false, true}) {
    Warnings warnings;
    const std::string urdf = four_bar(pin_friction());
    const auto system = made(held ? held_in_plane(urdf) : urdf, study, &warnings);
    Status status;
    const Counts counts = count_equations(*system, {}, &status);
    ASSERT_TRUE(status.ok()) << status.cause;
    EXPECT_EQ(counts.degrees_of_freedom, 1);
    EXPECT_EQ(counts.redundant_constraints, held ? 0 : 3);
    EXPECT_EQ(counts.in_joint_coordinates, held);
    EXPECT_EQ(counts.solved_coordinates, held ? 3 : 21);
    EXPECT_EQ(counts.solved_constraints, held ? 2 : 23);
    EXPECT_EQ(warnings.size(), held ? 0U : 1U);
    EXPECT_EQ(system->sharing().pairs.size(), held ? 0U : 4U);
  }
}

// At rest, with half of the coupler's weight on the loop: forces and moments by hand.
TEST(PlanarLoops, TheTreeCarriesWhatActsOutOfThePlane) {
  constexpr double kBar = 1.0, kCoupler = 2.0, kAcross = 3.0, kDown = 9.81, kCentre = 0.1,
                   kPin = 0.04;
  const std::string study =
      motion_study(1.0, "{left_hinge: {position: 0.0}, right_hinge: {guess: 0.0}}",
                   "left_hinge/velocity", "{}") +
      "gravity: [0, 3, -9.81]\n";
  std::vector<std::string> signals;
  for (const char* joint : {"left_pin", "left_hinge", "right_hinge", "right_pin"})
    for (const char* part : {"force", "torque"})
      for (const char* axis : {"x", "y", "z"})
        signals.push_back(std::string(joint) + "/reaction_" + part + "/" + axis);
  const double weight = kCoupler * kDown, all = kBar + kCoupler;
  // On the coupler at its left pin, with its weight at (0.6, c, 0) and the loop's force at
  // (1.2, e, 0).
  const double roll = weight * (kCentre - 0.5 * kPin), yaw = -0.6 * kCoupler * kAcross;
  const std::vector<double> expected = {
      // left_pin
      0.0, -kCoupler * kAcross, 0.5 * weight, roll, 0.0, yaw,
      // left_hinge, 1 m above: the bar's weight acts in the middle
      0.0, -all * kAcross, kBar * kDown + 0.5 * weight, roll - (0.5 * kBar + kCoupler) * kAcross,
      0.0, yaw,
      // right_hinge
      0.0, -kBar * kAcross, kBar * kDown + 0.5 * weight, -0.5 * kBar * kAcross, 0.0, 0.0,
      // the loop
      0.0, 0.0, 0.5 * weight, 0.0, 0.0, 0.0};
  for (const char* coordinates : {"joint", "absolute"}) {
    const std::string chosen = replaced_all(
        study, "solver: \\{\\}", std::string("solver: {coordinates: ") + coordinates + "}");
    const auto found = run(held_in_plane(offset_four_bar(kCentre, kPin)), chosen, signals);
    for (std::size_t k = 0; k < signals.size(); ++k)
      EXPECT_NEAR(found[0][k], expected[k], 1e-9) << signals[k] << " in " << coordinates;
  }
}

TEST(PlanarLoops, FrictionIsThatOfSharedLoopsWhereNothingActsOutOfThePlane) {
  const std::string ring =
      replaced_all(four_bar(pin_friction()), "</loop>", std::string(pin_friction()) + "</loop>");
  const std::vector<std::string> of_ring = {"left_hinge/friction", "right_pin/friction",
                                            "right_pin/normal_force", "left_hinge/position"},
                                 of_block = {"slide/friction", "slide/normal_force",
                                             "crank_joint/position"};
  const std::string swing = motion_study(0.5, "{left_hinge: {position: 0.6, velocity: 1.0}}",
                                         "left_hinge/velocity", kAccurate),
                    turn = motion_study(0.5, block_start(), "crank_joint/velocity", kAccurate);
  expect_same(run(held_in_plane(ring), swing, of_ring), run(ring, swing, of_ring), 1e-7, of_ring);
  const std::string block = block_on_a_loop(slide_friction());
  expect_same(run(held_in_plane(block), turn, of_block), run(block, turn, of_block), 1e-7,
              of_block);
}

/// The block on a loop with three numbers to tune.
std::string gradient_study(const std::string& coordinates, const std::string& gradient,
                           const std::string& relative, const std::string& absolute) {
  return std::string("duration: 0.3\ninitial_state: ") + block_start() +
         "\nparameters: {mass: {}, crank: {}, pitch: {}}\nobjective: {integral: [{signal: "
         "slide/friction, weight: 0.01}, {signal: crank_joint/velocity}], terminal: [{signal: "
         "rod_joint/reaction_force/x, weight: 0.01}]}\nsolver: {coordinates: " +
         coordinates + ", gradient: " + gradient +
         ", method: rodas5p, relative_tolerance: " + relative +
         ", absolute_tolerance: " + absolute + "}\n";
}

TEST(PlanarLoops, GradientsAreExact) {
  const std::string urdf = held_in_plane(block_on_a_loop(slide_friction()));
  for (const char* coordinates : {"joint", "absolute"})
    for (const char* gradient : {"direct", "adjoint"}) {
      const auto system = made(urdf, gradient_study(coordinates, gradient, "1.0e-7", "1.0e-8"));
      const Eigen::Vector3d rho(1.0, 0.3, 1.3);
      const GradientCheck check = check_gradient(system, rho, CheckMethod::kComplexStep);
      ASSERT_TRUE(check.status.ok()) << check.status.cause;
      EXPECT_LT(check.largest_relative_difference, 1e-8) << coordinates << ' ' << gradient;
      for (int k = 0; k < 3; ++k) EXPECT_GT(std::abs(check.evaluation.gradient[k]), 1e-6) << k;
    }
}

TEST(PlanarLoops, GradientsAreThoseOfIndependentRuns) {
  const std::string urdf = held_in_plane(block_on_a_loop(slide_friction()));
  for (const char* coordinates : {"joint", "absolute"}) {
    const auto system = made(urdf, gradient_study(coordinates, "direct", "1.0e-12", "1.0e-13"));
    const GradientCheck check =
        check_gradient(system, Eigen::Vector3d(1.0, 0.3, 1.3), CheckMethod::kRidders);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-8) << coordinates;
  }
}

TEST(PlanarLoops, ADesignThatLeavesThePlaneHasNoValue) {
  std::string urdf = held_in_plane(four_bar());
  urdf.replace(urdf.find("<axis xyz='0 1 0'/>"), 19,
               "<axis xyz='0 1 0' codesign:xyz='${tilt} 1 0'/>");
  urdf.insert(urdf.find("<link "), "<codesign:parameter name='tilt' value='0'/>");
  const auto system =
      made(urdf,
           "duration: 0.1\ninitial_state: {left_hinge: {position: 0.5}}\nparameters: {tilt: "
           "{}}\nobjective: {integral: [{signal: left_hinge/velocity}]}\n");
  Evaluator evaluator = evaluator_of(system);
  EXPECT_TRUE(evaluator.evaluate(Eigen::VectorXd::Zero(1), false).status.ok());
  const Status status = evaluator.evaluate(Eigen::VectorXd::Constant(1, 0.1), false).status;
  EXPECT_EQ(status.code, StatusCode::kInvalidDesign);
  EXPECT_NE(status.cause.find("joint 'left_hinge' turns about an axis that is not normal"),
            std::string::npos)
      << status.cause;
}

TEST(PlanarLoops, PosturesAreThoseOfSharedLoops) {
  const std::string study =
      "positions: {crank_joint: [0.9, 1.2, 1.5]}\ninitial_state: {rod_joint: {guess: -0.9}}\n"
      "parameters: {crank: {}, pitch: {}}\nobjective: {sum: [{signal: block/position/x}, {signal: "
      "slide/reaction_force/x, weight: 0.01}]}\n";
  const auto evaluated = [&study](const std::string& urdf) {
    return evaluator_of(made(urdf, study)).evaluate(Eigen::Vector2d(0.3, 1.3), true);
  };
  const Evaluation held = evaluated(held_in_plane(block_on_a_loop())),
                   shared = evaluated(block_on_a_loop());
  ASSERT_TRUE(held.status.ok()) << held.status.cause;
  ASSERT_TRUE(shared.status.ok()) << shared.status.cause;
  EXPECT_NEAR(held.objective, shared.objective, 1e-7 * shared.objective);
  EXPECT_LT((held.gradient - shared.gradient).norm(), 1e-6 * shared.gradient.norm());
}

TEST(PlanarLoops, IdasGivesThemAMotion) {
  const std::string study =
      "duration: 0.4\ninitial_state: {left_hinge: {position: 0.5}, right_hinge: {guess: 0.5}}\n"
      "motion: {left_hinge: {velocity: {type: sine, amplitude: 1.0, frequency: 1.0}}}\n"
      "objective: {integral: [{signal: left_hinge/velocity}]}\nsolver: {integrator: ";
  const std::vector<std::string> signals = {"left_hinge/effort", "coupler/position/x"};
  const std::string urdf = held_in_plane(four_bar());
  expect_same(run(urdf, study + "idas, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n",
                  signals),
              run(urdf,
                  study + "rosenbrock, relative_tolerance: 1.0e-10, absolute_tolerance: "
                          "1.0e-10}\n",
                  signals),
              1e-5, signals);
}

}  // namespace
}  // namespace codesign
