// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Motions and designs for which EffortModel finds no efforts.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "cases/shipped.h"
#include "equations/compiled.h"
#include "identification/effort/effort_model.h"
#include "identification/recorded_motion.h"

namespace codesign {
namespace {

TEST(EffortModel, AnImpossibleMotionIsAStatusThatNamesTheSample) {
  const Shipped shipped("slider_crank");
  const auto system = make_system(shipped.robot, shipped.study, nullptr);
  MotionSamples motion = record_motion(*system, {"crank_joint"}, 20, 0.01).motion;
  motion.position(0, 7) = std::nan("");
  EffortModel model(*system, measured({"crank_joint"}), motion);
  const Status status = model.begin(system->parameters());
  EXPECT_EQ(status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(status.cause.find("sample 7"), std::string::npos) << status.cause;
}

TEST(EffortModel, AnImpossibleDesignIsAStatus) {
  const Shipped shipped("slider_crank");
  const auto system = make_system(shipped.robot, shipped.study, nullptr);
  EffortModel model(*system, measured({"crank_joint"}), swing(70, 0.2, 0.4), 2);
  Eigen::MatrixXd efforts;
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  const auto with_crank = [&](double length) {
    std::vector<double> parameters = system->parameters();
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (system->study().parameters[k].name == "crank_length") parameters[k] = length;
    return model.evaluate(parameters, &efforts, nullptr);
  };
  EXPECT_EQ(with_crank(-0.1).code, StatusCode::kInvalidDesign);
  const Status too_long = with_crank(1.5);
  EXPECT_EQ(too_long.code, StatusCode::kAssemblyFailed);
  EXPECT_EQ(too_long.cause.find("sample "), 0u) << too_long.cause;
  EXPECT_TRUE(with_crank(0.09).ok());
}

TEST(EffortModel, ObeysACancel) {
  const auto system = compiled(pendulum(), let_go("{}", "hinge/velocity"));
  EffortModel model(*system, measured({"hinge"}), swing(100, 1.0));
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  const std::atomic<bool> cancel{true};
  model.obey(&cancel);
  Eigen::MatrixXd efforts;
  EXPECT_EQ(model.evaluate(system->parameters(), &efforts, nullptr).code, StatusCode::kCancelled);
  EXPECT_EQ(model.begin(system->parameters()).code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
