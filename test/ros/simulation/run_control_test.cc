// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_control.h"

#include <gtest/gtest.h>

#include <thread>

namespace codesign {
namespace {

TEST(RunControl, WithoutARunRequestsAreRefusedWithTheReason) {
  Bell bell;
  RunControl control(&bell);
  control.end_run("bad input: no model");
  for (const std_srvs::TriggerResponse& response :
       {control.pause(), control.resume(), control.step(), control.restart()}) {
    EXPECT_FALSE(response.success);
    EXPECT_NE(response.message.find("no model"), std::string::npos);
  }
}

// The first start could not be assembled; parameters that came since may have mended it.
TEST(RunControl, ARunThatHadNoFrameCanBeBegunAnew) {
  Bell bell;
  RunControl control(&bell);
  control.begin_run();
  control.end_run("assembly_failed");
  std::thread run([&] {
    while (!control.wants_restart()) bell.wait(0.01);
    control.begin_run();
    control.note_frame(0.0);
  });
  EXPECT_TRUE(control.restart().success);
  run.join();
}

TEST(RunControl, StepsOnlyWhilePausedAndAsManyFramesAsAskedFor) {
  Bell bell;
  RunControl control(&bell);
  control.configure(false, 3);
  control.begin_run();
  control.note_frame(0.0);
  EXPECT_FALSE(control.step().success);
  std::thread run([&] {
    while (!control.stand_if_paused()) bell.wait(0.01);
    while (control.is_paused()) bell.wait(0.01);
    for (int k = 1; !control.is_paused(); ++k) control.note_frame(0.1 * k);
  });
  EXPECT_TRUE(control.pause().success);
  EXPECT_TRUE(control.is_paused());
  const std_srvs::TriggerResponse response = control.step();
  run.join();
  EXPECT_TRUE(response.success);
  EXPECT_NE(response.message.find("0.3"), std::string::npos) << response.message;
  EXPECT_TRUE(control.is_paused());
  EXPECT_TRUE(control.resume().success);
  EXPECT_FALSE(control.is_paused());
}

// The node offers its services before it has read its model.
TEST(RunControl, AStepThatComesWhileTheNodeStartsWaitsForTheRun) {
  Bell bell;
  RunControl control(&bell);
  std::thread node([&] {
    bell.wait(0.05);
    control.configure(true, 1);
    control.begin_run();
    control.note_frame(0.0);
    while (control.stand_if_paused()) bell.wait(0.01);
    control.note_frame(0.1);
    EXPECT_TRUE(control.stand_if_paused());
  });
  const std_srvs::TriggerResponse response = control.step();
  node.join();
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.message, "t = 0.1 s");
}

TEST(RunControl, ARequestToARunThatWaitsToBeginIsToldWhatItWaitsFor) {
  Bell bell;
  RunControl control(&bell);
  control.end_run("waiting for subscribers");
  EXPECT_EQ(control.step().message, "waiting for subscribers");
  EXPECT_FALSE(control.restart().success);
}

// The node offers its services before the first frame.
TEST(RunControl, AStepAsksForAFrameAfterTheFirst) {
  Bell bell;
  RunControl control(&bell);
  control.configure(true, 1);
  control.begin_run();
  std::thread run([&] {
    bell.wait(0.05);
    control.note_frame(0.0);
    while (control.stand_if_paused()) bell.wait(0.01);
    control.note_frame(0.1);
    EXPECT_TRUE(control.stand_if_paused());
  });
  const std_srvs::TriggerResponse response = control.step();
  run.join();
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.message, "t = 0.1 s");
}

// A frame is being computed when the request comes.
TEST(RunControl, APauseIsAnsweredWithTheLastFrameThatIsPublished) {
  Bell bell;
  RunControl control(&bell);
  control.begin_run();
  control.note_frame(0.0);
  EXPECT_FALSE(control.stand_if_paused());
  std::thread run([&] {
    while (!control.is_paused()) bell.wait(0.01);
    control.note_frame(0.1);
    EXPECT_TRUE(control.stand_if_paused());
  });
  const std_srvs::TriggerResponse response = control.pause();
  run.join();
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.message, "paused after t = 0.1 s");
  EXPECT_EQ(control.pause().message, response.message) << "a run that stands is paused at once";
}

TEST(RunControl, ARestartIsAnsweredByTheFirstFrameOfTheNewRun) {
  Bell bell;
  RunControl control(&bell);
  control.begin_run();
  control.note_frame(0.0);
  std::thread run([&] {
    while (!*control.leaving()) bell.wait(0.01);
    EXPECT_TRUE(control.wants_restart());
    control.begin_run();
    EXPECT_FALSE(*control.leaving());
    control.note_frame(0.0);
  });
  EXPECT_TRUE(control.restart().success);
  run.join();
  EXPECT_FALSE(control.wants_restart());
}

TEST(RunControl, TheEndOfTheRunOrOfTheNodeAnswersWhoWaits) {
  Bell bell;
  RunControl control(&bell);
  control.configure(true, 5);
  control.begin_run();
  control.note_frame(0.0);
  EXPECT_TRUE(control.stand_if_paused());
  std::thread run([&] {
    while (control.is_paused()) bell.wait(0.01);
    control.end_run("finished");
  });
  const std_srvs::TriggerResponse response = control.step();
  run.join();
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("finished"), std::string::npos);
  std::thread node([&] {
    while (!control.wants_restart()) bell.wait(0.01);
    control.stop("the end of time");
  });
  EXPECT_FALSE(control.restart().success);
  node.join();
  EXPECT_TRUE(*control.leaving());
  EXPECT_EQ(control.pause().message, "the end of time");
}

}  // namespace
}  // namespace codesign
