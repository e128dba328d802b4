// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/shipped.h"
#include "description/study.h"
#include "equations/compiled.h"
#include "identification/complex_efforts.h"
#include "identification/recorded_motion.h"
#include "math/differences.h"

namespace codesign {
namespace {

/// The efforts of a model at the start values.
Eigen::MatrixXd efforts_of(EffortModel* model, const CompiledSystem& system,
                           RowJacobian* jacobian = nullptr) {
  Status status = model->begin(system.parameters());
  EXPECT_TRUE(status.ok()) << status.cause;
  Eigen::MatrixXd efforts;
  status = model->evaluate(system.parameters(), &efforts, jacobian);
  EXPECT_TRUE(status.ok()) << status.cause;
  return efforts;
}

/// Simulates a mechanism and expects that the efforts of the controllers are found again from the
/// motion of the joints.
void expect_applied_efforts(const CompiledSystem& system, const std::vector<std::string>& joints,
                            double largest_step) {
  const RecordedMotion recorded = record_motion(system, joints, 150, largest_step);
  ASSERT_GT(recorded.efforts.cwiseAbs().maxCoeff(), 0.01);
  EffortModel model(system, measured(joints), recorded.motion);
  const Eigen::MatrixXd efforts = efforts_of(&model, system);
  ASSERT_EQ(model.drives(), joints);
  EXPECT_LT((efforts - recorded.efforts).cwiseAbs().maxCoeff(),
            1e-9 * (1.0 + recorded.efforts.cwiseAbs().maxCoeff()));
}

/// Compares every derivative at every tenth sample with a complex step.
void expect_exact_jacobian(const CompiledSystem& system, const std::vector<std::string>& joints,
                           const MotionSamples& motion,
                           const std::vector<std::string>& passive = {}) {
  EffortModel model(system, measured(joints, passive), motion);
  RowJacobian jacobian;
  efforts_of(&model, system, &jacobian);
  const auto drives = static_cast<Eigen::Index>(model.drives().size());
  Eigen::VectorXd rho(model.parameters());
  for (int k = 0; k < model.parameters(); ++k)
    rho[k] = system.parameters()[to_index(system.study().tuned[to_index(k)])];
  EXPECT_GT(jacobian.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-6)
      << "a parameter without effect tests nothing";
  for (int sample = 0; sample < model.samples(); sample += 10) {
    const auto column = [&](const Eigen::MatrixXd& of) {
      return In<double>(of.data() + sample * drives, drives);
    };
    ComplexEfforts complex(
        model.driven(),
        {column(model.position()), column(model.velocity()), column(model.acceleration())},
        model.state(sample));
    const JacobianDifference difference = compare_jacobians(
        jacobian.middleRows(sample * drives, drives),
        complex_step_jacobian([&complex](const Eigen::VectorXcd& at) { return complex(at); }, rho));
    EXPECT_LT(difference.largest, 1e-9) << "sample " << sample << ", drive " << difference.row
                                        << ", parameter " << difference.column;
  }
}

/// Compares the derivatives by parameters and by shifts of all drives with a complex step, where
/// the motion is shifted.
TEST(EffortModel, DerivativesByShiftsAreExact) {
  Shipped shipped("slider_crank");
  const auto crank = make_system(shipped.robot, shipped.study, nullptr);
  MotionSamples motion = record_motion(*crank, {"crank_joint"}, 60, 0.01).motion;
  motion.shifted = {0};
  motion.begins = {0, 30};
  shipped.study.tuned.pop_back();
  const auto system = make_system(shipped.robot, shipped.study, nullptr);
  EffortModel model(*system, measured({"crank_joint"}), motion);
  model.shift(Eigen::RowVector2d(0.02, -0.1));
  EXPECT_EQ(model.position()(0, 0), motion.position(0, 0) + 0.02);
  EXPECT_EQ(model.position()(0, 30), motion.position(0, 30) - 0.1);
  RowJacobian jacobian;
  efforts_of(&model, *system, &jacobian);
  ASSERT_EQ(jacobian.cols(), model.parameters() + 1);
  EXPECT_GT(jacobian.rightCols(1).cwiseAbs().maxCoeff(), 1e-3);
  Eigen::VectorXd rho = Eigen::VectorXd::Zero(jacobian.cols());
  for (int k = 0; k < model.parameters(); ++k)
    rho[k] = system->parameters()[to_index(system->study().tuned[to_index(k)])];
  for (int sample = 0; sample < model.samples(); sample += 7) {
    const auto column = [&](const Eigen::MatrixXd& of) {
      return In<double>(of.data() + sample, 1);
    };
    ComplexEfforts complex(
        model.driven(),
        {column(model.position()), column(model.velocity()), column(model.acceleration())},
        model.state(sample));
    const JacobianDifference difference = compare_jacobians(
        jacobian.row(sample),
        complex_step_jacobian([&complex](const Eigen::VectorXcd& at) { return complex(at); }, rho));
    EXPECT_LT(difference.largest, 1e-9) << "sample " << sample << ", column " << difference.column;
  }
}

TEST(EffortModel, OnlyDrivesCanBeShiftedAndOnlyWithoutSurplus) {
  const Shipped shipped("slider_crank");
  const auto system = make_system(shipped.robot, shipped.study, nullptr);
  RecordedMotion recorded = record_motion(*system, {"crank_joint", "slider_joint"}, 30, 0.01);
  recorded.motion.shifted = {0};
  EXPECT_THROW(EffortModel(*system, measured({"crank_joint"}, {"slider_joint"}), recorded.motion),
               InputError);
}

TEST(EffortModel, APendulumNeedsInertiaGravityAndDamping) {
  const auto system = compiled(robot(bar("bar") + hinge("hinge", "ground", "bar", "0 0 0",
                                                        "<dynamics damping='0.3' friction='0'/>")),
                               let_go("{}", "hinge/velocity"));
  const MotionSamples motion = swing(300, 1.2);
  EffortModel model(*system, measured({"hinge"}), motion);
  const Eigen::MatrixXd efforts = efforts_of(&model, *system);
  for (int k = 0; k < 300; ++k) {
    const double by_hand = (0.0834 + 0.25) * motion.acceleration(0, k) +
                           9.81 * 0.5 * std::sin(motion.position(0, k)) +
                           0.3 * motion.velocity(0, k);
    EXPECT_NEAR(efforts(0, k), by_hand, 1e-11);
  }
}

/// A crank of length r turns a slider along x by a rod of length l, without gravity. The rod is two
/// point masses at its ends, so that all that moves is the crank's inertia J about its hinge and
/// the slider's mass M.
std::string point_mass_slider_crank() {
  const std::string mass =
      "<mass value='0.5'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.02' iyz='0' "
      "izz='0.01'/></inertial></link>";
  return robot("<link name='crank'><inertial><origin xyz='0.1 0 0'/>" + mass +
               "<link name='rod'><inertial><origin xyz='0.3 0 0'/><mass value='0.4'/>" +
               "<inertia ixx='0.001' ixy='0' ixz='0' iyy='0.036' iyz='0' "
               "izz='0.036'/></inertial></link><link name='slider'><inertial>" +
               mass + hinge("crank_joint", "ground", "crank", "0 0 0") +
               hinge("rod_joint", "crank", "rod", "0.2 0 0") +
               "<joint name='slider_joint' type='prismatic'><parent link='ground'/><child "
               "link='slider'/><axis xyz='1 0 0'/><limit effort='0' "
               "velocity='0'/><codesign:friction mu_static='0.3' mu_dynamic='0.3' "
               "transition_velocity='0.001' joint_length='0.1' joint_width='0.1' "
               "smoothing='1e-9'/></joint><loop name='pin' type='continuous'><predecessor "
               "link='rod'><origin xyz='0.6 0 0'/></predecessor>"
               "<successor link='slider'/><axis xyz='0 1 0'/></loop>");
}

TEST(EffortModel, ASliderCrankWithFrictionByHand) {
  const auto system = compiled(
      point_mass_slider_crank(),
      "gravity: [0, 0, 0]\n" + let_go("{crank_joint: {position: 0.6}, slider_joint: {guess: 0.7}}",
                                      "crank_joint/velocity"));
  const double r = 0.2, l = 0.6, J = 0.02 + 0.5 * 0.01 + 0.2 * r * r, M = 0.5 + 0.2;
  const MotionSamples motion = swing(200, 0.3, 0.9);
  EffortModel model(*system, measured({"crank_joint"}), motion);
  const Eigen::MatrixXd efforts = efforts_of(&model, *system);
  for (int k = 0; k < 200; ++k) {
    const double angle = motion.position(0, k), rate = motion.velocity(0, k),
                 second = motion.acceleration(0, k);
    const double s = r * std::sin(angle), c = r * std::cos(angle), root = std::sqrt(l * l - s * s);
    const double slope = -s - s * c / root;  // dx / d angle
    const double curvature = -c - (c * c - s * s) / root - s * s * c * c / (root * root * root);
    const double x_rate = slope * rate, x_second = slope * second + curvature * rate * rate;
    // The rod pushes the slider with P along itself, P cos - S |P sin| = M x''.
    const double S = 0.3 * std::tanh(4.0 * x_rate / 0.001), cosine = root / l,
                 sine = std::abs(s) / l;
    const double sign = M * x_second > 0.0 ? 1.0 : -1.0;
    const double P = M * x_second / (cosine - sign * S * sine);
    EXPECT_NEAR(efforts(0, k), J * second + P * cosine * slope, 1e-7) << k;
  }
}

TEST(EffortModel, EveryDerivativeOfAPendulumWithARotorIsExact) {
  const auto system = compiled(
      "<robot name='p' xmlns:codesign='urn:t'><codesign:parameter name='m' "
      "value='1'/><codesign:parameter name='l' value='0.5'/>"
      "<codesign:parameter name='c' value='0.3'/><codesign:parameter name='J' "
      "value='0.0005'/><codesign:parameter name='mu' value='0.2'/>"
      "<link name='ground'/><link name='bar'><inertial><origin xyz='0 0 -0.5' codesign:xyz='0 0 "
      "${-l}'/><mass value='1' "
      "codesign:value='${m}'/><inertia ixx='0.0834' ixy='0' ixz='0' iyy='0.0834' "
      "codesign:iyy='${0.0834*m}' iyz='0' izz='0.001'/>"
      "</inertial></link>" +
          hinge("hinge", "ground", "bar", "0 0 0",
                "<dynamics damping='0.3' codesign:damping='${c}'/><codesign:actuator "
                "gear_ratio='30' rotor_inertia='0.0005' "
                "codesign:rotor_inertia='${J}'/><codesign:friction mu_static='0.2' "
                "codesign:mu_static='${mu}' mu_dynamic='0.15' "
                "transition_velocity='0.01' joint_length='0.05' pin_radius='0.02'/>") +
          "</robot>",
      let_go("{}", "hinge/velocity",
             "parameters: {m: {tune: true}, l: {tune: true}, c: {tune: true}, J: {tune: true}, mu: "
             "{tune: true}}"));
  expect_exact_jacobian(*system, {"hinge"}, swing(200, 1.2));
}

TEST(EffortModel, FindsTheTorquesOfTheTwoLinkArm) {
  const Shipped shipped("two_link_arm");
  expect_applied_efforts(*make_system(shipped.robot, shipped.study, nullptr), {"shoulder", "elbow"},
                         0.01);
}

TEST(EffortModel, FindsTheTorqueOfTheSliderCrankWithFrictionByReactions) {
  const Shipped shipped("slider_crank");
  expect_applied_efforts(*make_system(shipped.robot, shipped.study, nullptr), {"crank_joint"},
                         0.01);
}

TEST(EffortModel, JacobianOfTheSliderCrankWithItsDimensions) {
  Shipped shipped("slider_crank");
  const auto system = make_system(shipped.robot, shipped.study, nullptr);
  const RecordedMotion recorded = record_motion(*system, {"crank_joint"}, 100, 0.01);
  // The gain of the controller has no influence on the efforts that the motion needs.
  shipped.study.tuned.pop_back();
  expect_exact_jacobian(*make_system(shipped.robot, shipped.study, nullptr), {"crank_joint"},
                        recorded.motion);
}

TEST(EffortModel, JacobianByTheTenNumbersOfAFreeInertia) {
  std::string tuned;
  for (const char* name : {"alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3"})
    tuned += std::string(tuned.empty() ? "" : ", ") + "camera_" + name + ": {tune: true}";
  const auto system = compiled(
      robot("<link name='head'><inertial><mass value='1'/><inertia ixx='0.01' ixy='0' ixz='0' "
            "iyy='0.01' iyz='0' "
            "izz='0.01'/></inertial></link>"
            "<link name='camera'><inertial codesign:inertia='free'><origin xyz='0.1 0.05 -0.2' "
            "rpy='0.2 0.1 0.3'/><mass value='2'/><inertia "
            "ixx='0.02' ixy='0.001' ixz='0' iyy='0.03' iyz='0.002' izz='0.04'/></inertial></link>"
            "<joint name='pan' type='continuous'><parent link='ground'/><child link='head'/><axis "
            "xyz='0.2 0.1 1'/></joint>" +
            hinge("tilt", "head", "camera", "0.1 0 0.3")),
      let_go("{}", "pan/velocity", "parameters: {" + tuned + "}"));
  expect_exact_jacobian(*system, {"pan", "tilt"}, swing(100, 1.2, 0.1, 2));
}

/// A four-bar linkage drawn in the plane, whose redundant reactions friction depends on, with
/// parameters of every kind.
std::string tunable_four_bar() {
  std::string urdf = four_bar(
      "<codesign:friction model='brown_mcphee' mu_static='0.2' codesign:mu_static='${mu+0.05}' "
      "mu_dynamic='0.15' "
      "codesign:mu_dynamic='${mu}' "
      "transition_velocity='0.01' joint_length='0.05' pin_radius='0.02' "
      "codesign:pin_radius='${radius}'/>");
  const auto replace = [&urdf](const std::string& from, const std::string& to) {
    const std::size_t at = urdf.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    urdf.replace(at, from.size(), to);
  };
  replace("<link name='ground'/>",
          "<codesign:parameter name='mu' value='0.15'/><codesign:parameter name='radius' "
          "value='0.02'/><codesign:parameter name='mass' "
          "value='1'/><codesign:parameter name='height' value='1'/><link name='ground'/>");
  replace("<mass value='1'/>", "<mass value='1' codesign:value='${mass}'/>");
  replace("<origin xyz='0 0 -1' rpy", "<origin xyz='0 0 -1' codesign:xyz='0 0 ${-height}' rpy");
  replace("<predecessor link='right'><origin xyz='0 0 -1'/>",
          "<predecessor link='right'><origin xyz='0 0 -1' codesign:xyz='0 0 ${-height}'/>");
  return urdf;
}

const char* driven_four_bar() {
  return "controllers: {motor: {type: pid, input: left_hinge/position, setpoint: {type: sine, "
         "offset: 0.3, amplitude: 0.4, frequency: "
         "0.8}, "
         "output: left_hinge, gains: {p: 200.0, d: 20.0}}}\n"
         "parameters: {mu: {tune: true}, radius: {tune: true}, mass: {tune: true}, height: {tune: "
         "true}}";
}

TEST(EffortModel, FindsTheTorqueOfARedundantFourBar) {
  const auto system =
      compiled(tunable_four_bar(),
               let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity", driven_four_bar()));
  ASSERT_TRUE(system->sharing().drops());
  expect_applied_efforts(*system, {"left_hinge"}, 0.01);
}

TEST(EffortModel, FindsTheTorqueWhereRedundantRowsHaveACompliance) {
  const std::string control = driven_four_bar();
  const auto system =
      compiled(four_bar(), let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity",
                                  control.substr(0, control.find("parameters"))));
  ASSERT_FALSE(system->sharing().drops());
  ASSERT_GT(system->compliance(), 0.0);
  expect_applied_efforts(*system, {"left_hinge"}, 0.01);
}

TEST(EffortModel, JacobianOfARedundantFourBarWithItsDimensions) {
  const auto system =
      compiled(tunable_four_bar(),
               let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity", driven_four_bar()));
  const RecordedMotion recorded = record_motion(*system, {"left_hinge"}, 100, 0.01);
  expect_exact_jacobian(*system, {"left_hinge"}, recorded.motion);
}

TEST(EffortModel, APassiveJointNeedsNoEffort) {
  const auto system = compiled(
      double_pendulum(pin_friction()),
      let_go("{shoulder: {position: 1.0}, elbow: {position: 0.5}}", "elbow/velocity",
             "controllers: {motor: {type: pid, input: shoulder/position, setpoint: 0.0, output: "
             "shoulder, gains: {p: 5.0}}}"));
  const RecordedMotion recorded = record_motion(*system, {"shoulder", "elbow"}, 100, 0.01);
  EffortModel model(*system, measured({"shoulder"}, {"elbow"}), recorded.motion);
  const Eigen::MatrixXd efforts = efforts_of(&model, *system);
  ASSERT_EQ(model.drives().size(), 2u);
  EXPECT_LT((efforts - recorded.efforts).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(efforts.row(1).cwiseAbs().maxCoeff(), 1e-9);
}

/// Compares efforts and derivatives in joint coordinates with those in absolute ones, along a
/// motion in joint coordinates.
void expect_absolute_coordinates_agree(const RobotDescription& robot, Study study,
                                       const std::vector<std::string>& joints, int coordinates) {
  study.solver.coordinates = CoordinatesKind::kJoint;
  const auto joint = make_system(robot, study, nullptr);
  study.solver.coordinates = CoordinatesKind::kAbsolute;
  const auto absolute = make_system(robot, study, nullptr);
  const RecordedMotion recorded = record_motion(*joint, joints, 60, 0.01);
  EffortModel model(*joint, measured(joints), recorded.motion),
      other(*absolute, measured(joints), recorded.motion);
  EXPECT_EQ(model.driven().system->layout().n, coordinates);
  EXPECT_EQ(other.driven().system->layout().n, 7 * other.driven().system->layout().bodies);
  RowJacobian jacobian, other_jacobian;
  const Eigen::MatrixXd efforts = efforts_of(&model, *joint, &jacobian);
  const Eigen::MatrixXd difference = efforts - efforts_of(&other, *absolute, &other_jacobian);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9 * (1.0 + efforts.cwiseAbs().maxCoeff()));
  EXPECT_LT(compare_jacobians(jacobian, other_jacobian).largest, 1e-9);
}

TEST(EffortModel, EffortsDoNotDependOnTheCoordinates) {
  const Shipped arm("two_link_arm"), crank("slider_crank");
  expect_absolute_coordinates_agree(arm.robot, arm.study, {"shoulder", "elbow"}, 2);
  expect_absolute_coordinates_agree(crank.robot, crank.study, {"crank_joint"}, 9);
  const RobotDescription four = read_urdf({"test.urdf", tunable_four_bar()});
  const std::string study =
      let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity", driven_four_bar());
  expect_absolute_coordinates_agree(four, read_study({"test.yaml", study}, four), {"left_hinge"},
                                    21);
}

TEST(EffortModel, TheSameBitsForAnyNumberOfThreads) {
  const auto system =
      compiled(tunable_four_bar(),
               let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity", driven_four_bar()));
  const RecordedMotion recorded = record_motion(*system, {"left_hinge"}, 200, 0.01);
  Eigen::MatrixXd first;
  RowJacobian first_jacobian;
  for (int threads : {1, 2, 3}) {
    EffortModel model(*system, measured({"left_hinge"}), recorded.motion, threads);
    RowJacobian jacobian;
    for (int repeat = 0; repeat < 2; ++repeat) {
      const Eigen::MatrixXd efforts = efforts_of(&model, *system, &jacobian);
      if (first.size() == 0) {
        first = efforts;
        first_jacobian = jacobian;
      }
      EXPECT_EQ(efforts, first) << threads;
      EXPECT_EQ(jacobian, first_jacobian) << threads;
    }
  }
}

TEST(EffortModel, FollowsAMotionThatBeginsFarFromTheStart) {
  const auto system =
      compiled(four_bar(), let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity"));
  const MotionSamples near = swing(50, 0.2, 0.3);
  MotionSamples far = near;
  far.position.array() += 2.0 * M_PI;  // one turn on, from the same position in space
  EffortModel model(*system, measured({"left_hinge"}), near),
      turned(*system, measured({"left_hinge"}), far);
  const Eigen::MatrixXd efforts = efforts_of(&model, *system);
  EXPECT_LT((efforts - efforts_of(&turned, *system)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(EffortModel, BeginComesFirstAndNoSamplesAreNoEfforts) {
  const auto system = compiled(pendulum(), let_go("{}", "hinge/velocity"));
  EffortModel model(*system, measured({"hinge"}), swing(10, 1.0));
  Eigen::MatrixXd efforts;
  EXPECT_THROW(model.evaluate(system->parameters(), &efforts, nullptr), std::logic_error);
  EffortModel empty(*system, measured({"hinge"}), swing(0, 1.0), 2);
  RowJacobian jacobian;
  EXPECT_EQ(efforts_of(&empty, *system, &jacobian).size(), 0);
  MotionSamples uneven = swing(10, 1.0);
  uneven.velocity.resize(1, 9);
  EXPECT_THROW(EffortModel(*system, measured({"hinge"}), uneven), std::invalid_argument);
  uneven = swing(10, 1.0);
  uneven.begins = {3};
  EXPECT_THROW(EffortModel(*system, measured({"hinge"}), uneven), std::invalid_argument);
}

}  // namespace
}  // namespace codesign
