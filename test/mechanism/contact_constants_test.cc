// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/contact_constants.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/playing.h"
#include "integration/touching.h"
#include "mechanism/constants.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

struct Evaluated {
  RobotDescription robot;
  Topology topology;
  Constants<double> constants;

  explicit Evaluated(const std::string& contact, const std::vector<double>& parameters = {})
      : robot(read_urdf({"test.urdf", free_ball("", contact)})),
        topology(derive_topology(robot)),
        constants(evaluate_constants(robot, topology,
                                     parameters.empty() ? default_values(robot) : parameters)) {}
  std::string fault() const { return find_impossible(robot, topology, constants); }
};

std::string round_contact(const std::string& ground, const std::string& ball,
                          const std::string& more = "") {
  return "<codesign:contact name='touch' " + more + "><predecessor link='ground' " + ground +
         "/><successor link='ball' shape='sphere' radius='0.05' codesign:radius='${radius}' " +
         ball + "/></codesign:contact>";
}

// 4/3 E sqrt(R) with 1/E the sum of (1 - nu^2)/E_k and 1/R the sum of the curvatures.
TEST(ContactConstants, HertzByHand) {
  const double steel = 2e11 / (1.0 - 0.09), rubber = 1e7 / (1.0 - 0.25),
               both = steel * rubber / (steel + rubber);
  const auto stiffness = [](const Evaluated& of) {
    return of.constants.contacts[0].force.stiffness;
  };
  const std::string of_steel = "youngs_modulus='2e11'",
                    of_rubber = "youngs_modulus='1e7' poisson_ratio='0.5'";
  const auto expect = [&](const Evaluated& of, double modulus, double radius) {
    EXPECT_NEAR(stiffness(of) / (4.0 / 3.0 * modulus * std::sqrt(radius)), 1.0, 1e-14);
  };
  expect(Evaluated(round_contact("shape='plane'", of_steel)), steel, 0.05);
  expect(Evaluated(round_contact("shape='plane' " + of_rubber, of_steel)), both, 0.05);
  expect(Evaluated(round_contact("shape='sphere' radius='0.2'", of_rubber)), rubber, 0.04);
  expect(Evaluated(round_contact("shape='socket' radius='0.2'", of_steel)), steel, 1.0 / 15.0);
  expect(Evaluated(round_contact("shape='plane'", of_steel), {0.02, 0.3, 0.05}), steel, 0.02);
}

// The bearing of 10 mm of Flores, Ambrosio, Claro and Lankarani (2007), whose K is 6.61e10 N/m^1.5.
TEST(ContactConstants, HertzOfAJournalIsThePublishedNumber) {
  const RobotDescription robot = read_urdf(
      {"test.urdf", playing_slider_crank("",
                                         "<codesign:clearance radial='5e-4' radius='0.0095' "
                                         "youngs_modulus='2.07e11' poisson_ratio='0.3'/>")});
  const Topology topology = derive_topology(robot);
  const Constants<double> constants = evaluate_constants(robot, topology, default_values(robot));
  EXPECT_NEAR(constants.contacts.at(0).force.stiffness, 6.61e10, 0.005e10);
  EXPECT_EQ(constants.contacts[0].surface.shape.radius, 0.01);
}

TEST(ContactConstants, SidesAndLosses) {
  const Evaluated of(
      "<codesign:contact name='touch' stiffness='1e6' restitution='0.8' impact_velocity='2'>"
      "<predecessor link='ball' shape='sphere' radius='0.05'><origin xyz='0.1 0 0'/></predecessor>"
      "<successor link='ground' shape='plane'><origin xyz='0 0 1' rpy='0 1.5707963267948966 0'/>"
      "</successor></codesign:contact>");
  const ContactConstants<double>& c = of.constants.contacts[0];
  EXPECT_EQ(c.surface.body, -1) << "the plane, although it is the successor";
  EXPECT_EQ(c.points.body, 0);
  EXPECT_EQ(c.points.shape.radius, 0.05);
  EXPECT_LT((c.points.frame.s - Vector3<double>(0.1, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((c.surface.frame.R.col(2) - Vector3<double>(1.0, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(c.force.loss, 1.5 * 0.2 / 2.0, 1e-15) << "Hunt and Crossley";
  EXPECT_EQ(c.force.exponent, 1.5);
  EXPECT_NEAR(c.force.onset, 5e-12, 1e-24);
}

TEST(ContactConstants, DesignsThatAreImpossibleHaveASentence) {
  const std::string contact = touching_ground("shape='plane'", kLossy, kSlippery);
  EXPECT_EQ(Evaluated(contact).fault(), "");
  EXPECT_EQ(Evaluated(contact, {0.0, 0.3, 0.05}).fault(), "radius of contact 'touch' is 0");
  EXPECT_EQ(Evaluated(contact, {0.05, -1.0, 0.05}).fault(), "dissipation of contact 'touch' is -1");
  EXPECT_NE(Evaluated(contact, {0.05, 0.3, -0.1}).fault().find("friction coefficients of contact"),
            std::string::npos);
}

TEST(ContactConstants, AClearanceOfZeroNamesTheAttributeOfTheJoint) {
  const auto fault = [](const std::string& radial, const std::string& axial) {
    const std::string play = "<codesign:clearance radial='1e-4' codesign:radial='" + radial +
                             "' axial='1e-4' codesign:axial='" + axial +
                             "' radius='0.01' stiffness='1e8'/>";
    const RobotDescription robot = read_urdf(robot_text(
        std::string("<codesign:parameter name='c' value='1e-4'/>") + kGround + link_with("arm") +
        joint_with("pin", "continuous", "ground", "arm", "<axis xyz='0 1 0'/>" + play)));
    const Topology topology = derive_topology(robot);
    std::vector<double> parameters = default_values(robot);
    EXPECT_EQ(
        find_impossible(robot, topology, evaluate_constants<double>(robot, topology, parameters)),
        "");
    parameters.back() = 0.0;
    return find_impossible(robot, topology,
                           evaluate_constants<double>(robot, topology, parameters));
  };
  const std::string of = " of <joint name=\"pin\"> <codesign:clearance> is 0 (allowed: > 0)";
  EXPECT_EQ(fault("${c}", "1e-4"), "radial" + of);
  EXPECT_EQ(fault("1e-4", "${c}"), "axial" + of);
}

}  // namespace
}  // namespace codesign
