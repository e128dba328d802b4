// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with_reference(const std::string& reference) {
  return "duration: 2.0\nobjective: {integral: [{signal: crank_joint/velocity, reference: " +
         reference + "}]}\nparameters: {A: {initial: 2.0}}\n";
}

ReferenceDescription read_reference_text(const std::string& reference) {
  return read_text(with_reference(reference)).integral.at(0).reference;
}

void expect_bad_reference(const std::string& reference, const std::string& key,
                          const std::string& message) {
  expect_fault(with_reference(reference), "objective.integral[0].reference" + key, message, 2);
}

TEST(StudyReferences, ANumberOrAnExpressionIsConstant) {
  EXPECT_EQ(read_reference_text("3.0").constant.nominal(), 3.0);
  EXPECT_EQ(read_reference_text("\"${2*A}\"").constant.nominal(), 4.0);
  expect_bad_reference("fast", "", "not a number");
}

TEST(StudyReferences, ASine) {
  const ReferenceDescription sine = read_reference_text(
      "{type: sine, amplitude: \"${A}\", period: 0.5, phase: 1.0, offset: -1.0}");
  EXPECT_EQ(sine.kind, ReferenceDescription::Kind::kSine);
  EXPECT_EQ(sine.sine.amplitude.nominal(), 2.0);
  EXPECT_TRUE(sine.sine.is_period);
  EXPECT_EQ(sine.sine.frequency.nominal(), 0.5);
  EXPECT_EQ(sine.sine.phase.nominal(), 1.0);
  EXPECT_EQ(sine.sine.offset.nominal(), -1.0);
  expect_bad_reference("{type: sine, amplitude: 1.0}", "", "either a frequency or a period");
  expect_bad_reference("{type: sine, amplitude: 1.0, frequency: 1.0, period: 1.0}", "",
                       "either a frequency or a period");
  expect_bad_reference("{type: sine, amplitude: 1.0, frequency: 0.0}", ".frequency",
                       "not above zero");
  expect_bad_reference("{type: sine, amplitude: 1.0, frequenzy: 2.0}", ".frequenzy",
                       "did you mean \"frequency\"");
  expect_bad_reference("{type: sin, amplitude: 1.0, frequency: 2.0}", ".type",
                       "did you mean \"sine\"");
}

TEST(StudyReferences, Waypoints) {
  const ReferenceDescription points = read_reference_text(
      "{type: waypoints, times: [0.0, 1.0, 2.5], positions: [0.0, \"${A}\", 1.0], velocities: [0, "
      "1, 0], interpolation: cubic}");
  EXPECT_EQ(points.kind, ReferenceDescription::Kind::kWaypoints);
  EXPECT_EQ(points.waypoints.interpolation, Interpolation::kCubic);
  EXPECT_EQ(points.waypoints.times, (std::vector<double>{0.0, 1.0, 2.5}));
  EXPECT_EQ(points.waypoints.positions.at(1).nominal(), 2.0);
  EXPECT_EQ(points.waypoints.velocities.size(), 3U);
  EXPECT_TRUE(points.waypoints.accelerations.empty());
  EXPECT_EQ(read_reference_text("{type: waypoints, times: [0, 1], positions: [0, 1]}")
                .waypoints.interpolation,
            Interpolation::kMonotone);
  EXPECT_EQ(read_reference_text(
                "{type: waypoints, times: [0, 1], positions: [0, 1], interpolation: quintic}")
                .waypoints.interpolation,
            Interpolation::kQuintic);
  expect_bad_reference("{type: waypoints, times: [0.0], positions: [0.0]}", ".times",
                       "at least two");
  expect_bad_reference("{type: waypoints, times: [0, 1, 1], positions: [0, 1, 2]}", ".times",
                       "must ascend");
  expect_bad_reference("{type: waypoints, times: [0, 1], positions: [0, 1, 2]}", ".positions",
                       "found 3 values for 2 times");
  expect_bad_reference("{type: waypoints, times: [0, 1], positions: [0, 1], accelerations: [1]}",
                       ".accelerations", "found 1 values");
  expect_bad_reference(
      "{type: waypoints, times: [0, 1], positions: [0, 1], velocities: [1, 1], interpolation: "
      "linear}",
      ".velocities", "does not use velocities");
  expect_bad_reference(
      "{type: waypoints, times: [0, 1], positions: [0, 1], accelerations: [1, 1], interpolation: "
      "cubic}",
      ".accelerations", "only monotone and quintic");
  expect_bad_reference("{type: waypoints, times: [0, 1], positions: [0, 1], interpolation: cubik}",
                       ".interpolation", "did you mean \"cubic\"");
}

constexpr const char* kInBag =
    "{type: trajectory, bag: moves.bag, topic: /arm/command, joint: crank_joint}";

TEST(StudyReferences, ATrajectoryInABagIsLeftToWhoCanReadIt) {
  TrajectoryAddress asked;
  const auto loader = [&asked](const TrajectoryAddress& address) {
    asked = address;
    return RecordedTrajectory{{0.0, 1.0}, {0.5, 2.0}, {0.0, 0.1}, {}};
  };
  const Study study = read_study({"study.yaml", with_reference(kInBag)}, study_robot(), loader);
  EXPECT_EQ(asked.bag, "moves.bag");
  EXPECT_EQ(asked.topic, "/arm/command");
  EXPECT_EQ(asked.joint, "crank_joint");
  EXPECT_EQ(asked.where.line, 2);
  const WaypointsDescription& points = study.integral.at(0).reference.waypoints;
  EXPECT_EQ(points.times, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(points.positions.at(1).nominal(), 2.0);
  EXPECT_EQ(points.velocities.at(1).nominal(), 0.1);
  EXPECT_TRUE(points.accelerations.empty());
}

TEST(StudyReferences, ATrajectoryInATable) {
  const std::string table = "t,height,note\n0,0.5,a\n0.5,0.7,b\n1.5,nan,c\n";
  const auto read = [&](const std::string& reference, const std::string& text) {
    const FileLoader files = [&text](const FileAddress& address) {
      EXPECT_EQ(address.file, "road.csv");
      return SourceText{"road.csv", text};
    };
    return read_study({"study.yaml", with_reference(reference)}, study_robot(), {}, files);
  };
  const std::string reference = "{type: trajectory, csv: road.csv, column: height, time: t}";
  const Study study = read(reference, table.substr(0, table.find("1.5")));
  const WaypointsDescription& points = study.integral.at(0).reference.waypoints;
  EXPECT_EQ(points.times, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(points.positions.at(1).nominal(), 0.7);
  EXPECT_TRUE(points.velocities.empty());
  const auto fault = [&](const std::string& of, const std::string& text) {
    try {
      read(of, text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(fault(reference, table).find("road.csv:4: column \"height\": not finite"),
            std::string::npos)
      << fault(reference, table);
  const std::string back = fault(reference, "t,height\n0,0\n\n2,1\n1,2\n");
  EXPECT_NE(
      back.find(
          "road.csv:5: column \"t\": the times must ascend, and this one does not come later"),
      std::string::npos)
      << back;
  const std::string long_row = fault(reference, "t;height\n0;0\n1;2;3\n");
  EXPECT_NE(long_row.find("road.csv:3: a row of 3 cells, where the first has 2"), std::string::npos)
      << long_row;
  EXPECT_NE(long_row.find("`delimiter`"), std::string::npos) << long_row;
  EXPECT_NE(fault("{type: trajectory, csv: road.csv, column: hight, time: t}", table)
                .find("did you mean \"height\""),
            std::string::npos);
  EXPECT_NE(fault("{type: trajectory, csv: road.csv, column: height}", table).find("road.csv:1"),
            std::string::npos);
  EXPECT_NE(fault(reference, "t,height\n0,0.5\n# a note\n1,0.7\n1,0.8\n")
                .find("road.csv:5: column \"t\": the times must ascend"),
            std::string::npos);
  EXPECT_NE(
      fault(reference, "t,height\n0,0.5\n").find("road.csv:1: column \"t\": a trajectory needs"),
      std::string::npos);
  EXPECT_THROW(read_study({"study.yaml", with_reference(reference)}, study_robot()), InputError);
  // The comma is the decimal point of the names, and the semicolon the separator.
  const std::string semicolons = "t;height,left\n0;0.5\n0.5;0.7\n";
  const std::string of_left = "{type: trajectory, csv: road.csv, column: \"height,left\", time: t";
  EXPECT_NE(fault(of_left + ", delimiter: comma}", semicolons).find("column of road.csv"),
            std::string::npos);
  EXPECT_NE(fault(reference, "t,height\n0,0.5\n1,0.7,3\n").find("road.csv:3: a row of 3 cells"),
            std::string::npos);
  EXPECT_EQ(read(of_left + ", delimiter: semicolon}", semicolons)
                .integral.at(0)
                .reference.waypoints.positions.size(),
            2u);
}

TEST(StudyReferences, AnExpressionOfTime) {
  const ReferenceDescription wave = read_reference_text("\"${A*sin(2*t)}\"");
  EXPECT_EQ(wave.kind, ReferenceDescription::Kind::kExpression);
  EXPECT_EQ(dependencies(wave), std::vector<int>{2});
  EXPECT_EQ(read_reference_text("\"${2*A}\"").kind, ReferenceDescription::Kind::kConstant);
  expect_bad_reference("\"${A*log(t)}\"", "", "not finite at t = 0");
  expect_bad_reference("\"${B*t}\"", "", "unknown name 'B'");
}

}  // namespace
}  // namespace codesign
