// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/turn_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "assembly/assembly.h"
#include "assembly/make_system.h"
#include "integration/turning_loops.h"

namespace codesign {
namespace {

/// A rotor whose bearing on the other side is a loop.
class FollowedRotor {
 public:
  explicit FollowedRotor(CoordinatesKind coordinates) {
    const RobotDescription robot = read_urdf({"test.urdf", rotor_with_slides()});
    Study study = read_study({"test.yaml",
                              "duration: 1.0\ngravity: [0, 0, 0]\nparameters: {k: {}}\nobjective: "
                              "{terminal: [{signal: pin/position}]}\n"},
                             robot);
    study.solver.coordinates = coordinates;
    system = make_system(robot, study);
    equations = std::make_unique<Equations<double>>(*system);
    equations->set_design(system->parameters());
    for (std::size_t p = 0; p < system->topology().pairs.size(); ++p)
      if (system->topology().pairs[p].is_loop) slot = system->layout().turn(static_cast<int>(p), 0);
  }

  State<double> at(double angle) const {
    State<double> state;
    state.resize(system->layout());
    const Layout& layout = system->layout();
    if (layout.has_forest()) state.q[layout.column(0)] = angle;
    for (int b = 0; !layout.has_forest() && b < layout.bodies; ++b)
      state.q.segment<4>(layout.column(b) + 3) << std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle),
          0.0;
    return state;
  }
  double reference(double from, double to) const {
    TurnFollower<double> follower(*system);
    State<double> a = at(from), b = at(to);
    a.turns[static_cast<std::size_t>(slot)] = from;
    follower.follow(a, equations.get(), &b);
    equations->track_turns(&b);
    return b.turns[static_cast<std::size_t>(slot)];
  }

  std::shared_ptr<const CompiledSystem> system;
  std::unique_ptr<Equations<double>> equations;
  int slot = -1;
};

// A motion that is given keeps the positions of its drives there.
TEST(TurnFollower, ReferencesOfTheForestStay) {
  const FollowedRotor rotor(CoordinatesKind::kJoint);
  ASSERT_GT(rotor.system->layout().drop_slot, 1) << "the tree's joint and the loop";
  State<double> state = rotor.at(0.3);
  std::iota(state.turns.begin(), state.turns.end(), 100.0);
  const std::vector<double> before(state.turns.begin(), state.turns.end());
  rotor.equations->track_turns(&state);
  const auto own = static_cast<std::size_t>(rotor.slot);
  EXPECT_NE(state.turns[own], before[own]);
  state.turns[own] = before[own];
  EXPECT_EQ(std::vector<double>(state.turns.begin(), state.turns.end()), before);
}

TEST(TurnFollower, CountsAnyNumberOfTurnsInJointCoordinates) {
  const FollowedRotor rotor(CoordinatesKind::kJoint);
  for (double to : {0.3, 1.7, 3.3, -3.3, 6.6, 40.0, -1234.5, 1e6})
    EXPECT_NEAR(rotor.reference(0.2, to), to, 1e-12 + 1e-9 * std::abs(to));
  EXPECT_NEAR(rotor.reference(3.1, 3.2), 3.2, 1e-12);
  EXPECT_NEAR(rotor.reference(-500.0, 500.0), 500.0, 1e-9);
}

// The Euler parameters of a turn and of two turns are the same; up to one turn they are not.
TEST(TurnFollower, CountsNearlyOneTurnInAbsoluteCoordinates) {
  const FollowedRotor rotor(CoordinatesKind::kAbsolute);
  for (double to : {0.3, 1.7, 3.3, -3.3, 5.5, -5.0})
    EXPECT_NEAR(rotor.reference(0.2, to), to, 1e-12);
}

TEST(TurnFollower, LeavesStatesThatAreNotFinite) {
  const FollowedRotor rotor(CoordinatesKind::kJoint);
  TurnFollower<double> follower(*rotor.system);
  for (double to :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    State<double> a = rotor.at(0.2), b = rotor.at(to);
    follower.follow(a, rotor.equations.get(), &b);
    EXPECT_EQ(b.turns.size(), a.turns.size());
  }
}

}  // namespace
}  // namespace codesign
