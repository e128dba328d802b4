// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/body_check.h"

#include <map>

#include "math/dense.h"
#include "mechanism/default_values.h"
#include "mechanism/rigid_groups.h"
#include "text/decimal.h"
#include "text/number_text.h"

namespace codesign {
namespace {

const LinkDescription& link_of(const RobotDescription& robot, int link) { return robot.links[static_cast<std::size_t>(link)]; }

/// The names of the links with an inertial, separated by commas.
std::string names_of(const RobotDescription& robot, const std::vector<int>& links) {
  std::string names;
  for (int link : links)
    if (link_of(robot, link).inertial) names += (names.empty() ? "" : ", ") + link_of(robot, link).name;
  return names;
}

/// A fault at the inertial of the base link or, if it has none, of the first link that has one.
InputFault fault_at(const RobotDescription& robot, int base, const std::vector<int>& links) {
  int link = base;
  for (int other : links)
    if (!link_of(robot, link).inertial) link = other;
  InputFault fault;
  fault.where = link_of(robot, link).inertial->where;
  fault.element = "<link name=\"" + link_of(robot, link).name + "\"> <inertial>";
  return fault;
}

void check_cancelled_mass(const RobotDescription& robot, const MassProperties<double>& body, int base, const std::vector<int>& links,
                          const std::vector<double>& values) {
  double sum = 0.0;
  for (int link : links)
    if (link_of(robot, link).inertial) sum += std::abs(mass_properties(*link_of(robot, link).inertial, values).mass);
  if (std::abs(body.mass) > 1e-12 * sum || sum == 0.0) return;
  InputFault fault = fault_at(robot, base, links);
  fault.message = "the masses of links that are fixed to each other cancel, so that the body has no centre of mass";
  fault.value = names_of(robot, links);
  fault.allowed = "a sum that is not zero";
  throw InputError(fault);
}

}  // namespace

MassFault find_mass_fault(const MassProperties<double>& body) {
  constexpr double kRounding = 1e-9, kTriangle = 1e-6;
  if (body.mass < 0.0) return {"negative_mass", "the mass is negative", to_decimal(body.mass)};
  const Vector3<double> moments = principal_moments(body.inertia);
  const auto text = [&moments] { return "principal moments " + format_numbers({moments[0], moments[1], moments[2]}); };
  // Moments below the moment of a radius of gyration of one micrometre (1e-12 m^2 times the mass) come from rounding in the file.
  const double rounding = kRounding * std::max(std::abs(moments[0]), std::abs(moments[2])) + 1e-12 * body.mass;
  if (moments[0] < -rounding) return {"inertia_not_positive", "the inertia has a negative principal moment", text()};
  if (moments[2] > (moments[0] + moments[1]) * (1.0 + kTriangle) + rounding)
    return {"triangle_inequality", "the inertia breaks the triangle inequality", text() + ", the largest at most the sum of the others"};
  return {};
}

void check_bodies(const RobotDescription& robot, Warnings* warnings) {
  const RigidGroups groups(robot);
  const std::vector<double> values = default_values(robot);
  std::map<int, std::vector<int>> bodies;
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    if (groups.link_base[link] != groups.link_base[static_cast<std::size_t>(robot.root)])
      bodies[groups.link_base[link]].push_back(static_cast<int>(link));
  MassWorkspace<double> workspace;
  workspace.poses.start(robot.links.size());
  for (const auto& [base, links] : bodies) {
    const std::string names = names_of(robot, links);
    if (names.empty()) continue;
    const MassProperties<double> body = merged_mass(robot, groups.link_base, groups.link_parent_joint, links, values, &workspace);
    check_cancelled_mass(robot, body, base, links, values);
    const MassFault fault = find_mass_fault(body);
    if (fault.code.empty()) continue;
    InputFault place = fault_at(robot, base, links);
    place.message = fault.message + "; it is used as it is written. Correct the numbers of the body's links to silence this";
    place.value = fault.value + "; links: " + names;
    warnings->push_back(warn(fault.code, place));
  }
}

}  // namespace codesign
