// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(AnnotationSchema, UnknownAttributeNamesTheNearest) {
  expect_error(pendulum("\n<origin xyz=\"0 0 0.2\" codesign:xzy=\"0 0 ${length}\"/>"),
               {"test.urdf:3: <joint name=\"hinge\"> <origin>: ", "did you mean \"codesign:xyz\"?",
                "value: codesign:xzy"});
  expect_error(pendulum("<codesign:friction mu_static=\"0.4\" mu_dynamic=\"0.3\" presure=\"1\"/>"),
               {"unknown attribute presure"});
}

TEST(AnnotationSchema, UnknownElementNamesTheNearest) {
  expect_error(pendulum("\n\n<codesign:fricton mu_static=\"0.4\"/>"),
               {"test.urdf:4:", "<codesign:fricton>", "did you mean \"codesign:friction\"?"});
  expect_error(robot_text("<codesign:paramter name=\"x\" value=\"1\"/><link name=\"a\"/>"),
               {"did you mean \"codesign:parameter\"?"});
}

TEST(AnnotationSchema, KnownNamesInTheWrongPlaceAreRefused) {
  expect_error(
      robot_text("<link name=\"a\"><codesign:friction mu_static=\"1\" mu_dynamic=\"1\"/></link>"),
      {"the element does not belong here", "allowed: in <joint>, <loop>"});
  expect_error(robot_text("<link name=\"a\" codesign:density=\"1\"/>"),
               {"misplaced attribute codesign:density"});
  expect_error(
      robot_text("<link name=\"a\"/><gazebo><codesign:parameter name=\"x\" value=\"1\"/></gazebo>"),
      {"does not belong here"});
  expect_error(robot_text("<link name=\"a\"/><gazebo codesign:xyz=\"1\"/>"),
               {"misplaced attribute codesign:xyz"});
}

TEST(AnnotationSchema, LoopsAndCouplingsAreStrictInside) {
  const auto loop = [](const std::string& inside) {
    return robot_text("<link name=\"a\"/>\n<loop name=\"l\" type=\"fixed\">" + inside + "</loop>");
  };
  expect_error(loop("<predecesor link=\"a\"/>"),
               {"test.urdf:3:", "unknown element <predecesor>, did you mean \"predecessor\"?"});
  expect_error(loop("<predecessor link=\"a\"><orign/></predecessor>"),
               {"did you mean \"origin\"?"});
  expect_error(loop("<predecessor lnk=\"a\"/>"), {"unknown attribute lnk", "allowed: link"});
  expect_error(loop("<axis xyz=\"1 0 0\" frame=\"a\"/>"), {"unknown attribute frame"});
  expect_error(robot_text("<link name=\"a\"/><coupling name=\"c\"><raio value=\"1\"/></coupling>"),
               {"did you mean \"ratio\"?"});
}

TEST(AnnotationSchema, ATwinNeedsItsPlainAttribute) {
  expect_error(pendulum("<origin codesign:xyz=\"0 0 ${length}\"/>"),
               {"the twin codesign:xyz lacks its plain attribute xyz"});
}

TEST(AnnotationSchema, WhatIsNotSimulatedTakesNoTwin) {
  expect_error(pendulum("<safety_controller k_velocity=\"1\" codesign:k_velocity=\"${length}\"/>"),
               {"k_velocity cannot depend on parameters"});
  expect_error(pendulum("<limit effort=\"1\" velocity=\"1\" codesign:efort=\"1\"/>"),
               {"did you mean \"codesign:effort\"?"});
}

TEST(AnnotationSchema, ThePrefixMustBeDeclared) {
  expect_error(
      {"a.urdf",
       "<robot name=\"x\">\n<link name=\"a\"/>\n<codesign:parameter name=\"p\" "
       "value=\"1\"/></robot>"},
      {"a.urdf:3: <robot>: the prefix codesign is not declared", "value: codesign:parameter"});
  expect_error(
      {"a.urdf",
       "<robot name=\"x\"><link name=\"a\"><inertial\n codesign:from=\"visual\"/></link></robot>"},
      {"a.urdf:2:", "not declared"});
}

TEST(AnnotationSchema, OthersArePassedOver) {
  EXPECT_NO_THROW(read_urdf(
      robot_text("<link name=\"a\" my:note=\"x\"><my:thing a=\"1\"/></link><gazebo "
                 "reference=\"a\"><kp>1</kp></gazebo>"
                 "<transmission name=\"t\"><type>any</type><joint "
                 "name=\"j\"><hardwareInterface>x</hardwareInterface></joint></transmission>"
                 "<my:tag xmlns:my=\"urn:my\"/><unknown_plain/>")));
  EXPECT_NO_THROW(read_urdf({"plain.urdf", "<robot name=\"x\"><link name=\"a\"/></robot>"}));
}

}  // namespace
}  // namespace codesign
