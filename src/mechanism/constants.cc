// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/constants.h"

#include <cmath>
#include <map>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "mechanism/mass_properties.h"
#include "mechanism/pair_geometry.h"
#include "mechanism/pose.h"
#include "mechanism/rigid_groups.h"
#include "text/number_text.h"

namespace codesign {
namespace {

template <class T>
BodyConstants<T> body_constants(const RobotDescription& robot, const Topology& topology,
                                const Body& body, const std::vector<T>& parameters,
                                MassWorkspace<T>* workspace) {
  const MassProperties<T> m = merged_mass(robot, topology.link_base, topology.link_parent_joint,
                                          body.links, parameters, workspace);
  return {m.mass, m.inertia, m.centre};
}

template <class T>
Vector3<T> centre_of(const Constants<T>& constants, int body) {
  return body < 0 ? Vector3<T>(Vector3<T>::Zero()) : constants.bodies[to_index(body)].centre;
}

template <class T>
void set_coupling(const Coupling& coupling, const std::vector<T>& parameters,
                  CouplingConstants<T>* constants) {
  constants->coefficients.clear();
  for (const CouplingTerm& term : coupling.terms)
    constants->coefficients.push_back(T(term.sign) * term.factor.at(parameters));
  constants->offset = coupling.offset.at(parameters);
}

/// Sets Constants::links and Constants::joint_frames; the bodies' centres must be set before.
template <class T>
void set_frames(const RobotDescription& robot, const Topology& topology,
                const std::vector<T>& parameters, LinkPoses<T>* poses, Constants<T>* constants) {
  constants->links.resize(robot.links.size());
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    if (topology.link_body[link] == Topology::kMassless) continue;
    const Pose<T>& X = poses->of(robot, topology.link_base, topology.link_parent_joint,
                                 static_cast<int>(link), parameters);
    constants->links[link] = {X.t - centre_of(*constants, topology.link_body[link]), X.R};
  }
  constants->joint_frames.clear();
  for (const JointDescription& joint : robot.joints) {
    LinkConstants<T>& frame = constants->joint_frames.emplace_back();
    if (topology.link_body[to_index(joint.child)] == Topology::kMassless) continue;
    const LinkConstants<T>& child = constants->links[to_index(joint.child)];
    frame = child;
    if (!joint.is_loop) continue;
    const Pose<T> X = pose_at(joint.child_origin, parameters);
    frame = {child.s + child.R * X.t, child.R * X.R};
  }
}

// Squares and quotients of other masses and inertias leave the range of numbers.
constexpr double kLeastMass = 1e-100, kLeastMoment = 1e-120;
constexpr const char *kMassRange = "from 1e-100 to 1e+100 kg, or zero",
                     *kMomentRange = "from 1e-120 to 1e+120 kg m^2, or zero";

/// A mass or a moment of inertia that is not zero, but beyond what can be computed with.
MassFault range_fault(const MassProperties<double>& body) {
  const auto is_beyond = [](double x, double least) {
    return x != 0.0 && !(std::abs(x) >= least && std::abs(x) <= 1.0 / least);
  };
  if (is_beyond(body.mass, kLeastMass))
    return {"mass_out_of_range", "the mass is out of the range that can be computed with",
            to_decimal(body.mass)};
  const double moment = principal_moments(body.inertia)[2];
  if (is_beyond(moment, kLeastMoment))
    return {"inertia_out_of_range", "the inertia is out of the range that can be computed with",
            to_decimal(moment)};
  return {};
}

MassFault body_fault(const BodyConstants<double>& body) {
  if (!std::isfinite(body.mass) || !body.centre.allFinite() || !body.J.allFinite())
    return {"not_finite", "mass or inertia is not finite", ""};
  if (MassFault fault = range_fault({body.mass, body.centre, body.J}); !fault.code.empty())
    return fault;
  return find_mass_fault({body.mass, body.centre, body.J});
}

/// The fault of body k in this design; empty if the body has the same fault at the default
/// parameters, of which check_bodies() warned.
std::string body_fault(const RobotDescription& robot, const Topology& topology, std::size_t k,
                       const Constants<double>& constants) {
  const MassFault fault = body_fault(constants.bodies[k]);
  if (fault.code.empty()) return "";
  MassWorkspace<double> workspace;
  workspace.poses.start(robot.links.size());
  const MassFault known = body_fault(
      body_constants(robot, topology, topology.bodies[k], default_values(robot), &workspace));
  if (known.code == fault.code) return "";
  return "body '" + topology.bodies[k].name + "': " + fault.message +
         (fault.value.empty() ? "" : " (" + fault.value + ")");
}

bool is_possible(const FrictionConstants<double>& f) {
  bool possible = f.mu_static >= f.mu_dynamic && f.mu_static_backward >= f.mu_dynamic_backward;
  const auto check = [&possible](const FrictionNumberRule& rule, const double& number) {
    // A radius that is not given is zero; check_friction_geometry() asks for it where the law needs
    // it.
    const bool may_be_zero =
        rule.zero_allowed ||
        (rule.missing == FrictionNumberRule::Missing::kStandard && rule.standard == 0.0) ||
        rule.missing == FrictionNumberRule::Missing::kPinRadius;
    possible = possible && (number > 0.0 || (may_be_zero && number == 0.0));
  };
  visit_friction_numbers(check, &f);
  return possible;
}

std::string friction_fault(const Pair& pair, const FrictionConstants<double>& f) {
  return is_possible(f) ? ""
                        : "friction geometry or coefficients of joint '" + pair.name +
                              "' are out of range (allowed: mu_static >= mu_dynamic >= 0, static "
                              ">= coulomb >= 0, pin_radius, preload and viscous >= 0, all others "
                              "> 0)";
}

bool is_possible(const GearConstants<double>& gear) {
  const double sum = gear.driving + gear.backdriving + gear.coulomb + gear.viscous;
  return gear.driving >= 0.0 && gear.backdriving >= 0.0 && gear.coulomb >= 0.0 &&
         gear.viscous >= 0.0 && std::isfinite(sum);
}

bool is_possible(const ElasticGearConstants<double>& elastic) {
  return elastic.stiffness > 0.0 && elastic.damping >= 0.0 &&
         (elastic.backlash > 0.0 || !elastic.plays) &&
         std::isfinite(elastic.stiffness + elastic.damping + elastic.backlash);
}

bool is_possible(const WindingConstants<double>& winding, bool has_state) {
  return winding.resistance > 0.0 && winding.torque_constant > 0.0 &&
         (winding.inductance > 0.0 || !has_state) &&
         (winding.bus_voltage > 0.0 || !winding.is_bounded) &&
         std::isfinite(winding.resistance + winding.torque_constant + winding.inductance +
                       winding.bus_voltage);
}

std::string joint_fault(const RobotDescription& robot, const Pair& pair,
                        const PairConstants<double>& constants) {
  for (std::size_t e = 0; e < pair.chain.size(); ++e) {
    const JointDescription& joint = robot.joints[to_index(pair.chain[e].joint)];
    const JointDynamicsConstants<double>& d = constants.dynamics[e];
    if (joint.limit && !(d.lower <= d.upper && d.effort >= 0.0))
      return "a limit of joint '" + joint.name +
             "' is out of range (allowed: lower <= upper, effort >= 0)";
    if (!(d.rotor_inertia >= 0.0) || !std::isfinite(d.rotor_inertia) ||
        !std::isfinite(d.gear_ratio))
      return "the rotor of joint '" + joint.name +
             "' is out of range (allowed: finite gear_ratio, finite rotor_inertia >= 0)";
    if (!(d.armature >= 0.0) || !std::isfinite(d.armature))
      return "the armature of joint '" + joint.name + "' is out of range (allowed: finite, >= 0)";
    if (joint.actuator && joint.actuator->gear &&
        !(is_possible(d.gear) && is_possible(d.gear.slip)))
      return "the gear of joint '" + joint.name +
             "' is out of range (allowed: efficiency > 0 and at most 1, backdrive_efficiency at "
             "most 1, coulomb and viscous >= 0, all others > 0)";
    // A motor that moves by itself has its speed by the gear ratio.
    if (joint.has_elastic_gear() &&
        !(is_possible(d.elastic) && d.rotor_inertia + d.armature > 0.0 && d.gear_ratio != 0.0))
      return "the elastic gear of joint '" + joint.name +
             "' is out of range (allowed: stiffness > 0, damping >= 0, backlash > 0, rotor_inertia "
             "or armature > 0, gear_ratio not 0)";
    if (joint.has_winding() && !is_possible(d.winding, joint.actuator->winding->has_state()))
      return "the winding of joint '" + joint.name +
             "' is out of range (allowed: resistance, torque_constant and bus_voltage > 0, "
             "inductance > 0, or 0 without a parameter)";
  }
  return "";
}

const LinkDescription& link_of(const RobotDescription& robot, int link) {
  return robot.links[to_index(link)];
}

/// The names of the links with an inertial, separated by commas.
std::string names_of(const RobotDescription& robot, const std::vector<int>& links) {
  std::string names;
  for (int link : links)
    if (link_of(robot, link).inertial)
      names += (names.empty() ? "" : ", ") + link_of(robot, link).name;
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

void check_cancelled_mass(const RobotDescription& robot, const MassProperties<double>& body,
                          int base, const std::vector<int>& links,
                          const std::vector<double>& values) {
  double sum = 0.0;
  for (int link : links)
    if (link_of(robot, link).inertial)
      sum += std::abs(mass_properties(*link_of(robot, link).inertial, values).mass);
  if (std::abs(body.mass) > 1e-12 * sum || sum == 0.0) return;
  InputFault fault = fault_at(robot, base, links);
  fault.message =
      "the masses of links that are fixed to each other cancel, so that the body has no centre of "
      "mass";
  fault.value = names_of(robot, links);
  fault.allowed = "a sum that is not zero";
  throw InputError(fault);
}

}  // namespace

template <class T>
void evaluate_constants(const RobotDescription& robot, const Topology& topology,
                        const std::vector<T>& parameters, MassWorkspace<T>* workspace,
                        Constants<T>* constants) {
  workspace->poses.start(robot.links.size());
  constants->bodies.clear();
  for (const Body& body : topology.bodies)
    constants->bodies.push_back(body_constants(robot, topology, body, parameters, workspace));
  set_frames(robot, topology, parameters, &workspace->poses, constants);
  constants->pairs.resize(topology.pairs.size());
  for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
    const Pair& pair = topology.pairs[k];
    pair_constants(robot, topology, pair, centre_of(*constants, pair.body_i),
                   centre_of(*constants, pair.body_j), parameters, &constants->pairs[k]);
  }
  for_each_link_element_list(robot, *constants, [&](const auto& elements, auto& numbers) {
    numbers.clear();
    for (const auto& element : elements)
      numbers.push_back(
          link_element_constants(robot, topology, element, constants->links, parameters));
  });
  constants->couplings.resize(topology.couplings.size());
  for (std::size_t k = 0; k < topology.couplings.size(); ++k)
    set_coupling(topology.couplings[k], parameters, &constants->couplings[k]);
}

std::string find_impossible(const RobotDescription& robot, const Topology& topology,
                            const Constants<double>& constants) {
  for (std::size_t k = 0; k < topology.bodies.size(); ++k)
    if (std::string fault = body_fault(robot, topology, k, constants); !fault.empty()) return fault;
  for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
    const PairConstants<double>& pair = constants.pairs[k];
    if (std::string fault = joint_fault(robot, topology.pairs[k], pair); !fault.empty())
      return fault;
    if (!pair.s_i.allFinite() || !pair.s_j.allFinite() || !pair.C_i.allFinite() ||
        !pair.C_j.allFinite())
      return "geometry of joint '" + topology.pairs[k].name + "' is not finite";
    if (topology.pairs[k].friction_joint < 0) continue;
    if (std::string fault = friction_fault(topology.pairs[k], pair.friction); !fault.empty())
      return fault;
  }
  std::string of_elements;
  for_each_link_element_list(robot, constants, [&](const auto& elements, const auto& numbers) {
    for (std::size_t k = 0; k < elements.size() && of_elements.empty(); ++k)
      of_elements = link_element_fault(elements[k], numbers[k]);
  });
  if (!of_elements.empty()) return of_elements;
  for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
    double sum = constants.couplings[k].offset;
    for (double coefficient : constants.couplings[k].coefficients) sum += coefficient;
    if (!std::isfinite(sum)) return topology.couplings[k].element() + " is not finite";
  }
  return "";
}

#define CODESIGN_INSTANTIATE(T)                                                 \
  template void evaluate_constants<T>(const RobotDescription&, const Topology&, \
                                      const std::vector<T>&, MassWorkspace<T>*, Constants<T>*);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

MassFault find_mass_fault(const MassProperties<double>& body) {
  constexpr double kRounding = 1e-9, kTriangle = 1e-6;
  if (body.mass < 0.0) return {"negative_mass", "the mass is negative", to_decimal(body.mass)};
  const Vector3<double> moments = principal_moments(body.inertia);
  const auto text = [&moments] {
    return "principal moments " + format_numbers({moments[0], moments[1], moments[2]});
  };
  // Moments below the moment of a radius of gyration of one micrometre (1e-12 m^2 times the mass)
  // come from rounding in the file.
  const double rounding =
      kRounding * std::max(std::abs(moments[0]), std::abs(moments[2])) + 1e-12 * body.mass;
  if (moments[0] < -rounding)
    return {"inertia_not_positive", "the inertia has a negative principal moment", text()};
  if (moments[2] > (moments[0] + moments[1]) * (1.0 + kTriangle) + rounding)
    return {"triangle_inequality", "the inertia breaks the triangle inequality",
            text() + ", the largest at most the sum of the others"};
  return {};
}

void check_bodies(const RobotDescription& robot, Warnings* warnings) {
  const RigidGroups groups(robot);
  const std::vector<double> values = default_values(robot);
  std::map<int, std::vector<int>> bodies;
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    if (groups.link_base[link] != groups.link_base[to_index(robot.root)])
      bodies[groups.link_base[link]].push_back(static_cast<int>(link));
  MassWorkspace<double> workspace;
  workspace.poses.start(robot.links.size());
  for (const auto& [base, links] : bodies) {
    const std::string names = names_of(robot, links);
    if (names.empty()) continue;
    const MassProperties<double> body =
        merged_mass(robot, groups.link_base, groups.link_parent_joint, links, values, &workspace);
    check_cancelled_mass(robot, body, base, links, values);
    if (const MassFault fault = range_fault(body); !fault.code.empty()) {
      InputFault place = fault_at(robot, base, links);
      place.message = fault.message;
      place.value = fault.value + "; links: " + names;
      place.allowed = fault.code == "mass_out_of_range" ? kMassRange : kMomentRange;
      throw InputError(place);
    }
    const MassFault fault = find_mass_fault(body);
    if (fault.code.empty()) continue;
    InputFault place = fault_at(robot, base, links);
    place.message =
        fault.message +
        "; it is used as it is written. Correct the numbers of the body's links to silence this";
    place.value = fault.value + "; links: " + names;
    warnings->push_back(warn(fault.code, place));
  }
}

}  // namespace codesign
