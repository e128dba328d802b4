// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sstream>

#include "cli/arguments.h"
#include "cli/command_help.h"

namespace codesign::cli {
namespace {

void expect_usage_error(const std::vector<std::string>& words, const std::string& message) {
  try {
    parse_arguments(words);
    ADD_FAILURE() << message;
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(Arguments, TakesCommandModelAndStudy) {
  const Arguments arguments = parse_arguments({"gradient", "a.urdf", "a.yaml"});
  EXPECT_EQ(arguments.command, "gradient");
  EXPECT_EQ(arguments.model, "a.urdf");
  EXPECT_EQ(arguments.study, "a.yaml");
  EXPECT_FALSE(arguments.json);
  EXPECT_FALSE(arguments.verify);
  EXPECT_EQ(arguments.samples, 101);
}

TEST(Arguments, CheckNeedsNoStudy) {
  EXPECT_EQ(parse_arguments({"check", "a.urdf"}).study, "");
  expect_usage_error({"check"}, "needs a MODEL, the path of a URDF file");
  for (const char* command : {"simulate", "gradient", "optimize"})
    expect_usage_error({command, "a.urdf"}, "needs a STUDY, the path of a YAML file");
}

TEST(Arguments, OptionsStandAnywhereAndTakeEitherSpelling) {
  const Arguments arguments = parse_arguments({"optimize", "--json", "a.urdf", "--set", "Kp=-1.5",
                                               "--overlay=o.urdf", "a.yaml", "--overlay", "p.urdf",
                                               "--set=crank_length=7e-2", "--output", "out"});
  EXPECT_TRUE(arguments.json);
  EXPECT_EQ(arguments.overlays, (std::vector<std::string>{"o.urdf", "p.urdf"}));
  EXPECT_EQ(arguments.settings, (ParameterSettings{{"Kp", -1.5}, {"crank_length", 0.07}}));
  EXPECT_EQ(arguments.output, "out");
  EXPECT_EQ(arguments.study, "a.yaml");
}

TEST(Arguments, EveryCommandTakesAResult) {
  for (const char* command : {"check", "urdf", "simulate", "gradient", "optimize", "identify"})
    EXPECT_EQ(parse_arguments({command, "m", "s", "--result", "r.json"}).result, "r.json")
        << command;
}

TEST(Arguments, ResumeNamesTheFolder) {
  EXPECT_TRUE(parse_arguments({"optimize", "m", "s", "--resume", "out"}).resume);
  EXPECT_EQ(parse_arguments({"optimize", "m", "s", "--resume=out"}).output, "out");
  EXPECT_TRUE(parse_arguments({"optimize", "m", "s", "--resume", "out", "--output", "out"}).resume);
  EXPECT_FALSE(parse_arguments({"optimize", "m", "s", "--output", "out"}).resume);
  expect_usage_error({"optimize", "m", "s", "--resume", "a", "--output", "b"}, "two folders");
  expect_usage_error({"optimize", "m", "s", "--resume"}, "needs a value");
  expect_usage_error({"simulate", "m", "s", "--resume", "a"}, "takes no --resume");
}

TEST(Arguments, SimulateTakesSignalsFileAndSamples) {
  const Arguments arguments =
      parse_arguments({"simulate", "m", "s", "--signals", "a/velocity,b/velocity - c/velocity",
                       "--csv", "f", "--samples=11"});
  EXPECT_EQ(arguments.signals, (std::vector<std::string>{"a/velocity", "b/velocity - c/velocity"}));
  EXPECT_EQ(arguments.csv, "f");
  EXPECT_EQ(arguments.samples, 11);
  expect_usage_error({"simulate", "m", "s", "--samples", "1"}, "less than 2");
  expect_usage_error({"simulate", "m", "s", "--samples=-99999999999"}, "less than 2");
  expect_usage_error({"simulate", "m", "s", "--samples", "99999999999"},
                     "99999999999 is out of range (allowed: 2 to 2147483647)");
  for (const char* samples : {"ten", "2.5"})
    expect_usage_error({"simulate", "m", "s", "--samples", samples}, "not a whole number");
  EXPECT_EQ(
      parse_arguments({"simulate", "m", "s", "--signals", "${max(a/x, 1)},b/velocity"}).signals,
      (std::vector<std::string>{"${max(a/x, 1)}", "b/velocity"}));
  expect_usage_error({"simulate", "m", "s", "--signals", "a/velocity,"}, "empty name");
  expect_usage_error({"simulate", "m", "s", "--signals="}, "needs a value");
}

TEST(Arguments, VerifyTakesAMethod) {
  EXPECT_TRUE(parse_arguments({"gradient", "m", "s", "--verify"}).verify);
  EXPECT_EQ(parse_arguments({"gradient", "m", "s", "--verify"}).method, CheckMethod::kComplexStep);
  EXPECT_EQ(parse_arguments({"gradient", "--verify=ridders", "m", "s"}).method,
            CheckMethod::kRidders);
  EXPECT_EQ(parse_arguments({"gradient", "--verify", "m", "s"}).model, "m");
  expect_usage_error({"gradient", "m", "s", "--verify=guess"}, "neither complex_step nor ridders");
}

TEST(Arguments, RefusesWhatItDoesNotKnow) {
  expect_usage_error({}, "no command given (allowed: ");
  expect_usage_error({}, "simulate, ");
  expect_usage_error({"optimise", "m", "s"},
                     "unknown command \"optimise\", did you mean \"optimize\"?");
  expect_usage_error({"check", "m", "--jsn"}, "unknown option \"--jsn\", did you mean \"--json\"?");
  expect_usage_error({"check", "m", "--verify"}, "\"check\" takes no --verify");
  expect_usage_error(
      {"check", "m", "s", "extra"},
      "unexpected \"extra\" after model and study; further URDF files are given by --overlay");
  expect_usage_error({"check", "m", ""}, "empty argument");
}

TEST(Arguments, RefusesMissingAndSurplusValues) {
  expect_usage_error({"check", "m", "--overlay"}, "--overlay needs a value");
  expect_usage_error({"check", "m", "--overlay="}, "--overlay needs a value");
  expect_usage_error({"check", "m", "--json=yes"}, "--json takes no value");
  expect_usage_error({"check", "m", "--set", "Kp"}, "expected PARAMETER=VALUE");
  expect_usage_error({"check", "m", "--set", "=1"}, "expected PARAMETER=VALUE");
  expect_usage_error({"check", "m", "--set", "Kp=1m"}, "\"1m\" is not a number");
}

TEST(Arguments, HelpWinsOverEverything) {
  EXPECT_EQ(parse_arguments({"help"}).command, "help");
  EXPECT_EQ(parse_arguments({"--help"}).command, "help");
  EXPECT_EQ(parse_arguments({"optimize", "--bogus", "-h"}).command, "help");
}

TEST(Arguments, VersionStandsAlone) {
  EXPECT_EQ(parse_arguments({"--version"}).command, "version");
  EXPECT_EQ(parse_arguments({"--version", "--help"}).command, "help");
  expect_usage_error({"check", "m", "--version"}, "unknown option \"--version\"");
}

TEST(Arguments, OfALinearization) {
  const Arguments arguments = parse_arguments(
      {"linearize", "m.urdf", "s.yaml", "--at", "0.5", "--friction=regularised", "--csv", "f.csv"});
  EXPECT_EQ(arguments.time, 0.5);
  EXPECT_EQ(arguments.friction, LinearFriction::kRegularised);
  EXPECT_LT(parse_arguments({"linearize", "m", "s"}).time, 0.0);
  expect_usage_error({"linearize", "m", "s", "--at", "-1"}, "--at must be a time of the run");
  expect_usage_error({"linearize", "m", "s", "--friction", "on"},
                     "--friction must be off, regularised or given_speed, not \"on\"");
  expect_usage_error({"simulate", "m", "s", "--at", "1"}, "takes no --at");
}

TEST(Usage, NamesEveryCommandAndOption) {
  for (const char* word :
       {"check MODEL", "urdf MODEL", "--sticks", "simulate MODEL STUDY", "gradient MODEL STUDY",
        "optimize MODEL STUDY", "--signals", "--csv", "--samples", "--verify", "--output",
        "--resume", "report DIR|BAG", "apply DIR|BAG", "--overlay", "--result", "--set", "--json",
        "--version"})
    EXPECT_NE(usage().find(word), std::string::npos) << word;
}

TEST(Usage, FitsATerminalAndEndsItsLastLine) {
  std::istringstream lines(usage());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_EQ(usage().back(), '\n');
}

TEST(Arguments, TheBaseMayFloat) {
  EXPECT_FALSE(parse_arguments({"check", "m.urdf"}).floating_base);
  EXPECT_TRUE(parse_arguments({"check", "m.urdf", "--base", "floating"}).floating_base);
  EXPECT_TRUE(parse_arguments({"simulate", "m.urdf", "s.yaml", "--base=floating"}).floating_base);
  EXPECT_THROW(parse_arguments({"check", "m.urdf", "--base", "flying"}), UsageError);
}

}  // namespace

}  // namespace codesign::cli
