// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/identifiability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

using Sentences = std::vector<std::string>;

/// Columns sin((k + 1) 0.1 t), t = 0 ... 199: nothing depends on anything.
Eigen::MatrixXd waves(Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(200, columns, [](Eigen::Index t, Eigen::Index k) {
    return std::sin(0.1 * static_cast<double>((k + 1) * t));
  });
}

TEST(Identifiability, FullRankSaysNothing) {
  const Identifiability found = find_identifiable(upper_factor(waves(4)));
  EXPECT_EQ(found.rank, 4);
  EXPECT_TRUE(found.dependent.empty());
  EXPECT_EQ(found.is_determined, std::vector<bool>(4, true));
  EXPECT_TRUE(describe_undetermined(found, {"a", "b", "c", "d"}).empty());
  EXPECT_GT(found.singular_values[3], 0.1);
}

TEST(Identifiability, TwoProportionalColumnsAppearAsTheirSum) {
  Eigen::MatrixXd J = waves(3);
  J.col(2) = 0.98 * J.col(1);
  const Identifiability found = find_identifiable(upper_factor(J));
  EXPECT_EQ(found.rank, 2);
  EXPECT_EQ(found.is_determined, (std::vector<bool>{true, false, false}));
  ASSERT_EQ(found.null_directions.cols(), 1);
  EXPECT_LT((J * found.null_directions).norm(), 1e-12);
  EXPECT_LT(found.singular_values[2], 1e-12);
  const Sentences sentences = describe_undetermined(found, {"friction", "mass_2", "mass_3"});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences[0], "mass_2 and mass_3 appear only as mass_2 + 0.98 mass_3");
}

// Which of the columns is called dependent must not be up to the rounding of a machine.
TEST(Identifiability, OfColumnsEqualButForRoundingTheFirstOneIsTaken) {
  for (const double rounding : {-1e-13, 0.0, 1e-13}) {
    Eigen::MatrixXd J = waves(4);
    J.col(3) = 9.0 * J.col(1);
    J.col(3).array() += rounding * J.col(0).array();
    J.col(1) *= 1.0 + rounding;
    EXPECT_EQ(find_identifiable(upper_factor(J)).dependent, std::vector<int>{3}) << rounding;
  }
}

TEST(Identifiability, UnitsDoNotMatter) {
  Eigen::MatrixXd J = waves(3);
  J.col(0) *= 1e9;
  J.col(1) *= 1e-9;
  EXPECT_EQ(find_identifiable(upper_factor(J)).rank, 3);
  J.col(2) = 1e12 * J.col(1);
  const Identifiability found = find_identifiable(upper_factor(J));
  EXPECT_EQ(found.rank, 2);
  EXPECT_TRUE(found.is_determined[0]);
  EXPECT_FALSE(found.is_determined[1]);
}

TEST(Identifiability, AParameterWithoutEffectIsNamed) {
  Eigen::MatrixXd J = waves(3);
  J.col(1).setZero();
  const Identifiability found = find_identifiable(upper_factor(J));
  EXPECT_EQ(found.rank, 2);
  EXPECT_EQ(found.is_determined, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(describe_undetermined(found, {"a", "preload", "c"}),
            Sentences{"preload has no effect"});
  const Identifiability none = find_identifiable(Eigen::MatrixXd::Zero(2, 2));
  EXPECT_EQ(none.rank, 0);
  EXPECT_EQ(describe_undetermined(none, {"a", "b"}).size(), 2U);
}

// A pendulum determines m c and J + m c^2 for mass m, known distance c, inertia J: with torque = (J
// + m c^2) a + m c g sin q all three columns of (m, J) are told apart by gravity; without gravity m
// and J appear only together.
TEST(Identifiability, ThePendulumTrap) {
  const double c = 0.5;
  Eigen::MatrixXd J(200, 2);
  for (Eigen::Index t = 0; t < 200; ++t) {
    const double a = std::sin(0.1 * static_cast<double>(t));
    J(t, 0) = c * c * a;
    J(t, 1) = a;
  }
  const Identifiability found = find_identifiable(upper_factor(J));
  EXPECT_EQ(found.rank, 1);
  const Sentences sentences = describe_undetermined(found, {"mass", "inertia"});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences[0], "mass and inertia appear only as mass + 4 inertia");
}

TEST(Identifiability, DirectionsOfSeveralDependenciesStayApart) {
  Eigen::MatrixXd J = waves(6);
  J.col(3) = 2.0 * J.col(0);
  J.col(5) = J.col(1) - J.col(2);
  const Identifiability found = find_identifiable(upper_factor(J));
  EXPECT_EQ(found.rank, 4);
  EXPECT_LT((J * found.null_directions).norm(), 1e-12);
  EXPECT_EQ(found.is_determined, (std::vector<bool>{false, false, false, false, true, false}));
  // One direction of two parameters, one of three.
  const auto entries = (found.null_directions.array() != 0.0).colwise().count();
  EXPECT_EQ(entries.minCoeff(), 2);
  EXPECT_EQ(entries.maxCoeff(), 3);
}

TEST(Identifiability, ALargerThresholdFindsWhatIsHardlyTold) {
  Eigen::MatrixXd J = waves(2);
  J.col(1) = J.col(0) + 1e-5 * J.col(1);
  EXPECT_EQ(find_identifiable(upper_factor(J)).rank, 2);
  EXPECT_EQ(find_identifiable(upper_factor(J), 1e-3).rank, 1);
}

TEST(ClearRounding, LeavesWhatHasAnEffect) {
  Eigen::MatrixXd J(2, 4);
  J << 3.0, 1e-14, 1e-10, 1e-14,  //
      4.0, 1e-14, 1e-10, 1e-14;
  Eigen::MatrixXd cleared = J;
  clear_rounding(Eigen::Vector4d(0.0, 0.0, 0.0, 1e6), &cleared);
  EXPECT_EQ(cleared.col(0), J.col(0)) << "a number may begin at zero";
  EXPECT_TRUE(cleared.col(1).isZero(0.0));
  EXPECT_EQ(cleared.col(2), J.col(2)) << "small, but not rounding";
  EXPECT_EQ(cleared.col(3), J.col(3)) << "a number of this magnitude has an effect";
}

TEST(ClearRounding, OfOtherNumbersDoesNotDependOnAUnit) {
  // A mass of 2 kg, written as 2 or, in units of 1e12 kg, as 2e-12.
  for (const double unit : {1.0, 1e12, 1e-12}) {
    Eigen::MatrixXd J(2, 4);
    J << 4.0 * unit, 0.5, 1e-16, 0.3,  //
        3.0 * unit, 0.7, 1e-16, 0.1;
    Eigen::MatrixXd cleared = J;
    clear_rounding(Eigen::Vector4d(2.0 / unit, 0.1, 0.2, 0.0), &cleared);
    EXPECT_TRUE(cleared.col(2).isZero(0.0));
    EXPECT_EQ(cleared.col(0), J.col(0));
    EXPECT_EQ(cleared.col(1), J.col(1));
    EXPECT_EQ(cleared.col(3), J.col(3));
  }
}

TEST(ClearRounding, AColumnAloneIsComparedWithWhatIsMeasured) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Constant(2, 1, 1e-14), alone = J;
  clear_rounding(Eigen::VectorXd::Ones(1), &alone);
  EXPECT_EQ(alone, J);
  clear_rounding(Eigen::VectorXd::Ones(1), &alone, 10.0);
  EXPECT_TRUE(alone.isZero(0.0));
}

}  // namespace
}  // namespace codesign
