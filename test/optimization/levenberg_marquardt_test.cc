// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "ensemble/ensemble_fixture.h"
#include "math/dense.h"
#include "optimization/levenberg_marquardt.h"

namespace codesign {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
using Outcome = LeastSquaresModel::Outcome;

/// Residuals with their Jacobian; the points tried are counted.
class Residuals final : public LeastSquaresModel {
 public:
  using Function =
      std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J)>;
  explicit Residuals(Function function) : function_(std::move(function)) {}

  Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) override {
    Eigen::VectorXd r;
    Eigen::MatrixXd J;
    ++evaluations;
    if (evaluations == stop_at) return Outcome::kStop;
    if (!function_(x, &r, &J)) return Outcome::kFailed;
    *point = {r.squaredNorm(), 2.0 * J.transpose() * r, triangular_root(J)};
    return Outcome::kUsable;
  }
  int evaluations = 0, stop_at = 0;

 private:
  Function function_;
};

struct Answer {
  LevenbergMarquardtEnd end;
  Eigen::VectorXd x;
  LeastSquaresPoint best;
};

Answer minimize(Residuals* residuals, const Eigen::VectorXd& start, double lower = -kUnbounded,
                double upper = kUnbounded, double tolerance = 1e-12, int most = 200) {
  LevenbergMarquardtOptions options;
  options.relative_tolerance = tolerance;
  options.max_evaluations = most;
  options.largest_first_step = kUnbounded;
  Answer answer{LevenbergMarquardtEnd::kStopped, start, {}};
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(start.size());
  answer.end =
      minimize_squares(options, lower * ones, upper * ones, residuals, &answer.x, &answer.best);
  return answer;
}

bool rosenbrock_valley(const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
  *r = Eigen::Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]);
  J->resize(2, 2);
  *J << -20.0 * x[0], 10.0, -1.0, 0.0;
  return true;
}

Residuals linear(double scale_of_second = 1.0) {
  return Residuals(
      [scale_of_second](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
        Eigen::Matrix<double, 4, 3> A;
        A << 1.0, 0.9, 0.2, 0.3, 1.0, 0.5, 0.1, 0.8, 1.0, 0.7, 0.2, 0.4;
        A.col(1) *= scale_of_second;
        *J = A;
        *r = A * x - Eigen::Vector4d(1.0, -2.0, 3.0, 0.5);
        return true;
      });
}

TEST(LevenbergMarquardt, OneStepSolvesALinearProblem) {
  Residuals residuals = linear();
  const Answer answer =
      minimize(&residuals, Eigen::Vector3d(5.0, -7.0, 11.0), -kUnbounded, kUnbounded, 1e-10, 2);
  EXPECT_EQ(residuals.evaluations, 2);
  EXPECT_LE(answer.best.gradient.norm(), 1e-12);
}

TEST(LevenbergMarquardt, OneStepSolvesALinearProblemWithinBounds) {
  Residuals residuals = linear();
  const Answer answer = minimize(&residuals, Eigen::Vector3d(0.5, 0.0, 0.2), -1.0, 1.0);
  EXPECT_LE(residuals.evaluations, 3);
  int held = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_TRUE(answer.x[k] == 1.0 || answer.best.gradient[k] >= -1e-10);
    EXPECT_TRUE(answer.x[k] == -1.0 || answer.best.gradient[k] <= 1e-10);
    held += std::abs(answer.x[k]) == 1.0;
  }
  EXPECT_GT(held, 0);
}

// The unit of a variable does not matter: D measures a step by the change of the residuals.
TEST(LevenbergMarquardt, TakesTheSameStepsInOtherUnits) {
  Residuals plain([](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
    return rosenbrock_valley(x, r, J);
  });
  Residuals scaled([](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
    rosenbrock_valley(Eigen::Vector2d(x[0], x[1] * 0x1p-20), r, J);
    J->col(1) *= 0x1p-20;
    return true;
  });
  const Answer a = minimize(&plain, Eigen::Vector2d(-1.2, 1.0)),
               b = minimize(&scaled, Eigen::Vector2d(-1.2, 0x1p20));
  EXPECT_EQ(plain.evaluations, scaled.evaluations);
  EXPECT_NEAR(a.x[1], b.x[1] * 0x1p-20, 1e-12);
}

TEST(LevenbergMarquardt, FollowsAValley) {
  Residuals residuals(rosenbrock_valley);
  const Answer answer = minimize(&residuals, Eigen::Vector2d(-1.2, 1.0));
  EXPECT_NEAR(answer.x[0], 1.0, 1e-8);
  EXPECT_NEAR(answer.x[1], 1.0, 1e-8);
  EXPECT_LE(residuals.evaluations, 30);
}

TEST(LevenbergMarquardt, TurnsBackFromPointsWithoutAValue) {
  Residuals residuals([](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
    return x[0] < 1.05 && rosenbrock_valley(x, r, J) && x[1] > -3.0;
  });
  const Answer answer = minimize(&residuals, Eigen::Vector2d(-1.2, 1.0));
  EXPECT_NEAR(answer.x[0], 1.0, 1e-7);
}

TEST(LevenbergMarquardt, EndsWithAReason) {
  Residuals none([](const Eigen::VectorXd&, Eigen::VectorXd*, Eigen::MatrixXd*) { return false; });
  EXPECT_EQ(minimize(&none, Eigen::Vector2d(0.0, 0.0)).end, LevenbergMarquardtEnd::kStartFailed);
  Residuals stopped(rosenbrock_valley);
  stopped.stop_at = 5;
  const Answer kept = minimize(&stopped, Eigen::Vector2d(-1.2, 1.0));
  EXPECT_EQ(kept.end, LevenbergMarquardtEnd::kStopped);
  EXPECT_LT(kept.best.value, 24.2) << "the best point is kept";
  Residuals few(rosenbrock_valley);
  EXPECT_EQ(minimize(&few, Eigen::Vector2d(-1.2, 1.0), -kUnbounded, kUnbounded, 1e-12, 4).end,
            LevenbergMarquardtEnd::kMaxEvaluations);
  EXPECT_EQ(few.evaluations, 4);
  Residuals at_optimum = linear();
  const Answer optimum = minimize(&at_optimum, Eigen::Vector3d::Zero());
  Residuals again = linear();
  const Answer still = minimize(&again, optimum.x);
  EXPECT_EQ(still.end, LevenbergMarquardtEnd::kOptimum);
  EXPECT_EQ(again.evaluations, 1);
  // A point in the middle of points without values.
  Residuals lonely([](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
    return x[0] == -1.2 && rosenbrock_valley(x, r, J);
  });
  EXPECT_EQ(minimize(&lonely, Eigen::Vector2d(-1.2, 1.0)).end,
            LevenbergMarquardtEnd::kVariableTolerance);
}

TEST(LevenbergMarquardt, AVariableWithoutInfluenceStaysWhereItIs) {
  Residuals residuals([](const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
    *r = Eigen::Vector2d(std::exp(x[0]) - 2.0, x[0] - 0.6);
    *J = Eigen::MatrixXd::Zero(2, 2);
    (*J)(0, 0) = std::exp(x[0]);
    (*J)(1, 0) = 1.0;
    return true;
  });
  const Answer answer = minimize(&residuals, Eigen::Vector2d(0.0, 0.3), -1.0, 1.0);
  EXPECT_EQ(answer.x[1], 0.3);
  EXPECT_LE(std::abs(answer.best.gradient[0]), 1e-4);
}

TEST(LevenbergMarquardt, EndsHaveTheNamesOfResults) {
  EXPECT_STREQ(name_of(LevenbergMarquardtEnd::kOptimum), "success");
  EXPECT_STREQ(name_of(LevenbergMarquardtEnd::kMaxEvaluations), "max_evaluations_reached");
  EXPECT_STREQ(name_of(LevenbergMarquardtEnd::kStopped), "cancelled");
}

/// Residuals (10 (x - 1), y - 3 x, 0.1): y is an unknown of the model's own and takes a step of
/// Gauss and Newton with each step of x.
class OwnUnknown final : public LeastSquaresModel {
 public:
  Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) override {
    ++evaluations;
    const double y = evaluations == 1 ? 5.0 : y_ - correction_ + 3.0 * (x[0] - x_);
    const double r = 10.0 * (x[0] - 1.0), own = y - 3.0 * x[0] + bend * (y - y_) * (y - y_);
    point->value = r * r + own * own + 0.01;
    point->gradient = Eigen::VectorXd::Constant(1, 20.0 * r);
    point->root = Eigen::MatrixXd::Constant(1, 1, 10.0);
    point->inner_decrease = own * own;
    if (evaluations == 1 || point->value < best_) {
      x_ = x[0];
      y_ = y;
      correction_ = own;
      best_ = point->value;
    }
    return Outcome::kUsable;
  }
  int evaluations = 0;
  double bend = 0.0;
  double y() const { return y_; }

 private:
  double x_ = 0.0, y_ = 5.0, correction_ = 0.0, best_ = 0.0;
};

TEST(LevenbergMarquardt, UnknownsOfTheModelsOwnArePartOfThePromise) {
  for (const double start : {0.0, 1.0}) {  // with 1, the first step leaves x where it is
    OwnUnknown model;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, start);
    LeastSquaresPoint best;
    const Eigen::VectorXd open = Eigen::VectorXd::Constant(1, kUnbounded);
    LevenbergMarquardtOptions options;
    options.largest_first_step = kUnbounded;
    EXPECT_EQ(minimize_squares(options, -open, open, &model, &x, &best),
              LevenbergMarquardtEnd::kOptimum);
    EXPECT_NEAR(x[0], 1.0, 1e-12);
    EXPECT_NEAR(model.y(), 3.0, 1e-12);
    EXPECT_NEAR(best.value, 0.01, 1e-14);
    EXPECT_LE(model.evaluations, 3);
  }
}

TEST(LevenbergMarquardt, PromisesOfOwnUnknownsThatAreNotKeptDoNotKeepItGoing) {
  OwnUnknown model;
  model.bend = 10.0;  // each further step of y is worse than none
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 1.0);
  LeastSquaresPoint best;
  const Eigen::VectorXd held = Eigen::VectorXd::Constant(1, 1.0);
  EXPECT_EQ(minimize_squares({}, held, held, &model, &x, &best), LevenbergMarquardtEnd::kOptimum);
  EXPECT_LE(model.evaluations, 3);
}

const char* const kSquares = "{algorithm: levenberg_marquardt, relative_tolerance: 1.0e-9}";
const char* const kSlsqp = "{algorithm: slsqp, relative_tolerance: 1.0e-11}";

TEST(LeastSquaresSearch, FindsTheOptimumOfOtherAlgorithms) {
  const OptimizationResult squares = optimize(block("", kSquares)),
                           slsqp = optimize(block("", kSlsqp));
  ASSERT_TRUE(squares.status.ok()) << squares.status.cause;
  EXPECT_EQ(squares.termination, "objective_tolerance_reached");
  EXPECT_NEAR(squares.best.objective, slsqp.best.objective, 1e-7 * slsqp.best.objective);
  EXPECT_EQ(squares.initial.objective, slsqp.initial.objective)
      << "the same bits of the same evaluation";
  EXPECT_EQ(squares.initial.gradient, slsqp.initial.gradient);
  EXPECT_EQ(squares.optimality.influences, std::vector<bool>(2, true));
  EXPECT_LT(squares.cost.evaluations, 40);
}

TEST(LeastSquaresSearch, TakesTheMeanOfRunsAndSamples) {
  const std::string blocks =
      "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}, weight: 2.0}}\nuncertain: {mu: "
      "{uniform: [0.2, 0.4]}}\n"
      "robust: {measure: mean, samples: 4}\n";
  const OptimizationResult squares = optimize(block(blocks, kSquares)),
                           slsqp = optimize(block(blocks, kSlsqp));
  ASSERT_TRUE(squares.status.ok()) << squares.status.cause;
  EXPECT_NEAR(squares.best.objective, slsqp.best.objective, 1e-6 * slsqp.best.objective);
  EXPECT_EQ(squares.best.values.size(), 8);
}

TEST(LeastSquaresSearch, ResultsDoNotDependOnTheNumberOfWorkers) {
  const std::string uncertain =
      "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: mean, samples: 4}\n";
  const OptimizationResult one = optimize(block(uncertain + "engine: {type: serial}\n", kSquares));
  const OptimizationResult two =
      optimize(block(uncertain + "engine: {type: threads, workers: 2}\n", kSquares));
  EXPECT_EQ(one.best.rho, two.best.rho);
  EXPECT_EQ(one.cost.evaluations, two.cost.evaluations);
}

TEST(LeastSquaresSearch, StartsFromManyPoints) {
  const OptimizationResult many = optimize(block("multistart: {starts: 4, screen: 8}\n", kSquares));
  ASSERT_TRUE(many.status.ok()) << many.status.cause;
  EXPECT_EQ(many.multistart.starts.size(), 4u);
  EXPECT_LE(many.best.objective, optimize(block("", kSquares)).best.objective * (1.0 + 1e-8));
}

/// A sentence about the fault of a study; empty if it has none. @param trials receives the number
/// of trial points.
InputFault refusal(const std::string& blocks, int* trials) {
  try {
    optimize(block(blocks, kSquares), [trials](const Trial&) { return ++*trials > 0; });
  } catch (const InputError& error) {
    return error.fault();
  }
  return {};
}

TEST(LeastSquaresSearch, RefusesWhatIsNoSumOfSquaresBeforeAnythingIsComputed) {
  const std::string runs = "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}}}\n";
  for (const std::string& blocks :
       {runs + "robust: {measure: worst}\n", runs + "robust: {measure: cvar}\n",
        runs + "robust: {measure: mean_plus_deviation}\n",
        std::string("constraints: [\"Kp >= Kd\"]\n"),
        std::string("multistart: {starts: 2, screen: 4}\nconstraints: [\"Kp >= Kd\"]\n"),
        std::string("path: [{signal: slide/position, between: [-1.0, 2.0]}]\n"),
        std::string("solver: {gradient: adjoint}\n")}) {
    int trials = 0;
    const InputFault fault = refusal(blocks, &trials);
    EXPECT_EQ(fault.element, "optimizer.algorithm") << blocks;
    EXPECT_EQ(fault.message.rfind("this algorithm ", 0), 0u) << blocks << fault.message;
    EXPECT_NE(fault.allowed.find("slsqp"), std::string::npos) << blocks << fault.allowed;
    EXPECT_EQ(fault.allowed.find("levenberg"), std::string::npos) << blocks;
    EXPECT_EQ(trials, 0) << blocks;
  }
}

TEST(LeastSquaresSearch, CancelKeepsTheBestPoint) {
  const OptimizationResult result =
      optimize(block("", kSquares), [](const Trial& trial) { return trial.evaluation < 3; });
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_EQ(result.cost.evaluations, 3);
  EXPECT_LE(result.best.objective, result.initial.objective);
  EXPECT_EQ(result.best.gradient.size(), 2);
}

TEST(LeastSquaresSearch, EndsAtTheLimitOfEvaluations) {
  const OptimizationResult result = optimize(block(
      "", "{algorithm: levenberg_marquardt, max_evaluations: 3, relative_tolerance: 1.0e-12}"));
  EXPECT_EQ(result.termination, "max_evaluations_reached");
  EXPECT_EQ(result.cost.evaluations, 3);
  ASSERT_FALSE(result.warnings.empty());
}

}  // namespace

}  // namespace codesign
