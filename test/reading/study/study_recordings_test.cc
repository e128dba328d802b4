// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <cmath>

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

const std::string kRecordedStudy =
    "duration: 2.0\nparameters: {rod_length: {}}\nidentify:\n  data: ";

std::vector<RecordingDescription> recordings_of(const std::string& list) {
  return read_text(kRecordedStudy + list + "\n").identification.value().data;
}

void expect_bad_recording(const std::string& entry, const std::string& element,
                          const std::string& message) {
  expect_fault(kRecordedStudy + "[" + entry + "]\n", "identify.data[0]" + element, message, 4);
}

TEST(StudyRecordings, ReadsABag) {
  const RecordingDescription bag =
      recordings_of("[{bag: excite.bag, topic: /joint_states, from: 7.0, to: 37.0}]").at(0);
  EXPECT_TRUE(bag.is_bag);
  EXPECT_EQ(bag.file, "excite.bag");
  EXPECT_EQ(bag.topic, "/joint_states");
  EXPECT_EQ(bag.from, 7.0);
  EXPECT_EQ(bag.to, 37.0);
  EXPECT_EQ(bag.stamp, StampKind::kHeader);
  EXPECT_EQ(bag.gaps, GapRule::kRefuse);
  EXPECT_EQ(bag.element, "identify.data[0]");
  EXPECT_EQ(bag.where.line, 4);
  EXPECT_EQ(recordings_of("[{bag: a.bag, topic: b, stamp: receive}]").at(0).stamp,
            StampKind::kReceive);
}

TEST(StudyRecordings, ReadsATable) {
  const std::vector<RecordingDescription> both = recordings_of(
      "\n    - {csv: a.csv}\n    - {csv: b.txt, delimiter: space, gaps: split, columns: {time: "
      "{column: t, scale: 0.001}, "
      "crank_joint/position: 2, slider_joint/effort: {column: force, scale: 35.15, offset: -1}}}");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_FALSE(both[0].is_bag);
  EXPECT_FALSE(both[0].time.has_value());
  EXPECT_TRUE(std::isinf(both[0].from) && std::isinf(both[0].to));
  const RecordingDescription& table = both[1];
  EXPECT_EQ(table.delimiter, CellDelimiter::kSpace);
  EXPECT_EQ(table.gaps, GapRule::kSplit);
  EXPECT_EQ(table.time.value().name, "t");
  EXPECT_EQ(table.time.value().scale, 0.001);
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].joint, "crank_joint");
  EXPECT_EQ(table.columns[0].quantity, MeasuredQuantity::kPosition);
  EXPECT_EQ(table.columns[0].column.number, 2);
  EXPECT_EQ(table.columns[1].quantity, MeasuredQuantity::kEffort);
  EXPECT_EQ(table.columns[1].column.name, "force");
  EXPECT_EQ(table.columns[1].column.offset, -1.0);
}

TEST(StudyRecordings, WhereJointsWithoutPositionsStart) {
  const RecordingDescription both = recordings_of(
                                        "[{csv: a.csv, start: {crank_joint: {initial: 0.2, lower: "
                                        "-1, upper: 2}, slider_joint: 0.1}}]")
                                        .at(0);
  ASSERT_EQ(both.starts.size(), 2U);
  EXPECT_EQ(both.starts[0].joint, "crank_joint");
  EXPECT_TRUE(both.starts[0].position.is_fitted);
  EXPECT_EQ(both.starts[0].position.value, 0.2);
  EXPECT_EQ(both.starts[0].position.lower, -1.0);
  EXPECT_EQ(both.starts[0].position.upper, 2.0);
  EXPECT_FALSE(both.starts[1].position.is_fitted);
  EXPECT_EQ(both.starts[1].position.value, 0.1);
  EXPECT_EQ(both.starts[1].position.where.line, 4);
  EXPECT_EQ(recordings_of("[{bag: a.bag, topic: b, start: {crank_joint: 1}}]").at(0).starts.size(),
            1U);
  expect_bad_recording("{csv: a.csv, start: {crank_joit: 1}}", ".start.crank_joit",
                       "did you mean \"crank_joint\"?");
  expect_bad_recording("{csv: a.csv, start: {crank_joint: {low: 1}}}", ".start.crank_joint.low",
                       "unknown key");
  expect_bad_recording("{csv: a.csv, start: {crank_joint: here}}", ".start.crank_joint", "");
}

}  // namespace
}  // namespace codesign
