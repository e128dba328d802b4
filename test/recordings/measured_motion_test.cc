// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "recordings/measured_motion.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

std::vector<double> values_at(const std::vector<double>& times, double (*f)(double)) {
  std::vector<double> values;
  for (const double t : times) values.push_back(f(t));
  return values;
}

double parabola(double t) { return 1.0 - 2.0 * t + 3.0 * t * t; }
double line(double t) { return 4.0 - 0.5 * t; }

TEST(UniformTimes, EqualStepsNeedNoInterpolation) {
  const UniformTimes times = uniform_times({1.0, 1.1, 1.2, 1.3, 1.4});
  EXPECT_TRUE(times.exact);
  EXPECT_EQ(times.count, 5);
  EXPECT_NEAR(times.step, 0.1, 1e-15);
  EXPECT_NEAR(times.rate(), 10.0, 1e-12);
  EXPECT_NEAR(times.at(4), 1.4, 1e-15);
}

TEST(UniformTimes, APauseCountsAsWholePeriods) {
  const UniformTimes times = uniform_times({0.0, 0.1, 0.2, 0.5, 0.6, 0.7, 0.8});
  EXPECT_FALSE(times.exact);
  EXPECT_EQ(times.count, 9);
  EXPECT_NEAR(times.step, 0.1, 1e-15);
}

TEST(UniformTimes, JitterBelowAThousandthIsNone) {
  EXPECT_TRUE(uniform_times({0.0, 1.0005, 1.9995, 3.0}).exact);
  EXPECT_FALSE(uniform_times({0.0, 1.002, 2.0, 3.0}).exact);
}

TEST(Resample, CubicsAreExactForParabolasAndLinesForLines) {
  const std::vector<double> times = {0.0, 0.9, 2.1, 3.0, 4.2, 4.9, 6.0};
  const UniformTimes uniform = uniform_times(times);
  ASSERT_FALSE(uniform.exact);
  const Eigen::VectorXd cubic =
      resample(times, values_at(times, parabola), uniform, Resampling::kCubic);
  const Eigen::VectorXd linear =
      resample(times, values_at(times, line), uniform, Resampling::kLinear);
  for (Eigen::Index k = 0; k < uniform.count; ++k) {
    EXPECT_NEAR(cubic[k], parabola(uniform.at(k)), 1e-12);
    EXPECT_NEAR(linear[k], line(uniform.at(k)), 1e-12);
  }
}

TEST(Resample, LinesDoNotOvershootAtAJump) {
  const std::vector<double> times = {0.0, 1.0, 2.1, 3.0, 3.9, 5.0};
  const std::vector<double> jump = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
  const UniformTimes uniform = uniform_times(times);
  const Eigen::VectorXd linear = resample(times, jump, uniform, Resampling::kLinear),
                        cubic = resample(times, jump, uniform, Resampling::kCubic);
  EXPECT_GE(linear.minCoeff(), 0.0);
  EXPECT_LE(linear.maxCoeff(), 1.0);
  EXPECT_GT(cubic.maxCoeff() - cubic.minCoeff(), 1.0);
}

TEST(Derivative, IsExactForPolynomialsOfItsOrder) {
  const double step = 0.1;
  const auto power = [step](int degree) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(
        21, [=](Eigen::Index k) { return std::pow(step * double(k - 10), degree); }));
  };
  const auto expected = [step](int degree, Eigen::Index k) {
    return degree * std::pow(step * double(k - 10), degree - 1);
  };
  const Eigen::VectorXd eighth = derivative(power(8), step), second = derivative(power(2), step);
  for (Eigen::Index k = 4; k < 17; ++k) EXPECT_NEAR(eighth[k], expected(8, k), 1e-12) << k;
  EXPECT_GT(std::abs(eighth[3] - expected(8, 3)), 1e-6);
  for (Eigen::Index k = 0; k < 21; ++k) EXPECT_NEAR(second[k], expected(2, k), 1e-12) << k;
}

// At 100 Hz, a motion of 20 Hz: differences of order two would lose a quarter of its velocity.
TEST(Derivative, HoldsUpToAFifthOfTheRate) {
  const double step = 0.01, w = 2.0 * 3.14159265358979323846 * 20.0;
  const Eigen::VectorXd wave = Eigen::VectorXd::NullaryExpr(
      101, [=](Eigen::Index k) { return std::sin(w * step * double(k)); });
  EXPECT_NEAR(derivative(wave, step)[50], w * std::cos(w * step * 50.0), 0.01 * w);
}

TEST(Integral, IsExactForPolynomialsOfItsOrder) {
  const double step = 0.1;
  const auto power = [step](int degree) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(
        21, [=](Eigen::Index k) { return std::pow(step * double(k - 10), degree); }));
  };
  const auto expected = [step](int degree, Eigen::Index k) {
    return (std::pow(step * double(k - 10), degree + 1) - std::pow(-10.0 * step, degree + 1)) /
           (degree + 1);
  };
  const Eigen::VectorXd third = integral(power(3), step), fifth = integral(power(5), step);
  EXPECT_EQ(third[0], 0.0);
  for (Eigen::Index k = 0; k < 21; ++k) EXPECT_NEAR(third[k], expected(3, k), 1e-13) << k;
  for (Eigen::Index k = 2; k < 19; ++k)
    EXPECT_NEAR(fifth[k] - fifth[2], expected(5, k) - expected(5, 2), 1e-13) << k;
  EXPECT_GT(std::abs(fifth[1] - expected(5, 1)), 1e-6);
}

// At 100 Hz, a motion of 10 Hz: the trapezoidal rule would lose 3 % of its amplitude.
TEST(Integral, UndoesTheDerivative) {
  const double step = 0.01, w = 2.0 * 3.14159265358979323846 * 10.0;
  const Eigen::VectorXd wave = Eigen::VectorXd::NullaryExpr(
      201, [=](Eigen::Index k) { return std::sin(w * step * double(k) + 0.3); });
  const Eigen::VectorXd again = integral(derivative(wave, step), step);
  for (Eigen::Index k = 10; k < 191; ++k)
    EXPECT_NEAR(again[k] - again[10], wave[k] - wave[10], 3e-3) << k;
}

FilterOptions filter_of(double cutoff, int decimate = 1) {
  FilterOptions filter;
  filter.cutoff = cutoff;
  filter.residual_cutoff = cutoff;
  filter.decimate = decimate;
  filter.where = {"study.yaml", 6};
  return filter;
}

// x = 0.5 sin(2 t): the velocity and the acceleration are known, and 10 Hz is far above 2 rad/s.
void expect_swing(const MeasuredMotion& motion, double tolerance) {
  const JointMotion& joint = motion.joints.at(0);
  for (Eigen::Index k = motion.first; k < motion.end; k += motion.every) {
    const double t = motion.times.at(k);
    ASSERT_NEAR(joint.position[k], 0.5 * std::sin(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.velocity[k], std::cos(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.acceleration[k], -2.0 * std::sin(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.effort[k], 3.0 * std::sin(2.0 * t), tolerance) << t;
  }
}

TEST(MeasuredMotion, DerivesWhatWasNotMeasured) {
  JointRecording recording = swing(400);
  recording.joints[0].velocity.clear();
  Warnings warnings;
  const MeasuredMotion motion = measured_motion(recording, filter_of(10.0), &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_FALSE(motion.joints[0].velocity_measured);
  EXPECT_EQ(motion.first, 44);
  EXPECT_EQ(motion.end, 356);
  EXPECT_EQ(motion.fitted(), 312);
  expect_swing(motion, 3e-4);
}

TEST(MeasuredMotion, TakesTheVelocityThatWasMeasured) {
  Warnings warnings;
  const MeasuredMotion motion = measured_motion(swing(400), filter_of(10.0, 5), &warnings);
  EXPECT_TRUE(motion.joints[0].velocity_measured);
  EXPECT_EQ(motion.every, 5);
  EXPECT_EQ(motion.fitted(), 63);
  expect_swing(motion, 2e-5);
}

TEST(MeasuredMotion, PutsJitteringTimesOnEqualSteps) {
  JointRecording recording = swing(400);
  JointSamples& samples = recording.joints[0];
  for (std::size_t k = 0; k < 400; ++k) {
    const double t = 0.01 * (static_cast<double>(k) + 0.3 * std::sin(7.0 * static_cast<double>(k)));
    recording.times[k] = t;
    samples.position[k] = 0.5 * std::sin(2.0 * t);
    samples.effort[k] = 3.0 * std::sin(2.0 * t);
  }
  samples.velocity.clear();
  Warnings warnings;
  expect_swing(measured_motion(recording, filter_of(10.0), &warnings), 2e-3);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_resampled");
}

TEST(MeasuredMotion, AVelocityAloneGivesAnAcceleration) {
  JointRecording recording = swing(400);
  recording.joints[0].position.clear();
  recording.joints[0].effort.clear();
  Warnings warnings;
  const JointMotion joint = measured_motion(recording, filter_of(10.0), &warnings).joints.at(0);
  EXPECT_EQ(joint.position.size(), 0);
  EXPECT_EQ(joint.effort.size(), 0);
  EXPECT_NEAR(joint.acceleration[200], -2.0 * std::sin(4.0), 1e-5);
}

TEST(MeasuredMotion, WarnsOfNoiseThatGetsThrough) {
  Warnings warnings;
  FilterOptions filter = filter_of(0.0, 4);
  measured_motion(swing(400), filter, &warnings);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0].code, "recording_not_filtered");
  EXPECT_EQ(warnings[1].code, "recording_aliased");
  expect_word(warnings[1].message, "above 12.5 Hz");
  warnings.clear();
  measured_motion(swing(400), filter_of(12.0, 4), &warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(MeasuredMotion, RefusesCutoffsAndLengthsThatCannotBe) {
  Warnings warnings;
  const InputFault cutoff =
      refusal_of([&] { measured_motion(swing(400), filter_of(50.0), &warnings); });
  EXPECT_EQ(cutoff.element, "identify.filter.cutoff");
  EXPECT_EQ(cutoff.where.line, 6);
  expect_word(cutoff.message, "a recording of 100 samples per second");
  EXPECT_EQ(cutoff.allowed, "less than 50 Hz, or 0 for no filter");
  const InputFault length =
      refusal_of([&] { measured_motion(swing(60), filter_of(10.0), &warnings); });
  EXPECT_EQ(length.element, "identify.data[0]");
  expect_word(length.message, "60 samples leave 0 to fit");
  for (const double low : {1e-9, 1e-300}) {
    const InputFault none =
        refusal_of([&] { measured_motion(swing(400), filter_of(low), &warnings); });
    expect_word(none.message, "400 samples leave 0 to fit");
  }
}

TEST(MeasuredMotion, APositionThatWasNotMeasuredIsTheIntegralOfTheVelocity) {
  JointRecording recording = swing(400);
  JointSamples& hinge = recording.joints[0];
  const std::vector<double> truth = hinge.position;
  hinge.position.clear();
  FilterOptions filter;
  filter.cutoff = 10.0;
  Warnings warnings;
  EXPECT_EQ(measured_motion(recording, filter, &warnings).joints[0].position.size(), 0);
  hinge.start.emplace(0.25);
  const MeasuredMotion motion = measured_motion(recording, filter, &warnings);
  EXPECT_EQ(motion.element, "identify.data[0]");
  EXPECT_FALSE(motion.joints[0].position_measured);
  EXPECT_EQ(motion.joints[0].position[0], 0.25);
  // The filter knows one side only at the beginning, which leaves a constant.
  const double off =
      motion.joints[0].position[motion.first] - truth[static_cast<std::size_t>(motion.first)];
  EXPECT_NEAR(off, 0.25, 2e-4);
  for (Eigen::Index k = motion.first; k < motion.end; ++k)
    EXPECT_NEAR(motion.joints[0].position[k], truth[static_cast<std::size_t>(k)] + off, 1e-6) << k;
}

}  // namespace

}  // namespace codesign
