// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>

#include "math/cpu_timer.h"
#include "recordings/number_table.h"
#include "recordings/some_recording.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

NumberTable table_of(const std::string& text, CellDelimiter delimiter = CellDelimiter::kAuto) {
  return {"log.csv", text, delimiter};
}

InputFault table_fault(const std::string& text, const std::vector<int>& indices) {
  const InputFault fault = refusal_of([&] { table_of(text).read(indices); });
  EXPECT_EQ(fault.where.file, "log.csv");
  return fault;
}

TEST(NumberTable, ReadsNamesAndNumbers) {
  const NumberTable table = table_of("time,q,tau\n0,1.5,-2e-3\n0.01,+1.6,3\n");
  EXPECT_EQ(table.names(), (Names{"time", "q", "tau"}));
  EXPECT_EQ(table.width(), 3);
  const NumberTable::Columns columns = table.read({0, 2});
  EXPECT_EQ(columns.values.at(0), (std::vector<double>{0.0, 0.01}));
  EXPECT_EQ(columns.values.at(1), (std::vector<double>{-2e-3, 3.0}));
  EXPECT_EQ(columns.lines, (std::vector<std::size_t>{2, 3}));
}

TEST(NumberTable, FindsTheDelimiter) {
  EXPECT_EQ(table_of("a;b\n1;2\n").read({1}).values[0], (std::vector<double>{2.0}));
  EXPECT_EQ(table_of("a\tb\n1\t2\n").read({1}).values[0], (std::vector<double>{2.0}));
  EXPECT_EQ(table_of("  a   b \n 1 \t 2\n").read({1}).values[0], (std::vector<double>{2.0}));
  EXPECT_EQ(table_of("a, b\n1, 2\n").names(), (Names{"a", "b"}));
  EXPECT_EQ(table_of("a,x b,y\n1,x 2,y\n", CellDelimiter::kSpace).names(), (Names{"a,x", "b,y"}));
}

TEST(NumberTable, TakesFilesAsTheyAreFound) {
  const NumberTable windows =
      table_of("\xEF\xBB\xBF\"time\",\"q, raw\"\r\n0,1\r\n\r\n# paused\r\n1,2");
  EXPECT_EQ(windows.names(), (Names{"time", "q, raw"}));
  EXPECT_EQ(windows.read({1}).values[0], (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(windows.read({1}).lines, (std::vector<std::size_t>{2, 5}));
  const NumberTable numpy = table_of("# by numpy\n# time q\n0 1\n1 2\n");
  EXPECT_EQ(numpy.names(), (Names{"time", "q"}));
  EXPECT_EQ(numpy.read({0}).lines.front(), 3U);
  EXPECT_TRUE(table_of("# a comment of some words\n0 1\n1 2\n").names().empty());
  EXPECT_EQ(table_of("0,1\n1,2\n").read({0}).values[0].size(), 2U);
  EXPECT_EQ(table_of("%time,name\n1.5,hinge\n").read({0}).values[0], (std::vector<double>{1.5}));
}

TEST(NumberTable, NumbersThatAreNotFiniteAreLeftToTheCaller) {
  const NumberTable::Columns columns = table_of("t,q\n0,nan\n1,1e400\n2,1e-400\n").read({1});
  EXPECT_TRUE(std::isnan(columns.values[0][0]));
  EXPECT_TRUE(std::isinf(columns.values[0][1]));
  EXPECT_EQ(columns.values[0][2], 0.0);
}

TEST(NumberTable, NamesThePlaceOfWhatIsWrong) {
  const InputFault cell = table_fault("t,q\n0,1\n1,x2\n", {0, 1});
  EXPECT_EQ(cell.where.line, 3);
  EXPECT_EQ(cell.element, "column \"q\"");
  EXPECT_EQ(cell.value, "x2");
  EXPECT_EQ(table_fault("0,1\n1,\n", {1}).element, "column 2");
  expect_word(table_fault("0,1\n1,\n", {1}).message, "the cell is empty");
  expect_word(table_fault("t;q\n0;1,5\n", {1}).allowed, "a decimal point, no comma");
  const InputFault row = table_fault("t,q\n0,1\n1\n", {0});
  EXPECT_EQ(row.where.line, 3);
  expect_word(row.message, "a row of 1 cells, where the first has 2");
  expect_word(refusal_of([] { table_of("# nothing\n\n"); }).message, "the table has no row");
}

TEST(NumberTable, ReadsARecordingOf30SecondsAt1kHzInATenthOfASecond) {
  std::string text = "time,a,b,c,d,e,f\n";
  for (int k = 0; k < 30000; ++k) {
    text += std::to_string(0.001 * k);
    for (int column = 0; column < 6; ++column)
      text += "," + std::to_string(std::sin(0.01 * k + column)) + "12345678";
    text += "\n";
  }
  const CpuTimer timer;
  const NumberTable::Columns columns = table_of(text).read({0, 1, 2, 3, 4, 5, 6});
  const double seconds = timer.seconds();
  EXPECT_EQ(columns.lines.size(), 30000U);
  EXPECT_LT(seconds, 0.1);
  RecordProperty("milliseconds", static_cast<int>(1e3 * seconds));
}

class TableRecording : public testing::Test {
 protected:
  TableRecording() {
    description_.file = "log.csv";
    description_.element = "identify.data[0]";
    description_.where = {"study.yaml", 4};
  }
  void write(const std::string& text) const { std::ofstream(path()) << text; }
  std::string path() const { return (directory_.path() / "log.csv").string(); }
  JointRecording read() const {
    return read_table_recording(description_, path(), {"hinge", "arm/slider"});
  }
  InputFault fault() const {
    return refusal_of([this] { read(); });
  }
  static ColumnDescription column(const std::string& name, int number = 0, double scale = 1.0,
                                  double offset = 0.0) {
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
