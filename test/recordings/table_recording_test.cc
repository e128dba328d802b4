// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/table_recording.h"

#include <fstream>

#include "recordings/some_recording.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

class TableRecording : public testing::Test {
 protected:
  TableRecording() {
    description_.file = "log.csv";
    description_.element = "identify.data[0]";
    description_.where = {"study.yaml", 4};
  }
  void write(const std::string& text) const { std::ofstream(path()) << text; }
  std::string path() const { return (directory_.path() / "log.csv").string(); }
  JointRecording read() const { return read_table_recording(description_, path(), {"hinge", "arm/slider"}); }
  InputFault fault() const {
    return refusal_of([this] { read(); });
  }
  static ColumnDescription column(const std::string& name, int number = 0, double scale = 1.0, double offset = 0.0) {
    return {name, number, scale, offset, {"study.yaml", 5}, "identify.data[0].columns.x"};
  }

  TemporaryDirectory directory_;
  RecordingDescription description_;
};

TEST_F(TableRecording, FindsColumnsThatAreNamedLikeSignals) {
  write("time,hinge/position,hinge/effort,arm/slider/velocity,other\n0,1,2,3,x\n1,4,5,6,y\n");
  const JointRecording recording = read();
  EXPECT_EQ(recording.times, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(recording.places, (std::vector<std::size_t>{2, 3}));
  ASSERT_EQ(recording.joints.size(), 2U);
  EXPECT_EQ(recording.find("hinge")->position, (std::vector<double>{1.0, 4.0}));
  EXPECT_EQ(recording.find("hinge")->effort, (std::vector<double>{2.0, 5.0}));
  EXPECT_TRUE(recording.find("hinge")->velocity.empty());
  EXPECT_EQ(recording.find("arm/slider")->velocity, (std::vector<double>{3.0, 6.0}));
  EXPECT_EQ(recording.file, path());
}

TEST_F(TableRecording, ColumnsHaveScaleAndOffset) {
  write("stamp q i\n1000 180 2\n1010 90 3\n");
  description_.time = column("stamp", 0, 1e-3);
  description_.columns = {{"hinge", MeasuredQuantity::kPosition, column("", 2, 0.5, -10.0)},
                          {"hinge", MeasuredQuantity::kEffort, column("i", 0, -2.0)}};
  const JointRecording recording = read();
  EXPECT_DOUBLE_EQ(recording.times[1], 1.01);
  EXPECT_EQ(recording.find("hinge")->position, (std::vector<double>{80.0, 35.0}));
  EXPECT_EQ(recording.find("hinge")->effort, (std::vector<double>{-4.0, -6.0}));
}

TEST_F(TableRecording, SaysWhichColumnIsNotThere) {
  write("stamp,angle\n0,1\n");
  expect_word(fault().message, "no column named time or t, but stamp, angle");
  description_.time = column("stmp");
  EXPECT_EQ(fault().where.line, 5);
  expect_word(fault().message, "did you mean \"stamp\"");
  description_.time = column("", 3);
  expect_word(fault().message, "the table has 2 columns");
  EXPECT_EQ(fault().allowed, "from 1 to 2");
  write("0,1\n");
  description_.time = column("stamp");
  expect_word(fault().message, "have no names");
  write("t,t,q\n0,1,2\n");
  description_.time = column("t");
  expect_word(fault().message, "several columns have this name");
}

TEST_F(TableRecording, ATableOfAnotherRobotIsRefused) {
  write("time,wrist/position\n0,1\n");
  expect_word(fault().message, "with a joint of the model, but time, wrist/position");
}

TEST_F(TableRecording, AFileMustBeThere) {
  EXPECT_EQ(fault().element, "identify.data[0].csv");
  EXPECT_EQ(fault().where.file, "study.yaml");
  expect_word(fault().message, "No such file");
}

}  // namespace
}  // namespace codesign
