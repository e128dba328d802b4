// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "equations/equations.h"
#include "excitation/excited_cases.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

// The largest rise of a wave between two of 64 samples.
const double kBetweenSamples = 1.0 - std::cos(std::acos(-1.0) / 64.0);

class TrajectorySpaceOfArm : public testing::Test {
 protected:
  const Problem problem_ = arm("harmonics: 3");
  const MotionLimits limits_ = motion_limits(problem_);
  const TrajectorySpace space_{*study_of(problem_).excitation, limits_, Eigen::Vector2d(0.1, 0.2)};
  const SampledShapes fine_{space_.basis(), times_in_period(5.0, 500)};
  Eigen::VectorXd some_point() const {
    return space_.mixed(
        Eigen::VectorXd::LinSpaced(space_.size(), 0.05, 0.93).unaryExpr([](double u) {
          return std::fmod(7.7 * u, 1.0);
        }));
  }
};

TEST_F(TrajectorySpaceOfArm, PlainAndMixedTrajectoriesReachALimitAndKeepAll) {
  for (const Eigen::VectorXd& x :
       {space_.plain(), some_point(), space_.plain_around(Eigen::Vector2d(0.1, 1.9))}) {
    const DrivePath path = space_.path(x, fine_);
    double worst = 0.0;
    for (const LimitedSignal& signal : limits_.signals) {
      if (signal.kind == LimitedSignal::Kind::kEffort) continue;
      const Eigen::MatrixXd& rows = signal.kind == LimitedSignal::Kind::kPosition ? path.position
                                    : signal.kind == LimitedSignal::Kind::kVelocity
                                        ? path.velocity
                                        : path.acceleration;
      for (Eigen::Index k = 0; k < rows.cols(); ++k)
        worst = std::max(worst, std::abs(signal.relative(rows(signal.joint, k))));
    }
    EXPECT_LE(worst, 1.0 + kBetweenSamples);
    EXPECT_GT(worst, 0.99);
    EXPECT_TRUE(path.position.col(0).isApprox(space_.rest(x)));
    EXPECT_LT(path.velocity.col(0).norm(), 1e-12);
  }
}

TEST_F(TrajectorySpaceOfArm, ThePlainTrajectorySwingsAroundTheMiddle) {
  const DrivePath path = space_.path(space_.plain(), fine_);
  for (Eigen::Index joint = 0; joint < 2; ++joint)
    EXPECT_NEAR(path.position.row(joint).maxCoeff() + path.position.row(joint).minCoeff(), 0.5,
                1e-3);
}

TEST_F(TrajectorySpaceOfArm, DerivativesArePulledBack) {
  const Eigen::VectorXd x = some_point();
  Eigen::MatrixXd by_motion(6, 500);
  for (Eigen::Index k = 0; k < by_motion.size(); ++k)
    by_motion.data()[k] = std::sin(0.37 * static_cast<double>(k));
  // The path is linear in x.
  const auto number = [&](const Eigen::VectorXd& at) {
    const DrivePath path = space_.path(at, fine_);
    return by_motion.topRows(2).cwiseProduct(path.position).sum() +
           by_motion.middleRows(2, 2).cwiseProduct(path.velocity).sum() +
           by_motion.bottomRows(2).cwiseProduct(path.acceleration).sum();
  };
  const Eigen::VectorXd gradient = space_.pull_back(fine_, by_motion);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    EXPECT_NEAR(gradient[k], number(x + Eigen::VectorXd::Unit(x.size(), k)) - number(x),
                1e-8 * gradient.cwiseAbs().maxCoeff());
}

TEST_F(TrajectorySpaceOfArm, ShrinksExcursionsAndNotTheRest) {
  const Eigen::VectorXd x = some_point(), half = space_.shrunk(x, 0.5);
  const DrivePath path = space_.path(x, fine_), small = space_.path(half, fine_);
  EXPECT_TRUE(space_.rest(half).isApprox(space_.rest(x)));
  EXPECT_TRUE((2.0 * small.velocity).isApprox(path.velocity));
  EXPECT_TRUE((2.0 * small.position).isApprox(path.position.colwise() + space_.rest(x)));
}

}  // namespace
}  // namespace codesign
