// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

// Lines 1 to 9; the runs begin in line 10.
const std::string kRunStudy = R"(duration: 2.0
initial_state: {crank_joint: {position: 0.1, velocity: -10.0}}
controllers:
  hold: {type: pid, input: crank_joint/velocity, setpoint: -10.0, output: crank_joint, gains: {p: 2.0}}
  shake: {type: state_feedback, output: slider_joint, feedforward: {type: sine, amplitude: 1.0, frequency: 2.0}}
  push: {type: basis, output: slider_joint, coefficients: {count: 2, tune: false}}
loads: [{joint: crank_joint, effort: 1.0}, {joint: slider_joint, effort: 2.0}]
parameters: {Kp: {initial: 1.0}, mass: {initial: 2.0, lower: 0.0, upper: 5.0, tune: false}, rod_length: {tune: false}}
objective: {integral: [{signal: crank_joint/velocity}, {signal: hold/error}]}
)";

std::vector<RunDescription> runs_of(const std::string& runs) {
  return read_text(kRunStudy + "runs: " + runs + "\n").ensemble.runs;
}

Study changed_study(const std::string& run) {
  return *runs_of("{changed: " + run + "}").at(0).study;
}

void expect_bad_run(const std::string& runs, const std::string& element, const std::string& message,
                    int line = 10) {
  expect_fault(kRunStudy + "runs: " + runs + "\n", element, message, line);
}

TEST(StudyRuns, ReadsValuesAndWeights) {
  const std::vector<RunDescription> runs = runs_of(
      "\n  full-5.0: {set: {mass: 5.0, rod_length: 0.25}}\n  empty: {set: {mass: 0}, weight: 2.5}");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].name, "full-5.0");
  EXPECT_EQ(runs[0].weight, 1.0);
  ASSERT_EQ(runs[0].set.size(), 2U);
  EXPECT_EQ(runs[0].set[0], std::make_pair(std::string("mass"), 5.0));
  EXPECT_EQ(runs[0].set[1], std::make_pair(std::string("rod_length"), 0.25));
  EXPECT_EQ(runs[0].study, nullptr);
  EXPECT_EQ(runs[0].where.line, 11);
  EXPECT_EQ(runs[1].weight, 2.5);
}

TEST(StudyRuns, ARunMayBeTheStudyItself) {
  const RunDescription run = runs_of("{as_written: {}}").at(0);
  EXPECT_TRUE(run.set.empty());
  EXPECT_EQ(run.study, nullptr);
}

TEST(StudyRuns, ChangesAreMergedIntoTheStudy) {
  const Study study = changed_study(
      "{gravity: [0, 0, -1.62], initial_state: {crank_joint: {velocity: 3.0}, slider_joint: "
      "{guess: 0.2}}, "
      "controllers: {hold: {setpoint: 4.0, gains: {d: 0.5}}, shake: {feedforward: {amplitude: "
      "\"${Kp}\"}}}}");
  EXPECT_EQ(study.duration, 2.0);
  EXPECT_EQ(study.gravity[2], -1.62);
  ASSERT_EQ(study.initial_state.size(), 2U);
  EXPECT_EQ(study.initial_state[0].position->nominal(), 0.1);
  EXPECT_EQ(study.initial_state[0].velocity->nominal(), 3.0);
  EXPECT_EQ(study.initial_state[1].guess, 0.2);
  ASSERT_EQ(study.controllers.size(), 3U);
  EXPECT_EQ(study.controllers[0].name, "hold");
  EXPECT_EQ(study.controllers[0].setpoint.constant.nominal(), 4.0);
  EXPECT_EQ(study.controllers[0].p.nominal(), 2.0);
  EXPECT_EQ(study.controllers[0].d.nominal(), 0.5);
  EXPECT_FALSE(study.controllers[1].feedforward.sine.amplitude.is_constant());
  EXPECT_EQ(study.controllers[1].feedforward.sine.frequency.nominal(), 2.0);
  EXPECT_EQ(study.loads.size(), 2U);
  EXPECT_EQ(study.integral.size(), 2U);
}

TEST(StudyRuns, TheStudyItselfStaysAsItIs) {
  const Study study = read_text(
      kRunStudy +
      "runs: {other: {initial_state: {crank_joint: {velocity: 3.0}}, gravity: [0, 0, 0]}}\n");
  EXPECT_EQ(study.gravity[2], -9.81);
  EXPECT_EQ(study.initial_state[0].velocity->nominal(), -10.0);
  const Study& other = *study.ensemble.runs.at(0).study;
  EXPECT_FALSE(other.ensemble.is_ensemble());
  EXPECT_EQ(other.tuned, study.tuned);
  EXPECT_EQ(other.parameters.size(), study.parameters.size());
}

TEST(StudyRuns, ListsAndOtherTypesReplaceWhatTheStudyHas) {
  const Study study = changed_study(
      "{loads: [{joint: crank_joint, effort: 7.0}], controllers: {hold: {setpoint: {type: sine, "
      "amplitude: 2.0, period: 1.0}}, "
      "shake: {feedforward: {type: waypoints, times: [0, 1], positions: [0, 3]}}}}");
  ASSERT_EQ(study.loads.size(), 1U);
  EXPECT_EQ(study.loads[0].effort.of_time.constant.nominal(), 7.0);
  EXPECT_TRUE(study.controllers[0].setpoint.sine.is_period);
  EXPECT_EQ(study.controllers[1].feedforward.waypoints.positions.at(1).nominal(), 3.0);
}

TEST(StudyRuns, RefusesWhatIsNoRun) {
  expect_bad_run("{}", "runs", "found 0 runs");
  expect_bad_run("[a]", "runs", "expected a map");
  expect_bad_run("{a: 3}", "runs.a", "expected a map");
  expect_bad_run("{a: {}, a: {}}", "runs.a", "repeated key");
  expect_bad_run("{a b: {}}", "runs.a b", "not a name for a run");
  expect_bad_run("{.a: {}}", "runs..a", "not a name for a run");
  expect_bad_run("{a/b: {}}", "runs.a/b", "not a name for a run");
  expect_bad_run("{a: {duration: 3}}", "runs.a.duration", "unknown key");
  expect_bad_run("{a: {objective: {}}}", "runs.a.objective", "unknown key");
  EXPECT_EQ(fault_in(kRunStudy + "runs: {a: {duration: 3}}").allowed,
            "set, weight, initial_state, controllers, loads, motion, gravity");
  expect_bad_run("{a: {weight: 0}}", "runs.a.weight", "must be positive");
  expect_bad_run("{a: {weight: heavy}}", "runs.a.weight", "not a number");
}

TEST(StudyRuns, RefusesValuesThatCannotBeSet) {
  expect_bad_run("{a: {set: {mas: 1}}}", "runs.a.set.mas",
                 "unknown parameter, did you mean \"mass\"");
  expect_bad_run("{a: {set: {Kp: 1}}}", "runs.a.set.Kp", "this parameter is tuned");
  expect_bad_run("{a: {set: {mass: 5.5}}}", "runs.a.set.mass",
                 "outside the bounds of the parameter mass");
  EXPECT_EQ(fault_in(kRunStudy + "runs: {a: {set: {mass: 5.5}}}").allowed, "[0, 5]");
  expect_bad_run("{a: {set: {mass: .nan}}}", "runs.a.set.mass", "not finite");
  expect_bad_run("{a: {set: {mass: \"${Kp}\"}}}", "runs.a.set.mass", "not a number");
  expect_bad_run("{a: {set: [mass]}}", "runs.a.set", "expected a map");
}

TEST(StudyRuns, RefusesOtherParameters) {
  expect_bad_run("{a: {controllers: {push: {coefficients: {count: 3}}}}}", "runs.a.controllers",
                 "must not change the coefficients");
  expect_bad_run("{a: {controllers: {push: {coefficients: {initial: 1}}}}}", "runs.a.controllers",
                 "must not change the coefficients");
  expect_bad_run("{a: {controllers: {push: {coefficients: {tune: true}}}}}", "runs.a.controllers",
                 "must not change the coefficients");
  EXPECT_EQ(runs_of("{a: {set: {push_c1: 3}}}").at(0).set.at(0).second, 3.0);
}

/// The runs of a table `runs.csv`, which stands beside the study.
std::vector<RunDescription> runs_in(const std::string& table) {
  const auto files = [&](const FileAddress& address) {
    EXPECT_EQ(address.file, "runs.csv");
    return SourceText{"runs.csv", table};
  };
  return read_study({"study.yaml", kRunStudy + "runs: runs.csv\n"}, study_robot(), {}, files)
      .ensemble.runs;
}

TEST(StudyRuns, ATableHasARunInEachRow) {
  const std::vector<RunDescription> runs =
      runs_in("# load cases\nmass, run, weight\n5, \"full\", 2\n0.5, empty, 1\n");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].name, "full");
  EXPECT_EQ(runs[0].weight, 2.0);
  ASSERT_EQ(runs[0].set.size(), 1U);
  EXPECT_EQ(runs[0].set[0], std::make_pair(std::string("mass"), 5.0));
  EXPECT_EQ(runs[0].where.file, "runs.csv");
  EXPECT_EQ(runs[0].where.line, 3);
  EXPECT_EQ(runs[1].weight, 1.0);
  EXPECT_EQ(runs[1].study, nullptr);
}

TEST(StudyRuns, BadTablesNameTheirLine) {
  const auto message_of = [](const std::string& table) -> std::string {
    try {
      runs_in(table);
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << table;
    return "";
  };
  const auto expect = [&](const std::string& table, const std::string& message) {
    EXPECT_NE(message_of(table).find(message), std::string::npos) << message_of(table);
  };
  expect("mass\n5\n", "runs.csv:1: runs: no column has the names of the runs");
  expect("run,mass\na,5\na,4\n", "runs.csv:3: column \"run\": two runs have the same name");
  expect("run,mass\na,5\n-b,4\n", "runs.csv:3: column \"run\": not a name for a run");
  expect("run,mass\na,6\n", "runs.csv:2: column \"mass\": the value lies outside the bounds");
  expect("run,mass\na,nan\n", "runs.csv:2: column \"mass\": the value lies outside the bounds");
  expect("run,mass\na,x\n", "runs.csv:2: column \"mass\": not a number");
  expect("run,mass\na\n", "runs.csv:2: a row of 1 cells");
  expect("run,mass,mass\na,5,4\n", "runs.csv:1: runs: two columns have the same name");
  expect("run,Kp\na,1\n", "runs.csv:2: column \"Kp\": this parameter is tuned");
  expect("run,mas\na,1\n", "did you mean \"mass\"?");
  expect("run,weight\na,0\n", "the weight of a run must be positive");
  expect("run,mass\n", "study.yaml:10: runs: found 0 runs");
}

}  // namespace
}  // namespace codesign
