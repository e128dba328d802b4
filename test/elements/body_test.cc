// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "elements/body.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"
#include "equations/joint_cases.h"
#include "math/dense.h"
#include "mechanism/mass_properties.h"

namespace codesign {
namespace {

template <class T>
BodyConstants<T> constants() {
  BodyConstants<T> body;
  body.mass = T(2.5);
  body.J << T(0.3), T(0.02), T(-0.01), T(0.02), T(0.4), T(0.03), T(-0.01), T(0.03), T(0.2);
  return body;
}

TEST(RigidBody, MassTimesAcceleration) {
  BodyKinematics<double> k;
  k.rdd = {1.0, -2.0, 3.0};
  Vector3<double> on_r;
  Vector4<double> on_p;
  inertia_force(constants<double>(), k, &on_r, &on_p);
  EXPECT_EQ(on_r, Eigen::Vector3d(2.5, -5.0, 7.5));
  EXPECT_EQ(on_p.norm(), 0.0);
}

TEST(RigidBody, AgreesWithEulersEquations) {
  // For a unit p with omega' = 2 G p' the rows are 2 G^T (J dw/dt + w x J w), up to a multiple of p
  // that the norm's multiplier takes.
  const Vector4<double> p = Vector4<double>(0.5, -0.3, 0.7, 0.2).normalized();
  const Matrix34<double> G = body_rate_matrix(p);
  const Vector3<double> w(1.2, -0.7, 0.4), wd(-0.3, 0.9, 2.0);
  BodyKinematics<double> k;
  k.p = p;
  k.pd = 0.5 * (G.transpose() * w);
  k.pdd = 0.5 * (G.transpose() * wd) - k.pd.squaredNorm() * p;
  Vector3<double> on_r;
  Vector4<double> on_p;
  const BodyConstants<double> body = constants<double>();
  inertia_force(body, k, &on_r, &on_p);
  const Vector3<double> torque = body.J * wd + w.cross(body.J * w);
  // G G^T = I, G p = 0.
  EXPECT_LT((0.5 * (G * on_p) - torque).norm(), 1e-14);
}

const char* const kActuator =
    "<codesign:actuator gear_ratio='3' codesign:gear_ratio='${2*ratio}' rotor_inertia='0.01' "
    "codesign:rotor_inertia='${mass/80}'/>";

std::vector<JointCase> rotor_cases() {
  using namespace joint_cases;
  const std::string more = std::string(kOrigin) + kActuator;
  std::string universal = chain({{'R', "1 0 0"}, {'R', "0.3 1 0"}}),
              cylindrical = chain({{'R', "0 0 1"}, {'P', "0 0 1"}});
  for (std::string* folded : {&universal, &cylindrical})
    folded->insert(folded->find("</joint>"), kActuator);
  const std::string from_tip = loop("revolute", "base", kActuator);
  return {{"revolute", tree("joint", "revolute", "base", "tip", "1 0 0.5", more)},
          {"prismatic", tree("joint", "prismatic", "base", "tip", "1 0 0.5", more)},
          {"on_the_ground", tree("joint", "continuous", "ground", "tip", "1 0 0.5", more)},
          {"universal", universal},
          {"cylindrical", cylindrical},
          {"loop", free("tip") + from_tip}};
}

class RotorConformance : public ::testing::TestWithParam<JointCase> {};

TEST_P(RotorConformance, DerivativesAreExact) {
  EquationsFixture e(
      joint_cases::model(GetParam()),
      "duration: 1.0\nobjective: {integral: [{signal: mechanism/kinetic_energy}]}\n");
  ASSERT_EQ(e.system.rotors().size(), 1U);
  e.expect_exact_derivatives(1e-10);
}

INSTANTIATE_TEST_SUITE_P(AllJoints, RotorConformance, ::testing::ValuesIn(rotor_cases()),
                         [](const auto& c) { return c.param.name; });

/// A link of given mass, centre and inertia.
std::string heavy(const std::string& name, const MassProperties<double>& m) {
  const auto number = [](double x) {
    std::ostringstream text;
    text.precision(17);
    text << x;
    return "'" + text.str() + "'";
  };
  std::ostringstream text;
  text.precision(17);
  text << "<link name='" << name << "'><inertial><origin xyz='" << m.centre.transpose()
       << "'/><mass value=" << number(m.mass) << "/><inertia ixx=" << number(m.inertia(0, 0))
       << " ixy=" << number(m.inertia(0, 1)) << " ixz=" << number(m.inertia(0, 2))
       << " iyy=" << number(m.inertia(1, 1)) << " iyz=" << number(m.inertia(1, 2))
       << " izz=" << number(m.inertia(2, 2)) << "/></inertial></link>";
  return text.str();
}

MassProperties<double> sum_of(const MassProperties<double>& a, const MassProperties<double>& b) {
  MassProperties<double> sum;
  sum.mass = a.mass + b.mass;
  sum.centre = (a.mass * a.centre + b.mass * b.centre) / sum.mass;
  sum.inertia.setZero();
  for (const MassProperties<double>* part : {&a, &b}) {
    const Eigen::Vector3d d = part->centre - sum.centre;
    sum.inertia += part->inertia +
                   part->mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  return sum;
}

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.3, 1.0, -0.4).normalized();
constexpr double kInertia = 2e-4;

MassProperties<double> body_mass() {
  MassProperties<double> m;
  m.mass = 3.0;
  m.centre = Eigen::Vector3d(0.02, -0.03, 0.05);
  m.inertia = Eigen::Vector3d(0.03, 0.04, 0.05).asDiagonal();
  m.inertia(0, 1) = m.inertia(1, 0) = 0.002;
  return m;
}

/// A thick disc about kAxis.
MassProperties<double> rotor_mass() {
  MassProperties<double> m;
  m.mass = 0.4;
  m.centre = Eigen::Vector3d(0.1, 0.05, -0.02);
  m.inertia =
      1.3e-4 * Eigen::Matrix3d::Identity() + (kInertia - 1.3e-4) * kAxis * kAxis.transpose();
  return m;
}

std::string text_of(const Eigen::Vector3d& x) {
  std::ostringstream text;
  text.precision(17);
  text << x.transpose();
  return text.str();
}

/// A body that flies and an arm on it. The rotor is annotated, or a link of its own with a
/// coupling.
std::string flyer(const std::string& type, bool annotated) {
  MassProperties<double> centred = rotor_mass();
  centred.centre.setZero();
  const std::string explicit_rotor =
      heavy("rotor", centred) +
      "<joint name='spin' type='continuous'><parent link='base'/><child link='rotor'/><origin "
      "xyz='" +
      text_of(rotor_mass().centre) + "'/><axis xyz='" + text_of(kAxis) +
      "'/></joint><coupling name='gear'><predecessor link='arm'/><successor link='rotor'/><ratio "
      "value='-20'/></coupling>";
  const std::string annotation = "<codesign:actuator gear_ratio='-20' rotor_inertia='0.0002'/>";
  return robot(heavy("base", annotated ? sum_of(body_mass(), rotor_mass()) : body_mass()) +
               bar("arm") +
               "<joint name='free' type='floating'><parent link='ground'/><child "
               "link='base'/></joint><joint name='drive' type='" +
               type +
               "'><parent link='base'/><child link='arm'/><origin xyz='0.2 0.1 0.3' rpy='0 0 "
               "0'/><axis xyz='" +
               text_of(kAxis) + "'/><limit lower='-9' upper='9' effort='9' velocity='9'/>" +
               (annotated ? annotation : "") + "</joint>" + (annotated ? "" : explicit_rotor));
}

const char* const kFlight =
    "duration: 1.0\nobjective: {integral: [{signal: drive/position}]}\nloads: [{joint: drive, "
    "effort: 0.7}]\n"
    "initial_state: {drive: {position: 0.3, velocity: 2.0}, free: {rotation: [0.4, -0.3, 1.2], "
    "linear_velocity: [0.5, 0, -0.2], "
    "angular_velocity: [1.5, -2.0, 3.0]}}\n";

class ExplicitRotor : public ::testing::TestWithParam<const char*> {};

TEST_P(ExplicitRotor, GivesTheSameAccelerationsReactionsAndEnergy) {
  Compiled annotated(flyer(GetParam(), true), kFlight),
      explicitly(flyer(GetParam(), false), kFlight);
  ASSERT_TRUE(annotated.start().ok());
  ASSERT_TRUE(explicitly.start().ok());
  const auto signal = [](Compiled* c, const std::string& text) {
    return c->equations.formulas().signal(
        resolve_signal(parse_signal(text, {}, "test"), c->system.robot(), c->system.topology(), {}),
        c->state);
  };
  const double acceleration = signal(&annotated, "drive/acceleration");
  EXPECT_GT(std::abs(acceleration), 0.1);
  EXPECT_NEAR(acceleration, signal(&explicitly, "drive/acceleration"),
              1e-10 * std::abs(acceleration));
  for (const char* text :
       {"mechanism/kinetic_energy", "mechanism/potential_energy", "mechanism/load_power"})
    EXPECT_NEAR(signal(&annotated, text), signal(&explicitly, text),
                1e-11 * (1.0 + std::abs(signal(&annotated, text))))
        << text;
  // The arm is body 1 in both; the base's centre of mass differs, but not its turning.
  const auto part = [](const Compiled& c, Eigen::Index first, Eigen::Index size) {
    return Eigen::VectorXd(c.state.z.segment(first, size));
  };
  EXPECT_LT((part(annotated, 3, 4) - part(explicitly, 3, 4)).norm(),
            1e-10 * part(annotated, 3, 4).norm());
  EXPECT_LT((part(annotated, 7, 7) - part(explicitly, 7, 7)).norm(),
            1e-10 * part(annotated, 7, 7).norm());
}

INSTANTIATE_TEST_SUITE_P(AllJoints, ExplicitRotor, ::testing::Values("revolute", "prismatic"));

// Two flat bodies that turn about z, and a rotor: (I1 + I2) w' + (I2 + n J) th'' = 0, (I2 + n J) w'
// + (I2 + n^2 J) th'' = tau.
TEST(Rotor, OfAGyrostatByHand) {
  const std::string disc =
      "<inertial><mass value='1'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' "
      "izz='0.2'/></inertial>";
  Compiled c(robot("<link name='base'>" + disc + "</link><link name='wheel'>" + disc +
                   "</link><joint name='free' type='floating'><parent link='ground'/><child "
                   "link='base'/></joint>"
                   "<joint name='drive' type='continuous'><parent link='base'/><child "
                   "link='wheel'/><axis xyz='0 0 1'/>"
                   "<codesign:actuator gear_ratio='5' rotor_inertia='0.004'/></joint>"),
             "duration: 1.0\nloads: [{joint: drive, effort: 0.3}]\ngravity: [0, 0, 0]\n");
  ASSERT_TRUE(c.start().ok());
  Eigen::Matrix2d M;
  M << 0.4, 0.2 + 5.0 * 0.004, 0.2 + 5.0 * 0.004, 0.2 + 25.0 * 0.004;
  const Eigen::Vector2d expected = solve_positive_definite(M, Eigen::Vector2d(0.0, 0.3));
  EXPECT_NEAR(2.0 * c.state.z[6], expected[0], 1e-14);
  EXPECT_NEAR(2.0 * c.state.z[13], expected[0] + expected[1], 1e-14);
}

TEST(Rotor, WithoutInertiaChangesNothing) {
  Compiled plain(double_pendulum(), let_go("{shoulder: {position: 1.0}}", "elbow/velocity"));
  Compiled with(double_pendulum("<codesign:actuator gear_ratio='100' rotor_inertia='0'/>"),
                let_go("{shoulder: {position: 1.0}}", "elbow/velocity"));
  ASSERT_TRUE(plain.start().ok() && with.start().ok());
  EXPECT_TRUE(with.system.rotors().empty());
  EXPECT_EQ(plain.state.z, with.state.z);
}

TEST(Rotor, NeedsACarrierWithMass) {
  const std::string actuator = "<codesign:actuator rotor_inertia='0.1'/>";
  std::string chain = joint_cases::chain({{'R', "1 0 0"}, {'R', "0.3 1 0"}});
  chain.insert(chain.rfind("</joint>"), actuator);
  try {
    EquationsFixture e(joint_cases::model({"", chain}), "duration: 1.0\n");
    ADD_FAILURE() << "a rotor on a link without mass";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("carries the rotor"), std::string::npos)
        << error.what();
    EXPECT_EQ(error.fault().value, "frame0");
  }
}

}  // namespace

}  // namespace codesign
