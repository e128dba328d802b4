// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/pair_geometry.h"

#include <cmath>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "mechanism/hinge_angles.h"
#include "mechanism/loop_plane.h"
#include "mechanism/pose.h"

namespace codesign {
namespace {

template <class T>
class PairBuilder {
 public:
  PairBuilder(const RobotDescription& robot, const Topology& topology, const Pair& pair,
              const std::vector<T>& parameters, PairConstants<T>* result)
      : robot_(robot),
        topology_(topology),
        pair_(pair),
        parameters_(parameters),
        geometry_(chain_geometry(robot, topology, pair.chain, parameters)),
        result_(*result) {
    result_.clear();
    for (std::size_t k = 0; k < pair.chain.size(); ++k) {
      if (joint(k).is_slide()) slides_.push_back(k);
      if (joint(k).is_turn()) turns_.push_back(k);
    }
  }

  void build(const Vector3<T>& centre_i, const Vector3<T>& centre_j) {
    const Pose<T> X_ji = geometry_.X_ij.inverse();
    const Vector3<T> point = joint_point();
    const Matrix3<T> C = joint_axes();
    result_.s_i = point - centre_i;
    result_.s_j = X_ji * point - centre_j;
    result_.C_i = C;
    result_.C_j = X_ji.R * C;
    if (pair_.kind == PairKind::kUniversal) place_universal(X_ji.R);
    if (pair_.kind == PairKind::kDistance) place_distance(centre_j);
    for (std::size_t k = 0; k < pair_.chain.size(); ++k) {
      result_.coordinates.push_back(coordinate(k, X_ji.R));
      result_.dynamics.push_back(dynamics(joint(k)));
      if (joint(k).actuator) place_rotor(k, X_ji.R);
    }
    if (pair_.kind == PairKind::kCylindrical && pair_.chain.size() == 1)
      add_cylindrical_coordinates();
    result_.R_ij = geometry_.X_ij.R;
    if (!pair_.is_loop && pair_.kind->in_forest) place_steps();
    if (pair_.friction_joint >= 0)
      result_.friction = friction(*robot_.joints[to_index(pair_.friction_joint)].friction);
    if (pair_.friction_joint >= 0) place_slip();
  }

 private:
  using Coordinate = CoordinateConstants<T>;
  using Elements = ShortVector<std::size_t, ChainGeometry<T>::kFew>;

  const JointDescription& joint(std::size_t k) const {
    return robot_.joints[to_index(pair_.chain[k].joint)];
  }
  const Vector3<T>& axis(std::size_t k) const { return geometry_.axes[k]; }
  const Vector3<T>& origin(std::size_t k) const { return geometry_.frames[k].t; }

  Vector3<T> joint_point() const {
    if (turns_.empty()) return origin(0);
    if (turns_.size() == 1) return origin(turns_[0]);
    return nearest_point(origin(turns_[0]), axis(turns_[0]), origin(turns_[1]), axis(turns_[1]));
  }

  Vector3<T> z_axis() const {
    if (pair_.kind == PairKind::kTable) {
      const Vector3<T> normal = cross(axis(0), axis(1));
      return normal / norm(normal);
    }
    if (turns_.size() == 1) return axis(turns_[0]);
    return axis(0);
  }

  static T norm(const Vector3<T>& x) {
    using std::sqrt;
    return sqrt(dot(x, x));
  }

  static Matrix3<T> axes_from(const Vector3<T>& x, const Vector3<T>& z) {
    Matrix3<T> C;
    C.col(0) = x;
    C.col(1) = cross(z, x);
    C.col(2) = z;
    return C;
  }

  // The axes of a loop that is held in the plane of its motion, theory (23c): z'' is the normal,
  // but along a slide, which has the normal as y''.
  Matrix3<T> axes_in_plane() const {
    const Vector3<T> normal = plane_normal(robot_, topology_, pair_, parameters_);
    if (slides_.empty()) return axes_from(transverse_axis<T>(normal, std::nullopt), normal);
    const Vector3<T> x = cross(normal, axis(0));
    return axes_from(x / norm(x), axis(0));
  }

  // x'' is given in the joint frame of the element with the friction, else in the joint frame of
  // the only turning element (else of the first element).
  Matrix3<T> joint_axes() const {
    if (is_in_plane(robot_, pair_)) return axes_in_plane();
    std::size_t frame = turns_.size() == 1 ? turns_[0] : 0;
    std::optional<std::array<double, 3>> preferred;
    for (std::size_t k = 0; k < pair_.chain.size(); ++k) {
      if (pair_.chain[k].joint != pair_.friction_joint) continue;
      frame = k;
      preferred = joint(k).friction->transverse_axis;
    }
    const Vector3<T> z = z_axis();
    const Matrix3<T>& R = geometry_.frames[frame].R;
    return axes_from(Vector3<T>(R * transverse_axis<T>(R.transpose() * z, preferred)), z);
  }

  // z of each side is its own axis. x is the other side's axis projected normal to z, so that both
  // angles are zero at zero position.
  void place_universal(const Matrix3<T>& R_ji) {
    const Vector3<T> z_i = axis(0);
    const Vector3<T> z_j_in_i =
        pair_.chain.size() == 2
            ? axis(1)
            : Vector3<T>(geometry_.frames[0].R * axis_at(joint(0).second_axis, parameters_));
    result_.cosine = dot(z_i, z_j_in_i);
    const auto frame = [](const Vector3<T>& z, const Vector3<T>& other) {
      Matrix3<T> C;
      const Vector3<T> x = other - dot(other, z) * z;
      C.col(0) = x / norm(x);
      C.col(2) = z;
      C.col(1) = cross<T>(C.col(2), C.col(0));
      return C;
    };
    result_.C_i = frame(z_i, z_j_in_i);
    result_.C_j = frame(R_ji * z_j_in_i, R_ji * z_i);
  }

  // The two points of a distance pair are independent of each other.
  void place_distance(const Vector3<T>& centre_j) {
    result_.s_j = vector_at(joint(0).child_origin.xyz, parameters_) - centre_j;
    result_.distance = joint(0).distance.at(parameters_);
  }

  Coordinate coordinate(std::size_t k, const Matrix3<T>& R_ji) const {
    Coordinate c;
    if (joint(k).is_slide()) c = slide(k, R_ji);
    if (joint(k).is_turn()) c = turn(k, R_ji);
    if (pair_.chain[k].reversed) {
      c.sign = -c.sign;
      c.offset = -c.offset;
    }
    return c;
  }

  void place_steps() {
    for (std::size_t k = 0; k < pair_.chain.size(); ++k)
      visit_freedoms(joint(k), parameters_, [&](bool turns, const Vector3<T>& axis) {
        result_.steps.push_back({turns, geometry_.frames[k].R * axis});
      });
  }

  // A single cylindrical loop has two coordinates, a turn and a slide.
  void add_cylindrical_coordinates() {
    Coordinate turning, sliding;
    turning.kind = Coordinate::Kind::kTurn;
    sliding.kind = Coordinate::Kind::kSlide;
    sliding.a = axis(0);
    result_.coordinates = {turning, sliding};
    result_.dynamics.resize(2);
  }

  // d is the sum of the slides times their axes, so that each slide is the scalar product of d with
  // a dual basis vector of the axes.
  Coordinate slide(std::size_t k, const Matrix3<T>& R_ji) const {
    Coordinate c;
    const bool before_turns = turns_.empty() || slides_.back() < turns_.front();
    const bool after_turns = !turns_.empty() && slides_.front() > turns_.back();
    if (!before_turns && !after_turns && pair_.kind != PairKind::kCylindrical) return c;
    c.kind = Coordinate::Kind::kSlide;
    c.fixed_in_j = after_turns && pair_.kind != PairKind::kCylindrical;
    const Vector3<T> dual = dual_axis(k);
    c.a = c.fixed_in_j ? Vector3<T>(R_ji * dual) : dual;
    return c;
  }

  Vector3<T> dual_axis(std::size_t k) const {
    if (slides_.size() == 1) return axis(k);
    Vector3<T> normal = Vector3<T>::Zero();
    Elements others;
    for (std::size_t other : slides_)
      if (other != k) others.push_back(other);
    if (others.size() == 1) {
      const Vector3<T>& b = axis(others[0]);
      normal = axis(k) - dot(axis(k), b) * b;
    } else {
      normal = cross(axis(others[0]), axis(others[1]));
    }
    return normal / dot(normal, axis(k));
  }

  Coordinate turn(std::size_t k, const Matrix3<T>& R_ji) const {
    Coordinate c;
    if (turns_.size() == 1) {
      c.kind = Coordinate::Kind::kTurn;
    } else if (turns_.size() == 2) {
      universal_angle(k == turns_[0], &c);
    } else {
      c = three_hinges(R_ji).angle(k == turns_[0] ? 0 : k == turns_[1] ? 1 : 2);
    }
    return c;
  }

  ThreeHinges<T> three_hinges(const Matrix3<T>& R_ji) const {
    ThreeHinges<T> hinges{axis(turns_[0]), axis(turns_[1]), axis(turns_[2]), std::nullopt, R_ji};
    const std::optional<Quantity>& start = joint(turns_[1]).start_position;
    if (start) hinges.start = start->at(parameters_);
    if (start && pair_.chain[turns_[1]].reversed) hinges.start = -*hinges.start;
    return hinges;
  }

  void universal_angle(bool first, Coordinate* c) const {
    c->kind = Coordinate::Kind::kAngle;
    const Matrix3<T>&C_i = result_.C_i, &C_j = result_.C_j;
    c->sign = first ? 1.0 : -1.0;
    c->a = first ? C_i.col(1) : C_i.col(2);
    c->b = first ? C_j.col(2) : C_j.col(1);
    c->c = first ? C_i.col(0) : C_i.col(2);
    c->d = first ? C_j.col(2) : C_j.col(0);
  }

  // A plane slips along x'' and y'' of body i and turns about z''; a ball turns about the three
  // ground axes.
  void place_slip() {
    SlipConstants<T>& slip = result_.slip;
    const auto add = [&slip](typename Coordinate::Kind kind, const Vector3<T>& a, const T& arm,
                             const T& viscous) {
      const std::size_t k = slip.coordinates.size();
      slip.coordinates.emplace_back();
      slip.coordinates[k].kind = kind;
      slip.coordinates[k].a = a;
      slip.arm[k] = arm;
      slip.viscous[k] = viscous;
    };
    const FrictionConstants<T>& f = result_.friction;
    if (pair_.kind == PairKind::kTable || pair_.kind == PairKind::kPlanar)
      for (int k = 0; k < 2; ++k)
        add(Coordinate::Kind::kSlide, result_.C_i.col(k), T(1.0), f.viscous);
    if (pair_.kind == PairKind::kPlanar)
      add(Coordinate::Kind::kTurn, Vector3<T>::Zero(), f.pin_radius,
          f.viscous * f.pin_radius * f.pin_radius);
    if (pair_.kind == PairKind::kSpherical)
      for (int k = 0; k < 3; ++k)
        add(Coordinate::Kind::kSpin, Vector3<T>::Unit(k), f.pin_radius, f.viscous);
  }

  JointDynamicsConstants<T> dynamics(const JointDescription& joint) const {
    JointDynamicsConstants<T> d;
    d.damping = joint.damping.at(parameters_);
    d.dry_friction = joint.dry_friction.at(parameters_);
    d.armature = joint.armature.at(parameters_);
    if (joint.limit) {
      d.lower = joint.limit->lower.at(parameters_);
      d.upper = joint.limit->upper.at(parameters_);
      d.effort = joint.limit->effort.at(parameters_);
    }
    if (!joint.spring) return d;
    d.stiffness = joint.spring->stiffness.at(parameters_);
    d.spring_damping = joint.spring->damping.at(parameters_);
    d.free_position = joint.spring->free_position.at(parameters_);
    return d;
  }

  // The rotor is carried by the parent link: body i, or body j if the element is reversed.
  void place_rotor(std::size_t k, const Matrix3<T>& R_ji) {
    const ActuatorDescription& actuator = *joint(k).actuator;
    JointDynamicsConstants<T>& d = result_.dynamics[k];
    d.gear_ratio = actuator.gear_ratio.at(parameters_);
    d.rotor_inertia = actuator.rotor_inertia.at(parameters_);
    d.rotor_axis = pair_.chain[k].reversed ? Vector3<T>(R_ji * axis(k)) : axis(k);
    if (actuator.gear) d.gear = gear(*actuator.gear, d.gear_ratio);
    if (actuator.winding) d.winding = winding(*actuator.winding);
    if (!actuator.elastic) return;
    d.elastic.stiffness = actuator.elastic->stiffness.at(parameters_);
    d.elastic.damping = actuator.elastic->damping.at(parameters_);
    d.elastic.plays = actuator.elastic->backlash.has_value();
    if (d.elastic.plays) d.elastic.backlash = actuator.elastic->backlash->at(parameters_);
  }

  // The same loss in both directions of power makes eta_b = 2 - 1/eta.
  GearConstants<T> gear(const GearDescription& gear, const T& n) const {
    GearConstants<T> c;
    if (gear.efficiency) c.driving = T(1.0) / gear.efficiency->at(parameters_) - T(1.0);
    c.backdriving = gear.backdrive_efficiency
                        ? T(T(1.0) - gear.backdrive_efficiency->at(parameters_))
                        : c.driving;
    c.coulomb = (is_less(n, T(0.0), false) ? T(-n) : n) * gear.coulomb.at(parameters_);
    c.viscous = n * n * gear.viscous.at(parameters_);
    c.slip = friction(gear.slip);
    return c;
  }

  WindingConstants<T> winding(const WindingDescription& winding) const {
    WindingConstants<T> c;
    c.resistance = winding.resistance.at(parameters_);
    c.inductance = winding.inductance.at(parameters_);
    c.torque_constant = winding.torque_constant.at(parameters_);
    c.is_bounded = winding.bus_voltage.has_value();
    if (c.is_bounded) c.bus_voltage = winding.bus_voltage->at(parameters_);
    return c;
  }

  FrictionConstants<T> friction(const FrictionDescription& f) const {
    FrictionConstants<T> c;
    const auto evaluate = [this, &c](const FrictionNumberRule& rule, const Quantity& q, T& number) {
      const bool missing = q.is_zero();
      using M = FrictionNumberRule::Missing;
      if (missing && (rule.missing == M::kLengthOfOne || rule.missing == M::kOfMachine))
        number = T(1.0);
      else if (missing && rule.missing == M::kPinRadius)
        number = c.pin_radius;
      else if (missing && rule.missing == M::kTenTransitions)
        number = T(10.0) * c.transition_velocity;
      else
        number = q.at(parameters_);
    };
    visit_friction_numbers(evaluate, &f, &c);
    if (f.is_direct) c.pin_radius = T(1.0);
    return c;
  }

  const RobotDescription& robot_;
  const Topology& topology_;
  const Pair& pair_;
  const std::vector<T>& parameters_;
  ChainGeometry<T> geometry_;
  Elements turns_, slides_;
  PairConstants<T>& result_;
};

}  // namespace

template <class T>
void pair_constants(const RobotDescription& robot, const Topology& topology, const Pair& pair,
                    const Vector3<T>& centre_i, const Vector3<T>& centre_j,
                    const std::vector<T>& parameters, PairConstants<T>* constants) {
  PairBuilder<T>(robot, topology, pair, parameters, constants).build(centre_i, centre_j);
}

#define CODESIGN_INSTANTIATE(T)                                                                \
  template void pair_constants<T>(const RobotDescription&, const Topology&, const Pair&,       \
                                  const Vector3<T>&, const Vector3<T>&, const std::vector<T>&, \
                                  PairConstants<T>*);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

void check_friction_geometry(const FrictionDescription& friction, PairKind kind,
                             const std::string& element) {
  const auto require = [&](const Quantity& dimension, const char* name) {
    if (dimension.is_zero())  // the reader accepts only positive dimensions
      throw InputError({friction.where, element,
                        std::string("the friction of this joint type needs the attribute ") + name,
                        "", "> 0"});
  };
  if (friction.is_directional && slips_isotropically(kind))
    throw InputError({friction.where, element,
                      "this joint slips in several directions, none of which is backward", "",
                      "mu_static_backward, mu_dynamic_backward and viscous_backward on revolute, "
                      "continuous, prismatic and cylindrical joints"});
  if (friction.has_exponent && slips_isotropically(kind))
    throw InputError(
        {friction.where, element,
         "this joint slips in several directions, for which the viscous load has no "
         "exponent",
         "", "viscous_exponent on revolute, continuous, prismatic and cylindrical joints"});
  if (friction.is_direct) {
    if (kind->has_one_coordinate()) return;
    throw InputError({friction.where, element,
                      "friction in N m or N needs a joint with one coordinate", "",
                      "revolute, continuous and prismatic joints; coefficients on others"});
  }
  const BearingLaw& bearing = kind->bearing;
  if (!bearing.normal_force)
    throw InputError(
        {friction.where, element, "joints of this type have no friction law", "",
         "friction on revolute, continuous, prismatic, cylindrical, spherical and planar joints"});
  if (bearing.joint_length) require(friction.joint_length, "joint_length");
  if (bearing.joint_width) require(friction.joint_width, "joint_width");
  if (bearing.pin_radius) require(friction.pin_radius, "pin_radius");
}

}  // namespace codesign
