// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/linear_check.h"

#include <gtest/gtest.h>

#include "integration/watch_layout.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

Problem cart(const std::string& blocks) {
  return loaded(carts(1, {""}),
                "parameters:\n  p: {initial: 4.0, lower: 0.1, upper: 100}\n  d: {initial: 1.0, "
                "lower: 0.1, upper: 100}\n" +
                    controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}")) + blocks);
}

struct Differences {
  explicit Differences(const Problem& of, const Eigen::MatrixXd& directions)
      : objective(Eigen::VectorXd::Zero(directions.cols())),
        error(Eigen::VectorXd::Zero(directions.cols())) {
    status = add_linear_differences(*system_of(of), of.parameters(), directions, nullptr,
                                    &objective, &error, &watched);
  }
  Eigen::VectorXd objective, error;
  Eigen::MatrixXd watched;
  Status status;
};

// s^2 + d s + p: the growth is -d/2, the damping ratio d/(2 sqrt p).
TEST(LinearCheck, OfACartByClosedForms) {
  const Problem problem = cart(
      "objective: {poles: [{measure: growth, weight: 3.0}]}\nconstraints: [{poles: "
      "damping_ratio, at_least: 0.1}]\n");
  Eigen::MatrixXd directions(2, 3);
  directions << 1.0, 0.0, 2.0, 0.0, 1.0, 1.0;
  const Differences found(problem, directions);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  const WatchLayout layout(study_of(problem));
  const int damping = layout.entries()[0].measure(), growth = layout.entries()[1].measure();
  const double by_p = -0.25 / 8.0, by_d = 0.25;
  const Eigen::Vector3d of_damping(by_p, by_d, 2.0 * by_p + by_d), of_growth(0.0, -0.5, -0.5);
  EXPECT_LT((found.watched.col(damping) - of_damping).norm(), 1e-9);
  EXPECT_LT((found.watched.col(growth) - of_growth).norm(), 1e-9);
  EXPECT_LT((found.objective - 3.0 * of_growth).norm(), 1e-9);
  EXPECT_LT(found.error.maxCoeff(), 1e-8);
  EXPECT_LT((found.watched.col(layout.entries()[0].first) - of_damping).norm(), 1e-9);
}

TEST(LinearCheck, LeavesAStudyWithoutSuchNumbersAlone) {
  const Differences found(cart(""), Eigen::MatrixXd::Identity(2, 2));
  EXPECT_TRUE(found.status.ok());
  EXPECT_EQ(found.watched.size(), 0);
  EXPECT_EQ(found.objective.norm(), 0.0);
}

// A step of the differences that leads to no rest ends them.
TEST(LinearCheck, TellsWhatThereIsNot) {
  const Problem problem =
      cart("constraints: [{loop: servo0, measure: gain_margin, at_least: 2}]\n");
  const Differences found(problem, Eigen::MatrixXd::Identity(2, 2));
  EXPECT_EQ(found.status.code, StatusCode::kNonFinite) << found.status.cause;
}

}  // namespace
}  // namespace codesign
