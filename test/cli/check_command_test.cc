// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>

#include "cli/slider_crank.h"
#include "integration/mechanisms.h"
#include "jobs/json.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign::cli {
namespace {

TEST(CheckCommand, PrintsThePapersTable) {
  const Outcome outcome = run_words({"check", kModel, kStudy});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  for (const char* row : {"bodies", "coordinates", "first-order equations", "degrees of freedom",
                          "dynamic equations", "equations in all"})
    EXPECT_NE(outcome.out.find(row), std::string::npos) << row;
  Json counts = json_of(run_words({"check", kModel, kStudy, "--json"}))["counts"];
  const std::vector<std::pair<std::string, int>> expected = {{"bodies", 3},
                                                             {"coordinates", 21},
                                                             {"first_order_equations", 42},
                                                             {"degrees_of_freedom", 1},
                                                             {"constraints", 20},
                                                             {"redundant_constraints", 0},
                                                             {"dynamic_equations", 62},
                                                             {"parameters", 5},
                                                             {"sensitivities", 310},
                                                             {"total_equations", 372}};
  for (const auto& [key, value] : expected) EXPECT_EQ(counts[key], value) << key;
}

TEST(CheckCommand, NamesRedundantRowsAndFrictionThatIsAChoice) {
  const ScratchFolder folder;
  const std::string model =
      folder.edited("four_bar.urdf", four_bar(pin_friction()), "name='test'", "name='four_bar'");
  const std::string study = folder.edited(
      "study.yaml", "duration: 1.0\ninitial_state: {left_hinge: {position: 0.6}}\n",
      "duration: 1.0", "objective: {integral: [{signal: left_hinge/velocity}]}\nduration: 1.0");
  const Outcome outcome = run_words({"check", model, study});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const Json counts = json_of(run_words({"check", model, study, "--json"}))["counts"];
  ASSERT_EQ(counts["redundant_rows"].size(), 3U);
  for (const Json& row : counts["redundant_rows"]) {
    const std::string line = row["joint"].get<std::string>() + ", row " +
                             std::to_string(row["row"].get<int>()) + ": " +
                             row["kind"].get<std::string>();
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(counts["undetermined_reactions"].size(), 4U);
  EXPECT_EQ(counts["chosen_friction"], Json::array({"left_hinge"}));
  EXPECT_NE(outcome.out.find("friction that depends on such a reaction\n  left_hinge\n"),
            std::string::npos)
      << outcome.out;
}

TEST(CheckCommand, TakesAMechanismAlone) {
  Json object = json_of(run_words({"check", kModel, "--json", "--set", "crank_length=0.07"}));
  EXPECT_EQ(object["counts"]["parameters"], 0);
  EXPECT_EQ(object["counts"]["total_equations"], 62);
  EXPECT_EQ(object["parameters"]["crank_length"], 0.07);
  EXPECT_FALSE(object["parameters"].contains("Kp"));
}

TEST(UrdfCommand, PrintsTheModelAtTheValuesAskedFor) {
  const Outcome outcome = run_words({"urdf", kModel, kStudy, "--set", "crank_length=0.1"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const RobotDescription robot = read_urdf({"printed", outcome.out});
  EXPECT_EQ(robot.parameters[0].value, 0.1);
  // The printed model contains the parameter values: without --set it gives the same simulation.
  const ScratchFolder folder;
  const std::string printed = folder.edited("printed.urdf", outcome.out, "<robot", "<robot");
  const Json there =
      json_of(run_words({"gradient", kModel, kStudy, "--set", "crank_length=0.1", "--json"}));
  const Json here = json_of(run_words({"gradient", printed, kStudy, "--json"}));
  EXPECT_NEAR(here["objective"].get<double>(), there["objective"].get<double>(), 1e-9);
}

TEST(UrdfCommand, MergesOverlays) {
  const ScratchFolder folder;
  const std::string overlay =
      folder.edited("overlay.urdf",
                    "<robot name=\"slider_crank\" xmlns:codesign=\"urn:mechanism_codesign\"><joint "
                    "name=\"J\"><dynamics damping=\"0.25\"/></joint></robot>",
                    "J", "crank_joint");
  const Outcome outcome = run_words({"urdf", kModel, "--overlay", overlay});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find("damping=\"0.25\""), std::string::npos);
}

TEST(UrdfCommand, AlsoAsJson) {
  const Json object = json_of(run_words({"urdf", kModel, "--json"}));
  EXPECT_EQ(object["urdf"].get<std::string>(), run_words({"urdf", kModel}).out);
}

TEST(UrdfCommand, DrawsLinksThatHaveNoVisualIfAskedTo) {
  const ScratchFolder folder;
  const std::string bare = folder.edited(
      "bare.urdf",
      "<robot name=\"bare\"><link name=\"ground\"/><joint name=\"j\" type=\"continuous\"><parent "
      "link=\"ground\"/><child link=\"rod\"/><axis xyz=\"0 1 0\"/></joint><link "
      "name=\"rod\"><inertial><origin "
      "xyz=\"0 0 -0.5\"/><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" "
      "ixz=\"0\" "
      "iyz=\"0\"/></inertial></link></robot>",
      "<robot", "<robot");
  EXPECT_EQ(run_words({"urdf", bare}).out.find("<visual"), std::string::npos);
  EXPECT_NE(run_words({"urdf", bare, "--sticks"}).out.find("<cylinder"), std::string::npos);
  EXPECT_EQ(run_words({"urdf", kModel, "--sticks"}).out, run_words({"urdf", kModel}).out)
      << "each link has a visual";
}

TEST(OverlayCommand, PrintsAnOverlayForTheFileThatCheckTakes) {
  const ScratchFolder folder;
  const std::string model = shipped("urdf/vendor_arm.urdf"), notes = folder.path("notes.urdf");
  const Outcome outcome = run_words({"overlay", model});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  std::ofstream(notes) << outcome.out;
  EXPECT_EQ(run_words({"check", model, "--overlay", notes}).code, kDone);
  const Json object = json_of(run_words({"overlay", model, "--json"}));
  EXPECT_EQ(object["overlay"], outcome.out);
  EXPECT_EQ(json_of(run_words({"overlay", model, "--overlay", notes, "--json"}))["model"],
            object["model"]);
}

TEST(OverlayCommand, AFreeBodyFliesByIt) {
  const ScratchFolder folder;
  const std::string model = folder.path("drone.urdf"), notes = folder.path("notes.urdf");
  std::ofstream(model)
      << "<robot name='drone'><link name='body'><inertial><mass value='0.03'/><inertia ixx='1e-5' "
         "ixy='0' ixz='0' iyy='1e-5' iyz='0' izz='2e-5'/></inertial></link></robot>";
  std::ofstream(notes) << run_words({"overlay", model}).out;
  const Outcome outcome = run_words({"check", model, "--overlay", notes, "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(json_of(outcome)["counts"]["degrees_of_freedom"], 6);
}

TEST(OverlayCommand, RefusesWhatItDoesNotRead) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"overlay", kModel, kStudy},
                                                {"overlay", kModel, "--set", "crank_length=0.1"},
                                                {"overlay"}}) {
    const Outcome outcome = run_words(words);
    EXPECT_EQ(outcome.code, kBadInput);
    EXPECT_NE(outcome.err.find("usage: codesign overlay MODEL"), std::string::npos) << outcome.err;
  }
}

}  // namespace

}  // namespace codesign::cli
