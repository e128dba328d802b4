// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excited_motion.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "excitation/excited_cases.h"
#include "excitation/trajectory_space.h"
#include "math/differences.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A mechanism with a motion, and its response.
struct Moved {
  explicit Moved(const Problem& of, int threads = 1)
      : problem(of),
        limits(motion_limits(problem)),
        space(*study_of(problem).excitation, limits,
              Eigen::VectorXd::Zero(static_cast<Eigen::Index>(limits.joints.size()))),
        motion(*system_of(problem), limits.joints, limits.followers, problem.parameters(),
               threads) {
    const Eigen::VectorXd x = space.shrunk(
        space.mixed(Eigen::VectorXd::LinSpaced(space.size(), 0.1, 0.9).unaryExpr([](double u) {
          return std::fmod(5.3 * u, 1.0);
        })),
        0.4);
    path = space.path(x, SampledShapes(space.basis(), times_in_period(space.basis().period(), 30)));
    EXPECT_TRUE(motion.begin(space.rest(x)).ok());
  }

  void run() {
    Status status = motion.respond(path, true, &response);
    ASSERT_TRUE(status.ok()) << status.cause;
    status = motion.differentiate(path, response, &slopes);
    ASSERT_TRUE(status.ok()) << status.cause;
  }

  const Problem problem;
  const MotionLimits limits;
  const TrajectorySpace space;
  ExcitedMotion motion;
  DrivePath path;
  PathResponse response;
  ExcitedMotion::Slopes slopes;
};

/// Each number of the response at one sample by each direction of the motion there.
void expect_slopes(Moved* moved, Eigen::Index sample, double tolerance) {
  const Eigen::Index n = moved->motion.joints();
  const DrivePath path = moved->path;
  for (Eigen::Index direction = 0; direction < 3 * n; ++direction) {
    const auto response_at = [&](double change) {
      DrivePath changed = path;
      (direction < n       ? changed.position
       : direction < 2 * n ? changed.velocity
                           : changed.acceleration)(direction % n, sample) += change;
      PathResponse response;
      EXPECT_TRUE(moved->motion.respond(changed, true, &response).ok());
      return response;
    };
    const Eigen::Index column = sample * 3 * n + direction;
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto effort = [&](double change) { return response_at(change).effort(k, sample); };
      EXPECT_NEAR(moved->slopes.effort(k, column), ridders_derivative(effort, 0.0, 1e-3).value,
                  tolerance * (1.0 + moved->slopes.effort.cwiseAbs().maxCoeff()));
      for (Eigen::Index p = 0; p < moved->motion.parameters(); ++p) {
        const auto entry = [&](double change) {
          return response_at(change).jacobian(sample * n + k, p);
        };
        EXPECT_NEAR(moved->slopes.jacobian(column * n + k, p),
                    ridders_derivative(entry, 0.0, 1e-3).value,
                    tolerance * (1.0 + moved->slopes.jacobian.cwiseAbs().maxCoeff()))
            << "direction " << direction << ", parameter " << p;
      }
    }
    for (Eigen::Index k = 0; k < moved->motion.followers(); ++k) {
      const auto position = [&](double change) {
        return response_at(change).follower_position(k, sample);
      };
      const auto velocity = [&](double change) {
        return response_at(change).follower_velocity(k, sample);
      };
      EXPECT_NEAR(moved->slopes.follower_position(k, column),
                  ridders_derivative(position, 0.0, 1e-3).value, tolerance);
      EXPECT_NEAR(moved->slopes.follower_velocity(k, column),
                  ridders_derivative(velocity, 0.0, 1e-3).value, tolerance);
    }
  }
}

TEST(ExcitedMotion, SlopesOfAnArm) {
  Moved moved(arm("harmonics: 3"));
  moved.run();
  expect_slopes(&moved, 7, 1e-7);
}

TEST(ExcitedMotion, SlopesOfAClosedLoop) {
  Moved moved(slider_crank("  harmonics: 3\n"));
  moved.run();
  expect_slopes(&moved, 11, 1e-7);
}

TEST(ExcitedMotion, EffortsOfAPendulumAreThoseOfTheFormula) {
  Moved moved(excited_pendulum(""));
  moved.run();
  const auto& path = moved.path;
  for (Eigen::Index k = 0; k < path.samples(); ++k) {
    const double expected = 0.6 * path.acceleration(0, k) +
                            2.0 * 9.81 * 0.5 * std::sin(path.position(0, k)) +
                            0.3 * path.velocity(0, k);
    EXPECT_NEAR(moved.response.effort(0, k), expected, 0.55) << "but for Coulomb friction";
    EXPECT_NEAR(moved.response.jacobian(k, 1), path.acceleration(0, k), 1e-9);
    EXPECT_NEAR(moved.response.jacobian(k, 2), path.velocity(0, k), 1e-9);
  }
}

TEST(ExcitedMotion, ResultsDoNotDependOnTheNumberOfThreads) {
  Moved one(arm("harmonics: 3")), four(arm("harmonics: 3"), 4);
  one.run();
  four.run();
  EXPECT_EQ(one.response.effort, four.response.effort);
  EXPECT_EQ(one.response.jacobian, four.response.jacobian);
  EXPECT_EQ(one.slopes.effort, four.slopes.effort);
  EXPECT_EQ(one.slopes.jacobian, four.slopes.jacobian);
}

TEST(ExcitedMotion, JointsThatDoNotDetermineTheMotionAreRefused) {
  const Problem problem = load_problem(
      {"arm.urdf", arm_urdf()}, {},
      {"study.yaml",
       "identify: {}\nexcite: {joints: {elbow: {noise: 1}}}\nparameters: {fore_mass: {}}\n"});
  const MotionLimits limits = motion_limits(problem);
  try {
    ExcitedMotion(*system_of(problem), limits.joints, {}, problem.parameters(), 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(error.fault().message.find("excite.joints"), std::string::npos) << error.what();
    EXPECT_NE(error.fault().element.find("shoulder"), std::string::npos) << error.what();
  }
}

TEST(ExcitedMotion, ObeysACancel) {
  Moved moved(arm("harmonics: 3"));
  const std::atomic<bool> cancel{true};
  moved.motion.obey(&cancel);
  EXPECT_EQ(moved.motion.respond(moved.path, true, &moved.response).code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
