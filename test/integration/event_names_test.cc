// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The events of runs: when, of which element, in which direction, jump or kink.
#include "integration/event_names.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"

namespace codesign {
namespace {

/// A slide of 2 kg without gravity, from x = 0, for 2 s.
Simulation slide_run(const std::string& study, const std::string& more = "") {
  const std::string urdf = robot(mass("piston", 2.0) + lift("slide", "piston", 0.0, more));
  const std::shared_ptr<const CompiledSystem> system =
      compile(urdf, "duration: 2.0\ngravity: [0, 0, 0]\n" + study);
  return simulation_of(system, system->parameters(), {});
}

Events events_of_run(const std::string& study, double end = 2.0, const std::string& more = "") {
  Simulation run = slide_run(study, more);
  Status status = run.start();
  if (status.ok()) status = run.advance_to(end);
  EXPECT_TRUE(status.ok()) << describe(status);
  const Events events = run.events();
  EXPECT_EQ(events.count, run.event_count());
  return events;
}

const char* const kMoving = "initial_state: {slide: {velocity: 1.0}}\n";

void expect_event(const Event& event, double time, const std::string& sentence) {
  EXPECT_NEAR(event.time, time, 1e-9) << sentence;
  EXPECT_EQ(describe(event), sentence);
}

TEST(EventNames, ALoadOfTheTimeAndOneOfAPosition) {
  const Events events = events_of_run(
      std::string(kMoving) +
      "loads: [{joint: slide, effort: \"${t < 0.7 ? 0 : 0*t}\"}, "
      "{link: piston, force: [0, 0, \"${(slide/position >= 0.25) ? 1e-12 : 0}\"]}]\n");
  ASSERT_EQ(events.list.size(), 2u);
  expect_event(events.list[0], 0.25,
               "loads[1].force/z, \"slide/position >= 0.25\", rising, a jump");
  EXPECT_EQ(events.list[0].object, "piston");
  expect_event(events.list[1], 0.7, "loads[0].effort, \"t < 0.7\", falling, a kink");
  EXPECT_EQ(events.list[1].object, "slide");
}

// x = 1 - t^2 + ... : the sign falls, then rises again.
TEST(EventNames, FunctionsRiseWithTheirArgument) {
  const Events events = events_of_run(
      "initial_state: {slide: {position: 0.5, velocity: -1.0}}\n"
      "loads: [{joint: slide, effort: \"${1e-12*sign(slide/position) + 1e-12*floor(3*t) + "
      "max(0, t - 1.9)}\"}]\n");
  ASSERT_EQ(events.list.size(), 7u);
  const double third = 1.0 / 3.0;
  expect_event(events.list[0], third, "loads[0].effort, \"floor(3*t)\", rising, a jump");
  expect_event(events.list[1], 0.5, "loads[0].effort, \"sign(slide/position)\", falling, a jump");
  for (int k = 2; k <= 5; ++k)
    expect_event(events.list[static_cast<std::size_t>(k)], k * third,
                 "loads[0].effort, \"floor(3*t)\", rising, a jump");
  expect_event(events.list[6], 1.9, "loads[0].effort, \"max(0, t - 1.9)\", rising, a kink");
}

// x = t, and what the controller adds is rounding.
TEST(EventNames, TheLimitOfAController) {
  const Events events = events_of_run(
      std::string(kMoving) +
      "controllers: {servo: {type: pid, input: slide/position, setpoint: 0, output: slide, gains: "
      "{p: 1.0e-11, i: 1.0e-21}, output_limit: [-5.0e-12, 9.0e-12], antiwindup: "
      "back_calculation}}\n");
  ASSERT_EQ(events.list.size(), 1u);
  expect_event(events.list[0], 0.5, "controllers.servo, \"lower output_limit\", rising, a kink");
  EXPECT_EQ(events.list[0].object, "slide");
}

TEST(EventNames, ControllersAndObjectives) {
  const Events events = events_of_run(
      std::string(kMoving) +
      "controllers: {hold: {type: state_feedback, output: slide, feedback: [{signal: "
      "\"${slide/position > 0.9 ? 1 : 0}\", gain: 1.0e-12}], feedforward: \"${t > 0.2 ? 1.0e-12 : "
      "0}\"}}\nobjective: {integral: [{signal: \"${t > 0.6 ? slide/position : 0}\"}, {signal: "
      "slide/position, reference: \"${t < 1.1 ? 0 : 1}\"}]}\n");
  ASSERT_EQ(events.list.size(), 4u);
  expect_event(events.list[0], 0.2, "controllers.hold.feedforward, \"t > 0.2\", rising, a jump");
  EXPECT_EQ(events.list[0].object, "slide");
  expect_event(events.list[1], 0.6, "objective.integral[0].signal, \"t > 0.6\", rising, a jump");
  EXPECT_EQ(events.list[1].object, "");
  expect_event(events.list[2], 0.9,
               "controllers.hold.feedback[0].signal, \"slide/position > 0.9\", rising, a jump");
  expect_event(events.list[3], 1.1,
               "objective.integral[1].reference, \"t < 1.1\", falling, a jump");
}

TEST(EventNames, LossesHaveKinks) {
  const Events events = events_of_run(
      std::string(kMoving) +
      "objective: {integral: [{signal: slide/position, reference: 1, loss: huber, scale: 0.25}, "
      "{signal: slide/position, reference: \"${1 - t}\", loss: absolute}, {signal: "
      "slide/position, loss: soft_l1, scale: 1}]}\n");
  ASSERT_EQ(events.list.size(), 3u);
  expect_event(events.list[0], 0.5,
               "objective.integral[1].loss, \"slide/position > reference\", rising, a kink");
  EXPECT_EQ(events.list[0].object, "");
  const std::string huber = "objective.integral[0].loss, \"slide/position > reference";
  expect_event(events.list[1], 0.75, huber + " - scale\", rising, a kink");
  expect_event(events.list[2], 1.25, huber + " + scale\", rising, a kink");
}

// Rounding of a residual that is zero all the time is no kink.
TEST(EventNames, AResidualThatStaysZeroHasNoEvents) {
  const Events events = events_of_run(
      std::string(kMoving) +
      "objective: {integral: [{signal: slide/position, reference: \"${t}\", loss: absolute}, "
      "{signal: slide/velocity, reference: 1, loss: above}]}\n");
  EXPECT_EQ(events.count, 0);
}

// From x = 4.5 at 1 m/s the upper stop at 5 is touched at 0.5 s, and left again.
TEST(EventNames, StopsAreTouchedAndLeft) {
  const Events events = events_of_run(
      "initial_state: {slide: {position: 4.5, velocity: 1.0}}\n"
      "limits: {position: true, stiffness: 1.0e4, width: 0.001}\n");
  ASSERT_EQ(events.list.size(), 2u);
  expect_event(events.list[0], 0.5, "joint \"slide\", \"touch of the upper stop\", rising, a kink");
  EXPECT_FALSE(events.list[1].rising);
  EXPECT_EQ(events.list[1].object, "slide");
}

// 20 switches per second for 30 s: those beyond the 500 that are listed are counted.
TEST(EventNames, ManyEventsAreCounted) {
  const Events events =
      events_of_run("loads: [{joint: slide, effort: \"${1.0e-12*floor(20*t)}\"}]\n", 30.01);
  EXPECT_EQ(events.list.size(), EventLog::kMost);
  EXPECT_EQ(events.count, 600);
}

TEST(EventNames, TheOrderIsThatOfTheEventsNotOfTheirTimes) {
  const auto order = [](const std::string& first, const std::string& second) {
    return events_of_run("loads: [{joint: slide, effort: \"${(t < " + first + " ? 0 : 1) + (t > " +
                         second +
                         " ? 1 : 0)}\"}]\nparameters: {a: {initial: 0.5, lower: 0, upper: "
                         "2}, b: {initial: 0.6, lower: 0, upper: 2}, c: {initial: 0.7, lower: 0, "
                         "upper: 2}}\n")
        .order;
  };
  EXPECT_EQ(events_of_run("").order, "");
  EXPECT_NE(order("a", "b"), "");
  EXPECT_EQ(order("a", "b"), order("a", "b"));
  EXPECT_NE(order("a", "c"), order("a", "b")) << "another expression";
  EXPECT_NE(order("c", "b"), order("a", "b"));
  EXPECT_EQ(order("a", "a").size(), order("a", "b").size());
}

/// A slide thrown at 1 m/s against -1 m/s^2, x = t - t^2/2 up to 0.5 at t = 1, with a force of 1 nN
/// beyond the threshold.
Warnings warnings_of_throw(const std::string& threshold) {
  Simulation run = slide_run(std::string(kMoving) +
                             "loads: [{joint: slide, effort: -2.0}, {joint: slide, effort: "
                             "\"${slide/position > " +
                             threshold + " ? 1.0e-9 : 0}\"}]\n");
  EXPECT_TRUE(run.start().ok());
  EXPECT_TRUE(run.advance_to(2.0).ok()) << "the run goes on";
  return run.warnings();
}

TEST(EventNames, AGuardThatIsOnlyTouchedWhereTheMotionWouldJumpIsAWarning) {
  for (const char* threshold : {"0.5", "(0.5 - 1.0e-10)", "(0.5 + 1.0e-10)"}) {
    const Warnings warnings = warnings_of_throw(threshold);
    ASSERT_EQ(warnings.size(), 1u) << threshold;
    EXPECT_EQ(warnings[0].code, "grazing_event");
    EXPECT_NE(
        warnings[0].message.find("loads[1].effort, \"slide/position > " + std::string(threshold)),
        std::string::npos)
        << warnings[0].message;
    EXPECT_NE(warnings[0].message.find(" s the guard is only touched"), std::string::npos);
  }
  for (const char* threshold : {"0.499", "0.501", "2.0"})
    EXPECT_TRUE(warnings_of_throw(threshold).empty()) << threshold;
}

// The force is continuous at the threshold: its instant does not matter.
TEST(EventNames, AKinkThatIsTouchedIsNone) {
  Simulation run = slide_run(std::string(kMoving) +
                             "loads: [{joint: slide, effort: -2.0}, {joint: slide, effort: "
                             "\"${max(0, slide/position - 0.5)}\"}]\n");
  ASSERT_TRUE(run.start().ok());
  ASSERT_TRUE(run.advance_to(2.0).ok());
  EXPECT_TRUE(run.warnings().empty());
}

}  // namespace
}  // namespace codesign
