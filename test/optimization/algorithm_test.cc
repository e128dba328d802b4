// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/algorithm.h"
#include "description/study.h"

#include <gtest/gtest.h>

#include <set>

namespace codesign {
namespace {

const char* const kNames[] = {"lbfgs", "var1",  "var2",   "tnewton", "mma",
                              "ccsaq", "slsqp", "cobyla", "bobyqa",  "auglag_lbfgs"};
const std::set<std::string> kTakeConstraints{"mma", "ccsaq", "slsqp", "cobyla", "auglag_lbfgs"};

Study study(const std::string& algorithm, bool constrained = false) {
  Study study;
  study.file = "study.yaml";
  study.optimizer.algorithm = algorithm;
  study.optimizer.relative_tolerance = 1e-10;
  if (constrained) study.constraints.emplace_back();
  return study;
}

TEST(Algorithm, EachFindsTheMinimumOfABowl) {
  for (const char* name : kNames) {
    nlopt::opt optimizer = make_optimizer(study(name).optimizer, 2);
    optimizer.set_min_objective(
        [](const std::vector<double>& x, std::vector<double>& gradient, void*) {
          if (!gradient.empty()) gradient = {2.0 * (x[0] - 0.3), 8.0 * (x[1] - 0.6)};
          return (x[0] - 0.3) * (x[0] - 0.3) + 4.0 * (x[1] - 0.6) * (x[1] - 0.6);
        },
        nullptr);
    optimizer.set_lower_bounds({0.0, 0.0});
    optimizer.set_upper_bounds({1.0, 1.0});
    optimizer.set_ftol_rel(1e-10);
    optimizer.set_xtol_rel(1e-9);
    optimizer.set_maxeval(2000);
    std::vector<double> x{0.9, 0.1};
    double value = 1.0;
    optimizer.optimize(x, value);
    EXPECT_NEAR(x[0], 0.3, 1e-4) << name;
    EXPECT_NEAR(x[1], 0.6, 1e-4) << name;
  }
}

TEST(Algorithm, ConstraintsAreForThoseThatTakeThem) {
  for (const char* name : kNames) {
    if (kTakeConstraints.count(name) > 0)
      EXPECT_NO_THROW(check_algorithm(study(name, true), study(name, true).optimizer, false))
          << name;
    else
      EXPECT_THROW(check_algorithm(study(name, true), study(name, true).optimizer, false),
                   InputError)
          << name;
  }
}

InputFault fault_of(const Study& study, RobustMeasure measure = RobustMeasure::kMean) {
  try {
    check_algorithm(study, study.optimizer, false);
    check_squares(study, study.optimizer, measure);
  } catch (const InputError& error) {
    return error.fault();
  }
  return {};
}

TEST(Algorithm, LeastSquaresAreForSumsOfSquares) {
  const char* const name = "levenberg_marquardt";
  EXPECT_TRUE(is_least_squares(name));
  for (const char* other : kNames) EXPECT_FALSE(is_least_squares(other));
  EXPECT_EQ(fault_of(study(name)).message, "");
  const InputFault constrained = fault_of(study(name, true));
  EXPECT_EQ(constrained.message, "this algorithm takes no constraints on parameters");
  EXPECT_NE(constrained.allowed.find("slsqp"), std::string::npos);
  EXPECT_EQ(constrained.allowed.find(name), std::string::npos);
  const InputFault deviation = fault_of(study(name), RobustMeasure::kMeanPlusDeviation);
  EXPECT_NE(deviation.message.find("mean_plus_deviation"), std::string::npos) << deviation.message;
  EXPECT_NE(deviation.allowed.find("lbfgs"), std::string::npos);
  EXPECT_EQ(deviation.allowed.find(name), std::string::npos);
  Study adjoint = study(name);
  adjoint.solver.gradient = GradientMethod::kAdjoint;
  EXPECT_NE(fault_of(adjoint).message.find("adjoint"), std::string::npos);
  Study negative = study(name);
  negative.integral.resize(2);
  negative.integral[1].weight = Quantity(-0.5);
  negative.integral[1].where = {"study.yaml", 17};
  const InputFault weight = fault_of(negative);
  EXPECT_EQ(weight.where.line, 17);
  EXPECT_EQ(weight.value, "-0.5");
  EXPECT_NE(weight.allowed.find("slsqp"), std::string::npos);
  Study robust = study(name);
  robust.integral.resize(2);
  robust.integral[1].loss = LossKind::kAbove;
  EXPECT_EQ(fault_of(robust).message, "") << "the square of what is above";
  robust.integral[1].loss = LossKind::kHuber;
  robust.integral[1].where = {"study.yaml", 18};
  const InputFault loss = fault_of(robust);
  EXPECT_EQ(loss.where.line, 18);
  EXPECT_EQ(loss.element, "objective.integral[1].loss");
  EXPECT_EQ(loss.value, "huber");
  EXPECT_NE(loss.allowed.find("square, above or below"), std::string::npos) << loss.allowed;
  EXPECT_NE(loss.allowed.find("slsqp"), std::string::npos) << loss.allowed;
  Study loose = study(name);
  loose.optimizer.relative_tolerance = 1.0;
  EXPECT_EQ(fault_of(loose).element, "optimizer.relative_tolerance");
}

TEST(Algorithm, AutoTakesWhatTheProblemAllows) {
  const auto first = [](const Study& study, RobustMeasure measure = RobustMeasure::kMean,
                        bool with_slack = false) {
    EXPECT_NO_THROW(check_algorithm(study, study.optimizer, with_slack));
    return algorithms_for(study, study.optimizer, measure, with_slack).front();
  };
  EXPECT_EQ(first(study("auto")), "levenberg_marquardt");
  EXPECT_EQ(first(study("auto", true)), "levenberg_marquardt")
      << "a constraint among parameters may be inactive";
  EXPECT_EQ(first(study("auto"), RobustMeasure::kWorst, true), "slsqp");
  EXPECT_EQ(first(study("auto"), RobustMeasure::kMeanPlusDeviation), "slsqp");
  Study negative = study("auto");
  negative.integral.resize(1);
  negative.integral[0].weight = Quantity(-0.5);
  EXPECT_EQ(first(negative), "slsqp");
  EXPECT_FALSE(is_sum_of_squares(negative));
  Study robust = study("auto");
  robust.terminal.resize(1);
  robust.terminal[0].loss = LossKind::kSoftL1;
  EXPECT_EQ(first(robust), "slsqp");
  EXPECT_FALSE(is_sum_of_squares(robust));
  robust.terminal[0].loss = LossKind::kBelow;
  EXPECT_EQ(first(robust), "levenberg_marquardt");
  EXPECT_TRUE(is_sum_of_squares(robust));
  const Study named = study("mma", true);
  EXPECT_EQ(algorithms_for(named, named.optimizer, RobustMeasure::kMean, false),
            std::vector<std::string>{"mma"})
      << "a name is kept";
}

TEST(Algorithm, AnUnknownNameIsAnsweredWithThoseKnown) {
  try {
    check_algorithm(study("newton"), study("newton").optimizer, false);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "study.yaml");
    EXPECT_EQ(error.fault().element, "optimizer.algorithm");
    EXPECT_EQ(error.fault().value, "newton");
    EXPECT_EQ(error.fault().where.line, 1) << "the study does not name it";
    for (const char* name : kNames)
      EXPECT_NE(error.fault().allowed.find(name), std::string::npos) << name;
    EXPECT_NE(error.fault().allowed.find("levenberg_marquardt"), std::string::npos);
  }
}

TEST(Algorithm, TerminationsHaveNames) {
  EXPECT_EQ(termination_name(nlopt::FTOL_REACHED), "objective_tolerance_reached");
  EXPECT_EQ(termination_name(nlopt::MAXEVAL_REACHED), "max_evaluations_reached");
  EXPECT_EQ(termination_name(nlopt::FORCED_STOP), "cancelled");
  EXPECT_EQ(termination_name(nlopt::FAILURE), "algorithm_failed");
}

}  // namespace
}  // namespace codesign
