// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/robots.h"

#include <algorithm>

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kQuarter = 1.5707963;  // as far as files of robots write it
constexpr bool kTurns = false, kSlides = true;

using Links = std::vector<RobotLink>;

/// Adds a limb whose first link hangs on `parent`. Other parents in it count from its own first
/// link.
void add_limb(const Links& limb, int parent, Links* links) {
  const int first = static_cast<int>(links->size());
  for (RobotLink link : limb) {
    link.parent = link.parent < 0 ? parent : link.parent + first;
    links->push_back(link);
  }
}

/// Adds a left limb and its mirror image on the right: turns about x and z change their sign with
/// y.
void add_both_limbs(const Links& left, int parent, Links* links) {
  Links right = left, named = left;
  for (RobotLink& link : named) link.name = "left_" + link.name;
  for (RobotLink& link : right) {
    link.name = "right_" + link.name;
    link.origin[1] = -link.origin[1];
    link.centre[1] = -link.centre[1];
    if (link.axis != 'y') link.position = -link.position;
  }
  add_limb(named, parent, links);
  add_limb(right, parent, links);
}

// Of humanoids, whose joint frames are parallel to the base at position 0: x ahead, y to the left,
// z up.
RobotLink part(const char* name, int parent, char axis, std::array<double, 3> origin, double mass,
               std::array<double, 3> centre, std::array<double, 3> box, double damping,
               double position, double friction = 0.0) {
  return {name, parent, axis, kTurns,  origin,   {0.0, 0.0, 0.0},
          mass, centre, box,  damping, friction, position};
}

/// A leg of six joints. @param size factor of lengths, @param mass of masses, @param friction dry
/// friction of a hip.
Links leg(double size, double mass, double friction) {
  const double s = size, m = mass, f = friction;
  return {part("hip_yaw", -1, 'z', {0, 0.09 * s, -0.05 * s}, 2.4 * m, {0.02, 0.01, -0.03},
               {0.12, 0.1, 0.1}, 0.6, 0.1, f),
          part("hip_roll", 0, 'x', {0, 0, -0.02 * s}, 1.4 * m, {0.03, 0.01, 0.0}, {0.1, 0.08, 0.12},
               3.0, 0.1, 2.0 * f),
          part("hip_pitch", 1, 'y', {0.05 * s, 0, -0.05 * s}, 8.0 * m, {0.0, 0.02, -0.17 * s},
               {0.14, 0.13, 0.4 * s}, 4.0, -0.6, 2.0 * f),
          part("knee", 2, 'y', {-0.05 * s, 0, -0.38 * s}, 4.6 * m, {0.0, 0.01, -0.18 * s},
               {0.1, 0.09, 0.4 * s}, 1.5, 1.1, f),
          part("ankle_pitch", 3, 'y', {0, 0, -0.4 * s}, 0.9 * m, {0.0, 0.0, -0.01},
               {0.08, 0.06, 0.07}, 0.15, -0.5, 0.5 * f),
          part("ankle_roll", 4, 'x', {0, 0, -0.02 * s}, 2.3 * m, {0.03, 0.0, -0.05},
               {0.26, 0.12, 0.05}, 0.06, -0.1, 0.3 * f)};
}

/// An arm of seven joints that hangs from the shoulder. The factors are those of leg().
Links arm(double size, double mass, double friction) {
  const double s = size, m = mass, f = friction;
  return {part("shoulder_pitch", -1, 'y', {0.02, 0.2 * s, 0.4 * s}, 2.6 * m, {0.0, 0.03, 0.01},
               {0.11, 0.12, 0.11}, 1.5, 0.3, f),
          part("shoulder_roll", 0, 'x', {0, 0.1 * s, 0}, 2.9 * m, {0.0, 0.01, -0.08 * s},
               {0.1, 0.1, 0.2 * s}, 1.2, 0.4, f),
          part("shoulder_yaw", 1, 'z', {0, 0.02 * s, -0.15 * s}, 1.9 * m, {0.01, 0.0, -0.07 * s},
               {0.08, 0.08, 0.18 * s}, 0.3, 0.2, 0.5 * f),
          part("elbow", 2, 'y', {0.02, 0, -0.14 * s}, 1.7 * m, {-0.01, 0.0, -0.06 * s},
               {0.08, 0.07, 0.16 * s}, 0.4, -1.2, 0.5 * f),
          part("forearm_yaw", 3, 'z', {-0.02, 0, -0.14 * s}, 1.6 * m, {0.0, 0.0, -0.06 * s},
               {0.07, 0.06, 0.14 * s}, 0.04, 0.3, 0.2 * f),
          part("wrist_roll", 4, 'x', {0, 0, -0.12 * s}, 0.4 * m, {0.0, 0.0, -0.01},
               {0.05, 0.05, 0.05}, 0.05, 0.2, 0.1 * f),
          part("wrist_pitch", 5, 'y', {0, 0, -0.02 * s}, 0.8 * m, {0.01, 0.01, -0.06},
               {0.08, 0.04, 0.14}, 0.04, 0.3, 0.1 * f)};
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }
std::string quoted(double value) { return quoted(to_decimal(value)); }
std::string quoted(const std::array<double, 3>& x) {
  return quoted(to_decimal(x[0]) + " " + to_decimal(x[1]) + " " + to_decimal(x[2]));
}

std::string link_text(const RobotLink& link) {
  const std::array<double, 3> I = inertia(link);
  return "<link name=" + quoted(link.name) + "><inertial><origin xyz=" + quoted(link.centre) +
         "/><mass value=" + quoted(link.mass) + "/><inertia ixx=" + quoted(I[0]) +
         " ixy=\"0\" ixz=\"0\" iyy=" + quoted(I[1]) + " iyz=\"0\" izz=" + quoted(I[2]) +
         "/></inertial></link>\n";
}

std::string joint_text(const RobotLink& link, const std::string& parent) {
  const char* const axis = link.axis == 'x' ? "1 0 0" : link.axis == 'y' ? "0 1 0" : "0 0 1";
  const std::string limit =
      link.slides ? "<limit lower=\"-9\" upper=\"9\" effort=\"100\" velocity=\"9\"/>" : "";
  return "<joint name=" + quoted(link.name + "_joint") +
         " type=" + quoted(link.slides ? "prismatic" : "continuous") +
         "><parent link=" + quoted(parent) + "/><child link=" + quoted(link.name) +
         "/><origin xyz=" + quoted(link.origin) + " rpy=" + quoted(link.rpy) +
         "/><axis xyz=" + quoted(axis) + "/>" + limit +
         "<dynamics damping=" + quoted(link.damping) + " friction=" + quoted(link.friction) +
         "/></joint>\n";
}

}  // namespace

std::array<double, 3> inertia(const RobotLink& link) {
  const auto [x, y, z] = link.box;
  const double m = link.mass / 12.0;
  return {m * (y * y + z * z), m * (x * x + z * z), m * (x * x + y * y)};
}

bool Robot::is_stiff() const {
  return std::any_of(links.begin(), links.end(),
                     [](const RobotLink& link) { return link.friction > 0.0; });
}

Robot ur5() {
  const double q = kQuarter;
  return {"UR5",
          5.0,
          1e-7,
          {{"shoulder",
            -1,
            'z',
            kTurns,
            {0, 0, 0.09},
            {},
            3.7,
            {0, 0, -0.02},
            {0.12, 0.12, 0.14},
            0.5,
            0,
            0.3},
           {"upper_arm",
            0,
            'y',
            kTurns,
            {0, 0.135, 0},
            {0, q, 0},
            8.4,
            {0, 0, 0.28},
            {0.12, 0.12, 0.5},
            2.0,
            0,
            -0.9},
           {"forearm",
            1,
            'y',
            kTurns,
            {0, -0.12, 0.425},
            {},
            2.3,
            {0, 0, 0.19},
            {0.09, 0.09, 0.4},
            0.6,
            0,
            1.2},
           {"wrist_1",
            2,
            'y',
            kTurns,
            {0, 0, 0.39},
            {0, q, 0},
            1.2,
            {0, 0.09, 0},
            {0.09, 0.1, 0.09},
            0.05,
            0,
            -0.6},
           {"wrist_2",
            3,
            'z',
            kTurns,
            {0, 0.09, 0},
            {},
            1.2,
            {0, 0, 0.09},
            {0.09, 0.09, 0.1},
            0.03,
            0,
            0.8},
           {"wrist_3",
            4,
            'y',
            kTurns,
            {0, 0, 0.095},
            {},
            0.2,
            {0, 0.06, 0},
            {0.08, 0.04, 0.08},
            0.002,
            0,
            0.2}}};
}

Robot panda() {
  const double q = kQuarter;
  return {"Panda",
          2.0,
          1e-6,
          {{"link1",
            -1,
            'z',
            kTurns,
            {0, 0, 0.33},
            {},
            2.8,
            {0, -0.03, -0.07},
            {0.11, 0.12, 0.25},
            0.4,
            0,
            0.2},
           {"link2",
            0,
            'z',
            kTurns,
            {},
            {-q, 0, 0},
            2.6,
            {0, -0.07, 0.03},
            {0.11, 0.25, 0.12},
            1.5,
            0,
            0.5},
           {"link3",
            1,
            'z',
            kTurns,
            {0, -0.316, 0},
            {q, 0, 0},
            2.4,
            {0.04, 0.02, -0.04},
            {0.13, 0.12, 0.2},
            0.2,
            0,
            -0.3},
           {"link4",
            2,
            'z',
            kTurns,
            {0.08, 0, 0},
            {q, 0, 0},
            2.4,
            {-0.04, 0.04, 0.03},
            {0.13, 0.2, 0.12},
            0.5,
            0,
            -1.6},
           {"link5",
            3,
            'z',
            kTurns,
            {-0.08, 0.384, 0},
            {-q, 0, 0},
            2.9,
            {0, 0.03, -0.1},
            {0.1, 0.12, 0.3},
            0.05,
            0,
            0.4},
           {"link6",
            4,
            'z',
            kTurns,
            {},
            {q, 0, 0},
            1.5,
            {0.05, -0.01, -0.01},
            {0.13, 0.09, 0.1},
            0.06,
            0,
            1.3},
           {"link7",
            5,
            'z',
            kTurns,
            {0.09, 0, 0},
            {q, 0, 0},
            1.3,
            {0.01, 0.01, 0.13},
            {0.1, 0.18, 0.12},
            0.03,
            0,
            0.7},
           {"finger1",
            6,
            'y',
            kSlides,
            {0, 0, 0.165},
            {0, 0, -0.785398},
            0.015,
            {0, 0.015, 0.02},
            {0.02, 0.02, 0.05},
            0.15,
            0,
            0.02},
           {"finger2",
            6,
            'y',
            kSlides,
            {0, 0, 0.165},
            {0, 0, 2.356194},
            0.015,
            {0, 0.015, 0.02},
            {0.02, 0.02, 0.05},
            0.15,
            0,
            0.03}}};
}

Robot atlas() {
  Links links = {
      part("lower_torso", -1, 'z', {-0.01, 0, 0.16}, 2.3, {-0.01, 0, 0.05}, {0.12, 0.16, 0.08}, 2.0,
           0.2),
      part("middle_torso", 0, 'y', {0, 0, 0.06}, 0.7, {0, 0, 0.02}, {0.1, 0.14, 0.08}, 6.0, 0.3),
      part("upper_torso", 1, 'x', {0, 0, 0.05}, 50.0, {-0.06, 0, 0.25}, {0.4, 0.45, 0.5}, 6.0, 0.1),
      part("head", 2, 'y', {0.15, 0, 0.6}, 4.5, {-0.05, 0, 0.04}, {0.2, 0.2, 0.2}, 0.2, 0.3)};
  add_both_limbs(arm(1.15, 1.6, 0.0), 2, &links);
  add_both_limbs(leg(1.05, 1.2, 0.0), -1, &links);
  return {"Atlas", 2.0, 1e-6, links};
}

Robot valkyrie() {
  Links links = {
      part("torso_yaw", -1, 'z', {0, 0, 0.09}, 0.5, {0, 0, 0.01}, {0.12, 0.12, 0.06}, 1.5, 0.1),
      part("torso_pitch", 0, 'y', {0.01, 0, 0.03}, 0.6, {0, 0, 0.02}, {0.1, 0.12, 0.08}, 5.0, 0.2),
      part("torso", 1, 'x', {0, 0, 0.05}, 38.0, {-0.05, 0, 0.2}, {0.32, 0.4, 0.45}, 5.0, 0.1),
      part("lower_neck", 2, 'y', {0.02, 0, 0.4}, 1.1, {-0.01, 0, 0.04}, {0.07, 0.07, 0.1}, 0.3,
           0.2),
      part("neck_yaw", 3, 'z', {-0.04, 0, 0.1}, 0.6, {0, 0, 0.02}, {0.07, 0.07, 0.06}, 0.06, 0.2),
      part("upper_neck", 4, 'y', {0, 0, 0.05}, 4.0, {0.06, 0, 0.04}, {0.18, 0.16, 0.18}, 0.2,
           -0.2)};
  add_both_limbs(arm(1.0, 1.1, 0.0), 2, &links);
  add_both_limbs(leg(1.0, 1.1, 0.0), -1, &links);
  return {"Valkyrie", 1.0, 1e-6, links};
}

Robot talos() {
  Links links = {
      part("torso_1", -1, 'z', {0, 0, 0.07}, 2.1, {0, 0, 0.03}, {0.14, 0.16, 0.08}, 1.0, 0.1, 8.0),
      part("torso_2", 0, 'y', {0, 0, 0.03}, 17.0, {-0.04, 0, 0.2}, {0.28, 0.36, 0.42}, 1.0, 0.2,
           12.0),
      part("head_1", 1, 'y', {0.02, 0, 0.32}, 0.8, {0, 0, 0.02}, {0.09, 0.1, 0.1}, 0.5, 0.1, 1.5),
      part("head_2", 2, 'z', {0, 0, 0.02}, 1.4, {0.02, 0, 0.1}, {0.14, 0.15, 0.14}, 0.1, 0.2, 1.0)};
  Links gripping = arm(0.95, 1.0, 6.0);
  gripping.push_back(part("gripper", 6, 'x', {0, 0, -0.12}, 0.3, {0, 0.02, -0.04},
                          {0.06, 0.03, 0.08}, 0.02, -0.2, 0.2));
  add_both_limbs(gripping, 1, &links);
  add_both_limbs(leg(0.97, 0.9, 6.0), -1, &links);
  return {"Talos, dry friction", 0.5, 1e-6, links};
}

std::vector<Robot> all_robots() { return {ur5(), panda(), atlas(), valkyrie(), talos()}; }

GeneratedCase robot_case(const Robot& robot, const std::string& solver) {
  std::string text = "<robot name=\"robot\">\n<link name=\"base\"/>\n", start;
  for (const RobotLink& link : robot.links) {
    text +=
        link_text(link) +
        joint_text(link, link.parent < 0 ? "base"
                                         : robot.links[static_cast<std::size_t>(link.parent)].name);
    start += (start.empty() ? "" : ", ") + link.name +
             "_joint: {position: " + to_decimal(link.position) + "}";
  }
  return {{"robot.urdf", text + "</robot>\n"},
          {"robot.yaml", "duration: " + to_decimal(robot.duration) + "\ninitial_state: {" + start +
                             "}\nsolver: {" + solver + "}\n"}};
}

}  // namespace codesign
