// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/slider_crank.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

TEST(SimulateCommand, WritesTheSignalsAskedFor) {
  const Outcome outcome =
      run_words({"simulate", kModel, kStudy, "--signals",
                 "crank_joint/velocity,slider_joint/position", "--samples", "3"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "time,crank_joint/velocity,slider_joint/position");
  EXPECT_EQ(lines[1].substr(0, 2), "0,");
  EXPECT_NEAR(std::stod(lines[1].substr(2)), -10.0, 1e-9);
  EXPECT_EQ(lines[2].substr(0, 2), "1,");
  EXPECT_EQ(lines[3].substr(0, 2), "2,");
}

TEST(SimulateCommand, GivesSeriesAndObjectiveAsJson) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_words({"simulate", kModel, kStudy, "--json", "--csv", folder.path("run.csv")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  Json object = json_of(outcome);
  expect_keys(object, {"objective", "parameters", "steps", "rejected_steps", "cpu_seconds",
                       "counts", "series"});
  EXPECT_NEAR(object["objective"].get<double>() / 0.05925272691, 1.0, 1e-4);
  expect_keys(object["series"],
              {"time", "crank_joint/position", "slider_joint/velocity", "slider_joint/friction",
               "slider_joint/normal_force", "slider_joint/sliding_velocity", "crank_speed/output"});
  EXPECT_EQ(object["series"]["time"].size(), 101U);
  EXPECT_EQ(object["series"]["slider_joint/friction"].size(), 101U);
  EXPECT_EQ(lines_of(read_text_file(folder.path("run.csv"))).size(), 102U);
}

TEST(SimulateCommand, ATableReplacesNoFileThatIsRead) {
  const ScratchFolder folder;
  std::vector<std::string> paths = {
      folder.edited("model.urdf", read_text_file(kModel), "<robot", "<robot"),
      folder.edited("study.yaml", read_text_file(kStudy), "duration", "duration"),
      folder.edited("overlay.urdf", "<robot name=\"slider_crank\"/>", "<robot", "<robot"),
      folder.edited("result.json", "{\"parameters\": {\"Kp\": 3.0}}", "{", "{")};
  std::filesystem::create_symlink(paths[0], folder.path("soft"));
  std::filesystem::create_hard_link(paths[1], folder.path("hard"));
  const std::vector<std::string> words = {"simulate", paths[0],   paths[1], "--overlay",
                                          paths[2],   "--result", paths[3], "--csv"};
  for (const std::string& path :
       {paths[0], paths[1], paths[2], paths[3], folder.path("soft"), folder.path("hard")}) {
    const std::string before = read_text_file(path);
    std::vector<std::string> all = words;
    all.push_back(path);
    const Outcome outcome = run_words(all);
    EXPECT_EQ(outcome.code, kBadInput) << path;
    EXPECT_NE(outcome.err.find("--csv: the table of the run would replace this file"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(read_text_file(path), before);
  }
}

TEST(SimulateCommand, AnObjectiveThatIsNotFiniteIsAFailure) {
  const ScratchFolder folder;
  const std::string study = folder.edited(
      "study.yaml", read_text_file(kStudy), "terminal: []",
      "terminal: [{signal: crank_joint/position, reference: 100.0, weight: 1.0e+306}]");
  const Outcome outcome = run_words({"simulate", kModel, study, "--json"});
  EXPECT_EQ(outcome.code, kFailed) << outcome.err;
  const Json object = json_of(outcome);
  EXPECT_EQ(object["error"]["code"], "non_finite");
  EXPECT_FALSE(object.contains("objective"));
}

// The objective is that of the run itself, to the last bit that of the evaluation, with terminal
// terms that read accelerations too.
TEST(SimulateCommand, TheObjectiveIsThatOfTheRun) {
  const ScratchFolder folder;
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const std::string terminal =
        folder.edited("terminal.yaml", read_text_file(short_study(folder)),
                      "integrator: rosenbrock", std::string("integrator: ") + integrator);
    const std::string study = folder.edited("study.yaml", read_text_file(terminal), "terminal: []",
                                            "terminal: [{signal: slider_joint/acceleration}]");
    const Json object = json_of(run_words({"simulate", kModel, study, "--json"}));
    const Problem problem = load_problem(read_source(kModel), {}, read_source(study));
    EXPECT_EQ(object["objective"].get<double>(),
              Evaluator(problem).evaluate(problem.start(), false).objective)
        << integrator;
  }
}

TEST(SimulateCommand, TheSetpointIsASignal) {
  const Json series = json_of(
      run_words({"simulate", kModel, kStudy, "--json", "--samples", "5", "--signals",
                 "crank_speed/setpoint,crank_speed/error + crank_joint/velocity"}))["series"];
  for (const double value : series["crank_speed/setpoint"]) EXPECT_EQ(value, -10.0);
  for (const double value : series["crank_speed/error + crank_joint/velocity"])
    EXPECT_NEAR(value, -10.0, 1e-12);
}

TEST(SimulateCommand, ARunThatFailsNamesStatusTimeAndCause) {
  const ScratchFolder folder;
  const std::string study = folder.edited("study.yaml", read_text_file(kStudy), "solver: {",
                                          "solver: {maximum_steps: 20, ");
  const Outcome outcome = run_words({"simulate", kModel, study, "--json", "--samples", "2001"});
  EXPECT_EQ(outcome.code, kFailed);
  Json object = json_of(outcome);
  EXPECT_EQ(object["error"]["code"], "too_many_steps");
  EXPECT_GT(object["error"]["time"].get<double>(), 0.0);
  EXPECT_GT(object["series"]["time"].size(), 1U);
  EXPECT_NE(outcome.err.find("too_many_steps at t = "), std::string::npos) << outcome.err;
  EXPECT_EQ(run_words({"gradient", kModel, study}).code, kFailed);
  EXPECT_EQ(run_words({"optimize", kModel, study}).code, kFailed);
}

TEST(SimulateCommand, EventsAreCountedAndListed) {
  const ScratchFolder folder;
  const std::string study = folder.edited(
      "study.yaml", read_text_file(kStudy), "controllers:",
      "loads: [{joint: crank_joint, effort: \"${t < 0.5 ? 0 : 1.0e-3}\"}]\ncontrollers:");
  const Outcome run = run_words({"simulate", kModel, study, "--csv", folder.path("run.csv")});
  ASSERT_EQ(run.code, kDone) << run.err;
  EXPECT_NE(run.err.find("1 event, the first one at t = 0.5 s: loads[0].effort, \"t < 0.5\", "
                         "falling, a jump\n"),
            std::string::npos)
      << run.err;
  const Json events = json_of(run_words({"simulate", kModel, study, "--json"}))["events"];
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0], Json({{"time", 0.5},
                             {"element", "loads[0].effort"},
                             {"object", "crank_joint"},
                             {"expression", "t < 0.5"},
                             {"direction", "falling"},
                             {"kind", "jump"}}));
  EXPECT_EQ(json_of(run_words({"gradient", kModel, study, "--json"}))["event_count"], 1);
  const Outcome plain = run_words({"simulate", kModel, kStudy, "--csv", folder.path("run.csv")});
  EXPECT_EQ(plain.err.find("event"), std::string::npos) << plain.err;
}

TEST(SimulateCommand, ALoopThatCannotBeClosedIsBadInput) {
  const ScratchFolder folder;
  const std::string lower = "name=\"rod_length\" value=\"0.3\" lower=";
  const std::string text = read_text_file(shipped("urdf/slider_crank_haug.urdf"));
  const std::string model =
      folder.edited("model.urdf", text, lower + "\"0.2\"", lower + "\"0.01\"");
  const Outcome outcome = run_words({"simulate", model, shipped("config/slider_crank_haug.yaml"),
                                     "--json", "--set", "rod_length=0.05"});
  EXPECT_EQ(outcome.code, kBadInput);
  Json error = json_of(outcome)["error"];
  EXPECT_EQ(error["file"], model);
  EXPECT_NE(error["element"].get<std::string>().find("slider_pin"), std::string::npos);
}

TEST(SimulateCommand, PrintsEveryPosture) {
  const std::string model = source_dir() + "/urdf/four_bar_function.urdf",
                    study = source_dir() + "/config/four_bar_function.yaml";
  const Outcome outcome =
      run_words({"simulate", model, study, "--signals", "crank_joint/position", "--samples", "3"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 62U);
  EXPECT_EQ(lines[61].substr(0, 3), "60,");
  EXPECT_NEAR(std::stod(lines[61].substr(3)), 0.903436 + 1.0471975511965976, 1e-12);
  EXPECT_NE(outcome.err.find("assembled 61 postures"), std::string::npos) << outcome.err;
  const Outcome longer = run_words({"simulate", model, study, "--set", "a=4.2"});
  EXPECT_EQ(longer.code, kFailed);
  EXPECT_NE(longer.err.find("assembly_failed"), std::string::npos) << longer.err;
  EXPECT_NE(longer.err.find("posture "), std::string::npos) << longer.err;
}

constexpr const char* kRod = R"(<robot name="p" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="n" value="3" lower="1" upper="5"/>
  <codesign:parameter name="b" value="-2" lower="-3" upper="-1"/>
  <link name="ground"/>
  <link name="rod"><inertial><origin xyz="0 0 -0.25"/><mass value="1"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.001"/></inertial></link>
  <joint name="pivot" type="continuous"><parent link="ground"/><child link="rod"/>
    <axis xyz="0 1 0"/></joint>
</robot>)";

Json objective_of_rod(const std::string& objective, const std::string& tuned = "{b: {}}") {
  const ScratchFolder folder;
  const std::string study =
      "duration: 0.1\ninitial_state: {pivot: {position: -1.0}}\nparameters: " + tuned +
      "\nobjective: " + objective + "\n";
  const Outcome outcome =
      run_words({"gradient", folder.edited("p.urdf", kRod, "<robot", "<robot"),
                 folder.edited("p.yaml", study, "duration", "duration"), "--json"});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  return json_of(outcome);
}

// However the whole exponent is written: in the text, by its value, of the time and of signals.
TEST(SimulateCommand, PowersOfNegativeNumbersAreExact) {
  const auto value = [](const std::string& objective) {
    return objective_of_rod(objective)["objective"].get<double>();
  };
  const auto of_time = [&](const std::string& power) {
    return value("{integral: [{signal: pivot/position, reference: \"${" + power + " + 0*b}\"}]}");
  };
  EXPECT_NEAR(of_time("(t - 1)**(1+1)") / of_time("(t - 1)*(t - 1)"), 1.0, 1e-12);
  EXPECT_NEAR(of_time("(t - 1)**n") / of_time("(t - 1)*(t - 1)*(t - 1)"), 1.0, 1e-12);
  EXPECT_NEAR(value("{integral: [{signal: \"${pivot/position**n - b}\"}]}") /
                  value("{integral: [{signal: \"${pivot/position*pivot/position*pivot/position - "
                        "b}\"}]}"),
              1.0, 1e-12);
  const Json power =
                 objective_of_rod("{terminal: [{signal: pivot/position, reference: \"${b**n}\"}]}"),
             eight = objective_of_rod(
                 "{terminal: [{signal: pivot/position, reference: \"${-8 + 12*(b + 2)}\"}]}");
  EXPECT_EQ(power["objective"], eight["objective"]) << "(-2)^3, and 3 (-2)^2 for each b";
  EXPECT_NEAR(power["gradient"]["b"].get<double>() / eight["gradient"]["b"].get<double>(), 1.0,
              1e-12);
}

}  // namespace
}  // namespace codesign::cli
