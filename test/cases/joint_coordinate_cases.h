// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "equations/arm.h"
#include "equations/joint_cases.h"
#include "equations/loaded_arm.h"
#include "integration/planar_linkages.h"

namespace codesign {

/// A mechanism that is run in joint and in absolute coordinates.
struct CoordinatesCase {
  std::string name, urdf;
  std::string study;           ///< initial state, controllers, loads and limits
  bool has_parameters = true;  ///< `size` and `mass` of joint_cases, or none
  double friction = 1e-8;      ///< tolerance of reactions and friction, relative to their size
  double start = 1e-11;        ///< the same before anything has been integrated
};

inline void PrintTo(const CoordinatesCase& c, std::ostream* out) { *out << c.name; }

namespace joint_coordinates {

/// `base` on a skew hinge to the ground, a joint of `content` from it to `tip`.
inline std::string on_hinge(const std::string& content) {
  return robot(
      "<codesign:parameter name='size' value='0.1'/><codesign:parameter name='mass' value='0.8'/>"
      "<codesign:parameter name='ratio' value='1.5'/>" +
      joint_cases::body("base") + joint_cases::body("tip") +
      joint_cases::tree(
          "root", "continuous", "ground", "base", "0.2 1 0.1",
          "<origin xyz='0.1 0 0.3' codesign:xyz='0.1 0 ${3*size}' rpy='0.3 -0.2 0.1'/>") +
      content);
}

inline std::vector<CoordinatesCase> types() {
  std::vector<CoordinatesCase> all;
  for (const std::vector<JointCase>& cases :
       {joint_cases::trees(), joint_cases::loops(), joint_cases::couplings()})
    for (const JointCase& c : cases)
      all.push_back(
          {c.name, on_hinge(c.content), "initial_state: {root: {position: 0.3, velocity: 1.5}}\n"});
  return all;
}

inline std::string annotation(const std::string& model, const std::string& geometry) {
  return "<codesign:friction model='" + model +
         "' mu_static='0.12' mu_dynamic='0.1' transition_velocity='0.05' viscous='0.01' "
         "preload='2' " +
         geometry + "/>";
}

/// A parallelogram that hangs on a hinged base, with what an annotation adds to one of its hinges:
/// three rows of its loop are redundant.
inline std::string carried_ring(const std::string& friction) {
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& at, const std::string& more) {
    return joint_cases::tree(name, "continuous", parent, child, "0 1 0",
                             "<origin xyz='" + at + "'/>" + more);
  };
  return on_hinge(
      joint_cases::tree("joint", "revolute", "base", "tip", "1 0 0.5", joint_cases::kOrigin) +
      joint_cases::body("left") + joint_cases::body("right") + joint_cases::body("coupler") +
      hinge("left_hinge", "tip", "left", "0 0 0", friction) +
      hinge("right_hinge", "tip", "right", "0.5 0 0", "") +
      hinge("left_pin", "left", "coupler", "0 0 -0.4", "") +
      "<loop name='right_pin' type='continuous'><predecessor link='right'><origin xyz='0 0 "
      "-0.4'/></predecessor>"
      "<successor link='coupler'><origin xyz='0.5 0 0'/></successor><axis xyz='0 1 0'/></loop>");
}

/// Loops whose reactions are shared by all their joints: with a compliance alone, and with rows
/// that are dropped. In absolute coordinates the rows of the joints that carry the loop have the
/// compliance of (23) too, 1e-9, in joint coordinates they have no rows; and reactions that nothing
/// determines carry rounding divided by it.
inline std::vector<CoordinatesCase> rings() {
  const std::string start =
      "initial_state: {root: {velocity: 1.0}, left_hinge: {position: 0.4, velocity: 1.0}}\n";
  return {{"ring", carried_ring(""), start, true, 1e-6, 1e-7},
          {"ring_with_friction",
           carried_ring(annotation("brown_mcphee", "joint_length='0.1' pin_radius='0.03'")), start,
           true, 1e-7, 1e-8}};
}

/// A carried ring, and a block that a ring pushes along its carrier, whose loops are held in their
/// plane only: nothing is redundant, though the carrier moves in space.
inline std::vector<CoordinatesCase> planes() {
  const std::string pin = annotation("brown_mcphee", "joint_length='0.1' pin_radius='0.03'"),
                    slide = annotation("brown_mcphee", "joint_length='0.1' joint_width='0.06'");
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& at) {
    return joint_cases::tree(name, "continuous", parent, child, "0 1 0",
                             "<origin xyz='" + at + "'/>");
  };
  const std::string block = held_in_plane(on_hinge(
      joint_cases::tree("joint", "revolute", "base", "tip", "1 0 0.5", joint_cases::kOrigin) +
      joint_cases::body("crank") + joint_cases::body("rod") + joint_cases::body("block") +
      hinge("crank_joint", "tip", "crank", "0 0 0") +
      hinge("rod_joint", "crank", "rod", "0 0.1 -0.2") + hinge("pin", "rod", "block", "0 0 -0.5") +
      "<loop name='close' type='prismatic'><predecessor link='tip'><origin xyz='0 0.1 -0.6' "
      "rpy='0 1.2 0'/></predecessor><successor link='block'><origin rpy='0 0.3 0'/></successor>"
      "<axis xyz='1 0 0'/>" +
      slide + "</loop>"));
  const std::string start =
      "initial_state: {root: {velocity: 1.0}, crank_joint: {position: 0.6, velocity: 1.0}, "
      "rod_joint: {guess: -0.8}}\n";
  return {{"ring_in_plane", held_in_plane(carried_ring(pin)),
           "initial_state: {root: {velocity: 1.0}, left_hinge: {position: 0.4, velocity: 1.0}}\n"},
          {"slide_in_plane", block, start}};
}

/// All joints with friction under each law; in a chain the first joint has the annotation.
inline std::vector<CoordinatesCase> frictions() {
  using joint_cases::chain;
  std::vector<CoordinatesCase> all;
  for (const std::string model : {"brown_mcphee", "gonthier", "lugre"}) {
    const std::string pin = annotation(model, "joint_length='0.1' pin_radius='0.03'"),
                      slide = annotation(model, "joint_length='0.1' joint_width='0.06'"),
                      ball = annotation(model, "pin_radius='0.04'"), flat = annotation(model, "");
    const auto in_chain = [](std::string content, const std::string& friction) {
      return content.insert(content.find("</joint>"), friction);
    };
    const auto one = [](const std::string& type, const std::string& friction) {
      return joint_cases::tree("joint", type, "base", "tip", "1 0 0.5",
                               joint_cases::kOrigin + friction);
    };
    const auto add = [&](const std::string& name, const std::string& content) {
      all.push_back(
          {name + "_" + model, on_hinge(content), "initial_state: {root: {velocity: 1.0}}\n"});
    };
    add("revolute", one("revolute", pin));
    add("prismatic", one("prismatic", slide));
    add("cylindrical", in_chain(chain({{'R', "1 0 0.5"}, {'P', "1 0 0.5"}}), pin));
    add("spherical", in_chain(chain({{'R', "1 0 0"}, {'R', "0 1 0"}, {'R', "0 0 1"}}), ball));
    add("planar", one("planar", ball));
    add("table", in_chain(chain({{'P', "1 0 0.5"}, {'P', "0.4 1 0"}}), flat));
    add("revolute_loop", joint_cases::free("tip") + joint_cases::loop("revolute", "base", pin));
    add("planar_loop", joint_cases::free("tip") + joint_cases::loop("planar", "base", ball));
    all.back().study.clear();  // in motion, LuGre's bristles would start with a friction
                               // coefficient that no reaction bears
  }
  const std::string by_direction =
      annotation("brown_mcphee",
                 "joint_length='0.1' pin_radius='0.03' mu_static_backward='0.06' "
                 "mu_dynamic_backward='0.05' viscous_backward='0.03'");
  all.push_back({"revolute_by_direction",
                 on_hinge(joint_cases::tree("joint", "revolute", "base", "tip", "1 0 0.5",
                                            joint_cases::kOrigin + by_direction)),
                 "initial_state: {root: {velocity: 1.0}}\n"});
  return all;
}

/// Gears that lose in the tree, folded, as a loop, and tied to another joint; friction in N m.
inline std::vector<CoordinatesCase> gears() {
  const std::string losses = "efficiency='0.8' backdrive_efficiency='0.7'",
                    step = " transition_velocity='0.05'";
  const auto actuator = [](const std::string& more) {
    return "<codesign:actuator gear_ratio='-7' rotor_inertia='0.004' " + more + "/>";
  };
  const auto one = [](const std::string& type, const std::string& more) {
    return joint_cases::tree("joint", type, "base", "tip", "1 0 0.5", joint_cases::kOrigin + more);
  };
  const std::string
      motor =
          "controllers: {motor: {type: state_feedback, output: joint, feedforward: {type: sine, "
          "amplitude: 8.0, frequency: 3.0}}}\n",
      start = "initial_state: {root: {velocity: 1.0}}\n";
  std::vector<CoordinatesCase> all;
  const auto add = [&](const std::string& name, const std::string& content,
                       const std::string& more = "") {
    all.push_back({name, on_hinge(content), start + motor + more});
  };
  const std::string gear = actuator(losses + step + " coulomb='0.02' viscous='0.001'");
  add("revolute", one("revolute", gear));
  add("prismatic", one("prismatic", gear));
  add("locks_itself", one("revolute", actuator("efficiency='0.45'" + step)));
  add("sticks", one("revolute", actuator(losses + " model='lugre'")));
  add("loop", joint_cases::free("tip") + joint_cases::loop("revolute", "base", gear));
  add("with_everything",
      one("revolute", gear + annotation("brown_mcphee", "joint_length='0.1' pin_radius='0.03'") +
                          "<dynamics damping='0.1' friction='0.2'/><codesign:torsion_spring "
                          "stiffness='5' free_position='0.2'/>"),
      "loads: [{joint: joint, effort: 0.7}]\n");
  std::string folded = joint_cases::chain({{'R', "1 0 0"}, {'R', "0 1 0"}});
  folded.insert(folded.find("</joint>"), gear);
  all.push_back({"folded", on_hinge(folded), start});
  add("mimicked", one("revolute", gear) + joint_cases::body("hand") +
                      joint_cases::tree("finger", "continuous", "tip", "hand", "0 1 0",
                                        "<mimic joint='joint' multiplier='-2'/>"));
  add("in_newton_metres",
      one("revolute",
          "<codesign:friction coulomb='0.3' static='0.5' stribeck_velocity='0.3' "
          "transition_velocity='0.05' viscous='0.2' viscous_exponent='0.6' "
          "coulomb_backward='0.4'/>"));
  all.push_back({"read_by_a_controller", on_hinge(one("revolute", gear)),
                 start + "controllers: {motor: {type: state_feedback, output: root, feedback: "
                         "[{signal: joint/gear_torque - joint/gear_loss, gain: 0.1}]}}\n"});
  return all;
}

/// Everything else that acts on a mechanism.
/// Bars on hinges one below the other.
inline std::string chain_of(int count) {
  std::string content;
  for (int k = 0; k < count; ++k)
    content += bar("bar" + std::to_string(k)) +
               hinge("hinge" + std::to_string(k), k == 0 ? "ground" : "bar" + std::to_string(k - 1),
                     "bar" + std::to_string(k), k == 0 ? "0 0 0" : "0 0 -1");
  return robot(content);
}

inline std::vector<CoordinatesCase> loads() {
  const std::string servo =
      "controllers:\n"
      "  a: {type: pid, input: shoulder/position, output: shoulder, setpoint: 0.2, gains: {p: 3.0, "
      "i: 2.0, d: 0.5}}\n"
      "  b: {type: pid, input: elbow/position + lower/velocity/x, output: elbow, setpoint: 0.1, "
      "gains: {p: 6.0, d: 0.1}}\n";
  const std::string forces =
      "loads: [{joint: shoulder, effort: 0.5}, {link: lower, force: [1.0, -2.0, 0.5], torque: "
      "[0.1, 0.2, 0.3], point: [0.1, 0, -0.4]},\n"
      "        {link: upper, force: [0.3, 0.2, -0.5], torque: [0.2, 0, 0.1], point: [0, 0.1, "
      "-0.4], frame: link}]\n";
  const std::string gravity =
      "controllers:\n"
      "  hold_reach: {type: pd_gravity, output: reach, setpoint: 0.1, gains: {p: 40.0, d: 3.0}}\n"
      "  hold_turn: {type: pd_gravity, output: turn, setpoint: 0.4, gains: {p: 10.0, d: 1.0}}\n";
  const std::string torque =
      "controllers:\n"
      "  a: {type: computed_torque, output: shoulder, setpoint: 0.2, gains: {p: 30.0, d: 5.0}}\n"
      "  b: {type: computed_torque, output: elbow, setpoint: 0.1, gains: {p: 30.0, d: 5.0}}\n";
  const std::string sampled =
      "controllers:\n"
      "  a: {type: pid, input: shoulder/position, output: shoulder, setpoint: 0.2, gains: {p: 3.0, "
      "i: 1.0, d: 0.5}, sample_time: 0.01}\n";
  const std::string compliant =
      "controllers:\n"
      "  a: {type: state_feedback, output: shoulder, feedback: [{signal: elbow/reaction_force/x + "
      "elbow/friction, gain: 0.02}]}\n";
  const std::string limits =
      "limits: {effort: true, position: true, stiffness: 1.0e3, width: 1.0e-2}\n";
  return {
      {"loaded_arm", loaded_arm(), servo + forces, false},
      {"loaded_arm_within_limits", loaded_arm(), servo + forces + limits, false},
      {"loaded_arm_sampled", loaded_arm(), sampled, false},
      {"fed_back_reactions", double_pendulum(pin_friction()),
       "initial_state: {elbow: {position: 1.2}}\n" + compliant, false},
      {"long_chain", chain_of(26),
       "initial_state: {hinge0: {position: 1.0}, hinge5: {velocity: 1.0}}\n", false},
      {"computed_torque", loaded_arm(), torque, false},
      {"crane", crane(),
       "initial_state: {turn: {velocity: 1.0}, ball_x: {position: 0.3}}\n" + gravity, false},
      {"puck", puck(), "initial_state: {hinge: {position: 0.4}}\n", false},
      {"spring_pendulum", spring_pendulum(), "initial_state: {hinge: {position: 0.4}}\n", false},
      {"double_pendulum", double_pendulum(pin_friction()),
       "initial_state: {shoulder: {position: 1.2}}\n", false}};
}

}  // namespace joint_coordinates
}  // namespace codesign
