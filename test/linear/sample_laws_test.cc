// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sample_laws.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "linear/linear_model.h"
#include "linear/linear_motion.h"
#include "linear/sampled_motion.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

/// Compares the jumps of all samples at t = 0 with those of the samples of runs, differentiated.
void expect_jumps_of_runs(const std::string& controllers) {
  const Problem problem =
      loaded(carts(2, {damped(1.0), sprung(3.0, 0.2)}, true), controlled(controllers));
  const CompiledSystem& of = *system_of(problem);
  const LinearStudy study = with_inputs(bare_study({&of, problem.parameters(), {}, true, {}}),
                                        problem.parameters(), 0.0, true);
  const CompiledSystem system(of.robot(), study.study, of.sharing());
  StartWorkspace start(system, study.parameters);
  ASSERT_TRUE(start.solve().ok());
  LinearMotion motion(system, study);
  ASSERT_TRUE(motion.linearize_at_rest(start.state).ok());
  const Eigen::Index f = motion.motions() / 2, x = motion.motions() + system.layout().states;
  ComplexMotion moves;
  cast_state(motion.state(), &moves.state);
  moves.parameters.assign(study.parameters.begin(), study.parameters.end());
  moves.motions = motion.motions();
  moves.q = Eigen::MatrixXcd::Zero(system.layout().n, x);
  moves.v = Eigen::MatrixXcd::Zero(system.layout().n, x);
  moves.q.leftCols(f) = motion.coordinates().Q.cast<std::complex<double>>();
  moves.v.middleCols(f, f) = moves.q.leftCols(f);
  // No constraints: the rates are those of y' and of s.
  moves.z = motion.flow().A.leftCols(x).bottomRows(x - f).cast<std::complex<double>>();
  SampleLaws laws(system, study);
  std::vector<ControlEvent> events;
  for (std::size_t c = 0; c < of.controllers().size(); ++c)
    if (const ControlRealization& realization = of.study().controllers[c].realization;
        realization.is_sampled())
      events.push_back(
          {ControlEvent::Kind::kSample, static_cast<int>(c), first_sample(realization)});
  ASSERT_FALSE(events.empty());
  const Eigen::MatrixXcd found = laws.jump(events, moves);
  const Eigen::MatrixXd expected = motion.jump(events).leftCols(x);
  EXPECT_LT((found.real() - expected).cwiseAbs().maxCoeff(),
            1e-12 * (1.0 + expected.cwiseAbs().maxCoeff()))
      << controllers << "\n"
      << found.real() << "\n\n"
      << expected;
}

TEST(SampleLaws, OfAPidWithItsMemory) {
  expect_jumps_of_runs(cart_servo(
      "gains: {p: 6, i: 2, d: 3}, derivative_filter: 0.03, sample_time: 0.02, i_clamp: 50, "
      "antiwindup: true, output_limit: 60"));
  expect_jumps_of_runs(
      cart_servo("gains: {p: 6, d: 3}, derivative: measurement, sample_time: 0.02, delay: 0.05"));
}

TEST(SampleLaws, OfChainsOfFilters) {
  expect_jumps_of_runs(
      cart_servo("gains: {p: 6, i: 2, d: 3}, sample_time: 0.02, filter: [{type: notch, frequency: "
                 "8, damping: 0.4, depth: 0.2}, {type: lead_lag, zero: 1.5, pole: 12}, {type: "
                 "low_pass, frequency: 20}]"));
  expect_jumps_of_runs(
      "servo: {type: state_feedback, output: x0, sample_time: 0.02, feedback: [{signal: "
      "x0/position, gain: 6, filter: {type: low_pass_2, frequency: 9}}, {signal: x0/velocity, "
      "gain: 2}, {signal: x1/position, gain: -1, filter: {type: lead_lag, zero: 4, pole: 1}}]}");
}

// The inner loop and the reader of a filter see what earlier samples of the instant have written.
TEST(SampleLaws, OfLawsThatReadEachOther) {
  expect_jumps_of_runs(
      "outer: {type: pid, input: x0/position, setpoint: 0.2, gains: {p: 3, i: 1}, sample_time: "
      "0.02}, smooth: {type: state_feedback, sample_time: 0.02, feedback: [{signal: x0/velocity, "
      "gain: -1, filter: {type: low_pass, frequency: 4}}]}, inner: {type: pid, input: "
      "smooth/output - outer/output, setpoint: 0, output: x0, gains: {p: 8}, sample_time: 0.01}");
}

// Through a continuous controller an acceleration reaches a sample.
TEST(SampleLaws, OfALawThatReadsAnAcceleration) {
  expect_jumps_of_runs(
      "servo: {type: pid, input: \"${x0/position + 0.1*x0/velocity + 0.01*x0/acceleration}\", "
      "setpoint: 0, output: x0, gains: {p: 30}}, follow: {type: pid, input: servo/output, "
      "setpoint: 0, output: x1, gains: {p: 0.1}, sample_time: 0.1, filter: {type: low_pass, "
      "frequency: 3}}");
}

}  // namespace
}  // namespace codesign
