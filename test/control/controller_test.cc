// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "control/controller.h"
#include "description/study.h"
#include "equations/compiled.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(ControllerConstants, EveryNumberOfALawIsEvaluatedAtTheDesign) {
  const Study study = read_text(
      kLeastStudy +
      "parameters: {k: {initial: 2.0}}\n"
      "controllers:\n"
      "  speed: {type: pid, input: crank_joint/velocity, setpoint: \"${3*k}\", output: "
      "crank_joint, gains: {p: \"${k}\", d: 0.5}}\n"
      "  hold: {type: state_feedback, output: slider_joint, feedforward: \"${k}\",\n"
      "         feedback: [{signal: slider_joint/position, gain: \"${k*k}\", reference: 0.1}]}\n"
      "  push: {type: basis, output: slider_joint, coefficients: [1.0, \"${k + rod_length}\"]}\n");
  std::vector<double> parameters;
  for (const Parameter& parameter : study.parameters)
    parameters.push_back(parameter.name == "k" ? 5.0 : parameter.value);
  const ControllerConstants<double> speed =
      controller_constants(study.controllers.at(0), parameters);
  EXPECT_EQ(speed.setpoint.at(0.0).value, 15.0);
  EXPECT_EQ(speed.pid.p, 5.0);
  EXPECT_EQ(speed.pid.i, 0.0);
  EXPECT_EQ(speed.pid.d, 0.5);
  const ControllerConstants<double> hold =
      controller_constants(study.controllers.at(1), parameters);
  EXPECT_EQ(hold.feedforward.at(0.0).value, 5.0);
  EXPECT_EQ(hold.gains, std::vector<double>{25.0});
  EXPECT_EQ(hold.references.at(0).at(1.0).value, 0.1);
  EXPECT_EQ(controller_constants(study.controllers.at(2), parameters).shape.coefficients(),
            (std::vector<double>{1.0, 5.3}));
}

TEST(ControllerConstants, ImpossibleNumbersOfADesignAreNamed) {
  const Study study = read_text(kLeastStudy +
                                "parameters: {k: {initial: 2.0}}\ncontrollers:\n  speed: {type: "
                                "pid, input: crank_joint/velocity, setpoint: 0, "
                                "output: crank_joint, gains: {p: 1, i: 1, d: 1}, i_clamp: "
                                "\"${k}\", output_limit: \"${2*k}\", derivative_filter: "
                                "\"${k}\", time_constant: \"${k/2}\"}\n");
  std::vector<double> parameters;
  for (const Parameter& parameter : study.parameters) parameters.push_back(parameter.value);
  const ControllerDescription& description = study.controllers.at(0);
  ControllerConstants<double> constants = controller_constants(description, parameters);
  EXPECT_EQ(constants.i_clamp.upper, 2.0);
  EXPECT_EQ(constants.i_clamp.lower, -2.0);
  EXPECT_EQ(constants.output_limit.upper, 4.0);
  EXPECT_EQ(constants.derivative_filter, 2.0);
  EXPECT_EQ(constants.time_constant, 1.0);
  EXPECT_EQ(find_impossible(description, constants), "");
  constants.time_constant = -1.0;
  EXPECT_EQ(find_impossible(description, constants),
            "controllers.speed.time_constant is -1, it must be positive");
  constants.i_clamp.upper = 0.0;
  EXPECT_NE(find_impossible(description, constants).find("i_clamp is 0"), std::string::npos);
}

TEST(ControllerConstants, ImpossibleBoundsAndFiltersAreNamed) {
  const Study study = read_text(
      kLeastStudy +
      "controllers:\n  speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: "
      "crank_joint, gains: {p: 1, i: 1}, i_clamp: [-1, 2], output_limit: [0, 3], antiwindup: "
      "back_calculation, filter: {type: notch, frequency: 4, damping: 0.5}}\n");
  ControllerDescription description = study.controllers.at(0);
  const auto fault = [&description](double ControllerConstants<double>::*member, double value) {
    ControllerConstants<double> constants =
        controller_constants(description, std::vector<double>{});
    constants.*member = value;
    return find_impossible(description, constants);
  };
  EXPECT_EQ(fault(&ControllerConstants<double>::tracking, 1.0), "");
  EXPECT_EQ(fault(&ControllerConstants<double>::tracking, -2.0),
            "controllers.speed.tracking_time, p / i, is -2, it must be positive");
  ControllerConstants<double> constants = controller_constants(description, std::vector<double>{});
  constants.i_clamp.lower = 0.0;
  EXPECT_EQ(find_impossible(description, constants),
            "the lower bound of controllers.speed.i_clamp is 0, it must be negative");
  constants.i_clamp.lower = -1.0;
  constants.output_limit.lower = 0.5;
  EXPECT_EQ(find_impossible(description, constants),
            "the lower bound of controllers.speed.output_limit is 0.5, it must not be positive");
  EXPECT_EQ(find_impossible_filter(description, {}), "");
  description.realization.sample_time = 0.125;
  EXPECT_EQ(find_impossible_filter(description, {}),
            "controllers.speed.filter.frequency is 4 Hz, it must be below half of the sampling "
            "rate, 4 Hz");
  description.filters[0].numbers[1] = -1.0;
  EXPECT_EQ(find_impossible_filter(description, {}),
            "controllers.speed.filter.damping is -1, it must be positive");
}

struct Resolved {
  explicit Resolved(const std::string& laws, const std::string& signal = "shoulder/velocity")
      : robot(read_urdf({"test.urdf", double_pendulum()})),
        study(read_study({"test.yaml", "duration: 1.0\ncontrollers:\n" + laws +
                                           "objective: {integral: [{signal: " + signal + "}]}\n"},
                         robot)),
        topology(derive_topology(robot)),
        controllers(resolve_controllers(
            study, robot, topology,
            {resolve_signal(study.integral[0].signal, robot, topology, study.controllers)},
            &states)) {}

  RobotDescription robot;
  Study study;
  Topology topology;
  int states = 0;
  std::vector<Controller> controllers;
};

constexpr const char* kInner =
    "  inner: {type: pid, input: shoulder/position, setpoint: 0.0, output: shoulder, gains: {p: "
    "1.0}}\n";

TEST(Controller, ALaterControllerMakesAnEarlierOneProvideItsRate) {
  EXPECT_TRUE(Resolved(kInner).controllers.at(0).input_rate.empty());
  const Resolved cascade(
      std::string(kInner) +
      "  outer: {type: pid, input: inner/error, setpoint: 0.0, output: elbow, gains: {d: 1.0}}\n" +
      "  last: {type: pid, input: outer/error, setpoint: 0.0, output: elbow, gains: {d: 1.0}}\n");
  EXPECT_EQ(cascade.controllers.at(1).input_rate.at(0).kind, SignalKind::kControllerErrorRate);
  EXPECT_EQ(cascade.controllers.at(0).input_rate.at(0).kind, SignalKind::kJointVelocity);
}

TEST(Controller, ALaterControllerMakesAnEarlierOneIntegrate) {
  EXPECT_EQ(Resolved(kInner).states, 0);
  EXPECT_EQ(Resolved(kInner, "inner/integral").states, 1);
  const Resolved by_input(std::string(kInner) +
                          "  outer: {type: pid, input: inner/integral, setpoint: 0.0, output: "
                          "elbow, gains: {p: 1.0}}\n");
  EXPECT_EQ(by_input.controllers.at(0).state, 0);
  EXPECT_EQ(by_input.controllers.at(1).state, -1);
  const Resolved by_feedback(std::string(kInner) +
                             "  outer: {type: state_feedback, output: elbow, feedback: [{signal: "
                             "inner/integral, gain: 1.0}]}\n");
  EXPECT_EQ(by_feedback.states, 1);
}

TEST(Controller, WhatARobotsControllerRemembersAreStates) {
  const std::string pid =
      "  a: {type: pid, input: shoulder/position, setpoint: 0.0, output: shoulder, gains: {p: 1.0, "
      "i: 1.0, d: 1.0}, ";
  const Resolved filtered(pid + "derivative_filter: 0.1, time_constant: 0.1}\n");
  EXPECT_EQ(filtered.states, 3);
  EXPECT_EQ(filtered.controllers.at(0).state, 0);
  EXPECT_EQ(filtered.controllers.at(0).states.filter, 1);
  EXPECT_EQ(filtered.controllers.at(0).states.lag, 2);
  EXPECT_TRUE(filtered.controllers.at(0).input_rate.empty()) << "the filter needs the error alone";
  const Resolved sampled(
      pid + "sample_time: 0.1, delay: 0.25}\n" +
      "  b: {type: basis, output: elbow, coefficients: [0.0, 1.0], sample_time: 0.1}\n");
  EXPECT_EQ(sampled.states, 7) << "integral, last error, output, three that wait; output of b";
  EXPECT_EQ(sampled.controllers.at(0).states.filter, -1);
  EXPECT_EQ(sampled.controllers.at(0).states.queue, 3);
  EXPECT_EQ(sampled.controllers.at(1).states.held, 6);
  EXPECT_EQ(sampled.controllers.at(1).states.queue, -1);
}

TEST(Controller, FiltersHaveStatesAndRates) {
  const auto resolved = [](const std::string& keys) {
    return Resolved("  a: {input: shoulder/velocity, setpoint: 0.0, output: shoulder, " + keys +
                    "}\n");
  };
  const std::string two =
      "filter: [{type: low_pass_2, frequency: 3}, {type: lead_lag, zero: 2, pole: 9}]";
  const Resolved filtered = resolved("type: pid, gains: {p: 1.0, i: 1.0, d: 1.0}, " + two);
  EXPECT_EQ(filtered.states, 4);
  const std::vector<FilterPlace>& places = filtered.controllers.at(0).states.inputs.at(0);
  EXPECT_EQ(places.at(0).state, 1);
  EXPECT_EQ(places.at(1).state, 3);
  EXPECT_TRUE(filtered.controllers.at(0).has_error_rate);
  EXPECT_TRUE(filtered.controllers.at(0).input_rate.empty()) << "a low-pass gives the rate itself";
  EXPECT_FALSE(resolved("type: pid, gains: {d: 1.0}, filter: {type: lead_lag, zero: 2, pole: 9}")
                   .controllers.at(0)
                   .input_rate.empty());
  EXPECT_THROW(Resolved("  a: {type: pid, input: shoulder/acceleration, setpoint: 0.0, output: "
                        "shoulder, gains: {p: 1.0}, " +
                        two + "}\n"),
               InputError);
  // A sampled filter gives no rate.
  EXPECT_NO_THROW(
      resolved("type: pid, gains: {d: 1.0}, sample_time: 0.1, filter: {type: low_pass, "
               "frequency: 3}"));
  EXPECT_THROW(
      Resolved("  a: {type: pd_gravity, output: shoulder, setpoint: 0.0, gains: {p: 1.0, d: 1.0}, "
               "sample_time: 0.1, filter: {type: low_pass, frequency: 3}}\n"),
      InputError);
}

TEST(Controller, SampledOnesReadWhatTheyDoNotDetermine) {
  const auto law = [](const std::string& input, const std::string& keys) {
    return "  a: {type: pid, input: " + input +
           ", setpoint: 0.0, output: shoulder, gains: {p: 1.0, d: 1.0}, " + keys + "}\n";
  };
  for (const char* keys : {"sample_time: 0.1", "derivative_filter: 0.1"}) {
    EXPECT_THROW(Resolved(law("shoulder/acceleration", keys)), InputError);
    EXPECT_THROW(Resolved(law("elbow/position + elbow/reaction_force/x", keys)), InputError);
    EXPECT_NO_THROW(Resolved(law("shoulder/velocity - mechanism/total_energy", keys)));
  }
  EXPECT_THROW(Resolved("  a: {type: state_feedback, output: elbow, feedback: [{signal: "
                        "elbow/acceleration, gain: 1.0}], sample_time: 0.1}\n"),
               InputError);
  // The integral of a clamped controller has no rate that could be differentiated.
  const std::string inner =
      "  i: {type: pid, input: elbow/position, setpoint: 0.0, output: elbow, gains: {i: 1.0}, "
      "i_clamp: 1.0, antiwindup: ";
  const std::string outer =
      "  o: {type: pid, input: i/integral, setpoint: 0.0, output: shoulder, gains: {d: 1.0}}\n";
  EXPECT_THROW(Resolved(inner + "true}\n" + outer), InputError);
  EXPECT_NO_THROW(Resolved(inner + "false}\n" + outer));
}

TEST(Controller, TheRateOfAnOutputNeedsRatesOfItsSignals) {
  const auto has_rate = [](const std::string& law) {
    return Resolved("  a: {output: shoulder, " + law + "}\n").controllers.at(0).has_output_rate;
  };
  const std::string velocity = "type: pid, setpoint: 0.0, input: shoulder/velocity, ";
  EXPECT_TRUE(has_rate(velocity + "gains: {p: 1.0, i: 1.0}"));
  EXPECT_FALSE(has_rate(velocity + "gains: {p: 1.0, d: 1.0}")) << "no rate of an acceleration";
  EXPECT_TRUE(has_rate(velocity + "gains: {p: 1.0, d: 1.0}, derivative_filter: 0.1"));
  EXPECT_TRUE(has_rate(velocity + "gains: {p: 1.0, d: 1.0}, time_constant: 0.1"));
  EXPECT_FALSE(has_rate(velocity + "gains: {p: 1.0}, sample_time: 0.1"));
  EXPECT_TRUE(has_rate(velocity + "gains: {p: 1.0}, sample_time: 0.1, time_constant: 0.1"));
  EXPECT_TRUE(has_rate("type: state_feedback, feedback: [{signal: elbow/velocity, gain: 1.0}]"));
  EXPECT_FALSE(
      has_rate("type: state_feedback, feedback: [{signal: elbow/acceleration, gain: 1.0}]"));
  EXPECT_FALSE(has_rate("type: pd_gravity, setpoint: 0.0, gains: {p: 1.0}"));
}

TEST(Controller, FeedbackReadsEarlierControllersOnly) {
  EXPECT_THROW(Resolved("  a: {type: state_feedback, output: elbow, feedback: [{signal: "
                        "elbow/effort, gain: 1.0}]}\n"),
               InputError);
  EXPECT_NO_THROW(Resolved(std::string(kInner) +
                           "  a: {type: state_feedback, output: elbow, feedback: "
                           "[{signal: inner/output, gain: 1.0}]}\n"));
}

// A controller cannot read a reaction or a power that contains its own output.
TEST(Controller, NothingReadsItsOwnEffort) {
  const auto feedback = [](const std::string& signal) {
    return "  a: {type: state_feedback, output: elbow, feedback: [{signal: " + signal +
           ", gain: 1.0}]}\n";
  };
  for (const char* signal : {"elbow/reaction_force/x", "elbow/reaction_torque/y",
                             "elbow/actuator_power", "mechanism/actuator_power"})
    EXPECT_THROW(Resolved(feedback(signal)), InputError) << signal;
  EXPECT_NO_THROW(Resolved(feedback("shoulder/reaction_force/x")));
  EXPECT_NO_THROW(Resolved(kInner + feedback("shoulder/reaction_torque/y")))
      << "an earlier controller drives the shoulder";
  EXPECT_THROW(Resolved(feedback("shoulder/reaction_torque/y") + kInner), InputError);
}

TEST(Controller, ComputedTorquesKnowOfEachOther) {
  const std::string servo = ": {type: computed_torque, setpoint: 0.0, gains: {p: 1.0}, output: ";
  const Resolved both("  a" + servo + "shoulder}\n  b" + servo + "elbow}\n");
  for (const Controller& controller : both.controllers) {
    ASSERT_EQ(controller.tree.nodes.size(), 2U);
    EXPECT_EQ(controller.tree.nodes[0].controller, 0);
    EXPECT_EQ(controller.tree.nodes[1].controller, 1);
  }
  const Resolved one(
      "  a" + servo +
      "shoulder}\n  b: {type: pd_gravity, setpoint: 0.0, gains: {p: 1.0}, output: elbow}\n");
  EXPECT_EQ(one.controllers.at(0).tree.nodes[1].controller, -1);
}

// Two computed torques on one joint would prescribe two accelerations.
TEST(Controller, AJointHasOneComputedTorqueAtMost) {
  const std::string servo =
      ": {type: computed_torque, setpoint: 0.0, gains: {p: 1.0}, output: shoulder}\n";
  EXPECT_THROW(Resolved("  a" + servo + "  b" + servo), InputError);
}

}  // namespace

}  // namespace codesign
