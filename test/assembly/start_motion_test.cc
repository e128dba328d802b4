// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// The parallelogram four_bar() folded flat, where it may also turn as an antiparallelogram.
struct FlatFourBar {
  LoopsToClose c{four_bar(), "{left_hinge: {position: 1.5707963267948966}}"};
  SingularStart singular{c.compiled.system, c.loops.tree, c.loops.jacobian};
  Posture posture = c.at({0.5 * M_PI, 0.5 * M_PI, -0.5 * M_PI});
  Warnings warnings;

  Status choose(double left, double right, bool both_given) {
    posture.rate << left, right, -left;
    posture.given.velocity = {true, both_given, false};
    return choose_motion(c.loops, c.design, &posture, &singular, &warnings);
  }
};

TEST(StartMotion, KeepsRatesOfAMotion) {
  FlatFourBar flat;
  EXPECT_TRUE(flat.choose(2.0, 2.0, true).ok());
  EXPECT_EQ(flat.posture.rate, Eigen::Vector3d(2.0, 2.0, -2.0));
  EXPECT_TRUE(flat.warnings.empty());
}

TEST(StartMotion, RefusesRatesOfNone) {
  FlatFourBar flat;
  const Status status = flat.choose(2.0, 1.0, true);
  EXPECT_EQ(status.code, StatusCode::kSingularConfiguration);
  EXPECT_NE(status.cause.find("'left_hinge', 'right_hinge', 'left_pin'"), std::string::npos)
      << status.cause;
}

TEST(StartMotion, FromRestTheAccelerationsDecide) {
  FlatFourBar flat;
  ASSERT_TRUE(flat.choose(0.0, 0.0, false).ok());
  State<double> state;
  state.resize(flat.c.compiled.system.layout());
  state.z.setZero();
  EXPECT_TRUE(require_motion(flat.c.loops, flat.posture, state, &flat.singular).ok());
  // The left bar alone begins to turn.
  state.z[0] = 0.0;
  state.z[2] = 0.5;
  state.z[3 + 1] = 0.5 * std::sin(0.25 * M_PI);
  state.z[3 + 3] = 0.5;
  const Status moved = require_motion(flat.c.loops, flat.posture, state, &flat.singular);
  EXPECT_EQ(moved.code, StatusCode::kSingularConfiguration) << moved.cause;
  // Not where the start moves.
  flat.posture.rate << 2.0, 2.0, -2.0;
  EXPECT_TRUE(require_motion(flat.c.loops, flat.posture, state, &flat.singular).ok());
}

}  // namespace
}  // namespace codesign
