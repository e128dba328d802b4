// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>
#include <filesystem>
#include <sstream>

#include "cli/inputs.h"
#include "cli/run_fixture.h"
#include "description/study.h"
#include "jobs/files.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"

namespace codesign::cli {
namespace {

std::string scratch(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) /
          ("output_file_" + name + "_" + std::to_string(getpid())))
      .string();
}

TEST(OutputFile, NamesTheOptionAndThePath) {
  const std::string path = scratch("missing") + "/run.csv";
  std::ofstream file;
  try {
    open_output(path, "--csv", &file);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, path);
    EXPECT_EQ(error.fault().element, "--csv");
  }
}

Arguments slider_crank() {
  Arguments arguments;
  arguments.model = shipped("urdf/slider_crank.urdf");
  arguments.study = shipped("config/slider_crank.yaml");
  return arguments;
}

TEST(Inputs, ReadsModelStudyOverlaysAndSettings) {
  const ScratchFolder folder;
  std::ofstream(folder.path("overlay.urdf")) << "<robot name=\"slider_crank\"/>";
  Arguments arguments = slider_crank();
  arguments.overlays = {folder.path("overlay.urdf")};
  arguments.settings = {{"Kp", 2.0}};
  const Problem problem = load(arguments);
  EXPECT_EQ(problem.overlays().size(), 1U);
  EXPECT_EQ(problem.start()[4], 2.0);
  EXPECT_EQ(study_of(load_tunable(arguments)).tuned.size(), 5U);
}

TEST(Inputs, ASettingCountsMoreThanAResult) {
  const ScratchFolder folder;
  std::ofstream(folder.path("result.json"))
      << R"({"parameters": {"crank_length": 0.07, "Kp": 3.0}})";
  Arguments arguments = slider_crank();
  arguments.result = folder.path("result.json");
  EXPECT_EQ(load(arguments).start()[0], 0.07);
  EXPECT_EQ(load(arguments).start()[4], 3.0);
  arguments.settings = {{"Kp", 2.0}};
  EXPECT_EQ(load(arguments).start()[4], 2.0);
  std::ofstream(folder.path("result.json")) << R"({"parameters": {"crank_length": 7.0}})";
  EXPECT_THROW(load(arguments), InputError) << "outside its bounds";
}

TEST(Inputs, OfAnotherStudysResultWhatFitsIsTaken) {
  const ScratchFolder folder;
  Arguments arguments = slider_crank();
  arguments.result = folder.path("other.json");
  std::ofstream(arguments.result)
      << R"({"parameters": {"crank_length": 0.07, "rod_length": 70.0, "elbow_gain": 3.0}})";
  const Problem problem = load(arguments), plain = load(slider_crank());
  EXPECT_EQ(problem.start()[0], 0.07);
  EXPECT_EQ(problem.start()[1], plain.start()[1]);
  ASSERT_EQ(problem.warnings().size(), plain.warnings().size() + 1U);
  const Warning& warning = problem.warnings().front();
  EXPECT_EQ(warning.code, "result_of_another_study");
  for (const char* part : {"other.json", "1 of its 3", "rod_length = 70",
                           "elbow_gain is no parameter", "Kp, which is tuned"})
    EXPECT_NE(warning.message.find(part), std::string::npos) << warning.message;
  for (const char* nothing : {R"({"parameters": {"elbow_gain": 3.0}})", R"({"parameters": {}})"}) {
    std::ofstream(arguments.result) << nothing;
    try {
      load(arguments);
      ADD_FAILURE() << "nothing fits of " << nothing;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.file, arguments.result);
    }
  }
}

TEST(Inputs, ALoneModelHasNothingToTune) {
  Arguments arguments = slider_crank();
  arguments.study.clear();
  EXPECT_TRUE(study_of(load(arguments)).tuned.empty());
  EXPECT_THROW(load_tunable(arguments), InputError);
}

TEST(Inputs, SignalsAreThoseAskedForOrTheDefaults) {
  Arguments arguments = slider_crank();
  const Problem problem = load(arguments);
  const std::vector<SignalDescription> all = select_signals(arguments, problem);
  EXPECT_GT(all.size(), 6U);
  EXPECT_EQ(all.front().text, "crank_joint/position");
  EXPECT_EQ(all.back().text, "crank_speed/output");
  arguments.signals = {"slider/position/x - crank/position/x"};
  EXPECT_EQ(select_signals(arguments, problem).at(0).terms.size(), 2U);
  arguments.signals = {"slider/position"};
  EXPECT_THROW(select_signals(arguments, problem), InputError);
}

TEST(Inputs, ABaseThatFloatsOnTheCommandLineIsThatOfTheStudy) {
  const ScratchFolder folder;
  std::ofstream(folder.path("drone.urdf"))
      << R"(<robot name="drone"><link name="base"><inertial><mass value="2"/><inertia ixx="0.1"
            ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/></inertial></link></robot>)";
  std::ofstream(folder.path("fall.yaml"))
      << "duration: 1\nbase: floating\n"
         "initial_state: {floating_base: {linear_velocity: [0, 0, 1]}}\n";
  Arguments arguments;
  arguments.model = folder.path("drone.urdf");
  EXPECT_THROW(load(arguments), InputError);
  arguments.floating_base = true;
  EXPECT_EQ(robot_of(load(arguments)).joints.size(), 1U);
  arguments.study = folder.path("fall.yaml");
  EXPECT_EQ(load(arguments).overlays().size(), 1U) << "named by both, once";
  arguments.floating_base = false;
  EXPECT_EQ(load(arguments).overlays().size(), 1U);
}

}  // namespace

}  // namespace codesign::cli
