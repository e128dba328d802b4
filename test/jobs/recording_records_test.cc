// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <limits>

#include "equations/equations.h"
#include "excitation/excited_cases.h"
#include "jobs/json.h"
#include "jobs/recording_records.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

TEST(RecordingRecords, TellWhatARecordingHolds) {
  JointRecording recording = swing(400);
  recording.joints[0].velocity.clear();
  FilterOptions filter;
  filter.cutoff = 10.0;
  filter.decimate = 2;
  Warnings warnings;
  const RecordingSummary summary =
      summary_of(recording, measured_motion(recording, filter, &warnings));
  EXPECT_EQ(summary.samples, 400U);
  EXPECT_NEAR(summary.rate, 100.0, 1e-9);
  EXPECT_EQ(summary.fitted, 176);
  EXPECT_EQ(summary.measured, (std::vector<std::string>{"hinge/position", "hinge/effort"}));
  const Json list = to_json(std::vector<RecordingSummary>{summary});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["recording"], "identify.data[0]");
  EXPECT_EQ(list[0]["file"], "swing.csv");
  EXPECT_EQ(list[0]["to"], 3.99);
  EXPECT_EQ(list[0]["measured"][1], "hinge/effort");
}

ExcitationResult some_result() {
  ExcitationResult result;
  result.termination = "objective_tolerance_reached";
  PredictedNumber number;
  number.name = "mass";
  number.unit = "kg";
  number.nominal = 2.0;
  number.deviation_before = std::numeric_limits<double>::infinity();
  number.deviation = 0.1;
  number.half = 0.2;
  result.numbers = {number};
  result.counted = 2;
  result.criterion_before = -10.0;
  result.criterion = -14.0;
  result.points.joints = {"hinge"};
  result.points.times = {0.0, 0.5};
  result.points.position = result.points.velocity = result.points.acceleration =
      Eigen::RowVector2d(0.25, 0.5);
  result.points.effort = Eigen::RowVector2d(7.0, 8.0);
  result.rest = Eigen::VectorXd::Constant(1, 0.25);
  result.coefficients = Eigen::MatrixXd::Constant(3, 1, 0.5);
  LimitedSignal limits;
  limits.name = "hinge/velocity";
  limits.lower = -4.0;
  limits.upper = 4.0;
  result.limits = {{limits, {-3.5, 4.0}}};
  result.starts = {{-10.0, -14.0, 33, "objective_tolerance_reached"}};
  return result;
}

TEST(ExcitationRecords, Json) {
  const Json object = excitation_json(excited_pendulum(""), some_result());
  EXPECT_NEAR(object["volume_factor"].get<double>(), std::exp(2.0), 1e-12);
  EXPECT_NEAR(object["mean_factor"].get<double>(), std::exp(1.0), 1e-12);
  EXPECT_EQ(object["predicted"]["mass"]["after"]["half_interval"], 0.2);
  EXPECT_NE(to_text(object).find("\"deviation\": null"), std::string::npos) << to_text(object);
  EXPECT_EQ(object["limits"]["hinge/velocity"]["lowest"], -3.5);
  EXPECT_EQ(object["trajectory"]["kind"], "fourier");
  EXPECT_EQ(object["trajectory"]["joints"]["hinge"]["coefficients"].size(), 3U);
  EXPECT_EQ(object["starts"][0]["evaluations"], 33);
}

TEST(ExcitationRecords, NothingFoundIsShort) {
  ExcitationResult result;
  result.termination = "start_failed";
  const Json object = excitation_json(excited_pendulum(""), result);
  EXPECT_EQ(object["termination"], "start_failed");
  EXPECT_FALSE(object.contains("predicted"));
  EXPECT_TRUE(excitation_sentences(result).empty());
}

TEST(ExcitationRecords, Sentences) {
  ExcitationResult result = some_result();
  result.undetermined = {"mass and inertia appear only as mass + 4 inertia"};
  result.numbers.resize(2);
  result.counted = 1;
  EXPECT_EQ(excitation_sentences(result)[0],
            "trajectories determine 1 numbers or combinations of 2 numbers; the prior decides the "
            "other 1");
  result.status.code = StatusCode::kNotIdentifiable;
  const std::vector<std::string> sentences = excitation_sentences(result);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_NE(sentences[0].find("not identifiable by any trajectory: mass and inertia"),
            std::string::npos);
  EXPECT_NE(sentences[1].find("7.39 times smaller than"), std::string::npos) << sentences[1];
  result.criterion_before = std::numeric_limits<double>::infinity();
  EXPECT_NE(excitation_sentences(result)[1].find("does not determine"), std::string::npos);
}

TEST(ExcitationRecords, Table) {
  const ExcitationResult result = some_result();
  EXPECT_EQ(trajectory_columns(result.points),
            (std::vector<std::string>{"time", "hinge/position", "hinge/velocity",
                                      "hinge/acceleration", "hinge/effort"}));
  const auto rows = trajectory_rows(result.points);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1], (std::vector<std::string>{"0.5", "0.5", "0.5", "0.5", "8"}));
}

}  // namespace

}  // namespace codesign
