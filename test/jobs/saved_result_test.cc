// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "jobs/files.h"
#include "jobs/optimization_records.h"
#include "jobs/result_folder.h"
#include "jobs/saved_result.h"
#include "jobs/tuned_pendulum.h"
#include "mechanism_codesign/error.h"
#include "reading/urdf/urdf_reader.h"
#include "temporary_directory.h"
#include "text/number_text.h"

namespace codesign {
namespace {

InputFault fault_in(const std::string& json) {
  try {
    read_result({"result.json", json});
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "result.json");
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << json;
  return {};
}

TEST(SavedResult, HoldsEveryParameterToTheLastBit) {
  const ParameterSettings settings = read_result(
      {"result.json",
       R"({"objective": 1, "parameters": {"a": 0.1, "Kp": 5, "b": 0.22358268481765226}})"});
  EXPECT_EQ(settings, (ParameterSettings{{"a", 0.1}, {"Kp", 5.0}, {"b", 0.22358268481765226}}));
}

TEST(SavedResult, SaysWhatIsWrong) {
  EXPECT_EQ(fault_in("{\n\"parameters\": {\n\"a\": }}").where.line, 3);
  EXPECT_EQ(fault_in("[1, 2]").element, "parameters");
  EXPECT_EQ(fault_in("{}").element, "parameters");
  EXPECT_EQ(fault_in("{\"parameters\": 3}").element, "parameters");
  const InputFault fault = fault_in("{\"parameters\": {\"a\": null}}");
  EXPECT_EQ(fault.element, "parameters.a");
  EXPECT_EQ(fault.value, "null");
  EXPECT_EQ(fault_in("{\n\"parameters\": {\"b\": 1,\n\"a\": true}}").where.line, 3);
  const InputFault beyond = fault_in(
      "{\"3e999\": [\"\\\"4e999\", 5e-999],\n\"parameters\": {\n\"a\": 1, \"b\": -1e999}}");
  EXPECT_EQ(beyond.where.line, 3);
  EXPECT_EQ(beyond.value, "1e999");
  EXPECT_EQ(beyond.message, "a number is beyond the range of double");
  const std::string deep(100000, '[');
  EXPECT_EQ(
      fault_in("{\"parameters\": {\"a\": " + deep + std::string(deep.size(), ']') + "}}").value,
      "array");
}

/// The pendulum with bounds that no other number equals, since its optimum lies on them: length
/// 0.7654 and Kp 0.4321.
Problem pendulum_with_odd_bounds() {
  const Problem problem = pendulum_on_hardware();
  return load_problem(
      {"pendulum.urdf", replaced(problem.urdf().text, "upper=\"0.8\"", "upper=\"0.7654\"")}, {},
      {"pendulum.yaml", replaced(problem.study_text().text, "lower: 0.0", "lower: 0.4321")});
}

/// The folder of an optimization of the pendulum, in which a test may change files.
class FinishedPendulum : public testing::Test {
 protected:
  FinishedPendulum() {
    std::vector<std::vector<std::string>> rows;
    result_ = optimize(problem_, problem_.optimizer_options(), [&](const Trial& trial) {
      rows.push_back(convergence_row(trial));
      return true;
    });
    const ResultFolder folder(path(), problem_);
    EXPECT_TRUE(
        folder.write_design(to_text(optimization_json(problem_, result_)), result_).empty());
    EXPECT_TRUE(folder.write_runs(result_, nullptr).empty());
    write_whole_file(path("convergence.csv"), csv_text(convergence_columns(problem_.tuned_names()),
                                                       rows, "convergence.csv"));
  }

  std::string path(const std::string& name = "") const {
    return (directory_.path() / "job" / name).string();
  }
  std::string tuned(int k) const { return to_decimal(result_.best.rho[k]); }

  /// Replaces each `from` in a file, which must have one.
  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read_source(path(name)).text;
    ASSERT_NE(text.find(from), std::string::npos) << name << " has no " << from;
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    write_whole_file(path(name), text);
  }

  /// The message with which the folder is refused; empty if it is not.
  std::string refusal() const {
    try {
      read_finished_job(path());
    } catch (const NeverSimulated& error) {
      return error.what();
    }
    return "";
  }

  static bool make(const std::filesystem::path& folder) {
    return std::filesystem::create_directory(folder);
  }

  TemporaryDirectory directory_;
  const bool made_ = make(directory_.path() / "job");
  Problem problem_ = pendulum_with_odd_bounds();
  OptimizationResult result_;
};

TEST_F(FinishedPendulum, IsTakenWithItsDesign) {
  ASSERT_EQ(tuned(0) + " " + tuned(1), "0.7654 0.4321") << "the tests below look for these";
  for (const std::string& given : {path(), (directory_.path() / "job.bag").string()}) {
    const FinishedJob job = read_finished_job(given);
    EXPECT_EQ(job.parameters, problem_.parameters(result_.best.rho));
    EXPECT_EQ(job.tuned, problem_.tuned_names());
    EXPECT_EQ(job.objective, result_.best.objective);
  }
}

// Jobs of before the number of events was written have no column for it.
TEST_F(FinishedPendulum, TheFolderOfAnOlderJobIsRead) {
  std::string table;
  std::istringstream lines(read_source(path("convergence.csv")).text);
  for (std::string line; std::getline(lines, line); table += line + "\n") {
    std::size_t comma = 0;
    for (int k = 0; k < 6; ++k) comma = line.find(',', comma) + 1;
    line.erase(comma, line.find(',', comma) + 1 - comma);
  }
  ASSERT_EQ(table.find("events"), std::string::npos);
  write_whole_file(path("convergence.csv"), table);
  EXPECT_EQ(read_finished_job(path()).tuned, problem_.tuned_names());
}

TEST_F(FinishedPendulum, AValueChangedInOneFileIsRefused) {
  const std::string other = to_decimal(std::nextafter(result_.best.rho[1], 10.0));
  change("result.json", tuned(1), other);
  EXPECT_NE(refusal().find("no trial point of convergence.csv has"), std::string::npos)
      << refusal();
}

TEST_F(FinishedPendulum, ADamagedResultIsBadInput) {
  const std::string whole = read_source(path("result.json")).text;
  const std::string begin = whole.substr(0, whole.find('{') + 1), rest = whole.substr(begin.size());
  for (const char* damage : {"\"a\": 1e999,", "\"error\": 3,", "\"error\": {\"code\": 3},"}) {
    write_whole_file(path("result.json"), begin + damage + rest);
    try {
      read_finished_job(path());
      ADD_FAILURE() << damage;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.file, path("result.json")) << damage;
    }
  }
}

TEST_F(FinishedPendulum, AModelChangedAfterItIsRefused) {
  write_whole_file(path("tuned.urdf"),
                   write_tuned_urdf(problem_.urdf(), {}, problem_.parameters()));
  EXPECT_NE(refusal().find("length is " + tuned(0) + ", but 0.5 in"), std::string::npos)
      << refusal();
}

TEST_F(FinishedPendulum, AGainChangedInGainsYamlIsRefusedWithItsLine) {
  change("gains.yaml", "i: 0.25", "i: 0.26");
  EXPECT_NE(refusal().find("gains.yaml:8: \"      i: 0.26\""), std::string::npos) << refusal();
}

TEST_F(FinishedPendulum, AValueChangedInEveryFileIsRefusedByTheSimulation) {
  for (const char* file : {"result.json", "convergence.csv", "gains.yaml"})
    change(file, tuned(1), "2.5");
  EXPECT_NE(refusal().find("the objective is " + to_decimal(result_.best.objective) + ", but "),
            std::string::npos)
      << refusal();
}

TEST_F(FinishedPendulum, AParameterThatWasNotTunedKeepsItsValue) {
  change("result.json", "\"mass\": 1.0", "\"mass\": 1.5");
  std::vector<double> heavy = problem_.parameters(result_.best.rho);
  heavy[1] = 1.5;
  write_whole_file(path("tuned.urdf"), write_tuned_urdf(problem_.urdf(), {}, heavy));
  EXPECT_NE(refusal().find("mass is 1.5, but 1 in"), std::string::npos) << refusal();
}

TEST_F(FinishedPendulum, AStudyChangedAfterItIsRefused) {
  change("job_study.yaml", "reference: -1.0", "reference: -1.5");
  EXPECT_NE(refusal().find("the objective is"), std::string::npos) << refusal();
}

TEST_F(FinishedPendulum, AJobThatDidNotFinishIsRefused) {
  std::filesystem::remove(path("details.json"));
  EXPECT_NE(refusal().find("details.json: it is missing"), std::string::npos) << refusal();
  change("result.json", "\"objective\"",
         "\"error\": {\"code\": \"cancelled\", \"message\": \"by the user\"}, \"objective\"");
  EXPECT_NE(refusal().find("did not finish (cancelled: by the user)"), std::string::npos)
      << refusal();
}

TEST_F(FinishedPendulum, WhatIsMissingIsBadInput) {
  EXPECT_THROW(read_finished_job(path("nowhere")), InputError);
  std::filesystem::remove(path("tuned.urdf"));
  EXPECT_THROW(read_finished_job(path()), InputError);
}

TEST_F(FinishedPendulum, AValueBeyondTheBoundsIsBadInput) {
  change("result.json", "\"Kp\": " + tuned(1), "\"Kp\": 7.5");
  try {
    read_finished_job(path());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("the value lies outside the bounds of the parameter Kp (value: 7.5"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace

}  // namespace codesign
