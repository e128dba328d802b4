// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/event_markers.h"

#include <gtest/gtest.h>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

const MessageContext kEventContext{ros::Time(2.0), "initial/ground"};

RecordedRun run_with_events(const std::vector<RunEvent>& events) {
  RecordedRun run{sample_names(), {sample_frame(0.0), sample_frame(1.0)}, {}, sample_parents()};
  run.events = events;
  return run;
}

TEST(EventMarkers, AMessageHasTheWholeEvent) {
  const auto message =
      event_message({0.5, "loads[0].effort", "hinge", "t < 0.5", true, false}, kEventContext);
  EXPECT_EQ(message.header.stamp, ros::Time(2.0));
  EXPECT_EQ(message.element, "loads[0].effort");
  EXPECT_EQ(message.object, "hinge");
  EXPECT_EQ(message.expression, "t < 0.5");
  EXPECT_TRUE(message.rising);
  EXPECT_FALSE(message.jump);
}

TEST(EventMarkers, TextsStandAboveTheirLinksOneAboveTheOther) {
  const Event event{0.5, "loads[0].effort", "hinge", "t < 0.5", true, false};
  Event soon = event, later = event;
  soon.time += 0.5 * kEventLifetime;
  later.time += 3.0 * kEventLifetime;
  const RecordedRun run = run_with_events({{event, 1}, {soon, 1}, {soon, 2}, {later, 1}});
  const SceneLayout layout = lay_out({{run.names, run.frames, nullptr}});
  const auto place = [&](std::size_t index) {
    const auto marker =
        event_markers(run, index, run.frames[1], layout, kEventContext).markers.at(0);
    EXPECT_EQ(marker.text, "t < 0.5 rising");
    EXPECT_EQ(marker.header.frame_id, "initial/ground");
    EXPECT_EQ(marker.id, static_cast<int>(index));
    EXPECT_EQ(marker.lifetime, ros::Duration(kEventLifetime));
    const auto& at = marker.pose.position;
    return Eigen::Vector3d(Eigen::Vector3d(at.x, at.y, at.z) -
                           run.frames[1].links[run.events[index].link].position);
  };
  const Eigen::Vector3d up = layout.view.up();
  EXPECT_GT(place(0).dot(up), 0.0);
  EXPECT_GT(place(1).dot(up), place(0).dot(up) + 0.5 * layout.letter);
  EXPECT_NEAR((place(2) - place(0)).norm(), 0.0, 1e-12) << "another link";
  EXPECT_NEAR((place(3) - place(0)).norm(), 0.0, 1e-12) << "the first ones are gone by then";
}

}  // namespace
}  // namespace codesign
