// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Sampled controllers on a double integrator, whose motion between samples is known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kPeriod = 0.01;

/// A mass of 1 kg on a slide, driven by a sampled PD on its position; no gravity, no friction.
std::shared_ptr<const CompiledSystem> cart(const std::string& gains, const std::string& keys,
                                           const std::string& integrator, double duration) {
  const std::string urdf = robot(
      "<link name='cart'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' "
      "iyz='0'/></inertial></link>"
      "<joint name='slide' type='prismatic'><parent link='ground'/><child link='cart'/><axis "
      "xyz='1 0 0'/><limit effort='1' "
      "velocity='1'/></joint>");
  return compile(
      urdf,
      "duration: " + std::to_string(duration) +
          "\ngravity: [0.0, 0.0, 0.0]\ninitial_state: {slide: {position: 0.1, velocity: "
          "0.3}}\ncontrollers: {pd: {type: pid, input: "
          "slide/position, setpoint: 0.0, output: slide, gains: " +
          gains + ", sample_time: 0.01" + keys + "}}\nsolver: {integrator: " + integrator +
          ", relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-11, maximum_speed: 1.0e6}\n");
}

std::string pd(double p, double d) {
  return "{p: " + std::to_string(p) + ", d: " + std::to_string(d) + "}";
}

/// One sample of the closed loop for (x, v, x at the sample before, outputs that wait, the oldest
/// first): the controller reads x, the output that comes into effect drives the mass for one
/// period.
Eigen::MatrixXd closed_loop(double p, double d, int wait) {
  const double T = kPeriod;
  const Eigen::Index size = 3 + wait;
  Eigen::RowVectorXd output = Eigen::RowVectorXd::Zero(size), effort = output;
  output[0] = -p - d / T;
  output[2] = d / T;
  if (wait > 0)
    effort[3] = 1.0;
  else
    effort = output;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  A(0, 0) = A(1, 1) = A(2, 0) = 1.0;
  A(0, 1) = T;
  A.row(0) += 0.5 * T * T * effort;
  A.row(1) += T * effort;
  for (int k = 0; k + 1 < wait; ++k) A(3 + k, 4 + k) = 1.0;
  if (wait > 0) A.row(size - 1) = output;
  return A;
}

double spectral_radius(const Eigen::MatrixXd& A) {
  return general_eigen(A).values.cwiseAbs().maxCoeff();
}

/// The largest stable p of the loop without delay, by Jury's criterion for z^3 + (a + b - 2) z^2 +
/// (1 + a) z - b with a = p T^2/2 and b = d T/2: a < 2 b (1 - b)/(1 + b). (Astrom and Wittenmark,
/// Computer-Controlled Systems, 3.2.)
double critical_gain(double d) {
  const double b = 0.5 * d * kPeriod;
  return 2.0 / (kPeriod * kPeriod) * 2.0 * b * (1.0 - b) / (1.0 + b);
}

/// Positions at the samples.
std::vector<double> simulate_cart(const std::shared_ptr<const CompiledSystem>& system,
                                  int samples) {
  Simulation simulation = simulation_of(system, {}, {parse_signal("slide/position", {}, "signal")});
  std::vector<double> positions;
  const Status status =
      simulate(&simulation, samples * kPeriod, samples + 1, [&](const Frame& frame) {
        positions.push_back(frame.signals[0]);
        return true;
      });
  EXPECT_TRUE(status.ok()) << status.cause;
  return positions;
}

TEST(SampledControl, MovesADoubleIntegratorFromSampleToSampleAsItsMatrixSays) {
  constexpr int kSamples = 60;
  for (const char* integrator : {"rosenbrock", "idas"})
    for (const int wait : {0, 1, 3}) {
      const std::string delay = wait == 0 ? "" : ", delay: " + std::to_string(wait * kPeriod);
      const std::vector<double> positions =
          simulate_cart(cart(pd(900.0, 40.0), delay, integrator, kSamples * kPeriod), kSamples);
      ASSERT_EQ(positions.size(), kSamples + 1u);
      const Eigen::MatrixXd A = closed_loop(900.0, 40.0, wait);
      Eigen::VectorXd state = Eigen::VectorXd::Zero(A.rows());
      state << 0.1, 0.3, 0.1, Eigen::VectorXd::Zero(wait);
      for (int k = 0; k <= kSamples; ++k) {
        EXPECT_NEAR(positions[static_cast<std::size_t>(k)], state[0],
                    1e-7 * (1.0 + std::abs(state[0])))
            << integrator << " " << wait << " " << k;
        state = A * state;
      }
    }
}

// k T and the instant of a sample are the same to rounding only.
TEST(SampledControl, SignalsAtAnInstantAreThoseBeforeItsJump) {
  constexpr int kSamples = 90;
  Simulation simulation =
      simulation_of(cart(pd(900.0, 40.0), ", delay: 0.01", "rosenbrock", kSamples * kPeriod), {},
                    {parse_signal("pd/output", {}, "signal")});
  std::vector<double> outputs;
  // Instants and the middles between them.
  const Status status =
      simulate(&simulation, kSamples * kPeriod, 2 * kSamples + 1, [&](const Frame& frame) {
        outputs.push_back(frame.signals[0]);
        return true;
      });
  ASSERT_TRUE(status.ok()) << status.cause;
  for (std::size_t k = 2; k < outputs.size(); k += 2)
    EXPECT_NEAR(outputs[k], outputs[k - 1], 1e-9) << k / 2;
}

TEST(SampledControl, LosesStabilityAtTheGainOfTheTextbook) {
  const double d = 60.0, critical = critical_gain(d);
  EXPECT_NEAR(spectral_radius(closed_loop(critical, d, 0)), 1.0, 1e-9)
      << "the eigenvalues say what Jury's criterion says";
  constexpr int kSamples = 400;
  const auto growth = [&](double p) {
    const std::vector<double> x =
        simulate_cart(cart(pd(p, d), "", "rosenbrock", kSamples * kPeriod), kSamples);
    double early = 0.0, late = 0.0;
    for (std::size_t k = 0; k < 100; ++k) {
      early = std::max(early, std::abs(x[100 + k]));
      late = std::max(late, std::abs(x[300 + k]));
    }
    return std::pow(late / early, 1.0 / 200.0);
  };
  const double below = 0.98 * critical, above = 1.02 * critical;
  EXPECT_LT(growth(below), 1.0);
  EXPECT_GT(growth(above), 1.0);
  EXPECT_NEAR(growth(below), spectral_radius(closed_loop(below, d, 0)), 2e-4);
  EXPECT_NEAR(growth(above), spectral_radius(closed_loop(above, d, 0)), 2e-4);
}

TEST(SampledControl, RoundsWhatItMeasures) {
  // x = 0.1 + 0.3 t with a gain of zero would not show; a small gain and a coarse encoder give
  // outputs in multiples of p q.
  const auto system = cart("{p: 0.01}", ", quantization: 0.02", "rosenbrock", 0.5);
  Simulation simulation = simulation_of(
      system, {},
      {parse_signal("pd/output", {}, "signal"), parse_signal("slide/position", {}, "signal")});
  int changes = 0;
  double last = 0.0;
  const Status status = simulate(&simulation, 0.495, 100, [&](const Frame& frame) {
    const double counts = frame.signals[0] / (0.01 * 0.02);
    EXPECT_NEAR(counts, std::round(counts), 1e-9);
    EXPECT_NEAR(frame.signals[0], -0.01 * frame.signals[1], 0.01 * (0.01 + 0.3 * kPeriod));
    changes += counts != last ? 1 : 0;
    last = counts;
    return true;
  });
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_GT(changes, 5);
}

/// The largest output of a PD on a cart at rest whose set-point steps from 0 to 1.
double largest_output(const std::string& keys, const std::string& integrator) {
  const std::string urdf = robot(
      "<link name='cart'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link>"
      "<joint name='slide' type='prismatic'><parent link='ground'/><child link='cart'/><axis "
      "xyz='1 0 0'/><limit effort='1' velocity='1'/></joint>");
  const auto system =
      compile(urdf,
              "duration: 0.3\ngravity: [0.0, 0.0, 0.0]\ncontrollers: {pd: {type: pid, input: "
              "slide/position, setpoint: \"${t < 0.095 ? 0 : 1}\", output: slide, gains: {p: 2.0, "
              "d: 1.0}" +
                  keys + "}}\nsolver: {integrator: " + integrator + "}\n");
  Simulation simulation = simulation_of(system, {}, {parse_signal("pd/output", {}, "signal")});
  double largest = 0.0;
  const Status status = simulate(&simulation, 0.3, 3001, [&](const Frame& frame) {
    largest = std::max(largest, frame.signals[0]);
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return largest;
}

// d of the error is 1/T for one sample, and 1/tau behind a filter; the impulse that it would be
// without both is left out.
TEST(SampledControl, ASetpointKicksTheDerivativeOfTheErrorAlone) {
  const std::string measured = ", derivative: measurement", sampled = ", sample_time: 0.01",
                    filtered = ", derivative_filter: 0.02";
  for (const char* integrator : {"rosenbrock", "idas"}) {
    SCOPED_TRACE(integrator);
    const bool is_rosenbrock = std::string(integrator) == "rosenbrock";
    EXPECT_NEAR(is_rosenbrock ? largest_output("", integrator) : 2.0, 2.0, 1e-3);
    EXPECT_NEAR(largest_output(sampled, integrator), 2.0 + 1.0 / 0.01, 1e-3);
    EXPECT_NEAR(largest_output(sampled + measured, integrator), 2.0, 1e-3);
  }
  EXPECT_NEAR(largest_output(measured, "rosenbrock"), 2.0, 1e-3);
  EXPECT_NEAR(largest_output(filtered, "rosenbrock"), 2.0 + 1.0 / 0.02, 0.5);
  EXPECT_NEAR(largest_output(filtered + measured, "rosenbrock"), 2.0, 1e-3);
}

TEST(SampledControl, GoesOnBeyondTheDuration) {
  const auto system = cart(pd(900.0, 40.0), "", "rosenbrock", 0.05);
  Simulation simulation = simulation_of(system, {}, {parse_signal("slide/position", {}, "signal")});
  ASSERT_TRUE(simulation.start().ok());
  Frame frame;
  ASSERT_TRUE(simulation.advance(0.6).ok());
  simulation.sample(0.6, &frame);
  EXPECT_LT(std::abs(frame.signals[0]), 0.01) << "the controller still holds the cart";
}

}  // namespace
}  // namespace codesign
