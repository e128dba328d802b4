// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "identification/fit/residual_fit.h"
#include "identification/identify.h"
#include "jobs/identification_records.h"
#include "jobs/json.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Decays x0 exp(-x1 t), one output per row of `measured`, of amplitude x0 times `factors`.
class Decays final : public ResidualSource {
 public:
  Decays(Eigen::MatrixXd measured, Eigen::VectorXd factors)
      : measured_(std::move(measured)), factors_(std::move(factors)) {
    lengths_ = {measured_.rows()};
    for (Eigen::Index k = 0; k < measured_.cols(); ++k)
      outputs_.push_back("output_" + std::to_string(k));
  }
  static double value(const Eigen::VectorXd& x, Eigen::Index row) {
    return x[0] * std::exp(-x[1] * time(row));
  }
  static double time(Eigen::Index row) { return 0.05 * static_cast<double>(row); }

  const std::vector<std::string>& outputs() const override { return outputs_; }
  const SeriesLengths& lengths() const override { return lengths_; }
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override {
    if (x[0] < fails_below) return {StatusCode::kInvalidDesign, 0.0, "the amplitude is too small"};
    residuals->resize(measured_.rows(), measured_.cols());
    if (jacobian) jacobian->setZero(measured_.size(), x.size());
    for (Eigen::Index k = 0; k < measured_.cols(); ++k)
      for (Eigen::Index row = 0; row < measured_.rows(); ++row) {
        (*residuals)(row, k) = factors_[k] * value(x, row) - measured_(row, k);
        if (!jacobian) continue;
        (*jacobian)(k * measured_.rows() + row, 0) = factors_[k] * value(x, row) / x[0];
        (*jacobian)(k * measured_.rows() + row, 1) = -factors_[k] * time(row) * value(x, row);
      }
    return {};
  }

  double fails_below = -kInfinity;

 private:
  Eigen::MatrixXd measured_;
  Eigen::VectorXd factors_;
  std::vector<std::string> outputs_;
  SeriesLengths lengths_;
};

const Eigen::Vector2d kTrueDecay(3.0, 0.7);

Eigen::MatrixXd decay(Eigen::Index rows, const Eigen::VectorXd& factors,
                      const Eigen::VectorXd& noise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd measured(rows, factors.size());
  for (Eigen::Index k = 0; k < factors.size(); ++k)
    for (Eigen::Index row = 0; row < rows; ++row)
      measured(row, k) = factors[k] * Decays::value(kTrueDecay, row) + noise[k] * normal(random);
  return measured;
}

FitProblem from(double amplitude, double rate) {
  FitProblem problem;
  problem.start = Eigen::Vector2d(amplitude, rate);
  problem.lower = Eigen::Vector2d(-kInfinity, -kInfinity);
  problem.upper = Eigen::Vector2d(kInfinity, kInfinity);
  problem.relative_tolerance = 1e-12;
  return problem;
}

Eigen::VectorXd one(double number) { return Eigen::VectorXd::Constant(1, number); }

// With other spreads a fit begins again where its residuals are known.
TEST(ResidualFit, NoPointIsEvaluatedTwiceWhenSpreadsChange) {
  const Eigen::Vector2d factors(1.0, 20.0), noise(0.01, 0.5);
  Decays source(decay(300, factors, noise), factors);
  std::vector<Eigen::VectorXd> points;
  const ResidualFit fit = fit_residuals(from(1.0, 0.2), &source, [&points](const FitTrial& trial) {
    points.push_back(trial.x);
    return true;
  });
  ASSERT_TRUE(fit.status.ok());
  EXPECT_EQ(fit.evaluations, static_cast<int>(points.size()));
  for (std::size_t k = 1; k < points.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) EXPECT_NE(points[k], points[j]) << k << ", " << j;
}

TEST(ResidualFit, ExactDataAreFoundExactly) {
  Decays source(decay(60, one(1.0), one(0.0)), one(1.0));
  const ResidualFit fit = fit_residuals(from(1.0, 0.1), &source);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
  EXPECT_LT((fit.x - kTrueDecay).norm(), 1e-8);
  EXPECT_LT(fit.residuals.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_GT(fit.start_residuals.norm(), 1.0);
}

TEST(ResidualFit, TheNoisyOutputCountsLess) {
  const Eigen::Vector2d factors(1.0, 2.0), noise(0.001, 1.0);
  Decays both(decay(200, factors, noise), factors);
  const ResidualFit fit = fit_residuals(from(1.0, 0.1), &both);
  ASSERT_TRUE(fit.status.ok());
  EXPECT_NEAR(fit.spreads[0], 0.001, 0.0002);
  EXPECT_NEAR(fit.spreads[1], 1.0, 0.15);
  EXPECT_LT((fit.x - kTrueDecay).norm(), 0.002) << "equal weights would be wrong by more than 0.02";
}

TEST(ResidualFit, ARobustLossIgnoresOutliers) {
  Eigen::MatrixXd measured = decay(200, one(1.0), one(0.01));
  for (Eigen::Index row = 0; row < 200; row += 10) measured(row, 0) += 5.0;
  Decays source(measured, one(1.0));
  const double plain = (fit_residuals(from(1.0, 0.1), &source).x - kTrueDecay).norm();
  FitProblem problem = from(1.0, 0.1);
  problem.loss = {LossKind::kHuber, 1.345};
  const ResidualFit fit = fit_residuals(problem, &source);
  EXPECT_GT(plain, 0.05);
  EXPECT_LT((fit.x - kTrueDecay).norm(), 0.02);
  EXPECT_NEAR(fit.spreads[0], 0.01, 0.004) << "outliers do not widen the spread";
}

TEST(ResidualFit, StaysWithinItsBounds) {
  Decays source(decay(60, one(1.0), one(0.0)), one(1.0));
  FitProblem problem = from(1.0, 0.1);
  problem.upper[1] = 0.5;
  const ResidualFit fit = fit_residuals(problem, &source);
  EXPECT_EQ(fit.x[1], 0.5);
  EXPECT_LT(fit.x[0], 3.0);
  problem.lower[1] = problem.upper[1] = problem.start[1] = 0.7;
  EXPECT_NEAR(fit_residuals(problem, &source).x[0], 3.0, 1e-9) << "equal bounds fix a number";
}

TEST(ResidualFit, TurnsBackFromPointsThatFail) {
  Decays source(decay(60, one(1.0), one(0.0)), one(1.0));
  source.fails_below = 0.5;
  FitProblem problem = from(40.0, 3.0);
  const ResidualFit fit = fit_residuals(problem, &source);
  ASSERT_TRUE(fit.status.ok());
  EXPECT_LT((fit.x - kTrueDecay).norm(), 1e-6);
  problem.start[0] = 0.1;
  const ResidualFit failed = fit_residuals(problem, &source);
  EXPECT_EQ(failed.status.code, StatusCode::kInvalidDesign);
  EXPECT_EQ(failed.termination, "start_failed");
}

TEST(ResidualFit, AnObserverEndsItWithTheBestPoint) {
  Decays source(decay(60, one(1.0), one(0.0)), one(1.0));
  int trials = 0;
  const ResidualFit fit = fit_residuals(from(1.0, 0.1), &source, [&trials](const FitTrial& trial) {
    EXPECT_EQ(trial.evaluation, ++trials);
    return trials < 3;
  });
  EXPECT_EQ(fit.status.code, StatusCode::kCancelled);
  EXPECT_EQ(fit.termination, "cancelled");
  EXPECT_EQ(fit.evaluations, 3);
  EXPECT_LT(fit.residuals.norm(), fit.start_residuals.norm());
}

TEST(ResidualFit, WeightedRowsGiveTheCostAndItsSlope) {
  const Eigen::Vector2d factors(1.0, 2.0);
  Decays source(decay(30, factors, Eigen::Vector2d(0.3, 0.3)), factors);
  const LossOptions loss{LossKind::kSoftL1, 1.0};
  const Eigen::Vector2d spreads(0.2, 0.5), x(2.0, 0.5);
  const auto cost = [&](const Eigen::VectorXd& at) {
    Eigen::MatrixXd residuals, jacobian;
    EXPECT_TRUE(source.evaluate(at, &residuals, &jacobian).ok());
    return weigh(residuals, &jacobian, spreads, loss);
  };
  const WeightedResiduals weighted = cost(x);
  const Eigen::VectorXd gradient =
      2.0 * weighted.jacobian.transpose() * weighted.residuals.reshaped();
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double h = 1e-6;
    Eigen::VectorXd above = x, below = x;
    above[k] += h;
    below[k] -= h;
    EXPECT_NEAR(gradient[k], (cost(above).value - cost(below).value) / (2.0 * h),
                1e-5 * std::abs(gradient[k]));
  }
}

/// Decays with a third variable, whose derivatives are only rounding.
class WithRounding final : public ResidualSource {
 public:
  explicit WithRounding(Decays decays) : decays_(std::move(decays)) {}
  const std::vector<std::string>& outputs() const override { return decays_.outputs(); }
  const SeriesLengths& lengths() const override { return decays_.lengths(); }
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override {
    Eigen::MatrixXd of_two;
    Status status = decays_.evaluate(x.head(2), residuals, jacobian ? &of_two : nullptr);
    if (!jacobian) return status;
    jacobian->resize(of_two.rows(), 3);
    *jacobian << of_two, 1e-14 * Eigen::VectorXd::Random(of_two.rows());
    return status;
  }

 private:
  Decays decays_;
};

TEST(ResidualFit, AVariableOfRoundingStaysAtItsStart) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  WithRounding source(Decays(decay(100, one, 0.05 * one), one));
  FitProblem problem;
  problem.start = Eigen::Vector3d(1.0, 0.2, 0.5);
  problem.lower.setConstant(3, -kInfinity);
  problem.upper.setConstant(3, kInfinity);
  const ResidualFit fit = fit_residuals(problem, &source);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
  EXPECT_EQ(fit.x[2], 0.5);
  EXPECT_TRUE(fit.jacobian.col(2).isZero(0.0)) << "so that nothing is told of it";
  EXPECT_NEAR(fit.x[0], 3.0, 0.1);
}

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// x1 sin(x0 t) - 2 sin(5 t): one valley of the frequency per oscillation, and only one of them is
/// right.
class Oscillation final : public ResidualSource {
 public:
  const std::vector<std::string>& outputs() const override { return outputs_; }
  const SeriesLengths& lengths() const override { return lengths_; }
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override {
    if (++evaluations > cancel_after) return {StatusCode::kCancelled, 0.0, "cancelled"};
    if (x[0] > fails_above) return {StatusCode::kInvalidDesign, 0.0, "too fast"};
    residuals->resize(lengths_[0], 1);
    if (jacobian) jacobian->resize(lengths_[0], 2);
    for (Eigen::Index k = 0; k < lengths_[0]; ++k) {
      const double t = 0.05 * static_cast<double>(k);
      (*residuals)(k, 0) = x[1] * std::sin(x[0] * t) - 2.0 * std::sin(5.0 * t);
      if (!jacobian) continue;
      (*jacobian)(k, 0) = x[1] * t * std::cos(x[0] * t);
      (*jacobian)(k, 1) = std::sin(x[0] * t);
    }
    return {};
  }

  int evaluations = 0, cancel_after = 1000000;
  double fails_above = kNoBound;

 private:
  std::vector<std::string> outputs_{"sensor"};
  SeriesLengths lengths_{200};
};

FitProblem oscillation_from(double frequency) {
  FitProblem problem;
  problem.start = Eigen::Vector2d(frequency, 1.0);
  problem.lower = Eigen::Vector2d(1.0, -kNoBound);
  problem.upper = Eigen::Vector2d(9.0, kNoBound);
  problem.relative_tolerance = 1e-12;
  return problem;
}

MultistartOptions starts(int count, int screened) {
  MultistartOptions options;
  options.starts = count;
  options.screen = screened;
  return options;
}

TEST(ManyStarts, FindTheBestOfSeveralValleys) {
  Oscillation alone, together;
  FitSearches none, searches;
  const ResidualFit stuck = fit_from_starts(oscillation_from(2.0), {}, &alone, {}, &none);
  ASSERT_TRUE(stuck.status.ok());
  EXPECT_GT(mean_spread(stuck.residuals, {}), 0.5)
      << "one start ends in a valley beside the right one";
  EXPECT_TRUE(none.starts.empty());
  int told = 0;
  const auto observer = [&told](const FitTrial& trial) { return trial.evaluation == ++told; };
  const ResidualFit fit =
      fit_from_starts(oscillation_from(2.0), starts(6, 64), &together, observer, &searches);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause << " evaluations are numbered through";
  EXPECT_NEAR(fit.x[0], 5.0, 1e-6);
  EXPECT_NEAR(fit.x[1], 2.0, 1e-6);
  EXPECT_EQ(searches.starts.size(), 6U);
  EXPECT_EQ(searches.screened, 64);
  EXPECT_EQ(searches.unusable, 0);
  ASSERT_GE(searches.optima.size(), 2U);
  EXPECT_LT(searches.optima[0].objective, 1e-6);
  EXPECT_GT(searches.optima[1].objective, 0.1);
  int found = 0;
  for (const Optimum& optimum : searches.optima) found += optimum.found;
  EXPECT_EQ(found, 6);
  Eigen::MatrixXd at_start;
  together.evaluate(oscillation_from(2.0).start, &at_start, nullptr);
  EXPECT_EQ(fit.start_residuals, at_start) << "the start is that of the study";
}

TEST(ManyStarts, PassOverPointsThatFail) {
  Oscillation source;
  source.fails_above = 6.0;
  FitSearches searches;
  const ResidualFit fit =
      fit_from_starts(oscillation_from(2.0), starts(4, 32), &source, {}, &searches);
  ASSERT_TRUE(fit.status.ok());
  EXPECT_NEAR(fit.x[0], 5.0, 1e-6);
  EXPECT_GT(searches.unusable, 4);
  EXPECT_GE(fit.failed_evaluations, searches.unusable);
}

TEST(ManyStarts, KeepTheBestSoFarWhenCancelled) {
  Oscillation counting;
  FitSearches searches;
  fit_from_starts(oscillation_from(2.0), starts(4, 16), &counting, {}, &searches);
  Oscillation source;
  source.cancel_after = counting.evaluations / 2;
  FitSearches some;
  const ResidualFit fit = fit_from_starts(oscillation_from(2.0), starts(4, 16), &source, {}, &some);
  EXPECT_EQ(fit.status.code, StatusCode::kCancelled);
  EXPECT_EQ(fit.termination, "cancelled");
  EXPECT_GT(fit.residuals.size(), 0);
  EXPECT_LT(some.starts.size(), 4U);
  Oscillation early;
  early.cancel_after = 3;
  EXPECT_EQ(fit_from_starts(oscillation_from(2.0), starts(4, 16), &early, {}, &some).status.code,
            StatusCode::kCancelled);
}

TEST(ManyStarts, WithoutAnyUsablePointTheStartIsTheCause) {
  Oscillation source;
  source.fails_above = 0.0;
  FitSearches searches;
  const ResidualFit fit =
      fit_from_starts(oscillation_from(2.0), starts(2, 8), &source, {}, &searches);
  EXPECT_EQ(fit.status.code, StatusCode::kInvalidDesign);
  EXPECT_EQ(fit.termination, "start_failed");
  EXPECT_EQ(fit.residuals.size(), 0);
}

TEST(ManyStarts, MeanSpreadIsGeometric) {
  Eigen::MatrixXd residuals(2, 2);
  residuals << 3, 0.5, -3, 0.5;
  EXPECT_DOUBLE_EQ(mean_spread(residuals, {}), std::sqrt(1.5));
}

/// Friction whose transition velocity is unknown: the study asks for several starts.
TEST(ManyStarts, AreAskedForByTheStudy) {
  const SourceText model{"cart.urdf", R"(<robot name="cart" xmlns:codesign="urn:x">
    <codesign:parameter name="mass" value="1" lower="0.1" upper="10"/><codesign:parameter name="mu" value="0.1" lower="0" upper="1"/>
    <link name="rail"/><link name="cart"><inertial><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="travel" type="prismatic"><parent link="rail"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-5" upper="5" effort="100" velocity="10"/><codesign:friction mu_static="0.1" codesign:mu_static="${mu}"
    mu_dynamic="0.1" codesign:mu_dynamic="${mu}" transition_velocity="0.05" joint_length="0.1" joint_width="0.1"/></joint></robot>)"};
  const SourceText study{
      "study.yaml",
      "identify: {data: [{csv: data.csv}], filter: {cutoff: 20}}\nparameters: {mass: {}, mu: {}}\n"
      "multistart: {starts: 2, screen: 4}\noptimizer: {algorithm: levenberg_marquardt}\n"};
  const Problem problem = load_problem(model, {}, study);
  JointRecording recording;
  recording.file = "data.csv";
  recording.element = "identify.data[0]";
  JointSamples travel{"travel", {}, {}, {}};
  for (int k = 0; k < 500; ++k) {
    const double t = 0.01 * k;
    recording.times.push_back(t);
    recording.places.push_back(static_cast<std::size_t>(k) + 2);
    travel.position.push_back(std::sin(3.0 * t));
    travel.velocity.push_back(3.0 * std::cos(3.0 * t));
    travel.effort.push_back(-2.0 * 9.0 * std::sin(3.0 * t) +
                            4.0 * std::tanh(60.0 * std::cos(3.0 * t)) + 0.01 * std::sin(70.0 * t));
  }
  recording.joints = {travel};
  StudyRecordings recordings;
  recordings.data = {recording};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.searches.starts.size(), 2U);
  EXPECT_NEAR(result.numbers[0].value, 2.0, 0.1);
  const Json json = identification_json(problem, result);
  EXPECT_EQ(json["multistart"]["screened"], 4);
  EXPECT_NEAR(json["multistart"]["optima"][0]["values"]["mass"].get<double>(),
              result.numbers[0].value, 1e-3);
  EXPECT_NE(identification_sentences(result).back().find("optimum 1"), std::string::npos);
}

}  // namespace

}  // namespace codesign
