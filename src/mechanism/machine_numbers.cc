// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/machine_numbers.h"

#include <algorithm>
#include <cmath>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/motor_sides.h"

namespace codesign {
namespace {

// Of machines without mass, length or time, which have no scale.
constexpr double kUsualSmoothing = 1e-3;   // [N or N m]
constexpr double kUsualStiffness = 1e4;    // [N/m or N m/rad]
constexpr double kUsualDissipation = 1.0;  // [s/m or s/rad]

// Numbers of <limit> such as 1e6 N stand for "unknown": a joint passes at most so many strokes
// during a study.
constexpr double kMostStrokes = 1e5;
constexpr double kStrokes = 10.0;         // likewise, where nothing else moves the joint
constexpr double kStopDissipation = 4.0;  // c times the speed at which the weight arrives

template <class T>
bool is_positive(const T& x) {
  return is_less(T(0.0), x, true);
}

template <class T>
T squared(const T& x) {
  return x * x;
}

/// Half of the harmonic mean: the smaller one of two numbers that differ much, smoothly.
template <class T>
T smaller(const T& x, const T& y) {
  return x * y / (x + y);
}

bool lacks_smoothing(const FrictionDescription& friction) {
  return !friction.is_direct && friction.smoothing.is_zero();
}

bool lacks_gear_smoothing(const JointDescription& joint) {
  return joint.actuator && joint.actuator->gear && joint.actuator->gear->efficiency &&
         joint.motor < 0 && joint.actuator->gear->slip.smoothing.is_zero();
}

bool gear_transition_follows(const JointDescription& joint) {
  return joint.actuator && joint.actuator->gear && joint.motor < 0 &&
         joint.actuator->gear->slip.transition_follows;
}

bool stops(const JointDescription& joint, const MotionStudy& study) {
  return study.limits.position && has_stops(joint);
}

bool has_machine_numbers(const RobotDescription& robot, const MotionStudy& study) {
  return std::any_of(robot.joints.begin(), robot.joints.end(), [&](const JointDescription& joint) {
    return (joint.friction &&
            (lacks_smoothing(*joint.friction) || joint.friction->transition_follows)) ||
           lacks_gear_smoothing(joint) || gear_transition_follows(joint) || stops(joint, study);
  });
}

bool has_loops(const RobotDescription& robot) {
  return !robot.couplings.empty() ||
         std::any_of(robot.joints.begin(), robot.joints.end(),
                     [](const JointDescription& joint) { return joint.is_loop || joint.mimic; });
}

/// The numbers of one design, (13i).
template <class T>
class MachineRules {
 public:
  MachineRules(const RobotDescription& robot, const MotionStudy& study,
               const std::vector<T>& parameters, const MachineScale<T>& scale)
      : study_(study), parameters_(parameters), scale_(scale), has_loops_(has_loops(robot)) {}

  T smoothing(const JointScale<T>& at) const {
    if (!is_positive(at.mass)) return T(kUsualSmoothing);
    return T(kSmoothingShare) * at.mass * scale_.acceleration;
  }

  T gear_smoothing(const JointDescription& joint, const JointScale<T>& at,
                   const JointDynamicsConstants<T>& d) const {
    const T torque = weight(at);
    if (!is_positive(torque)) return T(kUsualSmoothing);
    const bool bounded = joint.limit && joint.limit->bounds_effort();
    return T(kSmoothingShare) * (bounded ? smaller<T>(torque, d.effort) : torque);
  }

  /// Sets the transition velocity, and the Stribeck velocity that depends on it.
  void set_transition(const JointDescription& joint, const FrictionDescription& friction,
                      const JointScale<T>& at, FrictionConstants<T>* c) const {
    using std::sqrt;
    const JointScale<T>& all = scale_.all;
    if (!is_positive(at.mass) || !is_positive(at.inertia) || !is_positive(all.inertia)) return;
    // The square of a radius: of what turns, or of the machine.
    const T square = joint.is_turn() ? T(at.inertia / at.mass) : T(all.inertia / all.mass);
    const T radius = sqrt(square);
    c->transition_velocity =
        T(kTransitionShare) *
        sqrt(joint.is_turn() ? T(scale_.acceleration / radius) : T(scale_.acceleration * radius));
    if (friction.stribeck_velocity.is_zero())
      c->stribeck_velocity = T(10.0) * c->transition_velocity;
  }

  StopConstants<T> stop(const JointDescription& joint, const JointScale<T>& joint_scale,
                        const JointDynamicsConstants<T>& d) const {
    using std::sqrt;
    const JointScale<T> at = pushing(joint, joint_scale);
    const T S = stroke(d), M = at.inertia + squared(d.gear_ratio) * d.rotor_inertia;
    StopConstants<T> stop{T(kUsualStiffness), T(kUsualDissipation), T(kStopWidthShare * S)};
    if (is_positive(M)) {
      const T slow = T(2.0) * weight(at) * S / M + squared(T(kStrokes / time_scale(study_) * S)) +
                     squared(start_velocity(joint));
      stop.stiffness = M * (slow + allowed(joint, S, M, d)) / squared(T(kStopDepthShare * S));
      stop.dissipation = T(kStopDissipation) / sqrt(slow);
    }
    const LimitOptions& given = study_.limits;
    if (given.stiffness) stop.stiffness = T(*given.stiffness);
    if (given.dissipation) stop.dissipation = T(*given.dissipation);
    if (given.width) stop.width = T(*given.width);
    return stop;
  }

 private:
  /// In a mechanism with loops everything may push against a stop.
  JointScale<T> pushing(const JointDescription& joint, JointScale<T> at) const {
    if (!has_loops_) return at;
    at.mass += scale_.all.mass;
    at.inertia += joint.is_turn() ? scale_.all.inertia : scale_.all.mass;
    return at;
  }
  /// a sqrt(m M): of a slide the weight [N], else its torque at the radius of gyration [N m].
  T weight(const JointScale<T>& at) const {
    using std::sqrt;
    if (!is_positive(at.mass) || !is_positive(at.inertia)) return T(0.0);
    return scale_.acceleration * sqrt(at.mass * at.inertia);
  }
  static T stroke(const JointDynamicsConstants<T>& d) {
    using std::sqrt;
    const T range = d.upper - d.lower;
    if (is_positive(range)) return range;
    return T(1e-3) * sqrt(squared(d.lower) + squared(d.upper));
  }
  T start_velocity(const JointDescription& joint) const {
    for (const InitialJointState& initial : study_.initial_state)
      if (initial.joint == joint.name && initial.velocity) return initial.velocity->at(parameters_);
    return T(0.0);
  }
  /// The square of the speeds that the numbers of `<limit>` allow.
  T allowed(const JointDescription& joint, const T& S, const T& M,
            const JointDynamicsConstants<T>& d) const {
    const T most = squared(T(kMostStrokes / time_scale(study_) * S));
    T sum(0.0);
    if (joint.limit->bounds_velocity())
      sum += smaller<T>(squared(T(joint.limit->velocity.at(parameters_))), most);
    if (joint.limit->bounds_effort()) sum += smaller<T>(T(2.0) * d.effort * S / M, most);
    return sum;
  }

  const MotionStudy& study_;
  const std::vector<T>& parameters_;
  const MachineScale<T>& scale_;
  const bool has_loops_;
};

}  // namespace

template <class T>
void set_machine_numbers(const RobotDescription& robot, const Topology& topology,
                         const MotionStudy& study, const std::vector<T>& parameters,
                         MachineScale<T>* scale, Constants<T>* constants) {
  if (!has_machine_numbers(robot, study)) return;
  set_machine_scale(robot, study, parameters, scale);
  const MachineRules<T> rules(robot, study, parameters, *scale);
  for (std::size_t p = 0; p < topology.pairs.size(); ++p) {
    const Pair& pair = topology.pairs[p];
    PairConstants<T>& numbers = constants->pairs[p];
    if (pair.friction_joint >= 0) {
      const auto j = to_index(pair.friction_joint);
      const JointDescription& joint = robot.joints[j];
      if (lacks_smoothing(*joint.friction))
        numbers.friction.smoothing = rules.smoothing(scale->joints[j]);
      if (joint.friction->transition_follows)
        rules.set_transition(joint, *joint.friction, scale->joints[j], &numbers.friction);
    }
    for (std::size_t e = 0; e < pair.chain.size(); ++e) {
      const auto j = to_index(pair.chain[e].joint);
      const JointDescription& joint = robot.joints[j];
      JointDynamicsConstants<T>& d = numbers.dynamics[e];
      if (lacks_gear_smoothing(joint))
        d.gear.slip.smoothing = rules.gear_smoothing(joint, scale->joints[j], d);
      if (gear_transition_follows(joint))
        rules.set_transition(joint, joint.actuator->gear->slip, scale->joints[j], &d.gear.slip);
      if (stops(joint, study)) d.stop = rules.stop(joint, scale->joints[j], d);
    }
  }
}

std::vector<MachineNumber> machine_numbers(const RobotDescription& robot, const Topology& topology,
                                           const MotionStudy& study,
                                           const Constants<double>& constants) {
  std::vector<MachineNumber> all;
  const LimitOptions& given = study.limits;
  const auto add = [&](bool is_missing, const JointDescription& joint, const char* number,
                       const char* turning, const char* sliding, double value) {
    if (is_missing)
      all.push_back(
          {joint_of_motor(robot, joint.name), number, joint.is_turn() ? turning : sliding, value});
  };
  for (std::size_t p = 0; p < topology.pairs.size(); ++p) {
    const Pair& pair = topology.pairs[p];
    const PairConstants<double>& numbers = constants.pairs[p];
    if (pair.friction_joint >= 0) {
      const JointDescription& joint = robot.joints[to_index(pair.friction_joint)];
      const FrictionConstants<double>& f = numbers.friction;
      add(lacks_smoothing(*joint.friction), joint, "smoothing", "N", "N", f.smoothing);
      add(joint.friction->transition_follows, joint, "transition velocity", "rad/s", "m/s",
          f.transition_velocity);
    }
    for (std::size_t e = 0; e < pair.chain.size(); ++e) {
      const JointDescription& joint = robot.joints[to_index(pair.chain[e].joint)];
      const JointDynamicsConstants<double>& d = numbers.dynamics[e];
      const FrictionConstants<double>& slip = d.gear.slip;
      add(lacks_gear_smoothing(joint), joint, "gear smoothing", "N m", "N", slip.smoothing);
      add(gear_transition_follows(joint), joint, "gear transition velocity", "rad/s", "m/s",
          slip.transition_velocity);
      if (!stops(joint, study)) continue;
      add(!given.stiffness, joint, "stop stiffness", "N m/rad", "N/m", d.stop.stiffness);
      add(!given.dissipation, joint, "stop dissipation", "s/rad", "s/m", d.stop.dissipation);
      add(!given.width, joint, "stop width", "rad", "m", d.stop.width);
    }
  }
  return all;
}

#define CODESIGN_INSTANTIATE(T)                                                   \
  template void set_machine_numbers<T>(const RobotDescription&, const Topology&,  \
                                       const MotionStudy&, const std::vector<T>&, \
                                       MachineScale<T>*, Constants<T>*);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
