// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/best_record.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "reading/urdf/urdf_reader.h"
#include "ros/pendulum.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

class Best : public testing::Test {
 protected:
  Trial trial(int evaluation, int iteration, double objective, double length) const {
    Trial trial;
    trial.evaluation = evaluation;
    trial.iteration = iteration;
    trial.objective = objective;
    trial.rho = trial.gradient = Eigen::Vector2d(length, 1.0);
    return trial;
  }
  nlohmann::json on_disk() const { return nlohmann::json::parse(std::ifstream(prefix_ + "best.json")); }

  TemporaryDirectory directory_;
  std::string prefix_ = (directory_.path() / "stem.").string();
  Problem problem_ = pendulum();
  BestRecord record_{prefix_, problem_};
};

TEST_F(Best, HoldsThePointOfTheLastImprovement) {
  record_.note(trial(1, 0, 3.0, 0.5));
  EXPECT_EQ(on_disk()["objective"], 3.0);
  record_.note(trial(2, 1, 2.0, 0.6));
  record_.note(trial(3, 1, 2.5, 0.7));
  EXPECT_EQ(on_disk()["objective"], 2.0);
  EXPECT_EQ(on_disk()["initial_objective"], 3.0);
  EXPECT_EQ(on_disk()["parameters"]["length"], 0.6);
  EXPECT_EQ(on_disk()["initial_parameters"]["length"], 0.5);
  EXPECT_EQ(read_urdf(read_source(prefix_ + "best.urdf")).parameters[0].value, 0.6);
  EXPECT_EQ(record_.failure(), "");
  record_.remove();
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(Best, APointThatFailedIsNone) {
  Trial failed = trial(1, 0, 0.0, 0.5);
  failed.status.code = StatusCode::kAssemblyFailed;
  record_.note(failed);
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(Best, ADiskThatDoesNotTakeItIsTold) {
  std::filesystem::remove_all(directory_.path());
  record_.note(trial(1, 0, 3.0, 0.5));
  EXPECT_NE(record_.failure().find("No such file"), std::string::npos) << record_.failure();
}

}  // namespace
}  // namespace codesign
