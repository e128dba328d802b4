// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/finite_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

TEST(FiniteFrame, NamesWhatIsNot) {
  FrameNames names;
  names.joints = {"shoulder", "elbow"};
  names.frictions = {"elbow"};
  names.controllers = {"servo"};
  names.links = {"base", "arm"};
  Frame frame;
  frame.joints.resize(2);
  frame.frictions.resize(1);
  frame.controllers.resize(1);
  frame.links.resize(2);
  frame.signals = {1.0, 2.0};
  EXPECT_EQ(find_not_finite(names, frame), "");
  frame.signals[1] = std::nan("");
  EXPECT_EQ(find_not_finite(names, frame), "signal number 2 of the requested ones is not finite");
  frame.links[1].position[2] = HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "the pose of link \"arm\" is not finite");
  frame.controllers[0].output = -HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "controller \"servo\" is not finite");
  frame.frictions[0].force[0] = HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "the friction of joint \"elbow\" is not finite");
  frame.joints[1].effort = std::nan("");
  EXPECT_EQ(find_not_finite(names, frame), "the motion of joint \"elbow\" is not finite");
}

}  // namespace
}  // namespace codesign
