// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/signal_watch.h"
#include "sensitivity/watched_cases.h"

namespace codesign {
namespace {

Study watched_study() {
  Study study;
  study.duration = 1.0;
  WatchedSignal& peak = study.watched.emplace_back();
  peak.role = WatchedSignal::Role::kPeak;
  peak.weight = 3.0;
  peak.before = 1.0;
  return study;
}

TEST(Peaks, AreTheGreatestMagnitudeTimesTheWeight) {
  const Study study = watched_study();
  const WatchLayout layout(study);
  Extremes extremes;
  extremes.values.setZero(layout.size());
  extremes.gradients.setZero(2, layout.size());
  const int place = layout.entries()[0].smallest(3);
  extremes.values[layout.entries()[0].largest(1)] = 1.5;
  extremes.values[place] = -2.0;
  extremes.gradients.col(place) = Eigen::Vector2d(0.5, -1.0);
  EXPECT_EQ(find_peak(layout.entries()[0], extremes.values).place, place);
  Eigen::VectorXd gradient = Eigen::Vector2d(1.0, 1.0);
  EXPECT_EQ(watched_terms(study, layout, extremes, &gradient), 6.0);
  EXPECT_EQ(gradient, Eigen::VectorXd(Eigen::Vector2d(1.0 - 1.5, 1.0 + 3.0)));
}

TEST(Peaks, ConstraintsAddNothingToTheObjective) {
  Study study = watched_study();
  study.watched[0].role = WatchedSignal::Role::kPath;
  EXPECT_EQ(watched_terms(study, WatchLayout(study), {}, nullptr), 0.0);
}

class SignalWatchTest : public ::testing::TestWithParam<std::size_t> {
 protected:
  const GradientCase test_ = with_watched(gradient_cases().at(GetParam()));
};

std::vector<SignalDescription> watched_signals(const MotionStudy& study) {
  std::vector<SignalDescription> signals;
  for (const WatchedSignal& watched : study.watched) signals.push_back(watched.signal);
  return signals;
}

// A scan of the same run finds nothing beyond the extremes, and at their times it has their values.
TEST_P(SignalWatchTest, NoSampleOfTheRunIsBeyondTheExtremes) {
  const auto system = test_.compile("rodas4", "auto");
  const Evaluation evaluation = evaluator_of(system).evaluate_design(system->parameters(), false);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  const WatchLayout layout(system->study());
  ASSERT_EQ(evaluation.extremes.values.size(), layout.size());
  std::vector<double> times;
  for (const WatchLayout::Entry& entry : layout.entries())
    for (int window = 0; window < entry.windows(); ++window)
      for (int place : {entry.largest(window), entry.smallest(window)})
        times.push_back(evaluation.extremes.times[place]);
  for (int k = 0; k <= 2000; ++k) times.push_back(test_.study.duration * (0.1 + 0.85 * k / 2000));
  std::sort(times.begin(), times.end());
  Simulation simulation =
      simulation_of(system, system->parameters(), watched_signals(system->study()));
  ASSERT_TRUE(simulation.start().ok());
  Frame frame;
  int met = 0;
  for (double time : times) {
    ASSERT_TRUE(simulation.advance(time).ok());
    simulation.sample(time, &frame);
    for (std::size_t k = 0; k < layout.entries().size(); ++k) {
      const WatchLayout::Entry& entry = layout.entries()[k];
      const double value = frame.signals[k], slack = 1e-9 * std::max(1.0, std::abs(value));
      const auto after = std::upper_bound(entry.instants.begin(), entry.instants.end(), time);
      const int window =
          std::min(static_cast<int>(after - entry.instants.begin()), entry.windows()) - 1;
      if (window < 0) continue;
      for (int place : {entry.largest(window), entry.smallest(window)})
        if (evaluation.extremes.times[place] == time) {
          EXPECT_NEAR(evaluation.extremes.values[place], value, slack)
              << system->study().watched[k].signal.text << " at " << time;
          ++met;
        }
      EXPECT_LE(value, evaluation.extremes.values[entry.largest(window)] + slack)
          << system->study().watched[k].signal.text << " at " << time;
      EXPECT_GE(value, evaluation.extremes.values[entry.smallest(window)] - slack)
          << system->study().watched[k].signal.text << " at " << time;
    }
  }
  EXPECT_GE(met, 2 * static_cast<int>(layout.entries().size()));
}

TEST_P(SignalWatchTest, GradientsMeetTheComplexStep) {
  for (const char* method : {"rodas4", "rodas5p", "dopri5"}) {
    const auto system = test_.compile(method, "auto");
    const Eigen::VectorXd rho = start_of(system->study());
    const GradientCheck check = check_gradient(system, rho, CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    ASSERT_GT(check.extreme_reference.size(), 0);
    EXPECT_GT(check.extreme_reference.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_LT(check.largest_relative_difference, 1e-8) << method;
    GradientCheck wrong = check;
    wrong.evaluation.extremes.gradients *= 1.0 + 1e-6;
    wrong.largest_relative_difference = 0.0;
    compare(&wrong);
    EXPECT_GT(wrong.largest_relative_difference, 1e-7) << "a wrong derivative is found";
  }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, SignalWatchTest,
                         ::testing::Range(std::size_t{0}, gradient_cases().size()),
                         [](const auto& instance) {
                           return gradient_cases().at(instance.param).name;
                         });

// Two integrators, each with its own dense output and sensitivities.
TEST(SignalWatch, IdasAgrees) {
  GradientCase test = with_watched(gradient_cases().front());
  test.study.solver.relative_tolerance = 1e-9;
  test.study.solver.absolute_tolerance = 1e-10;
  const auto rosenbrock = test.compile("rodas5p", "auto");
  test.study.solver.integrator = IntegratorKind::kIdas;
  const auto idas = test.compile("rodas5p", "auto");
  const Evaluation a = evaluator_of(rosenbrock).evaluate(start_of(test.study), true),
                   b = evaluator_of(idas).evaluate(start_of(test.study), true);
  ASSERT_TRUE(a.status.ok() && b.status.ok()) << a.status.cause << b.status.cause;
  EXPECT_NEAR(b.objective, a.objective, 1e-5 * std::abs(a.objective));
  const double scale = a.extremes.values.cwiseAbs().maxCoeff(),
               slope = a.extremes.gradients.cwiseAbs().maxCoeff();
  EXPECT_LT((a.extremes.values - b.extremes.values).cwiseAbs().maxCoeff(), 1e-5 * scale);
  EXPECT_LT((a.extremes.gradients - b.extremes.gradients).cwiseAbs().maxCoeff(), 1e-3 * slope);
}

TEST(SignalWatch, WithoutWatchedSignalsThereIsNothing) {
  const auto system = gradient_cases().front().compile("rodas4", "auto");
  const Evaluation evaluation = evaluator_of(system).evaluate(start_of(system->study()), true);
  EXPECT_EQ(evaluation.extremes.values.size(), 0);
}

}  // namespace

}  // namespace codesign
