// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "jobs/edited_line.h"
#include "jobs/journal_lines.h"
#include "jobs/json.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::string header_of(const Problem& problem) {
  return journal_header(problem, problem.optimizer_options());
}

TEST(JournalHeader, IsTheSameForTheSameJob) {
  EXPECT_EQ(header_difference(header_of(block("")), header_of(block(""))), "");
}

TEST(JournalHeader, SaysWhatDiffers) {
  const Problem problem = block("");
  const std::string own = header_of(problem);
  EXPECT_EQ(header_difference(header_of(block("multistart: {starts: 2}\n")), own)
                .find("the study differs"),
            0u);
  EXPECT_NE(header_difference(header_of(with_settings(problem, {{"mu", 0.4}})), own).find("--set"),
            std::string::npos);
  OptimizerOptions options = problem.optimizer_options();
  options.max_evaluations += 1;
  EXPECT_NE(
      header_difference(journal_header(problem, options), own).find("options of the optimizer"),
      std::string::npos);
  Study study = study_of(problem);
  study.tuned.pop_back();
  EXPECT_NE(header_difference(header_of(with_study(problem, study)), own).find("tuned parameters"),
            std::string::npos);
}

TEST(JournalHeader, KnowsTheTrajectoriesInBags) {
  const auto header = [](double end) {
    const Problem plain = block("");
    std::string study = plain.study_text().text;
    const std::string setpoint = "setpoint: 0.5";
    study.replace(study.find(setpoint), setpoint.size(),
                  "setpoint: {type: trajectory, bag: a.bag, topic: t, joint: slide}");
    const auto loader = [end](const TrajectoryAddress&) {
      return RecordedTrajectory{{0.0, 0.5}, {0.0, end}, {}, {}};
    };
    return header_of(load_problem(plain.urdf(), {}, {"block.yaml", study}, {}, loader));
  };
  EXPECT_EQ(header_difference(header(0.5), header(0.5)), "");
  EXPECT_EQ(header_difference(header(0.5), header(0.6))
                .find("the recorded trajectories that the study names differ"),
            0u);
}

TEST(JournalHeader, KnowsTheContentsOfFiles) {
  const auto header = [](const std::string& path, double variance) {
    const Problem plain = block("");
    const auto files = [&](const FileAddress&) {
      return SourceText{path, "{names: [mu], covariance: [[" + std::to_string(variance) +
                                  "]], identified: {mu: {value: 0.3, determined: true}}}"};
    };
    const std::string study = plain.study_text().text + "uncertain: {from: i.json}\n";
    return header_of(load_problem(plain.urdf(), {}, {"block.yaml", study}, {}, {}, files));
  };
  EXPECT_EQ(header_difference(header("a.json", 0.01), header("b.json", 0.01)), "")
      << "the place does not count";
  EXPECT_EQ(header_difference(header("a.json", 0.01), header("a.json", 0.02))
                .find("the contents of the files that the study names differ"),
            0u);
}

TEST(JournalHeader, RefusesOtherVersionsAndOtherFiles) {
  const std::string own = header_of(block(""));
  const auto set = [&own](const char* key, const Json& value) {
    return edited_line(own, [&](Json* line) { (*line)[key] = value; });
  };
  EXPECT_NE(header_difference(set("version", "0.0.1"), own).find("version \"0.0.1\""),
            std::string::npos);
  EXPECT_NE(header_difference(set("journal", 2), own).find("format 2"), std::string::npos);
  EXPECT_NE(header_difference("{\"journal\":1,\"version\":\"0.1.0\"}", own).find("format 1"),
            std::string::npos)
      << "it had no checksums";
  for (const char* text : {"", "time,x", "{}", "[1]"})
    EXPECT_NE(header_difference(text, own).find("not the journal"), std::string::npos) << text;
  EXPECT_NE(header_difference(set("more", 1), own), "");
}

TEST(JournalHeader, RefusesADamagedLine) {
  const std::string own = header_of(block(""));
  std::string flipped = own;
  flipped[own.find("\"study\":\"") + 9] ^= 1;
  const std::string deep = "{\"journal\":" + std::string(1000000, '[');
  for (const std::string& text :
       {flipped, own.substr(0, own.size() - 1), with_checksum("{\"journal\":3,}"), deep})
    EXPECT_NE(header_difference(text, own).find("line 1 is damaged"), std::string::npos)
        << text.substr(0, 100);
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

EvaluationRecord record_of(const std::vector<double>& values) {
  EvaluationRecord record;
  record.system = 3;
  record.parameters = values;
  record.derivatives = Derivatives::kGradient;
  record.evaluation.status.time = 0.1;
  record.evaluation.objective = values.front();
  record.evaluation.gradient =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  record.evaluation.statistics = {12, 3, values.back(), values.front(), 1e-9};
  record.evaluation.warnings = {{"code", "a \"message\"\nin two lines", {"model.urdf", 7}}};
  return record;
}

TEST(EvaluationRecord, EveryDoubleKeepsItsBits) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values = {
      0.1,           -0.0,   0.0,  1.0 / 3.0,     1e300,         Limits::denorm_min(),
      Limits::max(), 5e-324, 1e22, 2.0 / 3 * 1e5, 123456789012.0};
  std::mt19937_64 random(1);
  while (values.size() < 500) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  const EvaluationRecord record = record_of(values), back = read_line(to_line(record));
  ASSERT_EQ(back.parameters.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_TRUE(same(back.parameters[k], values[k])) << values[k];
    EXPECT_TRUE(same(back.evaluation.gradient[static_cast<Eigen::Index>(k)], values[k]))
        << values[k];
  }
  EXPECT_TRUE(same(back.evaluation.objective, values.front()));
  EXPECT_TRUE(same(back.evaluation.statistics.cpu_seconds, values.back()));
  EXPECT_TRUE(same(back.evaluation.statistics.constraint_drift, values.front()));
}

TEST(EvaluationRecord, KeepsStatusStatisticsAndWarnings) {
  const EvaluationRecord record = record_of({1.0, 2.0});
  const std::string line = to_line(record);
  EXPECT_EQ(line.find('\n'), std::string::npos) << "one line";
  const EvaluationRecord back = read_line(line);
  EXPECT_EQ(back.system, 3);
  EXPECT_EQ(back.derivatives, Derivatives::kGradient);
  EXPECT_TRUE(back.evaluation.status.ok());
  EXPECT_EQ(back.evaluation.status.time, 0.1);
  EXPECT_EQ(back.evaluation.statistics.steps, 12);
  EXPECT_EQ(back.evaluation.statistics.rejected_steps, 3);
  EXPECT_EQ(back.evaluation.statistics.energy_error, 1e-9);
  ASSERT_EQ(back.evaluation.warnings.size(), 1u);
  EXPECT_EQ(back.evaluation.warnings[0].code, "code");
  EXPECT_EQ(back.evaluation.warnings[0].message, "a \"message\"\nin two lines");
  EXPECT_EQ(back.evaluation.warnings[0].where.file, "model.urdf");
  EXPECT_EQ(back.evaluation.warnings[0].where.line, 7);
}

TEST(EvaluationRecord, KeepsEvents) {
  EvaluationRecord record = record_of({1.0, 2.0});
  EXPECT_EQ(to_line(record).find("events"), std::string::npos) << "other journals stay as they are";
  record.evaluation.events = {
      {{1.0 / 3.0, "loads[0].effort", "slide", "t < 1", false, true}}, 7, "abc"};
  const Events back = read_line(to_line(record)).evaluation.events;
  EXPECT_EQ(back.count, 7);
  EXPECT_EQ(back.order, "abc");
  ASSERT_EQ(back.list.size(), 1u);
  EXPECT_EQ(back.list[0].time, 1.0 / 3.0);
  EXPECT_EQ(back.list[0].object, "slide");
  EXPECT_EQ(describe(back.list[0]), "loads[0].effort, \"t < 1\", falling, a jump");
}

TEST(EvaluationRecord, KeepsEveryStatus) {
  EvaluationRecord record = record_of({1.0});
  for (int k = 0; k <= static_cast<int>(StatusCode::kSwitchHolds); ++k) {
    record.evaluation.status.code = static_cast<StatusCode>(k);
    EXPECT_EQ(read_line(to_line(record)).evaluation.status.code, record.evaluation.status.code);
  }
}

TEST(EvaluationRecord, KeepsTheExtremesOfSignals) {
  EvaluationRecord record = record_of({1.0, 2.0});
  record.evaluation.extremes = {Eigen::Vector3d(0.1, 1.0 / 3.0, -2.0),
                                Eigen::Vector3d(0.0, 0.5, 1.0), Eigen::MatrixXd::Random(2, 3)};
  const Extremes back = read_line(to_line(record)).evaluation.extremes;
  EXPECT_EQ(back.values, record.evaluation.extremes.values);
  EXPECT_EQ(back.times, record.evaluation.extremes.times);
  EXPECT_EQ(back.gradients, record.evaluation.extremes.gradients);
  EXPECT_THROW(
      read_line(edited_line(to_line(record),
                            [](Json* line) { (*line)["extremes"]["times"].push_back(1.0); })),
      std::exception);
}

TEST(EvaluationRecord, KeepsTheRootOfTheJacobian) {
  EvaluationRecord record = record_of({1.0, 2.0, 1.0 / 3.0});
  EXPECT_EQ(to_line(record).find("root"), std::string::npos) << "other journals stay as they are";
  record.derivatives = Derivatives::kGaussNewton;
  record.evaluation.jacobian_root = Eigen::MatrixXd::Random(3, 3).triangularView<Eigen::Upper>();
  const EvaluationRecord back = read_line(to_line(record));
  EXPECT_EQ(back.derivatives, Derivatives::kGaussNewton);
  EXPECT_EQ(back.evaluation.jacobian_root, record.evaluation.jacobian_root);
  EXPECT_EQ(back.evaluation.gradient, record.evaluation.gradient);
  EXPECT_THROW(
      read_line(edited_line(to_line(record), [](Json* line) { (*line)["root"].push_back(1.0); })),
      std::exception);
  record.evaluation.status = {StatusCode::kNonFinite, 0.1, "no number"};
  EXPECT_EQ(read_line(to_line(record)).derivatives, Derivatives::kGaussNewton)
      << "a failure belongs to what was asked for";
}

TEST(EvaluationRecord, AFailureHasItsCauseAndNumbersThatJsonHasNot) {
  EvaluationRecord record;
  record.evaluation.status = {StatusCode::kNonFiniteGradient, 0.25, "not \xe4 number"};
  record.evaluation.objective = std::numeric_limits<double>::quiet_NaN();
  record.evaluation.statistics.energy_error = std::numeric_limits<double>::infinity();
  const EvaluationRecord back = read_line(to_line(record));
  EXPECT_EQ(back.evaluation.status.code, StatusCode::kNonFiniteGradient);
  EXPECT_EQ(back.evaluation.status.time, 0.25);
  EXPECT_EQ(back.evaluation.status.cause, "not \xef\xbf\xbd number");
  EXPECT_TRUE(std::isinf(back.evaluation.statistics.energy_error));
  EXPECT_EQ(back.evaluation.gradient.size(), 0);
  EXPECT_EQ(back.derivatives, Derivatives::kNone);
}

TEST(EvaluationRecord, WithoutGradientThereIsNone) {
  EvaluationRecord record = record_of({1.0});
  record.derivatives = Derivatives::kNone;
  record.evaluation.gradient.resize(0);
  EXPECT_EQ(to_line(record).find("gradient\":["), std::string::npos);
  EXPECT_EQ(read_line(to_line(record)).evaluation.gradient.size(), 0);
}

TEST(EvaluationRecord, WhatIsNoRecordThrows) {
  const std::string whole = to_line(record_of({1.0}));
  for (const std::string& text :
       {std::string("{\"system\":0"), std::string("{}"), std::string(), std::string("[1]")}) {
    EXPECT_THROW(read_line(text), std::exception) << text;
    EXPECT_THROW(read_line(with_checksum(text + "}")), std::exception) << text;
  }
  EXPECT_THROW(read_line(edited_line(whole, [](Json* line) { (*line)["status"] = "victory"; })),
               std::exception);
  EXPECT_NO_THROW(read_line(edited_line(whole, [](Json*) {})));
}

}  // namespace

}  // namespace codesign
