// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/command_oracle.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/command_inputs.h"

namespace codesign::fuzz {
namespace {

Input governor(const std::string& study) {
  Input input;
  input.arguments = {"simulate", "SHIPPED/urdf/governor.urdf", "study.yaml", "--json", "--samples",
                     "3"};
  input.files["study.yaml"] = study;
  return input;
}

TEST(CommandOracle, HasNothingAgainstShippedCases) {
  for (const Seed& seed : shipped_seeds()) {
    if (seed.name == "slider_crank_identify") continue;  // its recording is made by a script
    Input input;
    input.arguments = {"check", "model.urdf", "study.yaml", "--json"};
    input.files = {{"model.urdf", seed.urdf}, {"study.yaml", seed.study}};
    input.files.insert(seed.files.begin(), seed.files.end());
    input.exit = 0;
    EXPECT_EQ(run_command(input, default_limits()), "") << seed.name;
    for (const std::vector<std::string>& command : seed.commands) {
      input.arguments = command;
      input.arguments.insert(input.arguments.end(), {"model.urdf", "study.yaml", "--json"});
      input.exit.reset();  // few evaluations need not be enough
      EXPECT_EQ(run_command(input, default_limits()), "") << seed.name;
    }
  }
}

TEST(CommandOracle, FindsWhatIsNotAsExpected) {
  Input input = governor("duration: -1\nobjective: {}\n");
  input.exit = 2;
  input.says = "study.yaml:1: duration";
  EXPECT_EQ(run_command(input, default_limits()), "");
  input.exit = 0;
  EXPECT_NE(run_command(input, default_limits()).find("exit code 2 instead of 0"),
            std::string::npos);
  input.exit = 2;
  input.says = "something else";
  EXPECT_NE(run_command(input, default_limits()).find("does not say"), std::string::npos);
}

TEST(Inputs, ReadBackAsTheyAreKept) {
  const std::vector<Seed> seeds = shipped_seeds();
  const std::string path =
      (std::filesystem::temp_directory_path() / "codesign_fuzz_input.yaml").string();
  Dice dice(7);
  for (int k = 0; k < 50; ++k) {
    const Input input = random_input(seeds, &dice);
    save_input(path, input);
    const Input same = load_input(path);
    EXPECT_EQ(same.arguments, input.arguments);
    EXPECT_EQ(same.files, input.files);
    EXPECT_EQ(same.disk, input.disk);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace codesign::fuzz
