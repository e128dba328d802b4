// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/slider_crank.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign::cli {
namespace {

TEST(UrdfCommand, PrintsTheModelAtTheValuesAskedFor) {
  const Outcome outcome = run_words({"urdf", kModel, kStudy, "--set", "crank_length=0.1"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const RobotDescription robot = read_urdf({"printed", outcome.out});
  EXPECT_EQ(robot.parameters[0].value, 0.1);
  // The printed model contains the parameter values: without --set it gives the same simulation.
  const ScratchFolder folder;
  const std::string printed = folder.edited("printed.urdf", outcome.out, "<robot", "<robot");
  const Json there = json_of(run_words({"gradient", kModel, kStudy, "--set", "crank_length=0.1", "--json"}));
  const Json here = json_of(run_words({"gradient", printed, kStudy, "--json"}));
  EXPECT_NEAR(here["objective"].get<double>(), there["objective"].get<double>(), 1e-9);
}

TEST(UrdfCommand, MergesOverlays) {
  const ScratchFolder folder;
  const std::string overlay = folder.edited("overlay.urdf",
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

}  // namespace
}  // namespace codesign::cli
