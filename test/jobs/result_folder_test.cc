// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "jobs/json.h"
#include "jobs/optimization_records.h"
#include "jobs/result_folder.h"
#include "jobs/saved_result.h"
#include "jobs/tuned_pendulum.h"
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
  nlohmann::json on_disk() const {
    return nlohmann::json::parse(std::ifstream(prefix_ + "best.json"));
  }

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

class TakenAway : public testing::Test {
 protected:
  std::string path(const char* name) const { return (directory_.path() / name).string(); }

  TemporaryDirectory directory_;
  Problem problem_ = pendulum_on_hardware();
  OptimizationResult result_ = optimize(problem_);
  ResultFolder folder_{directory_.path().string(), problem_};
};

/// The state of a colleague who gets only the folder.
TEST_F(TakenAway, TheFilesAloneReproduceBothObjectives) {
  EXPECT_TRUE(folder_.write_design(to_text(optimization_json(problem_, result_)), result_).empty());
  for (const auto& [model, design, objective] :
       {std::tuple{"tuned.urdf", "result.json", result_.best.objective},
        std::tuple{"initial.urdf", "result.json", result_.best.objective},
        std::tuple{"initial.urdf", "initial.json", result_.initial.objective}}) {
    const Problem again =
        load_problem(read_source(path(model)), {}, read_source(path("job_study.yaml")),
                     read_result(read_source(path(design))));
    const Evaluation evaluation = Evaluator(again).evaluate(again.start(), true);
    ASSERT_TRUE(evaluation.status.ok());
    EXPECT_NEAR(evaluation.objective, objective, 1e-12 * objective) << model << " with " << design;
  }
  EXPECT_NE(result_.best.objective, result_.initial.objective);
}

TEST_F(TakenAway, EveryFileIsThere) {
  result_.cost.statistics.cpu_seconds = 0.0;  // else a slow machine leaves the check out
  EXPECT_TRUE(folder_.write_design(to_text(optimization_json(problem_, result_)), result_).empty());
  EXPECT_TRUE(folder_.write_runs(result_, nullptr).empty());
  for (const std::string& name : ResultFolder::file_names()) {
    const bool is_of_ensembles = name == "starts.csv" || name == "scenarios.csv";
    EXPECT_EQ(std::filesystem::exists(path(name.c_str())), !is_of_ensembles) << name;
  }
  const Json details = Json::parse(std::ifstream(path("details.json")));
  EXPECT_EQ(details["model"], "pendulum");
  EXPECT_EQ(details["files"]["study"], "pendulum.yaml");
  for (const char* side : {"initial", "tuned"})
    EXPECT_EQ(details[side]["status"]["code"], "success") << side;
  const Json& check = details.at("gradient_check");
  ASSERT_TRUE(check.contains("largest_relative_difference")) << check.dump();
  EXPECT_LT(check["largest_relative_difference"].get<double>(), 1e-8);
}

/// So that job_study.yaml finds them.
TEST_F(TakenAway, FilesThatTheStudyNamesGoAlong) {
  const char* const identification =
      R"({"names": ["mass"], "covariance": [[1e-4]], "identified": {"mass": {"value": 1.0, "determined": true}}})";
  const auto written = [&](const std::string& name, const std::string& read_from) {
    const auto files = [&](const FileAddress&) { return SourceText{read_from, identification}; };
    const std::string study =
        kPendulumStudy + "uncertain: {from: " + name + "}\nrobust: {measure: mean, samples: 2}\n";
    const Problem problem =
        load_problem({"pendulum.urdf", kPendulumUrdf}, {}, {"pendulum.yaml", study}, {}, {}, files);
    OptimizationResult result;
    result.best.rho = result.initial.rho = problem.start();
    return ResultFolder(directory_.path().string(), problem).write_design("{}\n", result).size();
  };
  EXPECT_EQ(written("rig/i.json", "/elsewhere/rig/i.json"), 0U);
  EXPECT_EQ(read_source(path("rig/i.json")).text, identification);
  EXPECT_NO_THROW(
      load_problem(read_source(path("tuned.urdf")), {}, read_source(path("job_study.yaml"))));
  // Files outside the folder stay there, and the file that was read does not change.
  EXPECT_EQ(written("../i.json", "/elsewhere/i.json") + written("/far/i.json", "/far/i.json"), 0U);
  EXPECT_FALSE(std::filesystem::exists(directory_.path().parent_path() / "i.json"));
  std::ofstream(path("here.json")) << "as it is";
  EXPECT_EQ(written("here.json", path("here.json")), 0U);
  EXPECT_EQ(read_source(path("here.json")).text, "as it is");
}

TEST_F(TakenAway, AFolderThatIsGoneIsTold) {
  std::filesystem::remove_all(directory_.path());
  const std::vector<Failure> failures =
      folder_.write_design(to_text(optimization_json(problem_, result_)), result_);
  ASSERT_EQ(failures.size(), 6U) << "one for each file";
  EXPECT_EQ(failures[0].code, "output_failed");
  EXPECT_NE(failures[0].message.find("result.json"), std::string::npos) << failures[0].message;
}

TEST(Convergence, AFailedTrialLeavesItsNumbersEmpty) {
  Trial trial;
  trial.evaluation = 2;
  trial.status.code = StatusCode::kAssemblyFailed;
  trial.best_objective = 0.25;
  trial.events = 3;
  trial.rho = Eigen::Vector2d(1.0, 0.5);
  EXPECT_EQ(convergence_row(trial), (std::vector<std::string>{"2", "0", "assembly_failed", "",
                                                              "0.25", "", "3", "1", "0.5"}));
  EXPECT_EQ(convergence_columns({"a", "b"}).size(), convergence_row(trial).size());
}

}  // namespace

}  // namespace codesign
