// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

/// The short study for IDAS.
std::string idas_study(const ScratchFolder& folder) {
  return folder.edited("idas.yaml", read_text_file(short_study(folder)), "integrator: rosenbrock",
                       "integrator: idas");
}

TEST(Integrators, EveryCommandTakesEither) {
  const ScratchFolder folder;
  const std::string study = idas_study(folder);
  for (const char* command : {"check", "simulate", "gradient"})
    EXPECT_EQ(run_words({command, kModel, study, "--json"}).code, kDone) << command;
  const Outcome outcome =
      run_words({"optimize", kModel, study, "--json", "--output", folder.path("job")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  EXPECT_LT(object["objective"].get<double>(), object["initial_objective"].get<double>());
}

TEST(Integrators, GiveTheSameNumbers) {
  const ScratchFolder folder;
  const std::string study = idas_study(folder);
  Json rosenbrock = json_of(run_words({"gradient", kModel, short_study(folder), "--json"})),
       idas = json_of(run_words({"gradient", kModel, study, "--json"}));
  EXPECT_NE(rosenbrock["steps"], idas["steps"]);
  EXPECT_NEAR(idas["objective"].get<double>() / rosenbrock["objective"].get<double>(), 1.0, 1e-6);
  for (const std::string& name : kTuned)
    EXPECT_NEAR(idas["gradient"][name].get<double>() / rosenbrock["gradient"][name].get<double>(),
                1.0, 1e-5)
        << name;
}

TEST(Integrators, IdasIsCheckedByDifferencesOfTheOther) {
  const ScratchFolder folder;
  const Outcome outcome = run_words({"gradient", kModel, idas_study(folder), "--verify", "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json verification = json_of(outcome)["verification"];
  EXPECT_EQ(verification["method"], "ridders");
  EXPECT_LT(verification["largest_relative_difference"].get<double>(), 1e-5);
}

}  // namespace
}  // namespace codesign::cli
