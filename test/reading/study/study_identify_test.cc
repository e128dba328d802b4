// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <cmath>

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

// Lines 1 and 2; `identify:` begins in line 3.
const std::string kStudyToIdentify =
    "duration: 2.0\nparameters: {rod_length: {}, crank_length: {tune: false}}\n";
const std::string kSomeData = "data: [{csv: excite.csv}]";

IdentificationDescription identification_of(const std::string& keys) {
  return read_text(kStudyToIdentify + "identify: {" + kSomeData + (keys.empty() ? "" : ", ") +
                   keys + "}\n")
      .identification.value();
}

void expect_bad_identify(const std::string& keys, const std::string& element,
                         const std::string& message) {
  expect_fault(kStudyToIdentify + "identify: {" + kSomeData + ", " + keys + "}\n", element, message,
               3);
}

TEST(StudyIdentify, IsThereOnlyIfWritten) {
  EXPECT_FALSE(read_text(kStudyToIdentify).identification.has_value());
  const IdentificationDescription description = identification_of("");
  EXPECT_EQ(description.data.size(), 1U);
  EXPECT_TRUE(description.holdout.empty());
  EXPECT_EQ(description.residual, ResidualKind::kEffort);
  EXPECT_EQ(description.segment, 1.0);
  EXPECT_EQ(description.filter.cutoff, 0.0);
  EXPECT_EQ(description.loss.kind, LossKind::kSquare);
  EXPECT_EQ(description.intervals.noise, NoiseModel::kCorrelated);
  EXPECT_EQ(description.intervals.level, 0.95);
  EXPECT_EQ(description.where.line, 3);
}

TEST(StudyIdentify, ReadsAllKeys) {
  const IdentificationDescription description = identification_of(
      "holdout: [{bag: ptp.bag, topic: /joint_states}], residual: motion, segment: 0.5, "
      "filter: {cutoff: 60.0, residual_cutoff: 20.0, order: 2, decimate: 10}, loss: {type: "
      "soft_l1, scale: 2.0}, "
      "intervals: {level: 0.9, noise: bootstrap, lag: 30, profiles: true}");
  EXPECT_EQ(description.holdout.at(0).topic, "/joint_states");
  EXPECT_EQ(description.residual, ResidualKind::kMotion);
  EXPECT_EQ(description.segment, 0.5);
  EXPECT_EQ(description.filter.cutoff, 60.0);
  EXPECT_EQ(description.filter.residual_cutoff, 20.0);
  EXPECT_EQ(description.filter.order, 2);
  EXPECT_EQ(description.filter.decimate, 10);
  EXPECT_EQ(description.loss.kind, LossKind::kSoftL1);
  EXPECT_EQ(description.loss.scale, 2.0);
  EXPECT_EQ(description.intervals.level, 0.9);
  EXPECT_EQ(description.intervals.noise, NoiseModel::kBootstrap);
  EXPECT_EQ(description.intervals.lag, 30);
  EXPECT_TRUE(description.intervals.profiles);
}

TEST(StudyIdentify, EffortsAreFilteredLikeTheMotionUnlessSaidOtherwise) {
  EXPECT_EQ(identification_of("filter: {cutoff: 30}").filter.residual_cutoff, 30.0);
  EXPECT_EQ(identification_of("filter: {cutoff: 30, residual_cutoff: 0}").filter.residual_cutoff,
            0.0);
}

TEST(StudyIdentify, AHoldoutStartsWhereTheStudySays) {
  const std::string start = "holdout: [{csv: ptp.csv, start: {crank_joint: ";
  EXPECT_EQ(identification_of(start + "0.4}}]").holdout.at(0).starts.at(0).position.value, 0.4);
  expect_bad_identify(start + "{}}}]", "identify.holdout[0].start.crank_joint",
                      "a holdout is never fitted");
}

TEST(StudyIdentify, ANumberIsKnownAndAMapIsFitted) {
  const JointCalibration joint = identification_of(
                                     "joints: {crank_joint: {effort_scale: 11.13, delay: {initial: "
                                     "0.001, upper: 0.02}, offset: {}}}")
                                     .joints.at(0);
  EXPECT_EQ(joint.joint, "crank_joint");
  EXPECT_EQ(joint.effort_scale.value, 11.13);
  EXPECT_FALSE(joint.effort_scale.is_fitted);
  EXPECT_TRUE(joint.delay.is_fitted);
  EXPECT_EQ(joint.delay.value, 0.001);
  EXPECT_EQ(joint.delay.lower, 0.0);
  EXPECT_EQ(joint.delay.upper, 0.02);
  EXPECT_TRUE(joint.offset.is_fitted);
  EXPECT_EQ(joint.offset.value, 0.0);
  EXPECT_TRUE(std::isinf(joint.offset.lower));
  const JointCalibration plain =
      identification_of("joints: {slider_joint: {effort_scale: {}}}").joints.at(0);
  EXPECT_EQ(plain.effort_scale.value, 1.0);
  EXPECT_TRUE(plain.effort_scale.is_fitted);
  EXPECT_EQ(
      identification_of("joints: {crank_joint: {delay: {lower: -0.1}}}").joints.at(0).delay.lower,
      -0.1);
  EXPECT_EQ(identification_of("joints: {crank_joint: {delay: -0.01}}").joints.at(0).delay.value,
            -0.01);
  EXPECT_FALSE(plain.delay.is_fitted);
}

TEST(StudyIdentify, MayHaveNothingToIdentifyOrNoRecordings) {
  EXPECT_TRUE(read_text(kStudyToIdentify + "identify: {}\n").identification->data.empty())
      << "a program may have them as arrays";
  EXPECT_TRUE(read_text("duration: 1\nidentify: {" + kSomeData + "}\n").identification.has_value())
      << "the model as it stands is judged";
  EXPECT_TRUE(
      read_text("duration: 1\nidentify: {" + kSomeData + ", joints: {crank_joint: {offset: {}}}}\n")
          .identification.has_value());
}

TEST(StudyIdentify, NeedsNoDurationOfItsOwn) {
  EXPECT_EQ(
      read_text("parameters: {rod_length: {}}\nidentify: {" + kSomeData + ", segment: 0.25}\n")
          .duration,
      0.25);
  EXPECT_EQ(read_text("parameters: {rod_length: {}}\nidentify: {" + kSomeData + "}\n").duration,
            1.0);
  expect_fault("parameters: {rod_length: {}}\n", "duration", "required key is missing", 1);
}

}  // namespace
}  // namespace codesign
