// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_loads.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with(const std::string& loads) { return kLeastStudy + "parameters: {push: {initial: 2}}\nloads:\n  - " + loads + "\n"; }

TEST(StudyLoads, ReadsAnEffort) {
  const LoadDescription load = read_text(with("{joint: slider_joint, effort: \"${3*push}\"}")).loads.at(0);
  EXPECT_EQ(load.joint, "slider_joint");
  EXPECT_TRUE(load.link.empty());
  EXPECT_EQ(load.effort.nominal(), 6.0);
  EXPECT_EQ(load.effort.at(std::vector<double>{0.08, 0.3, 4.0}), 12.0);
  EXPECT_EQ(load.where.line, 5);
}

TEST(StudyLoads, ReadsAWrench) {
  const Study study =
      read_text(with("{link: ball, force: [1, \"${push}\", 0], torque: [0, 0, 0.5], point: [0, 0.1, 0], frame: link}\n  - {link: "
                     "crank, torque: [1, 0, 0]}"));
  const LoadDescription& first = study.loads.at(0);
  EXPECT_EQ(first.link, "ball");
  EXPECT_EQ(first.force[1].nominal(), 2.0);
  EXPECT_EQ(first.torque[2].nominal(), 0.5);
  EXPECT_EQ(first.point[1].nominal(), 0.1);
  EXPECT_TRUE(first.in_link_frame);
  EXPECT_FALSE(study.loads.at(1).in_link_frame);
  EXPECT_EQ(study.loads.at(1).force[0].nominal(), 0.0);
}

TEST(StudyLoads, RefusesWhatActsOnNothingOrTwice) {
  expect_fault(with("{effort: 1}"), "loads[0]", "one joint or on one link", 5);
  expect_fault(with("{joint: slider_joint, link: ball, effort: 1}"), "loads[0]", "one joint or on one link", 5);
  expect_fault(with("3"), "loads[0]", "must be a map", 5);
  expect_fault(with("{link: ball}"), "loads[0]", "needs a force or a torque", 5);
  expect_fault(with("{link: ball, torque: [0, 0, 1], point: [0, 0, 0]}"), "loads[0].point", "where the force acts", 5);
}

TEST(StudyLoads, RefusesNamesAndNumbers) {
  expect_fault(with("{joint: slider_jont, effort: 1}"), "loads[0].joint", "did you mean \"slider_joint\"", 5);
  expect_fault(with("{joint: ball_joint, effort: 1}"), "loads[0].joint", "no single coordinate", 5);
  expect_fault(with("{joint: slider_joint, force: [1, 0, 0]}"), "loads[0].force", "unknown key", 5);
  expect_fault(with("{link: bal, force: [1, 0, 0]}"), "loads[0].link", "did you mean \"ball\"", 5);
  expect_fault(with("{link: ball, force: [1, 0]}"), "loads[0].force", "found 2", 5);
  expect_fault(with("{link: ball, force: 1}"), "loads[0].force", "three components", 5);
  expect_fault(with("{link: ball, force: [1, 0, x]}"), "loads[0].force[2]", "not a number", 5);
  expect_fault(with("{link: ball, force: [1, 0, 0], frame: world}"), "loads[0].frame", "unknown frame", 5);
  expect_fault(with("{link: ball, force: [1, 0, 0], efort: 1}"), "loads[0].efort", "unknown key", 5);
}

}  // namespace
}  // namespace codesign
