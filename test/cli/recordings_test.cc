// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "cli/run_fixture.h"
#include "codegen/traced.h"
#include "jobs/json.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

const std::string kHingeModel = R"(<robot name="pendulum">
  <link name="ground"/>
  <link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
    <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="ground"/><child link="bob"/><axis xyz="0 1 0"/></joint>
</robot>
)";

/// A study beside a recording of 3 s at 100 Hz, in degrees.
class RecordingsTable : public testing::Test {
 protected:
  RecordingsTable() {
    std::ofstream(folder_.path("model.urdf")) << kHingeModel;
    std::ofstream table(folder_.path("log.csv"));
    table << "t;angle;current\n";
    for (int k = 0; k < 300; ++k)
      table << 0.01 * k << ";" << 30.0 * std::sin(0.03 * k) << ";" << std::cos(0.03 * k) << "\n";
  }
  Outcome check(const std::string& columns, bool json = false) const {
    std::ofstream(folder_.path("study.yaml"))
        << "identify:\n  data: [{csv: log.csv, columns: {" << columns
        << "}}]\n  filter: {cutoff: 10}\n  joints: {hinge: {effort_scale: 11.13, offset: {}}}\n";
    std::vector<std::string> words = {"check", folder_.path("model.urdf"),
                                      folder_.path("study.yaml")};
    if (json) words.emplace_back("--json");
    return run_words(words);
  }

  ScratchFolder folder_;
};

TEST_F(RecordingsTable, CheckShowsTheRecordingsOfAStudy) {
  const std::string columns =
      "time: t, hinge/position: {column: angle, scale: 0.0174532925}, hinge/effort: current";
  const Outcome outcome = check(columns);
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find("identify.data[0]      300        100         0    2.99     212"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("identify.data[0]: hinge/position, hinge/effort ("), std::string::npos)
      << outcome.out;
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  const Json recordings = json_of(check(columns, true))["recordings"];
  ASSERT_EQ(recordings.size(), 1U);
  EXPECT_EQ(recordings[0]["fitted"], 212);
}

TEST_F(RecordingsTable, CheckNamesThePlaceOfWhatIsWrongInARecording) {
  const Outcome outcome = check("time: t, hinge/position: angel, hinge/effort: current");
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(
      outcome.err.find("study.yaml:2: identify.data[0].columns.hinge/position: unknown column of"),
      std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("did you mean \"angle\""), std::string::npos) << outcome.err;
}

TEST_F(RecordingsTable, ABagNeedsAReader) {
  std::ofstream(folder_.path("study.yaml")) << "identify:\n  data: [{bag: log.bag, topic: "
                                               "joint_states}]\n  joints: {hinge: {offset: {}}}\n";
  const Outcome outcome =
      run_words({"check", folder_.path("model.urdf"), folder_.path("study.yaml")});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("this program is installed without ROS"), std::string::npos)
      << outcome.err;
}

}  // namespace

}  // namespace codesign::cli
