// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/residuals_of_recordings.h"

#include <gtest/gtest.h>

#include "identification/effort/effort_residuals.h"
#include "identification/swinging_arm.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The rows of two recordings, the second one with its own damping if it is given.
Eigen::MatrixXd rows(double damping) {
  const Problem problem = load_problem(
      {"arm.urdf", kSwingingArm}, {},
      {"study.yaml",
       "identify: {data: [{csv: a.csv}], filter: {cutoff: 0}}\nparameters: {inertia: {}}\n"});
  const FitVariables variables(study_of(problem), &robot_of(problem));
  std::vector<JointRecording> recordings(2, SwingingRig().record("identify.data[0]"));
  if (damping >= 0.0) recordings[1].settings = {{1, damping}};
  Warnings warnings;
  const auto source = make_residuals(problem, variables, require_same_joints(recordings),
                                     recordings, nullptr, &warnings);
  EXPECT_TRUE(source->begin(variables.start()).ok());
  Eigen::MatrixXd residuals;
  EXPECT_TRUE(source->evaluate(variables.start(), &residuals, nullptr).ok());
  EXPECT_EQ(residuals.rows(), source->rows());
  EXPECT_EQ(series_of(*source, residuals).computed, source->recorded() + residuals);
  return residuals;
}

TEST(ResidualsOfRecordings, EachHasItsOwnValues) {
  const Eigen::MatrixXd alike = rows(-1.0), same = rows(0.1), other = rows(0.6);
  const Eigen::Index half = alike.rows() / 2;
  EXPECT_EQ(alike.topRows(half), alike.bottomRows(half));
  EXPECT_EQ(same, alike);
  EXPECT_EQ(other.topRows(half), alike.topRows(half));
  EXPECT_GT((other - alike).bottomRows(half).cwiseAbs().maxCoeff(), 0.5 * 3.0);
}

TEST(ResidualsOfRecordings, AreNoneAfterACancel) {
  const Problem problem = swinging_problem();
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const std::vector<JointRecording> recordings = {SwingingRig().record("identify.data[0]")};
  const std::atomic<bool> cancel{true};
  Warnings warnings;
  EXPECT_EQ(make_residuals(problem, variables, require_same_joints(recordings), recordings, &cancel,
                           &warnings),
            nullptr);
}

}  // namespace
}  // namespace codesign
