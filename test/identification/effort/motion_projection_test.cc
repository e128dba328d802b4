// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cases/shipped.h"
#include "description/study.h"
#include "equations/compiled.h"
#include "equations/formulas.h"
#include "identification/effort/motion_projection.h"
#include "identification/recorded_motion.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A linkage that is no parallelogram, so that the two hinges turn differently.
std::string uneven_four_bar() {
  std::string urdf = four_bar();
  const std::string from = "<origin xyz='1.2 0 0'/>", to = "<origin xyz='1.4 0 0.1'/>";
  urdf.replace(urdf.find(from), from.size(), to);
  return urdf;
}

class MotionProjectionTest : public testing::Test {
 protected:
  MotionProjectionTest()
      : system(compiled(uneven_four_bar(), let_go("{left_hinge: {position: 0.3, velocity: 1.0}}",
                                                  "left_hinge/velocity"))),
        recorded(record_motion(*system, {"left_hinge", "right_hinge"}, 60, 0.01)) {
    make_consistent();
  }

  /// Gives the right hinge the motion that follows from the left one's to rounding, not just to the
  /// integrator's tolerance.
  void make_consistent() {
    MotionSamples left = recorded.motion;
    for (Eigen::MatrixXd* part : {&left.position, &left.velocity, &left.acceleration})
      *part = part->topRows(1).eval();
    EffortModel model(*system, measured({"left_hinge"}), left);
    EXPECT_TRUE(model.begin(system->parameters()).ok());
    Formulas<double> formulas(*system);
    formulas.set_design(system->parameters());
    const CouplingTerm right =
        drive_of(system->robot(), system->topology(), joint_index(system->robot(), "right_hinge"))
            .terms.front();
    for (int sample = 0; sample < model.samples(); ++sample) {
      formulas.load(model.state(sample));
      const CoordinateMotion<double>& motion = formulas.coordinate(right.pair, right.element);
      recorded.motion.position(1, sample) = motion.position;
      recorded.motion.velocity(1, sample) = motion.rate;
      recorded.motion.acceleration(1, sample) = motion.acceleration;
    }
  }

  /// The weighted sum of squares by which positions at a sample miss the measured ones, with the
  /// left hinge `by` further on.
  double cost(const EffortModel& model, const std::vector<MeasuredJoint>& joints,
              const Eigen::VectorXd& measured, int sample, double by) {
    DrivenMotion motion(model.driven());
    motion.set_design(system->parameters());
    State<double> state = model.state(sample);
    const Eigen::VectorXd position = model.position().col(sample).array() + by,
                          zero = Eigen::VectorXd::Zero(1);
    EXPECT_TRUE(motion.follow({position, zero, zero}, &state).ok());
    Formulas<double>& formulas = motion.equations().formulas();
    formulas.load(state);
    const CouplingTerm right =
        drive_of(system->robot(), system->topology(), joint_index(system->robot(), "right_hinge"))
            .terms.front();
    const double misses[] = {position[0] - measured[0],
                             formulas.coordinate(right.pair, right.element).position - measured[1]};
    double sum = 0.0;
    for (std::size_t k = 0; k < 2; ++k)
      sum += misses[k] * misses[k] / (joints[k].deviation * joints[k].deviation);
    return sum;
  }

  std::shared_ptr<const CompiledSystem> system;
  RecordedMotion recorded;
};

TEST_F(MotionProjectionTest, AMotionThatFitsStays) {
  EffortModel model(*system, measured({"left_hinge"}, {"right_hinge"}), recorded.motion);
  const Status status = model.begin(system->parameters());
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_LT((model.position() - recorded.motion.position.row(0)).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((model.velocity() - recorded.motion.velocity.row(0)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((model.acceleration() - recorded.motion.acceleration.row(0)).cwiseAbs().maxCoeff(),
            1e-9);
}

TEST_F(MotionProjectionTest, PositionsMissByTheLeastWeightedSquares) {
  MotionSamples noisy = recorded.motion;
  for (int k = 0; k < noisy.position.cols(); ++k) {
    noisy.position(0, k) += 0.02 * std::sin(1.7 * k);
    noisy.position(1, k) += 0.03 * std::cos(2.3 * k);
  }
  std::vector<MeasuredJoint> joints = measured({"left_hinge"}, {"right_hinge"});
  joints[1].deviation = 0.5;
  EffortModel model(*system, joints, noisy);
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  for (int sample : {3, 17, 42}) {
    const Eigen::VectorXd at = noisy.position.col(sample);
    EXPECT_GT(std::abs(model.position()(0, sample) - at[0]), 1e-4);
    const double here = cost(model, joints, at, sample, 0.0);
    EXPECT_LT(here, cost(model, joints, at, sample, 1e-4));
    EXPECT_LT(here, cost(model, joints, at, sample, -1e-4));
    // The slope of the sum of squares vanishes.
    EXPECT_NEAR(
        (cost(model, joints, at, sample, 1e-5) - cost(model, joints, at, sample, -1e-5)) / 2e-5,
        0.0, 1e-8);
  }
}

TEST_F(MotionProjectionTest, AccelerationsOfEqualWeightAreShared) {
  MotionSamples noisy = recorded.motion;
  noisy.acceleration.row(1).array() += 0.7;
  noisy.velocity.row(1).array() += 0.3;
  EffortModel model(*system, measured({"left_hinge"}, {"right_hinge"}), noisy);
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  // With the slope K of the right hinge by the left one, an error e of the right one changes the
  // left one by K e / (1 + K^2).
  const double before = recorded.motion.velocity(1, 10) / recorded.motion.velocity(0, 10);
  EXPECT_NEAR(model.velocity()(0, 10) - recorded.motion.velocity(0, 10),
              0.3 * before / (1.0 + before * before), 1e-9);
}

TEST(MotionProjection, DoesNotDependOnTheCoordinates) {
  const Shipped shipped("slider_crank");
  const std::vector<MeasuredJoint> joints = measured({"crank_joint"}, {"slider_joint"});
  MotionSamples motion;
  std::vector<std::unique_ptr<EffortModel>> models;
  std::vector<std::shared_ptr<const CompiledSystem>> systems;
  for (CoordinatesKind coordinates : {CoordinatesKind::kJoint, CoordinatesKind::kAbsolute}) {
    Study study = shipped.study;
    study.solver.coordinates = coordinates;
    systems.push_back(make_system(shipped.robot, study, nullptr));
    if (models.empty()) {
      motion = record_motion(*systems[0], {"crank_joint", "slider_joint"}, 30, 0.01).motion;
      for (int k = 0; k < motion.position.cols(); ++k)
        motion.position(1, k) += 0.001 * std::sin(1.7 * k);
    }
    models.push_back(std::make_unique<EffortModel>(*systems.back(), joints, motion));
    const Status status = models.back()->begin(systems.back()->parameters());
    ASSERT_TRUE(status.ok()) << status.cause;
  }
  EXPECT_LT((models[0]->position() - models[1]->position()).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((models[0]->velocity() - models[1]->velocity()).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((models[0]->acceleration() - models[1]->acceleration()).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_GT((models[0]->position() - motion.position.row(0)).cwiseAbs().maxCoeff(), 1e-6)
      << "nothing was projected";
}

Eigen::VectorXd column_of(double value) { return Eigen::VectorXd::Constant(1, value); }

double largest_difference(const Frame& a, const Frame& b) {
  double largest = 0.0;
  const auto add = [&](double x, double y) {
    largest = std::max(largest, std::abs(x - y) / (1.0 + std::abs(x)));
  };
  for (std::size_t k = 0; k < a.joints.size(); ++k) {
    add(a.joints[k].position, b.joints[k].position);
    add(a.joints[k].velocity, b.joints[k].velocity);
    add(a.joints[k].effort, b.joints[k].effort);
  }
  for (std::size_t k = 0; k < a.frictions.size(); ++k) {
    add(a.frictions[k].friction, b.frictions[k].friction);
    add(a.frictions[k].normal_force, b.frictions[k].normal_force);
    add(0.0, (a.frictions[k].force - b.frictions[k].force).norm());
  }
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    add(0.0, (a.links[k].position - b.links[k].position).norm());
    add(0.0, a.links[k].orientation.angularDistance(b.links[k].orientation));
  }
  return largest;
}

// The crank alone is given; passive joints, the loop, friction by reactions and the motor's effort
// are found again.
TEST(DrivenReplay, ShowsWhatWasSimulated) {
  const Problem problem = shipped_problem("slider_crank", {});
  Simulation simulation(problem, problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  DrivenReplay replay(*system_of(problem), {{"crank_joint", true, 1.0, {}}},
                      Eigen::MatrixXd::Zero(1, 1), problem.parameters());
  ASSERT_EQ(replay.names().joints, simulation.names().joints);
  ASSERT_EQ(replay.names().frictions, simulation.names().frictions);
  ASSERT_EQ(replay.names().joints[0], "crank_joint");
  for (int k = 0; k <= 40; ++k) {
    Frame simulated, shown;
    ASSERT_TRUE(simulation.advance(0.005 * k).ok());
    simulation.sample(0.005 * k, &simulated);
    const JointSample& crank = simulated.joints[0];
    if (k == 0) {
      ASSERT_TRUE(replay.begin(column_of(crank.position)).ok());
    }
    const Eigen::VectorXd measured[] = {column_of(crank.position), column_of(crank.velocity),
                                        column_of(crank.acceleration)};
    const Status status = replay.show(0.0, measured, &shown);
    ASSERT_TRUE(status.ok()) << status.cause;
    ASSERT_EQ(shown.frictions.size(), simulated.frictions.size());
    EXPECT_LT(largest_difference(simulated, shown), 1e-5) << "t = " << 0.005 * k;
    EXPECT_GT(std::abs(shown.frictions[0].friction), 1e-3);
  }
}

TEST(DrivenReplay, APositionThatCannotBeAssembledIsAStatus) {
  const Problem problem = shipped_problem("slider_crank", {});
  DrivenReplay replay(*system_of(problem), {{"slider_joint", true, 1.0, {}}},
                      Eigen::MatrixXd::Zero(1, 1), problem.parameters());
  EXPECT_EQ(replay.begin(column_of(100.0)).code, StatusCode::kAssemblyFailed)
      << "the rod does not reach";
}

}  // namespace

}  // namespace codesign
