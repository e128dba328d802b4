// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <fstream>

#include "recordings/joint_recording.h"
#include "recordings/some_recording.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

TEST(JointRecording, FindsJointsAndPlaces) {
  JointRecording recording = swing(5);
  ASSERT_NE(recording.find("hinge"), nullptr);
  EXPECT_EQ(recording.find("wheel"), nullptr);
  EXPECT_EQ(recording.place_of(3), "line 5, t = 0.03 s");
  EXPECT_EQ(recording.location_of(3).line, 5);
  recording.topic = "/joint_states";
  EXPECT_EQ(recording.place_of(3), "message 5, t = 0.03 s");
  EXPECT_EQ(recording.location_of(3).line, 0);
  recording.topic.clear();
  recording.is_given = true;
  EXPECT_EQ(part_of(recording, 1, 5).place_of(2), "sample 5, t = 0.03 s");
  EXPECT_EQ(recording.location_of(3).line, 0);
}

TEST(JointRecording, APartKeepsWhatWasNotMeasuredEmpty) {
  JointRecording recording = swing(10);
  recording.joints[0].effort.clear();
  const JointRecording part = part_of(recording, 2, 6);
  EXPECT_EQ(part.times, (std::vector<double>{0.02, 0.03, 0.04, 0.05}));
  EXPECT_EQ(part.places.front(), 4U);
  EXPECT_EQ(part.joints[0].position.size(), 4U);
  EXPECT_EQ(part.joints[0].position[1], recording.joints[0].position[3]);
  EXPECT_TRUE(part.joints[0].effort.empty());
  EXPECT_EQ(part.file, "swing.csv");
  EXPECT_EQ(part.element, "identify.data[0]");
}

class LoadRecordings : public testing::Test {
 protected:
  LoadRecordings() {
    std::ofstream file(directory_.path() / "swing.csv");
    const JointRecording recording = swing(100);
    file << "time,hinge/position,hinge/effort\n";
    for (std::size_t k = 0; k < 100; ++k)
      file << recording.times[k] << "," << recording.joints[0].position[k] << ","
           << recording.joints[0].effort[k] << "\n";
    file.close();
    identification_.data = {entry("swing.csv", "identify.data[0]")};
  }
  static RecordingDescription entry(const std::string& file, const std::string& element) {
    RecordingDescription description;
    description.file = file;
    description.element = element;
    description.where = {"study.yaml", 4};
    return description;
  }
  StudyRecordings load(const std::string& folder, const BagReader& reader = {}) {
    return load_recordings(identification_, recorded_robot(), folder, reader, &warnings_);
  }
  StudyRecordings load() { return load(directory_.path().string()); }

  TemporaryDirectory directory_;
  IdentificationDescription identification_;
  Warnings warnings_;
};

TEST_F(LoadRecordings, ReadsDataAndHoldout) {
  identification_.holdout = {
      entry((directory_.path() / "swing.csv").string(), "identify.holdout[0]")};
  identification_.holdout[0].from = 0.5;
  const StudyRecordings recordings = load();
  ASSERT_EQ(recordings.data.size(), 1U);
  ASSERT_EQ(recordings.holdout.size(), 1U);
  EXPECT_EQ(recordings.data[0].times.size(), 100U);
  EXPECT_EQ(recordings.holdout[0].times.size(), 50U);
  EXPECT_EQ(recordings.holdout[0].element, "identify.holdout[0]");
}

TEST_F(LoadRecordings, SamplesThatAreUsedTwiceAreTold) {
  identification_.holdout = {entry("swing.csv", "identify.holdout[0]")};
  identification_.holdout[0].from = 0.5;
  identification_.data[0].to = 0.495;
  load();
  EXPECT_TRUE(warnings_.empty());
  identification_.data[0].to = 0.6;
  load();
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_EQ(warnings_[0].code, "recording_repeated");
  expect_word(warnings_[0].message,
              "identify.holdout[0]: some of its samples are fitted as identify.data[0]");
  identification_.holdout.clear();
  identification_.data.push_back(entry("swing.csv", "identify.data[1]"));
  load();
  EXPECT_EQ(warnings_.size(), 2U);
}

/// A reader in place of arrays: samples `begin` to `end` - 1 of one motion, or of another one.
TEST_F(LoadRecordings, OverlappingArraysAreNoticed) {
  const auto warns = [this](std::size_t begin, std::size_t end, bool is_other) {
    warnings_.clear();
    identification_.data[0].is_bag = true;
    identification_.holdout = {identification_.data[0]};
    identification_.holdout[0].element = "identify.holdout[0]";
    load("/", [&](const RecordingDescription& of, const std::string&,
                  const std::vector<std::string>&, Warnings*) {
      const bool is_data = of.element == "identify.data[0]";
      JointRecording whole = swing(200);
      for (std::size_t k = 60; is_other && !is_data && k < whole.times.size(); ++k)
        whole.joints[0].position[k] *= 1.01;
      JointRecording part = is_data ? part_of(whole, 0, 120) : part_of(whole, begin, end);
      part.file = "arrays";
      part.is_given = true;
      for (std::size_t k = 0; k < part.places.size(); ++k) part.places[k] = k + 1;
      part.element = of.element;
      return part;
    });
    return std::any_of(warnings_.begin(), warnings_.end(),
                       [](const Warning& warning) { return warning.code == "recording_repeated"; });
  };
  EXPECT_TRUE(warns(0, 120, false));
  EXPECT_TRUE(warns(60, 200, false));
  EXPECT_FALSE(warns(120, 200, false)) << "the next part";
  EXPECT_FALSE(warns(0, 120, true)) << "begins alike";
}

TEST_F(LoadRecordings, MasksInMotionAreRefused) {
  identification_.data[0].masks = {{"hinge", 0.1, {"study.yaml", 4}}};
  EXPECT_NO_THROW(load());
  identification_.residual = ResidualKind::kMotion;
  EXPECT_EQ(refusal_of([this] { load(); }).element, "identify.data[0].mask");
}

// The study of a shipped case names a recording that its reader has to make.
TEST_F(LoadRecordings, AMissingRecordingSaysHowToGetOne) {
  identification_.data = {entry("arm.csv", "identify.data[0]")};
  const InputFault fault = refusal_of([this] { load(); });
  EXPECT_EQ(fault.element, "identify.data[0].csv");
  EXPECT_EQ(fault.where.line, 4);
  expect_word(fault.message, "there is no such recording");
  expect_word(fault.value, "arm.csv");
  expect_word(fault.allowed, "doc/case_studies.md");
}

TEST_F(LoadRecordings, ARelativePathNeedsAFolder) {
  const InputFault fault = refusal_of([this] { load(""); });
  EXPECT_EQ(fault.element, "identify.data[0].csv");
  expect_word(fault.message, "a relative path is allowed only in a study file");
}

TEST_F(LoadRecordings, CalibratedJointsMustBeThereWithTheirEffort) {
  identification_.joints.resize(1);
  identification_.joints[0].joint = "hinge";
  identification_.joints[0].where = {"study.yaml", 9};
  EXPECT_EQ(load().data.size(), 1U);
  identification_.joints[0].joint = "wheel";
  const InputFault fault = refusal_of([this] { load(); });
  EXPECT_EQ(fault.where.line, 9);
  EXPECT_EQ(fault.element, "identify.joints.wheel");
  expect_word(fault.message, "unknown joint in");
  EXPECT_EQ(fault.allowed, "hinge");
  std::ofstream(directory_.path() / "swing.csv") << "time,wheel/position\n0,1\n";
  expect_word(refusal_of([this] { load(); }).message, "no effort of this joint was recorded");
}

TEST_F(LoadRecordings, BagsAreReadByTheCaller) {
  identification_.data[0].is_bag = true;
  identification_.data[0].file = "swing.bag";
  const InputFault fault = refusal_of([this] { load(); });
  EXPECT_EQ(fault.element, "identify.data[0].bag");
  expect_word(fault.message, "installed without ROS");
  std::string asked;
  const BagReader reader = [&asked](const RecordingDescription&, const std::string& path,
                                    const std::vector<std::string>& joints, Warnings*) {
    asked = path + " " + std::to_string(joints.size());
    return swing(50);
  };
  EXPECT_EQ(load("/logs", reader).data[0].times.size(), 50U);
  EXPECT_EQ(asked, "/logs/swing.bag 3");
}

TEST_F(LoadRecordings, ACancelEndsItBehindTheFileThatIsRead) {
  RecordingDescription bag = entry("swing.bag", "identify.data[0]");
  bag.is_bag = true;
  identification_.data = {bag, bag};
  identification_.holdout = {bag};
  std::atomic<bool> cancel{false};
  int read = 0;
  const BagReader reader = [&](const RecordingDescription&, const std::string&,
                               const std::vector<std::string>&, Warnings*) {
    ++read;
    cancel = true;
    return swing(3);  // as far as it came; too short to be used
  };
  const StudyRecordings recordings =
      load_recordings(identification_, recorded_robot(), "/", reader, &warnings_, &cancel);
  EXPECT_EQ(read, 1);
  EXPECT_TRUE(recordings.data.empty());
  EXPECT_TRUE(recordings.holdout.empty());
  expect_word(refusal_of([&] { load("/", reader); }).message, "3 samples");
}

class RecordedSpeed : public LoadRecordings {
 protected:
  RecordedSpeed() {
    write(0.0);
    identification_.data[0].file = "speed.csv";
    StartPosition start;
    start.joint = "hinge";
    start.position.value = 0.3;
    start.position.where = {"study.yaml", 5};
    identification_.data[0].starts = {start};
  }
  /// @param gap in the middle [s]
  void write(double gap) {
    std::ofstream file(directory_.path() / "speed.csv");
    const JointRecording recording = swing(100);
    file << "time,hinge/velocity,slider/position\n";
    for (std::size_t k = 0; k < 100; ++k)
      file << recording.times[k] + (k < 50 ? 0.0 : gap) << "," << recording.joints[0].velocity[k]
           << ",0\n";
  }
};

TEST_F(RecordedSpeed, GetsItsStart) {
  const JointRecording recording = load().data.at(0);
  EXPECT_EQ(recording.find("hinge")->start.value().value, 0.3);
  EXPECT_FALSE(recording.find("slider")->start.has_value());
  identification_.data[0].from = 0.5;
  EXPECT_EQ(load().data.at(0).find("hinge")->start.value().value, 0.3);
}

TEST_F(RecordedSpeed, OnlyWhereAVelocityIsAllThatIsKnown) {
  identification_.data[0].starts[0].joint = "slider";
  InputFault fault = refusal_of([this] { load(); });
  EXPECT_EQ(fault.element, "identify.data[0].start.slider");
  EXPECT_EQ(fault.where.line, 5);
  expect_word(fault.message, "positions of this joint were recorded");
  identification_.data[0].starts[0].joint = "wheel";
  fault = refusal_of([this] { load(); });
  expect_word(fault.message, "unknown joint in");
  expect_word(fault.allowed, "hinge");
  identification_.data[0].starts[0].joint = "hinge";
  std::ofstream(directory_.path() / "speed.csv")
      << "time,hinge/effort\n0,1\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n8,1\n9,1\n"
         "10,1\n11,1\n12,1\n13,1\n14,1\n15,1\n16,1\n17,1\n18,1\n19,1\n20,1\n";
  expect_word(refusal_of([this] { load(); }).message, "no velocity of this joint was recorded");
}

TEST_F(RecordedSpeed, IsNotFollowedOverAGap) {
  write(1.0);
  identification_.data[0].gaps = GapRule::kSplit;
  const InputFault fault = refusal_of([this] { load(); });
  EXPECT_EQ(fault.element, "identify.data[0].gaps");
  expect_word(fault.message, "after a gap the positions");
  identification_.data[0].starts.clear();
  EXPECT_EQ(load().data.size(), 2U);
}

TEST_F(LoadRecordings, APieceTooShortForTheFilterIsLeftOut) {
  std::ofstream file(directory_.path() / "gap.csv");
  const JointRecording recording = swing(400);
  file << "time,hinge/position,hinge/effort\n";
  for (std::size_t k = 0; k < 400; ++k)
    if (k < 350 || k >= 370)
      file << recording.times[k] << "," << recording.joints[0].position[k] << ","
           << recording.joints[0].effort[k] << "\n";
  file.close();
  identification_.data = {entry("gap.csv", "identify.data[0]")};
  identification_.data[0].gaps = GapRule::kSplit;
  EXPECT_EQ(load().data.size(), 2U) << "without a filter 30 samples are enough";
  EXPECT_TRUE(warnings_.empty());
  identification_.filter.cutoff = identification_.filter.residual_cutoff = 10.0;
  EXPECT_EQ(load().data.size(), 1U);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_EQ(warnings_[0].code, "recording_piece_dropped");
  expect_word(warnings_[0].message, "the filters leave");
}

}  // namespace
}  // namespace codesign
