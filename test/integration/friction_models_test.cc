// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Whole simulations under the friction laws with states: properties that they share with Brown and
// McPhee's law, and properties that only they have.
#include <gtest/gtest.h>

#include <tuple>

#include "assembly/make_system.h"
#include "description/study.h"
#include "edited_text.h"
#include "integration/mechanisms.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

const char* const kLooseRosenbrock =
    "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-8, absolute_tolerance: "
    "1.0e-9}";
const char* const kLooseIdas =
    "{integrator: idas, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}";

/// A block of 2 kg on a plane inclined by `slope` about y; x'' points downhill.
std::string block(double slope) {
  return robot(
      "<link name='block'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' "
      "iyy='0.01' iyz='0' izz='0.02'/></inertial></link>"
      "<joint name='plane' type='planar'><parent link='ground'/><child link='block'/><origin "
      "rpy='0 " +
      std::to_string(slope) +
      " 0'/><axis xyz='0 0 1'/><codesign:friction mu_static='0.4' mu_dynamic='0.3' "
      "transition_velocity='0.01'/></joint>");
}

struct Series {
  std::vector<std::vector<double>> frames;
  Status status;
};

Series run(const std::string& urdf, double duration, const std::string& initial,
           const std::vector<std::string>& names, const char* solver, int count = 11) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study(
      {"test.yaml", motion_study(duration, initial, names.front(), solver)}, description);
  std::vector<SignalDescription> signals;
  for (const std::string& name : names)
    signals.push_back(parse_signal(name, {"test", 0}, "signal"));
  Simulation simulation = simulation_of(make_system(description, study), {}, signals);
  Series series;
  series.status = simulate(&simulation, duration, count, [&](const Frame& frame) {
    series.frames.push_back(frame.signals);
    return true;
  });
  return series;
}

TEST(FrictionModels, SlidingSteadilyTheyAgree) {
  // Downhill at 0.6 rad against mu_d = 0.3: the acceleration is g (sin - 0.3 cos), whatever the
  // model.
  const double acceleration = 9.81 * (std::sin(0.6) - 0.3 * std::cos(0.6)),
               N = 2.0 * 9.81 * std::cos(0.6);
  for (const char* model : {"brown_mcphee", "gonthier", "lugre"}) {
    const Series s = run(with_friction_model(block(0.6), model), 1.0, "{}",
                         {"plane/sliding_velocity", "plane/friction"}, kLooseRosenbrock, 3);
    ASSERT_TRUE(s.status.ok()) << model << ": " << s.status.cause;
    EXPECT_NEAR(s.frames[2][0] - s.frames[1][0], 0.5 * acceleration, 1e-6) << model;
    EXPECT_NEAR(s.frames[2][1], -0.3 * N, 1e-5 * N) << model;
  }
}

TEST(FrictionModels, BristlesHoldWhereASmoothCurveCreeps) {
  // tan(0.25) = 0.255 is below mu_d. A smooth curve holds the block only while it moves; bristles
  // hold it at rest.
  const Series creeping = run(with_friction_model(block(0.25), "brown_mcphee"), 2.0, "{}",
                              {"plane/sliding_velocity", "plane/friction"}, kLooseRosenbrock, 3);
  ASSERT_TRUE(creeping.status.ok());
  EXPECT_GT(creeping.frames[2][0], 1e-3);
  for (const char* model : {"gonthier", "lugre"}) {
    const Series held = run(with_friction_model(block(0.25), model), 2.0, "{}",
                            {"plane/sliding_velocity", "plane/friction"}, kLooseRosenbrock, 3);
    ASSERT_TRUE(held.status.ok()) << model << ": " << held.status.cause;
    EXPECT_LT(held.frames[2][0], 2e-6) << model;
    EXPECT_NEAR(held.frames[2][1], -2.0 * 9.81 * std::sin(0.25), 1e-4) << model;
  }
}

TEST(FrictionModels, GonthiersContactMustRestToHold) {
  // tan(0.33) = 0.343 lies between mu_d and mu_s: it slips at once, when it has not rested yet.
  // LuGre's has no memory of that and holds, if it is damped enough not to overshoot.
  const std::string damped = replaced_all(
      block(0.33), "mu_static", "bristle_stiffness='1e5' bristle_damping='150' mu_static");
  const Series slips = run(with_friction_model(damped, "gonthier"), 1.0, "{}",
                           {"plane/sliding_velocity"}, kLooseRosenbrock, 2);
  const Series holds = run(with_friction_model(damped, "lugre"), 1.0, "{}",
                           {"plane/sliding_velocity"}, kLooseRosenbrock, 2);
  ASSERT_TRUE(slips.status.ok() && holds.status.ok());
  EXPECT_NEAR(slips.frames[1][0], 9.81 * (std::sin(0.33) - 0.3 * std::cos(0.33)), 0.05);
  EXPECT_LT(holds.frames[1][0], 1e-3);
}

TEST(FrictionModels, AStuckStartDoesNotGiveWay) {
  for (const char* model : {"gonthier", "lugre"})
    for (const char* solver : {kLooseRosenbrock, kLooseIdas}) {
      const Series held =
          run(with_friction_model(block(0.33), model), 2.0, "{plane: {stuck: true}}",
              {"plane/sliding_velocity", "block/position/x", "plane/friction"}, solver, 3);
      ASSERT_TRUE(held.status.ok()) << model << ": " << held.status.cause;
      EXPECT_LT(std::abs(held.frames[2][0]), 1e-12) << model;
      EXPECT_LT(std::abs(held.frames[2][1]), 1e-12) << model;
      EXPECT_NEAR(held.frames[2][2], -2.0 * 9.81 * std::sin(0.33), 1e-8) << model;
    }
}

TEST(FrictionModels, BothIntegratorsAgree) {
  for (const char* model : {"gonthier", "lugre"}) {
    for (const auto& [urdf, initial, signal] :
         {std::tuple<std::string, std::string, std::string>{
              double_pendulum(pin_friction()), "{shoulder: {position: 1.5}}", "elbow/position"},
          {puck(), "{}", "puck/position/x"},
          {ball_pendulum(), "{ball_x: {position: 1.0}, ball_z: {velocity: 8.0}}",
           "bar/angular_velocity/x"}}) {
      const Series a = run(with_friction_model(urdf, model), 0.6, initial, {signal},
                           kLooseRosenbrock),
                   b = run(with_friction_model(urdf, model), 0.6, initial, {signal}, kLooseIdas);
      ASSERT_TRUE(a.status.ok() && b.status.ok())
          << model << " " << signal << " " << a.status.cause << b.status.cause;
      for (std::size_t k = 0; k < a.frames.size(); ++k)
        EXPECT_NEAR(a.frames[k][0], b.frames[k][0], 2e-6) << model << " " << signal << " " << k;
    }
  }
}

}  // namespace
}  // namespace codesign
