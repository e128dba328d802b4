// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "observation/observer.h"

#include <algorithm>

#include "elements/body_contact.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "system/tree_kinematics.h"

namespace codesign {

Observer::Observer(const CompiledSystem& system, const std::vector<SignalDescription>& signals)
    : system_(system), tree_(system.robot()) {
  for (const SignalDescription& signal : signals) {
    signals_.push_back(resolve_signal(signal, system.robot(), system.topology(),
                                      system.study().controllers, system.study().parameters));
    system.check_readable(signals_.back(), signal);
    names_.signals.push_back(signal.text);
  }
  name_joints();
  name_frictions();
  name_links();
  for (const ControllerDescription& controller : system.study().controllers)
    names_.controllers.push_back(controller.name);
}

void Observer::name_joints() {
  const RobotDescription& robot = system_.robot();
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    if (!robot.joints[k].has_one_coordinate() || robot.joints[k].is_motor) continue;
    JointSource source;
    source.joint = static_cast<int>(k);
    source.pair = system_.topology().joint_pair[k];
    if (source.pair >= 0) {
      const auto& chain = system_.topology().pairs[to_index(source.pair)].chain;
      for (std::size_t e = 0; e < chain.size(); ++e)
        if (chain[e].joint == source.joint) source.element = static_cast<int>(e);
    }
    joints_.push_back(source);
    names_.joints.push_back(robot.joints[k].name);
    if (!robot.joints[k].is_loop) ++names_.tree_joints;
  }
  for (JointSource& source : joints_) {
    const auto& mimic = robot.joints[to_index(source.joint)].mimic;
    if (source.pair >= 0 || !mimic) continue;
    source.mimicked =
        static_cast<int>(std::find(names_.joints.begin(), names_.joints.end(), mimic->joint) -
                         names_.joints.begin());
  }
}

void Observer::name_frictions() {
  const Topology& topology = system_.topology();
  for (const JointLoad& load : system_.loads()) {
    if (!load.has_friction()) continue;
    const Pair& pair = topology.pairs[to_index(load.pair)];
    const int element = std::min(load.element, static_cast<int>(pair.chain.size()) - 1);
    const JointDescription& joint =
        system_.robot().joints[to_index(pair.chain[to_index(element)].joint)];
    frictions_.push_back({load.pair, load.element, -1});
    names_.frictions.push_back(joint.name);
    names_.friction_is_torque.push_back(
        !joint.is_slide() && !(pair.kind == PairKind::kCylindrical && load.element == 1));
  }
  for (int contact : system_.contacts()) {
    const Pair& pair = topology.pairs[to_index(contact)];
    frictions_.push_back({contact, kContact, -1});
    names_.frictions.push_back(system_.robot().joints[to_index(pair.friction_joint)].name);
    names_.friction_is_torque.push_back(pair.kind == PairKind::kSpherical);
  }
  const std::vector<ContactDescription>& touching = system_.robot().contacts;
  for (std::size_t k = 0; k < touching.size(); ++k) {
    frictions_.push_back({-1, -1, static_cast<int>(k)});
    names_.frictions.push_back(touching[k].name);
    names_.friction_is_torque.push_back(false);
  }
}

void Observer::name_links() {
  const RobotDescription& robot = system_.robot();
  for (const LinkDescription& link : robot.links) names_.links.push_back(link.name);
  // Motors behind elastic gears turn links of their own, the last ones, which no file holds.
  names_.links.resize(names_.links.size() - system_.elastic_gears().size());
  for (const JointDescription& joint : robot.joints)
    if (joint.has_pose())
      names_.free_links.emplace_back(to_index(joint.child), to_index(joint.parent));
  for (std::size_t k = 0; k < system_.topology().pairs.size(); ++k) {
    if (!system_.topology().pairs[k].is_loop) continue;
    loops_.push_back(static_cast<int>(k));
    for (const ChainElement& element : system_.topology().pairs[k].chain)
      if (robot.joints[to_index(element.joint)].is_loop)
        names_.loops.push_back(robot.joints[to_index(element.joint)].name);
  }
}

std::vector<std::size_t> link_parents(const RobotDescription& robot) {
  std::vector<std::size_t> parents(robot.links.size(), to_index(robot.root));
  for (const JointDescription& joint : robot.joints)
    if (!joint.is_loop) parents[to_index(joint.child)] = to_index(joint.parent);
  return parents;
}

void Observer::observe(const State<double>& state, double objective, const VectorX<double>& theta,
                       Equations<double>* equations, Frame* frame) {
  frame->time = state.t;
  frame->objective = objective;
  observe_loops(state, equations, frame);
  equations->formulas().load(state);
  frame->joints.resize(joints_.size());
  VectorX<double> positions = theta;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const JointSource& source = joints_[k];
    JointSample& sample = frame->joints[k];
    const int c = tree_.offset[to_index(source.joint)];
    if (source.pair < 0) {
      sample = {theta[c], 0.0, 0.0, 0.0};
      continue;
    }
    const CoordinateMotion<double> motion =
        equations->formulas().coordinate(source.pair, source.element);
    sample = {motion.position, motion.rate, motion.acceleration,
              equations->formulas().effort(source.pair, source.element)};
    if (k < names_.tree_joints) positions[c] = motion.position;
  }
  follow_mimics(equations->parameters(), &positions, frame);
  observe_frictions(equations, frame);
  observe_controllers(state, equations, frame);
  observe_links(positions, equations, frame);
  frame->signals.resize(signals_.size());
  for (std::size_t k = 0; k < signals_.size(); ++k)
    frame->signals[k] = equations->formulas().signal(signals_[k]);
}

// A joint below which nothing has mass has no row of motion; if it mimics another joint, its
// position follows from the position of that joint.
void Observer::follow_mimics(const std::vector<double>& parameters, VectorX<double>* positions,
                             Frame* frame) const {
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    double factor = 1.0, offset = 0.0;
    std::size_t target = k;
    while (joints_[target].mimicked >= 0) {
      const MimicDescription& mimic =
          *system_.robot().joints[to_index(joints_[target].joint)].mimic;
      offset += factor * mimic.offset.at(parameters);
      factor *= mimic.multiplier.at(parameters);
      target = to_index(joints_[target].mimicked);
    }
    if (target == k) continue;
    const JointSample& source = frame->joints[target];
    frame->joints[k] = {factor * source.position + offset, factor * source.velocity,
                        factor * source.acceleration, 0.0};
    (*positions)[tree_.offset[to_index(joints_[k].joint)]] = frame->joints[k].position;
  }
}

void Observer::observe_frictions(Equations<double>* equations, Frame* frame) const {
  frame->frictions.resize(frictions_.size());
  for (std::size_t k = 0; k < frictions_.size(); ++k) {
    const FrictionSource& source = frictions_[k];
    if (source.contact >= 0) {
      observe_touch(source.contact, equations, &frame->frictions[k]);
      continue;
    }
    const Pair& pair = system_.topology().pairs[to_index(source.pair)];
    const PairConstants<double>& c = equations->constants().pairs[to_index(source.pair)];
    FrictionSample& sample = frame->frictions[k];
    sample = {};
    sample.position = equations->formulas().body(pair.body_j).r +
                      equations->formulas().body(pair.body_j).A * c.s_j;
    if (source.element == kContact) {
      observe_contact(source.pair, equations, &sample);
      continue;
    }
    const FrictionState<double> friction =
        equations->formulas().friction(source.pair, source.element);
    const double sign = c.coordinates[to_index(source.element)].sign;
    const Eigen::Vector3d axis = equations->formulas().body(pair.body_i).A * c.C_i.col(2);
    sample.friction = -friction.load;
    sample.normal_force = friction.normal;
    sample.sliding_velocity = friction.velocity;
    (names_.friction_is_torque[k] ? sample.torque : sample.force) = -sign * friction.load * axis;
  }
}

void Observer::observe_contact(int index, Equations<double>* equations,
                               FrictionSample* sample) const {
  const Pair& pair = system_.topology().pairs[to_index(index)];
  const PairConstants<double>& c = equations->constants().pairs[to_index(index)];
  const ContactFriction<double> contact = equations->formulas().contact(index);
  sample->friction = -contact.magnitude();
  sample->normal_force = contact.normal;
  sample->sliding_velocity = contact.speed();
  // If the chain runs from the joint's child to its parent, body j is on the parent's side.
  const bool reversed = std::any_of(
      pair.chain.begin(), pair.chain.end(),
      [&](const ChainElement& e) { return e.joint == pair.friction_joint && e.reversed; });
  const Eigen::Vector3d on_child = (reversed ? 1.0 : -1.0) * contact.load;
  if (pair.kind == PairKind::kSpherical) {
    sample->torque = on_child;
    return;
  }
  const Eigen::Matrix3d axes = equations->formulas().body(pair.body_i).A * c.C_i;
  sample->force = axes.leftCols<2>() * on_child.head<2>();
  sample->torque = axes.col(2) * on_child[2];
}

void Observer::observe_touch(int index, Equations<double>* equations,
                             FrictionSample* sample) const {
  const StateView<double>& view = equations->formulas().view();
  const TouchPoint<double> nearest = nearest_point(view, index);
  *sample = {};
  sample->sliding_velocity = nearest.slip.norm();
  Eigen::Vector3d friction = Eigen::Vector3d::Zero(), place = Eigen::Vector3d::Zero();
  for_each_touch(view, to_index(index),
                 [&](const TouchPoint<double>& point, const ContactForce<double>& force,
                     const Eigen::Vector3d& of_point) {
                   sample->normal_force += force.normal;
                   sample->force += force.normal * point.normal + of_point;
                   friction += of_point;
                   place += force.normal * point.place;
                 });
  sample->friction = -friction.norm();
  sample->position =
      sample->normal_force > 0.0 ? Eigen::Vector3d(place / sample->normal_force) : nearest.place;
}

void Observer::observe_controllers(const State<double>& state, Equations<double>* equations,
                                   Frame* frame) const {
  frame->controllers.resize(system_.controllers().size());
  for (std::size_t k = 0; k < frame->controllers.size(); ++k) {
    const int controller = static_cast<int>(k), s = system_.controllers()[k].state;
    ControllerSample& sample = frame->controllers[k];
    sample.setpoint = equations->formulas().setpoint(controller);
    sample.error = equations->formulas().controller_error(controller);
    sample.input = sample.setpoint - sample.error;
    sample.integral = s >= 0 ? state.s[s] : 0.0;
    sample.output = equations->formulas().controller_output(controller);
  }
}

// Links with mass get their poses from the state. A massless link is placed relative to its parent
// by its joint's position; forward kinematics from the root would be wrong, since theta has planar
// and floating joints at their start positions only.
void Observer::observe_links(const VectorX<double>& theta, Equations<double>* equations,
                             Frame* frame) const {
  const auto& links = equations->constants().links;
  frame->links.resize(links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const int body = system_.topology().link_body[k];
    if (body == Topology::kMassless) continue;
    const BodyKinematics<double>& b = equations->formulas().body(body);
    frame->links[k] = {b.r + b.A * links[k].s,
                       Eigen::Quaterniond(Eigen::Matrix3d(b.A * links[k].R)).normalized()};
  }
  const std::vector<LinkMotion<double>> motions = link_motions<double>(
      system_.robot(), tree_, equations->parameters(), theta, VectorX<double>::Zero(theta.size()));
  for (int joint : tree_.joint_order) {
    const JointDescription& description = system_.robot().joints[to_index(joint)];
    const auto parent = to_index(description.parent), child = to_index(description.child);
    if (system_.topology().link_body[child] != Topology::kMassless) continue;
    const LinkSample& base = frame->links[parent];
    const Pose<double> X = motions[parent].X.inverse() * motions[child].X;
    frame->links[child] = {base.position + base.orientation * X.t,
                           (base.orientation * Eigen::Quaterniond(X.R)).normalized()};
  }
  frame->links.resize(names_.links.size());
}

void Observer::observe_loops(const State<double>& state, Equations<double>* equations,
                             Frame* frame) {
  equations->constraint_errors(state, &errors_, &rates_);
  frame->loop_errors.resize(loops_.size());
  for (std::size_t k = 0; k < loops_.size(); ++k) {
    const auto pair = to_index(loops_[k]);
    const int first = system_.layout().pair_row[pair], last = system_.layout().pair_end(loops_[k]);
    frame->loop_errors[k] =
        last > first ? errors_.segment(first, last - first).cwiseAbs().maxCoeff() : 0.0;
  }
}

}  // namespace codesign
