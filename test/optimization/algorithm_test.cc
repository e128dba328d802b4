// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/algorithm.h"

#include <gtest/gtest.h>

#include <set>

namespace codesign {
namespace {

const char* const kNames[] = {"lbfgs", "var1", "var2", "tnewton", "mma", "ccsaq", "slsqp", "cobyla", "bobyqa", "auglag_lbfgs"};
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
    nlopt::opt optimizer = make_optimizer(study(name), study(name).optimizer, 2);
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
      EXPECT_NO_THROW(make_optimizer(study(name, true), study(name, true).optimizer, 2)) << name;
    else
      EXPECT_THROW(make_optimizer(study(name, true), study(name, true).optimizer, 2), InputError) << name;
  }
}

TEST(Algorithm, AnUnknownNameIsAnsweredWithThoseKnown) {
  try {
    make_optimizer(study("newton"), study("newton").optimizer, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "study.yaml");
    EXPECT_EQ(error.fault().element, "optimizer.algorithm");
    EXPECT_EQ(error.fault().value, "newton");
    EXPECT_EQ(error.fault().where.line, 1) << "the study does not name it";
    for (const char* name : kNames) EXPECT_NE(error.fault().allowed.find(name), std::string::npos) << name;
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
