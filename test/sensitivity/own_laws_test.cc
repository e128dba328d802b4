// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Laws that are not in the library: a friction law, a joint, a controller and a loss, each one
// function and one row of a table.
#include <gtest/gtest.h>

#include "codegen/traced.h"
#include "integration/mechanisms.h"
#include "integration/touching.h"
#include "joints/pair_constants.h"
#include "joints/pair_rows.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// Coulomb friction that falls from mu_s to mu_d as a Gaussian of the speed, without a jump at
/// rest.
template <class T>
T gauss(const T& v, const T& mu_static, const T& mu_dynamic, const FrictionNumbers<T>& c) {
  using std::exp;
  using std::tanh;
  const T w = v / c.transition_velocity;
  return (mu_dynamic + (mu_static - mu_dynamic) * exp(-w * w)) * tanh(8.0 * w);
}
const FrictionLaw kGauss{"gauss", "Gauss", {gauss, gauss}};

/// The point of body j stays in the plane of body i that is normal to z and goes through the point
/// of body i.
template <class T>
void point_in_plane(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(2);
}
const JointLaw kPointInPlane{
    nullptr, "codesign:point_in_plane",       JointType::kOther, 1, ForceRows::kAlong, false,
    false,   {point_in_plane, point_in_plane}};

/// A joint of the tree: a sleeve turns about its shaft and slides along it.
template <class T>
void on_shaft(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(0);
  rows->keep_in_plane(1);
  rows->keep_parallel();
}
constexpr JointLaw sleeve() {
  JointLaw law;
  law.of_joints = "sleeve";
  law.type = JointType::kOther;
  law.rows = 4;
  law.force = ForceRows::kAcross;
  law.torque_rows = law.in_forest = true;
  law.add_rows = {on_shaft, on_shaft};
  law.freedoms.slide(FreedomAxis::kAxis);
  law.freedoms.turn(FreedomAxis::kAxis);
  return law;
}
constexpr JointLaw kSleeve = sleeve();

/// u = p tanh(d e).
template <class T>
T soft_p(const ControlValues<T>& x) {
  using std::tanh;
  return x.gains.p * tanh(x.gains.d * x.error);
}
const ControlLaw kSoftP{"soft_p", {soft_p, soft_p}, "pd"};

/// Cauchy's loss c^2 log(1 + (r/c)^2).
template <class T>
T cauchy(const LossValues<T>& x) {
  using std::log;
  const T u = x.residual() / x.scale;
  return x.scale * x.scale * log(1.0 + u * u);
}
const LossLaw kCauchy{"cauchy", {}, {cauchy, cauchy}, true};

/// The normal force k delta^n (1 + lambda delta')^2, and a plane that rises with x at 45 degrees.
template <class T>
T squared(const ContactValues<T>& x) {
  const T growth = T(1.0) + x.loss * x.rate;
  return growth * growth;
}
const ContactLaw kSquared{"squared", "squared", "dissipation", {squared, squared}};

template <class T>
SurfaceDistance<T> above_ramp(const Vector3<T>& at, const ShapeNumbers<T>&) {
  const T half(std::sqrt(0.5));
  return {T(half * (at[2] - at[0])), Vector3<T>(T(-half), T(0.0), half)};
}
constexpr ContactShape ramp() {
  ContactShape shape;
  shape.name = "ramp";
  shape.surface = {above_ramp, above_ramp};
  shape.holds_points = shape.flat = true;
  return shape;
}
constexpr ContactShape kRamp = ramp();

Laws own_laws() {
  Laws laws = standard_laws();
  laws.contacts.emplace_back(kSquared);
  laws.shapes.emplace_back(kRamp);
  laws.friction.emplace_back(kGauss);
  laws.joints.emplace_back(kPointInPlane);
  laws.joints.emplace_back(kSleeve);
  laws.controllers.emplace_back(kSoftP);
  laws.losses.emplace_back(kCauchy);
  return laws;
}

constexpr double kRadius = 0.02, kMuS = 0.5, kMuD = 0.3, kVt = 0.02, kHeight = -1.5;

double gauss_at(double v) {
  FrictionNumbers<double> c;
  c.transition_velocity = kVt;
  return gauss(v, kMuS, kMuD, c);
}

/// A double pendulum whose tip slides in a horizontal plane 1.5 m below its shoulder.
std::string guided() {
  const auto parameter = [](const char* name, const char* value) {
    return std::string("<codesign:parameter name='") + name + "' value='" + value + "'/>";
  };
  return robot(parameter("mu_s", "0.5") + parameter("v_t", "0.02") + parameter("height", "-1.5") +
               bar("upper") + bar("lower") +
               hinge("shoulder", "ground", "upper", "0 0 0",
                     "<codesign:friction model='gauss' mu_static='0.5' "
                     "codesign:mu_static='${mu_s}' mu_dynamic='0.3' "
                     "transition_velocity='0.02' codesign:transition_velocity='${v_t}' "
                     "joint_length='0.05' pin_radius='0.02'/>") +
               hinge("elbow", "upper", "lower", "0 0 -1") +
               "<loop name='rail' type='codesign:point_in_plane'><predecessor "
               "link='ground'><origin xyz='0.3 0.2 -1.5' codesign:xyz='0.3 0.2 "
               "${height}'/></predecessor><successor link='lower'><origin xyz='0 0 "
               "-1'/></successor><axis xyz='0 0 1'/></loop>");
}

std::string study(const std::string& solver) {
  return "duration: 0.4\ninitial_state: {shoulder: {position: 0.3, velocity: 1.5}, elbow: {guess: "
         "0.7}}\n"
         "controllers: {hold: {type: soft_p, input: shoulder/position, setpoint: 0.5, output: "
         "shoulder, gains: {p: \"${strength}\", d: "
         "\"${slope}\"}}}\n"
         "parameters: {mu_s: {tune: true}, v_t: {tune: true}, height: {tune: true}, strength: "
         "{initial: 4.0}, slope: {initial: 3.0}, width: {initial: 0.2}}\n"
         "objective: {integral: [{signal: shoulder/velocity}, {signal: elbow/position, weight: "
         "2.0}, {signal: hold/output, weight: 0.1}, "
         "{signal: shoulder/normal_force, weight: 0.001}, {signal: elbow/velocity, reference: "
         "0.3, loss: cauchy, scale: \"${width}\"}]}\n"
         "solver: {integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-9, "
         "absolute_tolerance: 1.0e-10" +
         solver + "}\n";
}

Problem own(const std::string& urdf, const std::string& text) {
  return load_problem({"own.urdf", urdf}, {}, {"own.yaml", text}, {}, TrajectoryLoader(),
                      FileLoader(), own_laws());
}

TEST(OwnLaws, ValuesAreThoseOfTheFunctions) {
  for (const char* coordinates : {", coordinates: absolute", ", coordinates: joint"}) {
    const Problem problem = own(guided(), study(coordinates));
    Simulation simulation(
        problem, problem.parameters(),
        {"shoulder/position", "elbow/position", "shoulder/velocity", "shoulder/friction",
         "shoulder/normal_force", "hold/error", "hold/output", "shoulder/effort"});
    ASSERT_TRUE(simulation.start().ok()) << coordinates;
    Frame frame;
    for (int k = 0; k <= 8; ++k) {
      const double time = 0.05 * k;
      ASSERT_TRUE(k == 0 || simulation.advance_to(time).ok()) << coordinates;
      simulation.sample(time, &frame);
      const std::vector<double>& s = frame.signals;
      EXPECT_NEAR(-std::cos(s[0]) - std::cos(s[0] + s[1]), kHeight, 1e-9)
          << "the tip stays in the plane, " << coordinates << time;
      EXPECT_NEAR(s[3], -kRadius * gauss_at(kRadius * s[2]) * s[4], 1e-12) << coordinates << time;
      EXPECT_GT(s[4], 1.0) << coordinates << time;
      EXPECT_NEAR(s[6], 4.0 * std::tanh(3.0 * s[5]), 1e-13) << coordinates << time;
      EXPECT_EQ(s[7], s[6]) << coordinates << time;
    }
    EXPECT_LT(simulation.statistics().energy_error, 1e-8)
        << coordinates << " the plane does no work";
  }
}

TEST(OwnLaws, TheirDerivativesFollow) {
  for (const char* solver : {"", ", gradient: adjoint", ", coordinates: joint"}) {
    const Problem problem = own(guided(), study(solver));
    const GradientCheck exact = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(exact.status.ok()) << solver << exact.status.cause;
    EXPECT_LT(exact.largest_relative_difference, 1e-9) << solver;
    EXPECT_GT(exact.evaluation.gradient.cwiseAbs().minCoeff(), 1e-6) << "every parameter counts";
  }
  const Problem problem = own(guided(), study(""));
  const GradientCheck independent = check_gradient(problem, problem.start(), CheckMethod::kRidders);
  ASSERT_TRUE(independent.status.ok()) << independent.status.cause;
  EXPECT_LT(independent.largest_relative_difference, 1e-5);
}

// A bar on an inclined shaft falls along it while it turns, at 0.3 rad to the vertical.
constexpr double kIncline = 0.3, kSpeed = 0.4, kSpin = 2.0;

std::string sleeved() {
  return robot(bar("bar") +
               "<joint name='sleeve' type='floating' codesign:type='sleeve'><parent "
               "link='ground'/><child link='bar'/>"
               "<origin rpy='0.3 0 0'/><axis xyz='0 0 1'/></joint>");
}

std::string sleeved_study(const std::string& coordinates) {
  return "duration: 0.5\nparameters: {speed: {initial: 0.4}, spin: {initial: 2.0}}\n"
         "initial_state: {sleeve: {translation: [0, 0, 0.1], linear_velocity: [0, 0, \"${speed}\"],"
         " rotation: 0.7, angular_velocity: \"${spin}\"}}\n"
         "objective: {terminal: [{signal: bar/position/z}, {signal: bar/angular_velocity/z}]}\n"
         "solver: {coordinates: " +
         coordinates + ", relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n";
}

TEST(OwnLaws, AJointOfTheTreeHasCoordinatesOfItsOwn) {
  for (const char* coordinates : {"joint", "absolute"}) {
    const Problem problem = own(sleeved(), sleeved_study(coordinates));
    Evaluator evaluator(problem);
    const Evaluation found = evaluator.evaluate(problem.start(), true);
    ASSERT_TRUE(found.status.ok()) << coordinates << found.status.cause;
    const double t = 0.5, along = 0.1 + kSpeed * t - 0.5 * 9.81 * std::cos(kIncline) * t * t,
                 z = along * std::cos(kIncline), turning = kSpin * std::cos(kIncline);
    EXPECT_NEAR(found.objective, z * z + turning * turning, 1e-8) << coordinates;
    EXPECT_NEAR(found.gradient[0], 2.0 * z * t * std::cos(kIncline), 1e-8) << coordinates;
    EXPECT_NEAR(found.gradient[1], 2.0 * turning * std::cos(kIncline), 1e-8) << coordinates;
  }
}

/// A bar that falls, with one term of this loss.
Problem falling(const std::string& loss) {
  return own(pendulum(""),
             "duration: 0.4\ninitial_state: {hinge: {position: 1.0, velocity: -1.0}}\nparameters: "
             "{width: {initial: "
             "0.2}}\nobjective: {integral: [{signal: " +
                 loss + "}], terminal: [{signal: " + loss + "}]}\n");
}

TEST(OwnLaws, ALossCountsAsItsFunctionSays) {
  const Problem own_loss = falling("hinge/velocity, loss: cauchy, scale: \"${width}\""),
                expression = falling("\"${sqrt(width**2*log(1 + (hinge/velocity/width)**2))}\"");
  const Evaluation a = Evaluator(own_loss).evaluate(own_loss.start(), true),
                   b = Evaluator(expression).evaluate(expression.start(), true);
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_NEAR(a.objective, b.objective, 1e-5 * b.objective)
      << "as an expression whose square is it";
  EXPECT_NEAR(a.gradient[0], b.gradient[0], 1e-4 * std::abs(b.gradient[0]));
  EXPECT_EQ(Evaluator(own_loss).evaluate(own_loss.start(), Derivatives::kGaussNewton).status.code,
            StatusCode::kInvalidDesign)
      << "it is no square";
}

TEST(OwnLaws, SuchAJointStartsOnlyAsItCanMove) {
  const auto complaint = [](const std::string& urdf, const std::string& start) {
    try {
      own(urdf, "duration: 0.5\ninitial_state: {sleeve: " + start + "}\n");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(sleeved(), "{translation: [0, 0, 0.1], rotation: 0.7}"), "");
  EXPECT_NE(complaint(sleeved(), "{translation: [0.2, 0, 0.1]}").find("across it is 0.2"),
            std::string::npos);
  EXPECT_NE(complaint(sleeved(), "{rotation: [0, 0, 0.7]}").find("turns only about its axis"),
            std::string::npos);
  std::string fixed = sleeved();
  fixed.replace(fixed.find("floating"), 8, "fixed");
  EXPECT_NE(complaint(fixed, "{rotation: 0.7}").find("must be floating for other readers"),
            std::string::npos);
}

TEST(OwnLaws, AFunctionOfTheSpeedAlsoSlipsInSeveralDirections) {
  FrictionNumbers<double> c;
  c.mu_static = kMuS;
  c.mu_dynamic = kMuD;
  c.transition_velocity = kVt;
  for (double v : {1e-4, 0.003, 0.02, 0.5})
    EXPECT_NEAR(per_speed(kGauss, v * v, c) * v, gauss_at(v), 1e-9) << v;
  EXPECT_NEAR(per_speed(kGauss, 0.0, c), 8.0 * kMuS / kVt, 1e-6) << "the slope at rest";

  const Problem problem =
      own(with_friction_model(puck(), "gauss"),
          "duration: 0.2\ninitial_state: {}\nparameters: {weight: {initial: 1.0}}\n"
          "objective: {integral: [{signal: slope/friction, weight: \"${weight}\"}]}\n");
  Simulation simulation(problem, problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  ASSERT_TRUE(simulation.advance_to(0.2).ok());
  EXPECT_LT(simulation.statistics().energy_error, 1e-4);
}

// The ramp is a plane that the library turns; Hunt and Crossley's law with twice the dissipation
// differs by (lambda delta')^2 only.
TEST(OwnLaws, AContactHasLawsAndShapesOfItsOwn) {
  const auto end_of = [](const std::string& model, const std::string& on,
                         const std::string& dissipation) {
    const Problem problem = own(
        free_ball("", "<codesign:contact name='touch' stiffness='1e6' model='" + model +
                          "' dissipation='" + dissipation + "'><predecessor link='ground' " + on +
                          "</predecessor><successor link='ball' shape='sphere' radius='0.05' "
                          "codesign:radius='${radius}'/></codesign:contact>"),
        "duration: 0.4\ninitial_state: {free: {translation: [0, 0, 0.3]}}\nparameters: {radius: "
        "{}}\nobjective: {terminal: [{signal: ball/position/x}]}\nsolver: {relative_tolerance: "
        "1.0e-10, absolute_tolerance: 1.0e-12}\n");
    Evaluator evaluator(problem);
    const Evaluation run = evaluator.evaluate(problem.start(), true);
    EXPECT_TRUE(run.status.ok()) << run.status.cause;
    return Eigen::Vector2d(run.objective, run.gradient[0]);
  };
  const std::string plane = "shape='plane'><origin rpy='0 -0.7853981633974483 0'/>";
  const Eigen::Vector2d turned = end_of("squared", plane, "0.05"),
                        ramp = end_of("squared", "shape='ramp'>", "0.05"),
                        nearly = end_of("hunt_crossley", plane, "0.1"),
                        other = end_of("hunt_crossley", plane, "0.3");
  EXPECT_LT((turned - ramp).norm(), 1e-9 * ramp.norm());
  EXPECT_LT((turned - nearly).norm(), 0.02 * ramp.norm());
  EXPECT_GT((turned - nearly).norm(), 1e-5 * ramp.norm());
  EXPECT_GT((turned - other).norm(), 0.02 * ramp.norm());
}

TEST(OwnLaws, FilesNameThemOnlyWithTheirRows) {
  const auto complaint = [](const std::string& urdf, const Laws& laws) {
    try {
      read_urdf({"own.urdf", urdf}, {}, laws);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(guided(), own_laws()), "");
  EXPECT_NE(complaint(guided(), standard_laws()).find("gauss"), std::string::npos);
  EXPECT_NE(
      complaint(with_friction_model(pendulum(pin_friction()), "gaus"), own_laws()).find("gauss"),
      std::string::npos)
      << "nearest name";
  const std::string bristles =
      with_friction_model(pendulum(pin_friction()), "gauss' dwell_time='1");
  EXPECT_NE(
      complaint(bristles, own_laws()).find("dwell_time has no meaning for this friction model"),
      std::string::npos);
  const RobotDescription read = read_urdf({"own.urdf", guided()}, {}, own_laws());
  const std::string written = write_tuned_urdf({"own.urdf", guided()}, {}, {0.6, 0.02, -1.4},
                                               FrictionModel::kLuGre, own_laws());
  EXPECT_EQ(read.joints[0].friction->model, FrictionModel(kGauss));
  EXPECT_EQ(read_urdf({"written.urdf", written}, {}, own_laws()).joints[0].friction->model,
            FrictionModel::kLuGre);
}

}  // namespace
}  // namespace codesign
