// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cli/slider_crank.h"
#include "excitation/excited_cases.h"

namespace codesign::cli {
namespace {

const std::string kSwing =
    "duration: 1\ncontrollers: {servo: {type: pid, input: hinge/position, output: hinge, gains: "
    "{p: "
    "\"${gain}\"}, setpoint: {type: sine, amplitude: \"${reach}\", frequency: 1}}}\n"
    "parameters: {gain: {initial: 1}, reach: {initial: 0.5, lower: 0, upper: 2, tune: false}}\n";

/// A pendulum and a study in a folder of their own.
struct PendulumFiles {
  explicit PendulumFiles(const std::string& study) {
    write("model.urdf", pendulum_urdf());
    write("study.yaml", study);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path(name)) << text;
  }
  Outcome run(const std::string& command, const std::vector<std::string>& more) const {
    std::vector<std::string> words{command, folder.path("model.urdf"), folder.path("study.yaml")};
    words.insert(words.end(), more.begin(), more.end());
    return run_words(words);
  }
  ScratchFolder folder;
};

TEST(EffortsCommand, PrintsATableAndWhatTheDrivesNeed) {
  const PendulumFiles files(kSwing);
  const Outcome outcome = files.run("efforts", {"--samples", "5"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0],
            "time,hinge/position,hinge/velocity,hinge/acceleration,hinge/effort,hinge/friction,"
            "hinge/normal_force,hinge/sliding_velocity");
  EXPECT_NE(outcome.err.find("rms_effort"), std::string::npos) << outcome.err;
  EXPECT_EQ(files.run("efforts", {"--quiet"}).err, "");
}

TEST(EffortsCommand, WritesJsonAndCsv) {
  const PendulumFiles files(kSwing);
  const std::string csv = files.folder.path("efforts.csv");
  const Outcome outcome = files.run(
      "efforts", {"--json", "--csv", csv, "--samples=3", "--signals", "hinge/reaction_force/z"});
  const Json object = json_of(outcome);
  expect_keys(object, {"version", "parameters", "joints", "limits_exceeded", "series", "warnings"});
  EXPECT_EQ(object["series"]["hinge/reaction_force/z"].size(), 3U);
  EXPECT_EQ(object["joints"]["hinge"]["effort"]["value"].is_number(), true);
  EXPECT_EQ(lines_of(read_text_file(csv)).size(), 4U);
  const Outcome over = files.run("efforts", {"--csv", files.folder.path("study.yaml")});
  EXPECT_EQ(over.code, kBadInput);
  EXPECT_NE(over.err.find("the table of efforts would replace this file"), std::string::npos);
}

TEST(EffortsCommand, PrintsPostures) {
  const PendulumFiles files("duration: 1\nefforts: {grid: {hinge: {from: 0, to: 1, count: 3}}}\n");
  const Outcome outcome = files.run("efforts", {});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "hinge/position,hinge/effort,hinge/breakaway_down,hinge/breakaway_up,hinge/holding");
  EXPECT_NE(outcome.err.find("in posture"), std::string::npos) << outcome.err;
}

// A run of the study has its own values; so does a run of a table.
TEST(EffortsCommand, TakesOneRun) {
  for (const bool from_table : {false, true}) {
    const PendulumFiles files(
        kSwing + (from_table ? "runs: runs.csv\n"
                             : "runs: {wide: {set: {reach: 1.0}}, still: {set: {reach: 0}}}\n"));
    files.write("runs.csv", "run,reach\nwide,1.0\nstill,0\n");
    const auto largest = [&](const std::string& run) {
      const Outcome outcome = files.run("efforts", {"--json", "--run", run});
      EXPECT_EQ(outcome.code, kDone) << outcome.err;
      return json_of(outcome)["joints"]["hinge"]["velocity"]["value"].get<double>();
    };
    EXPECT_NEAR(std::abs(largest("wide")), 2.0 * 3.141592653589793, 1e-9);
    EXPECT_EQ(largest("still"), 0.0);
    const Outcome wrong = files.run("efforts", {"--run", "wied"});
    EXPECT_EQ(wrong.code, kBadInput);
    EXPECT_NE(wrong.err.find("unknown run, did you mean \"wide\"?"), std::string::npos)
        << wrong.err;
  }
  const Outcome none = PendulumFiles(kSwing).run("efforts", {"--run", "wide"});
  EXPECT_NE(none.err.find("there are none"), std::string::npos) << none.err;
}

TEST(SimulateCommand, TakesOneRun) {
  const PendulumFiles files(kSwing +
                            "objective: {integral: [{signal: hinge/velocity}]}\n"
                            "runs: {wide: {set: {reach: 1.0}}, still: {set: {reach: 0}}, "
                            "pushed: {loads: [{joint: hinge, effort: 2}]}}\n");
  const auto objective = [&](const std::string& run) {
    const Outcome outcome = files.run("simulate", {"--json", "--run=" + run});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return json_of(outcome)["objective"].get<double>();
  };
  EXPECT_EQ(objective("still"), 0.0);
  EXPECT_GT(objective("wide"), 0.0);
  EXPECT_GT(objective("pushed"), 0.0);
  EXPECT_EQ(run_words({"optimize", "m", "s", "--run", "a"}).code, kBadInput) << "no such option";
}

TEST(EffortsCommand, RefusesWhatItCannotUse) {
  const Outcome none = PendulumFiles("duration: 1\n").run("efforts", {});
  EXPECT_EQ(none.code, kBadInput);
  EXPECT_NE(none.err.find("the study gives no motion"), std::string::npos) << none.err;
  const Outcome signal = PendulumFiles(kSwing).run("efforts", {"--signals", "servo/output"});
  EXPECT_EQ(signal.code, kBadInput);
  EXPECT_NE(signal.err.find("servo"), std::string::npos) << signal.err;
  EXPECT_NE(run_words({"help", "efforts"}).out.find("--samples"), std::string::npos);
}

TEST(EquilibriumCommand, PrintsThePostureAndItsStability) {
  const PendulumFiles files("duration: 10\ninitial_state: {hinge: {position: 1.5}}\n");
  const Outcome outcome = files.run("equilibrium", {"--signals", "hinge/reaction_force/z"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find("\nstable: slowest pole -0.25 1/s; damping and controllers counted, "
                             "friction not\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(files.run("equilibrium", {"--friction", "regularised"}).out.find("friction counted\n"),
            std::string::npos);
  EXPECT_NE(outcome.out.find("hinge/reaction_force/z  19.62\n"), std::string::npos) << outcome.out;
  const Json object = json_of(files.run("equilibrium", {"--json"}));
  expect_keys(object,
              {"joints", "signals", "stability", "verdict", "modes", "limits_exceeded", "steps"});
  EXPECT_NEAR(object["joints"]["hinge"]["position"].get<double>(), 0.0, 1e-10);
  EXPECT_EQ(object["modes"].size(), 1U);
}

TEST(EquilibriumCommand, SaysThatThereIsNone) {
  const PendulumFiles files(
      "duration: 10\ngravity: [0, 0, 0]\nloads: [{joint: hinge, effort: 1}]\n");
  const Outcome outcome = files.run("equilibrium", {"--json"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_EQ(json_of(outcome)["error"]["code"], "no_equilibrium");
}

TEST(UrdfCommand, FillsInPlainNumbers) {
  const PendulumFiles files("duration: 1\n");
  const std::string text = pendulum_urdf();
  files.folder.edited("bare.urdf", text, "damping=\"0.3\" ", "");
  const std::string bare = files.folder.path("bare.urdf");
  EXPECT_EQ(run_words({"urdf", bare}).code, kBadInput);
  const Outcome outcome = run_words({"urdf", bare, "--fill"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find(" damping=\"0.3\""), std::string::npos) << outcome.out;
  const Outcome set = run_words({"urdf", bare, "--fill", "--set", "viscous=2"});
  EXPECT_NE(set.out.find(" damping=\"2\""), std::string::npos) << set.out;
}

TEST(UrdfCommand, FaultsAndWarningsOfWhatIsFilledInHaveTheLinesOfTheFile) {
  const ScratchFolder folder;
  const auto model = [&folder](const char* name, const char* izz) {
    std::ofstream(folder.path(name))
        << "<robot name='r' xmlns:codesign='urn:mechanism_codesign'>\n<codesign:parameter name='L' "
           "value='1'/>\n\n\n<link name='g'/>\n\n<link name='a'><inertial><origin codesign:xyz='0 "
           "0 ${L}'/><mass value='1'/>\n<inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='"
        << izz
        << "'/></inertial></link>\n<joint name='j' type='continuous'><parent link='g'/><child "
           "link='a'/><axis xyz='0 0 1'/></joint></robot>";
    return folder.path(name);
  };
  const Outcome fault = run_words({"urdf", model("fault.urdf", "0"), "--fill"});
  EXPECT_EQ(fault.code, kBadInput);
  EXPECT_NE(fault.err.find("fault.urdf:7: <link name=\"a\">"), std::string::npos) << fault.err;
  const Outcome warning = run_words({"urdf", model("warning.urdf", "0.5"), "--fill"});
  ASSERT_EQ(warning.code, kDone) << warning.err;
  EXPECT_NE(warning.err.find("triangle_inequality"), std::string::npos) << warning.err;
  EXPECT_NE(warning.err.find("warning.urdf:7: "), std::string::npos) << warning.err;
}

}  // namespace
}  // namespace codesign::cli
