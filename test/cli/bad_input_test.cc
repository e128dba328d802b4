// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Errors in input files, end to end: each message names the place, the value and the allowed
// values.
#include <gtest/gtest.h>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

/// One error put into a shipped file, and the text that the message must contain.
struct Slip {
  const char *from, *to;                    ///< the edit
  int line;                                 ///< where it stands
  const char *element, *message, *allowed;  ///< parts of the answer
};

void expect_answer(const Slip& slip, const std::string& file, const Outcome& outcome) {
  SCOPED_TRACE(slip.to);
  EXPECT_EQ(outcome.code, kBadInput);
  Json error = json_of(outcome)["error"];
  ASSERT_TRUE(error.is_object());
  EXPECT_EQ(error["file"], file);
  EXPECT_EQ(error["line"], slip.line);
  const auto text = [&error](const char* key) { return error.value(key, std::string()); };
  EXPECT_NE(text("element").find(slip.element), std::string::npos) << text("element");
  EXPECT_NE(text("message").find(slip.message), std::string::npos) << text("message");
  EXPECT_NE(text("allowed").find(slip.allowed), std::string::npos) << text("allowed");
  EXPECT_NE(text("value"), "");
  EXPECT_NE(outcome.err.find(file + ":" + std::to_string(slip.line)), std::string::npos)
      << outcome.err;
}

TEST(BadInput, InTheModel) {
  const std::vector<Slip> slips{
      {"<codesign:friction model", "<codesign:fricton model", 120, "slider_joint",
       "did you mean \"codesign:friction\"", "codesign:friction"},
      {"mu_static=", "mu_statik=", 120, "<codesign:friction>", "did you mean \"mu_static\"",
       "mu_static"},
      {"${0.12*crank_length/0.08}", "${0.13*crank_length/0.08}", 46, "<mass>",
       "at the default parameters", "equal values"},
      {"${0.12*crank_length/0.08}", "${0.12*(crank_length/0.08}", 46, "<mass>", "parenthesis",
       "an expression"},
      {"${0.12*crank_length/0.08}", "${0.12*crank_lenght/0.08}", 46, "<mass>",
       "did you mean 'crank_length'", "an expression"},
      {"<mass value=\"0.12\" codesign:value=\"${0.12*crank_length/0.08}\"/>",
       "<mass value=\"nan\"/>", 46, "<mass>", "not finite", "finite"},
      {"<child link=\"crank\"/>", "<child link=\"crnk\"/>", 69, "<child>", "did you mean \"crank\"",
       "ground"},
      {"</robot>", "<link name=\"island\"/></robot>", 144, "island", "a second root", "one root"},
      {"lower=\"0.06\" upper=\"0.1\"", "lower=\"0.1\" upper=\"0.06\"", 9, "crank_length",
       "lower bound is above", "0.06"},
      {"<origin xyz=\"0 0 0\"/>", "<origin xyz=\"0 0 2\"/>", 138, "slider_pin", "cannot be closed",
       "0"},
  };
  const ScratchFolder folder;
  for (const Slip& slip : slips) {
    const std::string model =
        folder.edited("model.urdf", read_text_file(kModel), slip.from, slip.to);
    expect_answer(slip, model, run_words({"check", model, kStudy, "--json"}));
  }
}

TEST(BadInput, WhatIsOnlyDoubtfulIsToldAsWarnings) {
  const std::string mass = "<mass value=\"0.12\" codesign:value=\"${0.12*crank_length/0.08}\"/>";
  const ScratchFolder folder;
  const std::string model = folder.edited("model.urdf", read_text_file(kModel), mass,
                                          "<mass value=\"-0.12\" val=\"1\"/>");
  const Outcome outcome = run_words({"check", model, kStudy, "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Json warnings = json_of(outcome)["warnings"];
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0]["code"], "negative_mass");
  EXPECT_EQ(warnings[1]["code"], "unknown_attribute");
  EXPECT_NE(warnings[1]["message"].get<std::string>().find(model + ":46: "), std::string::npos);
}

TEST(BadInput, InTheStudy) {
  const std::vector<Slip> slips{
      {"objective:", "objektive:", 14, "objektive", "did you mean \"objective\"", "objective"},
      {"max_evaluations", "max_evalutions", 21, "optimizer.max_evalutions", "did you mean",
       "max_evaluations"},
      {"lower: -5.0, upper: 5.0", "lower: 5.0, upper: -5.0", 13, "parameters.Kp", "lower bound",
       "lower < upper"},
      {"- {signal: crank_joint/velocity", "- {signal: crank_joint/velocty", 16,
       "objective.integral[0].signal", "did you mean", "velocity"},
      {"- {signal: crank_joint/velocity", "- {signal: crnk_joint/velocity", 16,
       "objective.integral[0].signal", "did you mean", "crank_joint"},
      {"duration: 2.0", "duration: .nan", 3, "duration", "not finite", "finite"},
      {"\"${Kp}\"", "\"${Kq}\"", 7, "controllers.crank_speed.gains.p", "did you mean 'Kp'",
       "expression"},
  };
  const ScratchFolder folder;
  for (const Slip& slip : slips) {
    const std::string study =
        folder.edited("study.yaml", read_text_file(kStudy), slip.from, slip.to);
    expect_answer(slip, study, run_words({"check", kModel, study, "--json"}));
  }
}

TEST(BadInput, AnAlgorithmThatTakesNoConstraints) {
  const ScratchFolder folder;
  const Slip slip{"algorithm: mma",      "algorithm: lbfgs",     23,
                  "optimizer.algorithm", "takes no constraints", "slsqp"};
  const std::string study = folder.edited(
      "study.yaml", read_text_file(shipped("config/slider_crank_haug.yaml")), slip.from, slip.to);
  expect_answer(slip, study,
                run_words({"optimize", shipped("urdf/slider_crank_haug.urdf"), study, "--json"}));
}

TEST(BadInput, AnEmptyFile) {
  const ScratchFolder folder;
  std::ofstream(folder.path("empty.urdf")).close();
  const Outcome outcome = run_words({"check", folder.path("empty.urdf")});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("the file is empty"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace codesign::cli
