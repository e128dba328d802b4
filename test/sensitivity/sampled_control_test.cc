// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients through controllers as robots run them, theory (50)-(54).
#include <gtest/gtest.h>

#include <string>

#include "assembly/make_system.h"
#include "description/tuned_parameters.h"
#include "integration/servo.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

struct ControlCase {
  std::string name;
  std::string controllers;
  std::string term = "shoulder/effort";
};

const std::string kGains = "gains: {p: \"${Kp}\", i: \"${Ki}\", d: \"${Kd}\"}";
const std::string kShoulder =
    "type: pid, input: shoulder/position, setpoint: \"${aim}\", output: shoulder, ";

std::string shoulder(const std::string& keys) {
  return "  servo: {" + kShoulder + kGains + ", " + keys + "}\n";
}

const std::string kRange = "output_limit: [\"${-100*tau}\", \"${200*tau}\"]";
const std::string kLimit = kRange + ", antiwindup: ";
const std::string kNotch =
    "{type: notch, frequency: \"${150*tau}\", damping: \"${10*tau}\", depth: \"${2*tau}\"}";

std::string feedback(const std::string& keys) {
  return "  servo: {type: state_feedback, output: shoulder, " + keys +
         "feedback: [{signal: shoulder/position, gain: \"${Kp}\", reference: \"${aim}\", filter: " +
         kNotch +
         "}, {signal: shoulder/velocity, gain: \"${Kd}\", filter: {type: low_pass_2, frequency: "
         "\"${400*tau}\"}}]}\n";
}

std::vector<ControlCase> control_cases() {
  const std::string cascade =
      "  outer: {type: pid, input: shoulder/position, setpoint: \"${aim}\", gains: {p: "
      "\"${Ki/10}\"}";
  const std::string inner =
      "}\n  servo: {type: pid, input: shoulder/velocity - outer/output, setpoint: 0.0, output: "
      "shoulder, gains: {p: \"${Kd}\", i: "
      "\"${Kp}\"}";
  return {
      {"derivative_filter", shoulder("derivative_filter: \"${tau}\"")},
      {"clamp", shoulder("i_clamp: \"${20*tau}\"")},
      {"antiwindup", shoulder("i_clamp: \"${20*tau}\", antiwindup: true")},
      {"output_limit", shoulder("output_limit: \"${200*tau}\"")},
      {"time_constant", shoulder("time_constant: \"${tau}\""), "shoulder/effort_rate"},
      {"effort_rate", shoulder("derivative_filter: \"${tau}\", output_limit: 15.0"),
       "shoulder/effort_rate"},
      {"sampled", shoulder("sample_time: 0.01")},
      {"sampled_filter", shoulder("sample_time: 0.01, derivative_filter: \"${tau}\"")},
      {"sampled_clamp", shoulder("sample_time: 0.01, i_clamp: \"${20*tau}\"")},
      {"sampled_antiwindup",
       shoulder("sample_time: 0.01, i_clamp: \"${20*tau}\", antiwindup: true")},
      {"sampled_limit", shoulder("sample_time: 0.01, output_limit: \"${200*tau}\"")},
      {"delayed", shoulder("sample_time: 0.01, delay: 0.004")},
      {"delayed_by_a_period", shoulder("sample_time: 0.01, delay: 0.01")},
      {"delayed_by_more", shoulder("sample_time: 0.005, delay: 0.0137, time_constant: \"${tau}\""),
       "shoulder/effort_rate"},
      {"state_feedback",
       "  servo: {type: state_feedback, output: shoulder, sample_time: 0.01, delay: 0.002, "
       "feedback: [{signal: shoulder/position, gain: "
       "\"${Kp}\", reference: \"${aim}\"}, {signal: shoulder/velocity, gain: \"${Kd}\"}]}\n"},
      {"pd_gravity",
       "  servo: {type: pd_gravity, output: shoulder, setpoint: \"${aim}\", gains: {p: \"${Kp}\", "
       "d: \"${Kd}\"}, sample_time: 0.01}\n"},
      {"unsymmetric_limit", shoulder("output_limit: [\"${-100*tau}\", \"${200*tau}\"]")},
      {"unsymmetric_clamp", shoulder("i_clamp: [\"${-20*tau}\", \"${50*tau}\"]")},
      {"unsymmetric_antiwindup",
       shoulder("i_clamp: [\"${-20*tau}\", \"${50*tau}\"], antiwindup: clamping")},
      {"back_calculation", shoulder(kLimit + "back_calculation")},
      {"back_calculation_in_time",
       shoulder(kLimit + "back_calculation, tracking_time: \"${3*tau}\"")},
      {"conditional", shoulder(kLimit + "conditional")},
      {"conditional_rate", shoulder(kLimit + "conditional, derivative_filter: \"${tau}\""),
       "shoulder/effort_rate"},
      {"sampled_unsymmetric",
       shoulder("sample_time: 0.01, i_clamp: [0, \"${50*tau}\"], antiwindup: true, " + kRange)},
      {"sampled_back_calculation", shoulder("sample_time: 0.01, " + kLimit + "back_calculation")},
      {"sampled_conditional", shoulder("sample_time: 0.01, " + kLimit + "conditional")},
      {"notch", shoulder("filter: " + kNotch)},
      {"measured_notch", shoulder("derivative: measurement, filter: " + kNotch)},
      {"filters",
       shoulder("derivative_filter: 0.02, filter: [{type: low_pass_2, frequency: "
                "\"${400*tau}\", damping: 0.6}, {type: lead_lag, zero: 5, pole: "
                "\"${500*tau}\"}, {type: low_pass, frequency: 20}]"),
       "shoulder/effort_rate"},
      {"low_pass_of_a_rate",
       "  servo: {type: pid, input: shoulder/velocity, setpoint: \"${aim}\", output: shoulder, "
       "gains: {p: \"${Kd}\", d: \"${Kd/100}\"}, filter: {type: low_pass, frequency: "
       "\"${400*tau}\"}}\n"},
      {"sampled_filters",
       shoulder("sample_time: 0.01, delay: 0.004, filter: [" + kNotch +
                ", {type: low_pass, frequency: \"${400*tau}\"}], derivative: measurement")},
      {"filtered_feedback", feedback("")},
      {"sampled_filtered_feedback", feedback("sample_time: 0.01, ")},
      {"filtered_pd_gravity",
       "  servo: {type: pd_gravity, output: shoulder, setpoint: \"${aim}\", gains: {p: \"${Kp}\", "
       "d: \"${Kd}\"}, filter: " +
           kNotch + "}\n"},
      {"filtered_cascade", cascade + ", filter: {type: low_pass, frequency: 30}" + inner +
                               ", filter: " + kNotch + "}\n"},
      {"cascade", cascade + inner + "}\n"},
      {"cascade_of_two_rates",
       cascade + ", sample_time: 0.02" + inner + ", sample_time: 0.004, delay: 0.001}\n"}};
}

std::shared_ptr<const CompiledSystem> compile_case(const ControlCase& c, const std::string& solver,
                                                   const std::string& more = "") {
  return compile(double_pendulum(pin_friction()),
                 "duration: 0.4\ninitial_state: {shoulder: {position: \"${start}\"}, elbow: "
                 "{velocity: 1.0}}\ncontrollers:\n" +
                     c.controllers +
                     "parameters: {Kp: {initial: 40.0}, Ki: {initial: 60.0}, Kd: {initial: 1.5}, "
                     "aim: {initial: 0.3}, tau: {initial: "
                     "0.04}, start: {initial: 1.0}}\n"
                     "objective: {integral: [{signal: servo/output, weight: 0.01}, {signal: " +
                     c.term +
                     ", weight: 1.0e-3}, {signal: shoulder/position}],\n  terminal: [{signal: "
                     "elbow/position}, {signal: "
                     "shoulder/acceleration, weight: 0.01}]}\n" +
                     more + "solver: " + solver + "\n");
}

class ControlGradientTest : public ::testing::TestWithParam<ControlCase> {};

TEST_P(ControlGradientTest, MeetsTheComplexStep) {
  for (const char* method : {"rodas5p", "dopri5"}) {
    const auto system =
        compile_case(GetParam(), "{gradient: direct, method: " + std::string(method) + "}");
    const GradientCheck check =
        check_gradient(system, start_of(system->study()), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-10);
    EXPECT_GT(check.evaluation.gradient.cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST_P(ControlGradientTest, IsThatOfTheOtherIntegrator) {
  const auto own = compile_case(GetParam(),
                                "{gradient: direct, method: rodas5p, relative_tolerance: 1.0e-9, "
                                "absolute_tolerance: 1.0e-10}");
  const auto other = compile_case(
      GetParam(), "{integrator: idas, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}");
  const Eigen::VectorXd rho = start_of(own->study());
  const Evaluation a = evaluator_of(own).evaluate(rho, true),
                   b = evaluator_of(other).evaluate(rho, true);
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_NEAR(a.objective, b.objective, 1e-6 * a.objective);
  EXPECT_LT((a.gradient - b.gradient).cwiseAbs().maxCoeff(),
            1e-5 * a.gradient.cwiseAbs().maxCoeff())
      << a.gradient << "\n"
      << b.gradient;
}

TEST_P(ControlGradientTest, OfTheAdjointIsTheSame) {
  for (const char* method : {"rodas4", "dopri5"}) {
    const auto system =
        compile_case(GetParam(), "{gradient: adjoint, method: " + std::string(method) + "}");
    EXPECT_TRUE(prefers_adjoint(*system));
    RosenbrockGradient direct(*system);
    AdjointGradient adjoint(*system);
    const GradientRun a = run_gradient(&direct, *system, system->parameters()),
                      b = run_gradient(&adjoint, *system, system->parameters());
    ASSERT_TRUE(a.status.ok() && b.status.ok());
    EXPECT_LT((a.gradient - b.gradient).cwiseAbs().maxCoeff(),
              1e-10 * a.gradient.cwiseAbs().maxCoeff())
        << method;
  }
}

INSTANTIATE_TEST_SUITE_P(Controls, ControlGradientTest, ::testing::ValuesIn(control_cases()),
                         [](const ::testing::TestParamInfo<ControlCase>& test) {
                           return test.param.name;
                         });

TEST(SampledPeaks, MeetTheComplexStep) {
  // The effort jumps at each sample, so that its peak lies right behind one.
  const ControlCase sampled{"", shoulder("sample_time: 0.02"), "shoulder/position"};
  const auto system = compile_case(sampled, "{method: rodas5p}",
                                   "path: [{signal: shoulder/effort, at_most: 20.0}, {signal: "
                                   "elbow/acceleration, at_most: 50.0}]\n");
  const GradientCheck check =
      check_gradient(system, start_of(system->study()), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-9);
}

TEST(RoundedMeasurements, HaveNoGradient) {
  const ControlCase rounded{"", shoulder("sample_time: 0.02, quantization: 0.01"),
                            "shoulder/position"};
  const auto system = compile_case(rounded, "{}");
  Evaluator evaluator = evaluator_of(system);
  EXPECT_TRUE(evaluator.evaluate(start_of(system->study()), false).status.ok());
  const Evaluation refused = evaluator.evaluate(start_of(system->study()), true);
  EXPECT_EQ(refused.status.code, StatusCode::kNonFiniteGradient);
  EXPECT_NE(refused.status.cause.find("servo.quantization"), std::string::npos);
}

}  // namespace
}  // namespace codesign
