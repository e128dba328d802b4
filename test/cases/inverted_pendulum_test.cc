// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// References: an independent solution of the same data at tolerances down to 1e-12 (psi converged
// to 1e-13 relative).
#include <algorithm>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/simulation.h"
#include "optimization/search_hooks.h"

namespace codesign {
namespace {

TEST(InvertedPendulum, CountsAreThePapers) {
  expect_counts(Shipped("inverted_pendulum"), {14, 28, 5, 9, 37, 3, 111, 148});
  expect_counts(Shipped("inverted_pendulum_frictionless"), {14, 28, 5, 9, 37, 3, 111, 148});
}

TEST(InvertedPendulum, ObjectiveAndGradientMeetTheReference) {
  expect_reference(Shipped("inverted_pendulum"), 8249.6225551550, 1e-8,
                   {15.8380455957, 2.0142948764, -301.6258782391}, 1e-7);
  expect_reference(Shipped("inverted_pendulum_frictionless"), 14494.3670139029, 1e-8,
                   {28.3792394324, 13.1506317687, -1614.4194428180}, 1e-7);
}

TEST(InvertedPendulum, SeriesMeetTheReference) {
  expect_series(
      Shipped("inverted_pendulum"),
      {{"plate/position/x",
        {0.39692012978584557, 0.5784779422403677, 0.8381889419770324, 1.1825094688044484},
        1.182509},
       {"plate/position/y",
        {0.22916194377864016, 0.3339843956727365, 0.483928611282217, 0.6827221601335526},
        0.682722},
       {"plate_x/velocity",
        {-0.00454753321606647, 0.17677665641004844, 0.4509047741501974, 0.649900914837519},
        5.160882},
       {"plate_y/velocity",
        {-0.002625519526443842, 0.10206205016479618, 0.26032999273451524, 0.375220468128055},
        2.979637},
       {"rod_centre/position/x",
        {0.46315715057765233, 0.6192076752019479, 0.8693098571302519, 1.2064526115893144},
        0.97221},
       {"rod_centre/position/z",
        {0.6605870188215183, 0.6633348464165776, 0.6640283514429448, 0.6644250405812869},
        0.057492},
       {"servo_x/error",
        {0.06623702079180677, 0.04072973296158011, 0.031120915153219464, 0.02394314278486598},
        0.384398},
       {"servo_x/integral",
        {0.0026881055354225545, 0.016061748046295232, 0.02841349541263639, 0.038634698677956054},
        0.039859},
       {"servo_x/output",
        {51.27379799231304, 34.979825898017026, 29.56800143729299, 25.871714842813027},
        285.864574},
       {"servo_y/output",
        {29.602941073236433, 20.195611898428606, 17.071093589221412, 14.937041528895763},
        165.043989},
       {"plate_x/normal_force",
        {80.40420668037794, 71.5438009258298, 71.12738211553861, 70.88398799482367},
        108.563327},
       {"plate_x/friction",
        {-29.704557977053465, -21.476407429729797, -21.339019148471273, -21.26546447325049},
        34.069662},
       {"plate_x/sliding_velocity",
        {0.0052510390528890324, 0.20412410032957326, 0.5206599854690135, 0.7504409362560659},
        4.120088}});
  expect_series(
      Shipped("inverted_pendulum_frictionless"),
      {{"plate/position/x",
        {0.22822330704906227, 0.3724649656252725, 0.4775270531117701, 0.5610065401947149},
        0.693749},
       {"plate/position/y",
        {0.1317647877601239, 0.21504274816745783, 0.27570037265941205, 0.3238972769985658},
        0.400536},
       {"plate_x/velocity",
        {-0.42759267365634585, -0.16828856566895836, 0.05661535417409545, 0.16251908270942103},
        6.610334},
       {"plate_y/velocity",
        {-0.24687074523900096, -0.0971614486905056, 0.03268688997268946, 0.09383043615074269},
        3.816478},
       {"rod_centre/position/x",
        {0.37062507084090085, 0.46010398176744205, 0.5315162002429095, 0.5934263262590582},
        0.368528},
       {"rod_centre/position/z",
        {0.6443503060385435, 0.6572550523195012, 0.6620714180932973, 0.663945487191574},
        0.057491},
       {"servo_x/error",
        {0.14240176379183858, 0.08763901614216957, 0.05398914713113939, 0.03241978606434337},
        0.421304},
       {"servo_x/integral",
        {-0.0015162680147046907, 0.0001638928383509322, 0.001352321425960661, 0.001825904073904475},
        0.034416},
       {"servo_x/output",
        {109.69781917395112, 67.46292710025723, 40.965518162818135, 24.148400060063626},
        315.051779},
       {"servo_y/output",
        {63.33406542959556, 38.94973912165355, 23.651452938795494, 13.94208527517611},
        181.89523}});
}

TEST(InvertedPendulum, FrictionIsAForceAgainstTheSlip) {
  const Shipped shipped("inverted_pendulum");
  Simulation simulation =
      simulation_of(make_system(shipped.robot, shipped.study), shipped.parameters());
  ASSERT_EQ(simulation.names().frictions, std::vector<std::string>{"plate_x"});
  EXPECT_FALSE(simulation.names().friction_is_torque[0]);
  double work = 0.0;
  const Status status = simulate(&simulation, 0.5, 6, [&](const Frame& frame) {
    const FrictionSample& sample = frame.frictions[0];
    const Eigen::Vector3d velocity(frame.joints[0].velocity, frame.joints[1].velocity, 0.0);
    EXPECT_EQ(simulation.names().joints[1], "plate_y");
    EXPECT_NEAR(sample.sliding_velocity, velocity.norm(), 1e-12);
    EXPECT_NEAR(sample.force.dot(velocity), sample.friction * sample.sliding_velocity, 1e-9);
    EXPECT_NEAR(sample.force.norm(), -sample.friction, 1e-9);
    EXPECT_EQ(sample.torque.norm(), 0.0);
    work += sample.force.dot(velocity);
    return true;
  });
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_LT(work, -1.0);
}

void expect_tuned(const std::string& name, double objective, const Eigen::Vector3d& optimum) {
  Shipped shipped(name);
  // Looser tolerances than shipped, to save time: the optimum is compared to 2 %.
  shipped.study.solver.relative_tolerance = 1e-7;
  shipped.study.solver.absolute_tolerance = 1e-8;
  const OptimizationResult result =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.best.objective, objective);
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_NEAR(result.best.rho[k], optimum[k], 0.02 * optimum[k] + 1.0) << k;
  // The gradient at the start is ten thousand times the variables' unit: without scaling, the first
  // step of the search would end where the pendulum falls.
  EXPECT_EQ(result.cost.failed_evaluations, 0);
  EXPECT_LE(result.cost.evaluations, 80);
}

TEST(InvertedPendulum, TunesToTheBestKnownGains) {
  expect_tuned("inverted_pendulum", 3119.15, {546.115, 623.979, 90.071});
  expect_tuned("inverted_pendulum_frictionless", 1808.9, {427.73, 1.11, 65.22});
}

}  // namespace
}  // namespace codesign
