// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/limit_scan.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "equations/equations.h"
#include "excitation/excited_cases.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

class LimitScanOf : public testing::Test {
 protected:
  void open(const Problem& problem) {
    limits_ = motion_limits(problem);
    const auto joints = static_cast<Eigen::Index>(limits_.joints.size());
    space_ = std::make_unique<TrajectorySpace>(*study_of(problem).excitation, limits_,
                                               Eigen::VectorXd::Zero(joints));
    motion_ = std::make_unique<ExcitedMotion>(*system_of(problem), limits_.joints,
                                              limits_.followers, problem.parameters(), 1);
    scan_ = std::make_unique<LimitScan>(*space_, limits_, motion_.get());
    x_ = space_->mixed(Eigen::VectorXd::LinSpaced(space_->size(), 0.1, 0.9).unaryExpr([](double u) {
      return std::fmod(5.3 * u, 1.0);
    }));
    ASSERT_TRUE(motion_->begin(space_->rest(x_)).ok());
  }

  /// The largest |z| at many equal steps.
  double worst_of(int count) {
    const DrivePath path = space_->path(
        x_, SampledShapes(space_->basis(), times_in_period(space_->basis().period(), count)));
    return worst_along(limits_, path, motion_.get());
  }

  MotionLimits limits_;
  std::unique_ptr<TrajectorySpace> space_;
  std::unique_ptr<ExcitedMotion> motion_;
  std::unique_ptr<LimitScan> scan_;
  Eigen::VectorXd x_;
};

TEST_F(LimitScanOf, FindsPeaksThatAFineGridApproaches) {
  open(arm("harmonics: 3"));
  const double found = scan_->scan(x_).worst, coarse = worst_of(2000), fine = worst_of(100000);
  EXPECT_GE(found, fine - 1e-10);
  EXPECT_NEAR(found, fine, 1e-7);
  EXPECT_LT(coarse, found) << "the peaks lie between the samples";
}

TEST_F(LimitScanOf, KnowsBothEndsOfEachSignal) {
  open(arm("harmonics: 3"));
  const LimitScan::Extremes found = scan_->scan(x_);
  const DrivePath path = space_->path(
      x_, SampledShapes(space_->basis(), times_in_period(space_->basis().period(), 100000)));
  for (std::size_t s = 0; s < limits_.signals.size(); ++s) {
    const LimitedSignal& signal = limits_.signals[s];
    if (signal.kind == LimitedSignal::Kind::kEffort) continue;
    const Eigen::MatrixXd& rows = signal.kind == LimitedSignal::Kind::kPosition ? path.position
                                  : signal.kind == LimitedSignal::Kind::kVelocity
                                      ? path.velocity
                                      : path.acceleration;
    EXPECT_NEAR(found.signals[s].lowest, rows.row(signal.joint).minCoeff(), 1e-7 * signal.half())
        << signal.name;
    EXPECT_NEAR(found.signals[s].highest, rows.row(signal.joint).maxCoeff(), 1e-7 * signal.half())
        << signal.name;
  }
}

TEST_F(LimitScanOf, AFittedMotionKeepsAllLimits) {
  open(arm("harmonics: 3"));
  x_ = space_->shrunk(x_, 1.3);
  EXPECT_GT(scan_->scan(x_).worst, 1.1);
  LimitScan::Extremes extremes;
  ASSERT_TRUE(scan_->fit(&x_, &extremes));
  EXPECT_LE(extremes.worst, 1.0);
  EXPECT_GT(extremes.worst, 0.9) << "no more than needed";
  EXPECT_LE(worst_of(100000), 1.0 + 1e-9);
  for (std::size_t s = 0; s < limits_.signals.size(); ++s) {
    EXPECT_GE(extremes.signals[s].lowest, limits_.signals[s].lower);
    EXPECT_LE(extremes.signals[s].highest, limits_.signals[s].upper);
  }
}

TEST_F(LimitScanOf, JointsThatFollowCount) {
  open(slider_crank("  harmonics: 3\n"));
  LimitScan::Extremes extremes;
  ASSERT_TRUE(scan_->fit(&x_, &extremes)) << extremes.status.cause;
  EXPECT_LE(worst_of(20000), 1.0 + 1e-9);
}

TEST_F(LimitScanOf, ARestBeyondALimitCannotBeFitted) {
  // 2 kg at 0.5 m need 9.81 N m to be held level, and more than 2 N m from 0.2 rad on.
  const Problem problem =
      load_problem({"pendulum.urdf", pendulum_urdf()}, {},
                   {"study.yaml",
                    "identify: {}\nexcite: {joints: {hinge: {position: [0.4, 1.0], effort: 2.0, "
                    "noise: 1}}}\nparameters: {mass: {}}\n"});
  open(problem);
  LimitScan::Extremes extremes;
  EXPECT_FALSE(scan_->fit(&x_, &extremes));
  EXPECT_GT(extremes.worst, 1.0);
}

}  // namespace
}  // namespace codesign
