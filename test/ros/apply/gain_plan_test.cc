// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/apply.h"

#include <gtest/gtest.h>

#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

/// The state of the dynamic_reconfigure server of a control_toolbox::Pid.
GainServerState toolbox() {
  GainServerState state;
  for (const char* name : {"p", "i", "d", "i_clamp_min", "i_clamp_max"}) {
    state.now[name] = {0.0, false};
    state.lower[name] = {-1000.0, false};
    state.upper[name] = {1000.0, false};
  }
  state.now["antiwindup"] = state.now["publish_state"] = {0.0, true};
  return state;
}

FinishedJob planned_job() {
  Problem problem = pendulum_on_hardware();
  std::vector<double> parameters = problem.parameters();
  return {"job", std::move(problem), std::move(parameters), {"length", "Kp"}, 0.5};
}

std::string fault_of(const GainOrder& order, const GainServerState& state) {
  try {
    wanted_values(order, state, "/arm/elbow");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GainPlan, GainsGoToTheNamesOfTheToolbox) {
  const std::vector<GainOrder> orders = orders_of(planned_job(), "");
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].server, "arm_controller/gains/hinge");
  const GainValues wanted = wanted_values(orders[0], toolbox(), "/arm/elbow");
  EXPECT_EQ(wanted, (GainValues{{"p", {1.0, false}},
                                {"i", {0.25, false}},
                                {"d", {0.0, false}},
                                {"i_clamp_min", {-2.0, false}},
                                {"i_clamp_max", {2.0, false}},
                                {"antiwindup", {1.0, true}}}));
  EXPECT_EQ(only(wanted, toolbox().now).size(), wanted.size()) << "not publish_state";
}

TEST(GainPlan, AClampMayHaveOneName) {
  GainServerState state = toolbox();
  state.now.erase("i_clamp_min");
  state.now.erase("i_clamp_max");
  const GainOrder order = orders_of(planned_job(), "")[0];
  EXPECT_NE(fault_of(order, state).find("i_clamp: the server has no such parameter"),
            std::string::npos)
      << fault_of(order, state);
  state.now["i_clamp"] = {0.0, false};
  EXPECT_EQ(wanted_values(order, state, "/arm/elbow").at("i_clamp").number, 2.0);
  GainOrder without_integral = order;
  without_integral.gains->i = without_integral.gains->i_clamp_min =
      without_integral.gains->i_clamp_max = 0.0;
  state.now.erase("i_clamp");
  EXPECT_EQ(fault_of(without_integral, state), "");
}

TEST(GainPlan, TwoBoundsNeedTwoNames) {
  GainServerState state = toolbox();
  GainOrder order = orders_of(planned_job(), "")[0];
  order.gains->i_clamp_min = -0.5;
  const GainValues wanted = wanted_values(order, state, "/arm/elbow");
  EXPECT_EQ(wanted.at("i_clamp_min").number, -0.5);
  EXPECT_EQ(wanted.at("i_clamp_max").number, 2.0);
  state.now.erase("i_clamp_min");
  EXPECT_NE(fault_of(order, state).find("i_clamp_min: the server has no such parameter"),
            std::string::npos);
  state.now.erase("i_clamp_max");
  state.now["i_clamp"] = {0.0, false};
  EXPECT_NE(fault_of(order, state).find("i_clamp_max: the server has no such parameter"),
            std::string::npos);
}

TEST(GainPlan, WhatAServerDoesNotTakeIsRefused) {
  const GainOrder order = orders_of(planned_job(), "")[0];
  GainServerState state = toolbox();
  state.upper["p"] = {0.5, false};
  EXPECT_EQ(fault_of(order, state),
            "/arm/elbow: p: the value is outside the limits of the server (value: 1, allowed: "
            "-1000 to 0.5)");
  state = toolbox();
  state.now["antiwindup"] = {0.0, false};
  EXPECT_NE(fault_of(order, state).find("antiwindup: the server has a parameter of another type"),
            std::string::npos);
  state = toolbox();
  state.now.erase("antiwindup");
  EXPECT_NE(fault_of(order, state).find("antiwindup: the server has no such parameter"),
            std::string::npos);
}

TEST(GainPlan, OneServerGetsTheTunedParametersByName) {
  const std::vector<GainOrder> orders = orders_of(planned_job(), "simulation");
  ASSERT_EQ(orders.size(), 1U);
  GainServerState state;
  for (const char* name : {"length", "mass", "Kp"}) state.now[name] = {2.0, false};
  EXPECT_EQ(wanted_values(orders[0], state, "/simulation"),
            (GainValues{{"length", {0.5, false}}, {"Kp", {1.0, false}}}));
  state.now.erase("length");
  state.now["lenght"] = {2.0, false};
  EXPECT_NE(fault_of(orders[0], state).find("did you mean \"lenght\"?"), std::string::npos)
      << fault_of(orders[0], state);
}

TEST(GainPlan, AStudyWithoutHardwareNeedsAServer) {
  FinishedJob job = planned_job();
  job.problem = pendulum();
  EXPECT_THROW(orders_of(job, ""), InputError);
  EXPECT_EQ(orders_of(job, "simulation").size(), 1U);
}

TEST(GainPlan, AValueBeyondTheBoundsOfTheStudyIsRefused) {
  FinishedJob job = planned_job();
  job.parameters.back() = 5.5;  // Kp
  EXPECT_THROW(orders_of(job, ""), InputError);
}

}  // namespace
}  // namespace codesign
