// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/motion_limits.h"

#include <gtest/gtest.h>

#include "excitation/excited_cases.h"

namespace codesign {
namespace {

using Kind = LimitedSignal::Kind;

InputFault fault_of(const Problem& problem) {
  try {
    motion_limits(problem);
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(MotionLimits, TheNarrowerOfModelAndStudyCount) {
  const MotionLimits limits = motion_limits(arm(""));
  ASSERT_EQ(limits.joints.size(), 2U);
  EXPECT_EQ(limits.find(0, Kind::kPosition)->lower, -1.5);
  EXPECT_EQ(limits.find(0, Kind::kPosition)->upper, 2.0);
  EXPECT_EQ(limits.find(0, Kind::kAcceleration)->upper, 15.0);
  EXPECT_EQ(limits.find(0, Kind::kEffort)->lower, -25.0);
  EXPECT_EQ(limits.find(1, Kind::kEffort)->upper, 9.0);
  EXPECT_EQ(limits.find(1, Kind::kAcceleration), nullptr);
  EXPECT_EQ(limits.noise[1], 0.2);
  EXPECT_EQ(limits.signals.front().name, "shoulder/position");
  EXPECT_DOUBLE_EQ(limits.signals.front().relative(2.0), 1.0);
  EXPECT_DOUBLE_EQ(limits.signals.front().relative(0.25), 0.0);
}

TEST(MotionLimits, JointsThatFollowKeepTheirs) {
  const MotionLimits limits = motion_limits(slider_crank(""));
  ASSERT_EQ(limits.followers.size(), 1U);
  EXPECT_EQ(limits.followers[0].name, "slider_joint");
  int found = 0;
  for (const LimitedSignal& signal : limits.signals) {
    if (!signal.is_follower) continue;
    ++found;
    if (signal.kind == Kind::kPosition) {
      EXPECT_EQ(signal.upper, 0.27);
    } else {
      EXPECT_EQ(signal.upper, 0.4);
    }
  }
  EXPECT_EQ(found, 2);
}

TEST(MotionLimits, RefusesWhatLeavesNoMotion) {
  const auto excite = [](const std::string& keys) {
    return load_problem({"pendulum.urdf", pendulum_urdf()}, {},
                        {"study.yaml", "identify: {}\nexcite: {noise: 1, joints: {hinge: {" + keys +
                                           "}}}\nparameters: {mass: {}}\n"});
  };
  const InputFault fault = fault_of(excite("position: [1.3, 2.0]"));
  EXPECT_EQ(fault.element, "excite.joints.hinge");
  EXPECT_EQ(fault.where.line, 2);
  std::string urdf = pendulum_urdf();
  const std::string limit = R"(<limit lower="-1.2" upper="1.2" velocity="4" effort="14"/>)";
  urdf.replace(urdf.find(limit), limit.size(),
               R"(<limit lower="-1.2" upper="1.2" velocity="0" effort="14"/>)");
  const InputFault still = fault_of(load_problem(
      {"pendulum.urdf", urdf}, {},
      {"study.yaml",
       "identify: {}\nexcite: {noise: 1, joints: {hinge: {}}}\nparameters: {mass: {}}\n"}));
  EXPECT_NE(still.message.find("velocity"), std::string::npos) << still.message;
}

}  // namespace
}  // namespace codesign
